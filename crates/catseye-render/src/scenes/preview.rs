//! A stage for one material.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use catseye_materialx::Material;
use glam::Vec3;

use super::Lighting;
use crate::light::{AreaLight, Environment, SphereLight};
use crate::{Bsdf, Camera, Error, Frame, Mesh, PictureInfo, Scene, SceneBuilder, Sphere, ToneMap};

/// Where the camera stands.
const EYE: Vec3 = Vec3::new(0.0, 2.1, 11.0);
/// What it looks at.
const TARGET: Vec3 = Vec3::new(0.0, 0.78, 0.0);
/// Angle in degrees between camera and headlamp, seen from the target, where none is asked for: the first
/// observation angle of ASTM D4956's tables.
const LAMP_DEG: f32 = 0.2;
/// Irradiance that the headlamp brings to a surface at the target that faces it, the same for all materials:
/// sheeting with an `R_A` of 250 cd/lx/m2 shines with the radiance 75, a lobe of roughness 0.5 with 0.2,
/// about as the white ball.
const LAMP_IRRADIANCE: f32 = 0.3;
/// Radius of the lamp, and of one that a perfect retro-reflector shows as bright as sheeting of about 450
/// cd/lx/m2.
const LAMP_RADIUS: f32 = 0.006;
const WIDE_LAMP_RADIUS: f32 = 0.3;
/// How far the lamp stands behind the camera's pinhole, through which it shines where they are in line.
const LAMP_BEHIND: f32 = 1e-3;

/// Radiance that a path may bring of indirect light, about that of the white ball: the lamp is tiny and would
/// make specks.
const INDIRECT_LIMIT: f32 = 0.6;

pub(crate) fn scene(materials: [&Material; 2], lighting: &Lighting) -> Result<Scene, Error> {
    let mut builder = SceneBuilder::new(Camera::perspective(EYE, TARGET, Vec3::Y, 0.235));
    let [sphere, sheet] = materials.map(|material| builder.materialx(material, lighting.model));
    let ground = builder.material(Bsdf::matte(Vec3::splat(0.16)));
    let white = builder.material(Bsdf::matte(Vec3::splat(0.8)));

    builder.sphere(Sphere { centre: Vec3::new(-1.0, 0.9, 0.0), radius: 0.9 }, sphere?);
    builder.mesh(folded_sheet(), sheet?);
    builder.sphere(Sphere { centre: Vec3::new(0.12, 0.2, 1.0), radius: 0.2 }, white);
    builder.mesh(studio(), ground);
    let mirrors = builder.has_retro_mirror();
    let lamp_deg = lighting.lamp_deg.unwrap_or(if mirrors { 0.0 } else { LAMP_DEG });
    builder.light(headlamp(lamp_deg, if mirrors { WIDE_LAMP_RADIUS } else { LAMP_RADIUS }));
    add_panels(&mut builder);
    builder.light(Environment::Constant(Vec3::new(0.03, 0.035, 0.045)));
    builder.indirect_limit(INDIRECT_LIMIT);
    builder.tone_map(ToneMap { exposure_ev: 3.0, white: 2400.0, glare: 0.001 });
    builder.info(PictureInfo {
        units: format!("radiance, the headlamp's irradiance {LAMP_IRRADIANCE}"),
        lamp_deg: Some(lamp_deg),
        ..PictureInfo::default()
    });
    builder.build()
}

fn headlamp(lamp_deg: f32, radius: f32) -> SphereLight {
    let wo = (EYE - TARGET).normalize();
    let aside = Vec3::X * (EYE.distance(TARGET) * lamp_deg.to_radians().tan());
    let sphere = Sphere { centre: EYE + aside + wo * (LAMP_BEHIND + radius), radius };
    let intensity = LAMP_IRRADIANCE * sphere.centre.distance_squared(TARGET);
    SphereLight::new(sphere, Vec3::splat(intensity / (PI * radius * radius)))
}

/// Soft lights: a warm one from the left, a cool one from behind on the right.
fn add_panels(builder: &mut SceneBuilder) {
    let mut panel = |centre: Vec3, half_size: f32, radiance: Vec3| {
        let frame = Frame::from_normal((Vec3::Y * 0.8 - centre).normalize());
        builder.light(AreaLight::rectangle(centre, frame.x * half_size, frame.y * half_size, radiance));
    };
    panel(Vec3::new(-6.0, 6.0, 3.5), 1.4, Vec3::new(1.0, 0.93, 0.84) * 7.0);
    panel(Vec3::new(5.5, 5.0, -2.5), 1.0, Vec3::new(0.6, 0.78, 1.0) * 12.0);
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
