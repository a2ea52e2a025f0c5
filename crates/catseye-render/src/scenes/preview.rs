//! A stage for one material.

use catseye::Model;
use catseye_materialx::Material;
use glam::Vec3;

use crate::light::{AreaLight, Environment, SphereLight};
use crate::{Bsdf, Camera, Error, Mesh, Scene, SceneBuilder, Sphere, ToneMap};

/// Where the camera stands.
const EYE: Vec3 = Vec3::new(0.0, 1.7, 9.0);
/// What it looks at.
const TARGET: Vec3 = Vec3::new(0.0, 0.82, 0.0);
/// Angle between camera and headlamp, seen from the target: the first observation angle of ASTM D4956's tables.
const OBSERVATION_ANGLE: f32 = 0.2 * std::f32::consts::PI / 180.0;

pub(crate) fn scene(material: &Material, model: Model) -> Result<Scene, Error> {
    let mut builder = SceneBuilder::new(Camera::perspective(EYE, TARGET, Vec3::Y, 0.29));
    let subject = builder.materialx(material, model)?;
    builder.sphere(Sphere { centre: Vec3::new(-1.05, 1.0, 0.0), radius: 1.0 }, subject);
    builder.mesh(folded_sheet(), subject);
    let ground = builder.material(Bsdf::matte(Vec3::splat(0.18)));
    builder.mesh(Mesh::quad(Vec3::new(-60.0, 0.0, 20.0), Vec3::X * 120.0, Vec3::NEG_Z * 120.0), ground);
    let lamp = EYE + Vec3::X * ((EYE - TARGET).length() * OBSERVATION_ANGLE.tan());
    builder.light(SphereLight::new(Sphere { centre: lamp, radius: 0.008 }, Vec3::splat(6.0e4)));
    let key = Vec3::new(-5.0, 5.0, 3.0);
    let (u, v) = (Vec3::new(0.5, 0.0, 0.85) * 1.2, Vec3::new(0.55, 0.75, -0.32) * 1.2);
    builder.light(AreaLight::rectangle(key, u, v, Vec3::new(1.0, 0.95, 0.88) * 3.0));
    builder.light(Environment::Constant(Vec3::new(0.045, 0.055, 0.075)));
    builder.tone_map(ToneMap { exposure_ev: 0.0, white: 8.0 });
    builder.build()
}

/// A sheet that waves like a flag: every angle between surface and camera in one piece.
fn folded_sheet() -> Mesh {
    let mut mesh = Mesh::grid([96, 24], |s, t| {
        let wave = 0.28 * (s * std::f32::consts::TAU * 1.25).sin();
        Vec3::new(0.25 + 1.75 * s, 0.06 + 1.7 * t, wave + 0.1 * (t - 0.5))
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
