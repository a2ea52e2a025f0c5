//! A stage for one material.

use std::f32::consts::{FRAC_PI_2, TAU};

use catseye::Model;
use catseye_materialx::Material;
use glam::Vec3;

use crate::light::{AreaLight, Environment, SphereLight};
use crate::{Bsdf, Camera, Error, Frame, Mesh, Scene, SceneBuilder, Sphere, ToneMap};

/// Where the camera stands.
const EYE: Vec3 = Vec3::new(0.0, 2.1, 11.0);
/// What it looks at.
const TARGET: Vec3 = Vec3::new(0.0, 0.78, 0.0);
/// Angle between camera and headlamp, seen from the target: the first observation angle of ASTM D4956's tables.
const OBSERVATION_ANGLE: f32 = 0.2 * std::f32::consts::PI / 180.0;
/// Irradiance at the target by the headlamp for a material that doesn't send much of it back.
const LAMP_IRRADIANCE: f32 = 0.8;
/// Radiance that the lamp is dimmed to where more would come back.
const LAMP_RETURN: f32 = 0.7;

pub(crate) fn scene(material: &Material, model: Model) -> Result<Scene, Error> {
    let mut builder = SceneBuilder::new(Camera::perspective(EYE, TARGET, Vec3::Y, 0.235));
    let bsdf = Bsdf::with_model(&material.bsdf, model)?;
    let lamp = EYE + Vec3::X * (EYE.distance(TARGET) * OBSERVATION_ANGLE.tan());
    let irradiance = LAMP_IRRADIANCE.min(LAMP_RETURN / returned(&bsdf, lamp).max(1e-6));
    let subject = builder.translucent_material(bsdf, material.opacity);
    let ground = builder.material(Bsdf::matte(Vec3::splat(0.16)));
    let white = builder.material(Bsdf::matte(Vec3::splat(0.8)));

    builder.sphere(Sphere { centre: Vec3::new(-1.0, 0.9, 0.0), radius: 0.9 }, subject);
    builder.mesh(folded_sheet(), subject);
    builder.sphere(Sphere { centre: Vec3::new(0.12, 0.2, 1.0), radius: 0.2 }, white);
    builder.mesh(studio(), ground);
    add_lights(&mut builder, lamp, irradiance);
    builder.tone_map(ToneMap { exposure_ev: 0.4, white: 4.0, glare: 0.01 });
    builder.build()
}

/// The share f cos of the lamp's irradiance that a surface 30 degrees from the line of sight sends to the camera.
fn returned(bsdf: &Bsdf, lamp: Vec3) -> f32 {
    let (wo, wi) = ((EYE - TARGET).normalize(), (lamp - TARGET).normalize());
    let normal = Frame::from_normal(wo).to_world(Vec3::new(0.5, 0.0, 0.75_f32.sqrt()));
    let (f_cos, _) = bsdf.at(Frame::from_normal(normal), wo, false).eval_pdf(wi);
    f_cos.max_element()
}

fn add_lights(builder: &mut SceneBuilder, lamp: Vec3, irradiance: f32) {
    let sphere = Sphere { centre: lamp, radius: 0.006 };
    let intensity = irradiance * lamp.distance_squared(TARGET);
    let radiance = intensity / (std::f32::consts::PI * sphere.radius * sphere.radius);
    builder.light(SphereLight::new(sphere, Vec3::splat(radiance)));
    let mut panel = |centre: Vec3, half_size: f32, radiance: Vec3| {
        let frame = Frame::from_normal((Vec3::Y * 0.8 - centre).normalize());
        builder.light(AreaLight::rectangle(centre, frame.x * half_size, frame.y * half_size, radiance));
    };
    panel(Vec3::new(-6.0, 6.0, 3.5), 1.4, Vec3::new(1.0, 0.93, 0.84) * 7.0);
    panel(Vec3::new(5.5, 5.0, -2.5), 1.0, Vec3::new(0.6, 0.78, 1.0) * 12.0);
    builder.light(Environment::Constant(Vec3::new(0.03, 0.035, 0.045)));
}

/// A sheet that waves like a flag: many angles between surface and camera in one piece.
fn folded_sheet() -> Mesh {
    let mut mesh = Mesh::grid([160, 40], |s, t| {
        let wave = 0.32 * (s * TAU * 1.5 + 0.4).sin();
        Vec3::new(0.42 + 1.55 * s, 0.0005 + 1.62 * t, wave - 0.2)
    });
    mesh.normals = smooth_normals(&mesh);
    mesh
}

/// A ground that bends up into a wall behind: no horizon.
fn studio() -> Mesh {
    const DEPTH: f32 = -3.5;
    const BEND: f32 = 3.0;
    let profile = |t: f32| match t {
        t if t < 0.4 => [12.0 + (DEPTH - 12.0) * t / 0.4, 0.0],
        t if t < 0.8 => {
            let angle = FRAC_PI_2 * (t - 0.4) / 0.4;
            [DEPTH - BEND * angle.sin(), BEND * (1.0 - angle.cos())]
        }
        t => [DEPTH - BEND, BEND + 40.0 * (t - 0.8)],
    };
    let mut mesh = Mesh::grid([1, 80], |s, t| {
        let [z, y] = profile(t);
        Vec3::new(60.0 * (s - 0.5), y, z)
    });
    mesh.normals = smooth_normals(&mesh);
    mesh
}

/// Normals averaged over the triangles around each vertex, by area.
fn smooth_normals(mesh: &Mesh) -> Vec<Vec3> {
    let mut normals = vec![Vec3::ZERO; mesh.positions.len()];
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
        for &i in triangle {
            normals[i as usize] += (b - a).cross(c - a);
        }
    }
    normals
}
