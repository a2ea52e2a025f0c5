//! A specimen gives the BSDF of its material, within the precision of f32.

use catseye::{Lobe as _, Model, Params, Reciprocal, Vec3};
use catseye_materialx::{Closure, Document, Material};
use catseye_render::{Error, Specimen};

/// Directions at an observation and an entrance angle in the plane of the normal, in degrees.
fn directions(observation_deg: f64, entrance_deg: f64) -> [Vec3<f64>; 2] {
    [entrance_deg - observation_deg, entrance_deg].map(|deg| Vec3::from_angles(deg.to_radians(), 0.0))
}

fn retro(roughness: f32) -> Material {
    let params = Params::isotropic(roughness).with_tint([0.5, 0.25, 0.125]);
    let bsdf = Closure::RetroReflective { weight: 1.0, params };
    Material { name: "sheeting".to_owned(), ..Material::of(bsdf) }
}

#[test]
fn single_precision_is_enough_from_a_tenth_of_a_degree_on() {
    let (mut worst, mut of_standards): (f64, f64) = (0.0, 0.0);
    for roughness in [0.0005_f32, 0.001, 0.003, 0.0057, 0.02, 0.1, 1.0] {
        let specimen = Specimen::new(&retro(roughness), Model::Reciprocal).unwrap();
        let exact = Reciprocal::<f64>::new(&Params::isotropic(f64::from(roughness))).unwrap();
        for observation in [0.1, 0.2, 0.33, 0.5, 1.0, 1.5, 2.0] {
            for entrance in [-40.0, -4.0, 5.0, 30.0, 60.0, 88.76] {
                let [wo, wi] = directions(observation, entrance);
                let expected = 0.5 * exact.eval(wo, wi)[0];
                // What is a millionth of the peak is nothing to a photometer.
                if expected < 1e-6 * 0.5 * exact.eval(wi, wi)[0] {
                    continue;
                }
                let [r, g, _] = specimen.eval(wo, wi).unwrap();
                let error = (r / expected - 1.0).abs();
                worst = worst.max(error);
                let at_a_limit = observation > 0.1 && expected > 1e-4 * 0.5 * exact.eval(wi, wi)[0];
                of_standards = of_standards.max(if at_a_limit { error } else { 0.0 });
                assert!((g / r - 0.5).abs() < 1e-6);
            }
        }
    }
    println!("worst {worst:e}, at the angles of standards {of_standards:e}");
    assert!(worst < 1e-3, "{worst:e}");
    // `catseye_photometry::verdict::EVALUATION`, which verdicts allow for.
    assert!(of_standards < 1e-4, "{of_standards:e}");
}

#[test]
fn patterns_see_the_receiver() {
    let text = r#"
        <materialx version="1.39">
          <facingratio name="cosine" type="float" />
          <oren_nayar_diffuse_bsdf name="paint" type="BSDF">
            <input name="weight" type="float" nodename="cosine" />
          </oren_nayar_diffuse_bsdf>
          <surface name="skin" type="surfaceshader">
            <input name="bsdf" type="BSDF" nodename="paint" />
            <input name="opacity" type="float" value="0.5" />
          </surface>
          <surfacematerial name="m" type="material">
            <input name="surfaceshader" type="surfaceshader" nodename="skin" />
          </surfacematerial>
        </materialx>"#;
    let material = Document::parse(text, "t.mtlx").unwrap().material(None).unwrap();
    let specimen = Specimen::new(&material, Model::Reciprocal).unwrap();
    let at = |deg: f64| {
        specimen.eval(Vec3::from_angles(deg.to_radians(), 0.4), Vec3::new(0.0, 0.0, 1.0)).unwrap()[0]
    };
    let ratio = at(60.0) / at(0.0);
    assert!((ratio - 0.5).abs() < 1e-5, "{ratio}: the weight is the cosine to the viewer");
    assert!((at(0.0) - 0.5 * 0.18 / std::f64::consts::PI).abs() < 1e-6, "{}", at(0.0));
    let below = specimen.eval(Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.0, 0.0, 1.0)).unwrap();
    assert_eq!(below, [0.0; 3]);
}

#[test]
fn a_perfect_retro_reflector_is_refused() {
    let [wo, wi] = directions(0.2, 5.0);
    let error = Specimen::new(&retro(0.0), Model::Reciprocal).unwrap().eval(wo, wi).unwrap_err();
    assert!(matches!(error, Error::RetroMirror), "{error}");
}
