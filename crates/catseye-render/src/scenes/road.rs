//! The road: asphalt, markings, studs, delineator posts.

use glam::Vec3;

use super::materials::{AMBER, Finish, WHITE};
use crate::sampler::combine;
use crate::{Bsdf, Error, Mesh, SceneBuilder};

/// Half the width of the asphalt.
pub(crate) const HALF_WIDTH: f32 = 2.05;
/// How far the road goes.
pub(crate) const LENGTH: f32 = 400.0;
/// White of the markings.
const PAINT: Vec3 = Vec3::splat(0.6);
/// Height of markings over the asphalt.
const MARKING: f32 = 0.003;

/// Adds the road and the line in its middle.
pub(crate) fn add(builder: &mut SceneBuilder) {
    let asphalt = builder.material(Bsdf::matte(Vec3::new(0.2, 0.2, 0.205)));
    builder.mesh(surface(), asphalt);
    let paint = builder.material(Bsdf::matte(PAINT));
    for i in 0..40 {
        builder.mesh(strip(0.0, 0.06, 4.0 + 6.0 * i as f32, 3.0), paint);
    }
}

/// Adds the line along one side, its studs and its posts; `side` is 1 for the right one.
pub(crate) fn add_side(
    builder: &mut SceneBuilder,
    side: f32,
    studs: &Finish,
    posts: &Finish,
) -> Result<(), Error> {
    let paint = builder.material(Bsdf::matte(PAINT));
    builder.mesh(strip(side * (HALF_WIDTH - 0.2), 0.06, 0.0, LENGTH), paint);
    let stud = studs.material(builder, AMBER)?;
    let reflector = posts.material(builder, WHITE)?;
    let body = builder.material(Bsdf::matte(Vec3::splat(0.5)));
    for i in 0..9 {
        add_stud(builder, Vec3::new(side * (HALF_WIDTH - 0.4), 0.0, -4.6 - 5.0 * i as f32), stud, body);
    }
    for i in 0..5 {
        let foot = Vec3::new(side * (HALF_WIDTH + 0.55), 0.0, -17.0 - 11.0 * i as f32);
        add_post(builder, foot, reflector, body);
    }
    Ok(())
}

/// Asphalt with the grain of its stones, finer near the camera.
fn surface() -> Mesh {
    const ROWS: u32 = 360;
    const COLUMNS: u32 = 80;
    // Rows that grow with the distance look alike from the camera.
    let depth = |t: f32| LENGTH * (t * 5.0).exp_m1() / 5.0_f32.exp_m1();
    let mut mesh =
        Mesh::grid([COLUMNS, ROWS], |s, t| Vec3::new((2.0 * s - 1.0) * HALF_WIDTH, 0.0, 1.0 - depth(t)));
    mesh.colors = (0..mesh.positions.len() as u32).map(|i| Vec3::splat(0.55 + 0.45 * random(i, 0))).collect();
    mesh
}

/// A painted line, `half_width` to each side of `x`, beginning at the distance `start`.
fn strip(x: f32, half_width: f32, start: f32, length: f32) -> Mesh {
    let corner = Vec3::new(x - half_width, MARKING, -start);
    Mesh::quad(corner, Vec3::X * (2.0 * half_width), Vec3::NEG_Z * length)
}

fn add_stud(builder: &mut SceneBuilder, foot: Vec3, face: crate::MaterialId, body: crate::MaterialId) {
    builder.mesh(Mesh::cuboid(foot + Vec3::Y * 0.012, Vec3::new(0.13, 0.024, 0.10)), body);
    let slope = Mesh::quad(Vec3::new(-0.055, 0.002, 0.066), Vec3::X * 0.11, Vec3::new(0.0, 0.026, -0.014));
    builder.mesh(slope.translated(foot), face);
}

fn add_post(builder: &mut SceneBuilder, foot: Vec3, face: crate::MaterialId, body: crate::MaterialId) {
    builder.mesh(Mesh::cuboid(foot + Vec3::Y * 0.5, Vec3::new(0.12, 1.0, 0.08)), body);
    let reflector = Mesh::quad(Vec3::new(-0.045, 0.72, 0.043), Vec3::X * 0.09, Vec3::Y * 0.2);
    builder.mesh(reflector.translated(foot), face);
}

/// A fixed random number in `[0, 1)` for a thing and a purpose.
pub(crate) fn random(thing: u32, purpose: u32) -> f32 {
    (combine(combine(0x6361_7473, thing), purpose) >> 8) as f32 / (1 << 24) as f32
}
