//! What a document makes vary over a surface varies in the picture, and lobes that are asked to send light
//! back do.

use catseye::Model;
use catseye_materialx::{Closure, Document, Material};
use catseye_render::light::Environment;
use catseye_render::{Bsdf, Camera, Frame, Scene, SceneBuilder, Sphere};
use glam::Vec3;

use crate::common::{outgoing, picture, points};

/// A material with these nodes, the surface's inputs among them.
fn material(nodes: &str, surface: &str) -> Material {
    let text = format!(
        r#"<materialx version="1.39">{nodes}<surface name="surface" type="surfaceshader">{surface}</surface>
        <surfacematerial name="m" type="material">
          <input name="surfaceshader" type="surfaceshader" nodename="surface" />
        </surfacematerial></materialx>"#
    );
    Document::parse(&text, "test.mtlx")
        .and_then(|document| document.material(None))
        .expect("the document is legal")
}

/// A sphere in white light, seen from the front; x to the right.
fn scene(material: &Material) -> Scene {
    let mut builder =
        SceneBuilder::new(Camera::perspective(Vec3::new(0.0, 0.0, 10.0), Vec3::ZERO, Vec3::Y, 0.2));
    let id = builder.materialx(material, Model::Reciprocal).expect("the material is legal");
    builder.sphere(Sphere { centre: Vec3::ZERO, radius: 0.9 }, id);
    builder.light(Environment::Constant(Vec3::ONE));
    builder.build().expect("the scene is legal")
}

const RAMP: &str = r#"<position name="at" type="vector3" />
    <extract name="x" type="float">
      <input name="in" type="vector3" nodename="at" />
      <input name="index" type="integer" value="0" />
    </extract>
    <smoothstep name="step" type="float">
      <input name="in" type="float" nodename="x" />
      <input name="low" type="float" value="-0.1" />
      <input name="high" type="float" value="0.1" />
    </smoothstep>
    <convert name="grey" type="color3"><input name="in" type="float" nodename="step" /></convert>"#;

/// Mean values left and right of the middle.
fn halves(material: &Material) -> [f32; 2] {
    let image = picture(&scene(material), [32, 32], 16, 4);
    [10, 21].map(|x| image.pixel(x, 16)[0])
}

#[test]
fn colour_emission_and_opacity_vary() {
    let diffuse = r#"<oren_nayar_diffuse_bsdf name="d" type="BSDF">
      <input name="color" type="color3" nodename="grey" />
    </oren_nayar_diffuse_bsdf>"#;
    let [left, right] =
        halves(&material(&format!("{RAMP}{diffuse}"), r#"<input name="bsdf" type="BSDF" nodename="d" />"#));
    assert!(left < 0.01 && right > 0.9, "colour: {left} {right}");

    let glow = r#"<uniform_edf name="e" type="EDF">
      <input name="color" type="color3" nodename="grey" />
    </uniform_edf>"#;
    let [left, right] =
        halves(&material(&format!("{RAMP}{glow}"), r#"<input name="edf" type="EDF" nodename="e" />"#));
    assert!(left == 0.0 && (right - 1.0).abs() < 1e-5, "emission: {left} {right}");

    // Nothing scatters: what is opaque is black, what is not shows the light behind.
    let [left, right] = halves(&material(RAMP, r#"<input name="opacity" type="float" nodename="step" />"#));
    assert!(left > 0.99 && right < 0.01, "opacity: {left} {right}");
}

#[test]
fn retroreflective_mirrors_send_light_back() {
    let frame = Frame { x: Vec3::X, y: Vec3::Y, z: Vec3::Z };
    for retroreflective in [false, true] {
        let metal = Closure::Conductor {
            weight: 1.0,
            ior: [0.2; 3],
            extinction: [3.0; 3],
            roughness: [0.0; 2],
            retroreflective,
        };
        let bsdf = Bsdf::new(&metal).expect("the closure is legal");
        for wo in outgoing() {
            let mirrored = Vec3::new(-wo.x, -wo.y, wo.z);
            let expected = if retroreflective { wo } else { mirrored };
            for u in points(4) {
                let sample = bsdf.at(frame, wo, false).sample(u).expect("mirrors lose no sample");
                assert!(sample.wi.distance(expected) < 1e-5 && sample.is_dirac, "{wo}: {}", sample.wi);
            }
        }
    }
}
