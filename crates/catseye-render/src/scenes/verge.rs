//! What lies beside and behind the road: grass, a hedge of trees against the sky.

use glam::Vec3;

use super::road::{HALF_WIDTH, LENGTH, random};
use crate::{Bsdf, Mesh, SceneBuilder};

/// Adds the ground beside the road, blades of grass and a tree line.
pub(crate) fn add(builder: &mut SceneBuilder) {
    let soil = builder.material(Bsdf::matte(Vec3::new(0.11, 0.125, 0.06)));
    let grass = builder.material(Bsdf::matte(Vec3::new(0.22, 0.31, 0.08)));
    let trees = builder.material(Bsdf::matte(Vec3::new(0.03, 0.035, 0.03)));
    for side in [-1.0, 1.0] {
        let inner = side * HALF_WIDTH;
        let (from, to) = if side < 0.0 { (inner - 300.0, inner) } else { (inner, inner + 300.0) };
        let ground =
            Mesh::quad(Vec3::new(from, -0.01, 2.0), Vec3::X * (to - from), Vec3::NEG_Z * (LENGTH + 2.0));
        builder.mesh(ground, soil);
        builder.mesh(blades(side), grass);
    }
    builder.mesh(tree_line(), trees);
}

/// Blades of grass along one side of the road, each a triangle.
fn blades(side: f32) -> Mesh {
    const COUNT: u32 = 26_000;
    let mut mesh = Mesh::default();
    for i in 0..COUNT {
        let thing = if side < 0.0 { i } else { i + COUNT };
        let pick = |purpose: u32| random(thing, purpose);
        // Dense at the edge of the asphalt and near the camera.
        let x = side * (HALF_WIDTH + 0.02 + 4.5 * pick(0) * pick(1));
        let z = -3.0 - 45.0 * pick(2) * pick(3);
        let height = 0.05 + 0.16 * pick(4) * pick(5);
        let foot = Vec3::new(x, -0.01, z);
        let turn = std::f32::consts::TAU * pick(6);
        let width = Vec3::new(turn.cos(), 0.0, turn.sin()) * (0.004 + 0.006 * pick(7));
        let lean = Vec3::new(pick(8) - 0.5, 0.0, pick(9) - 0.5) * (height * 0.9);
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([foot - width, foot + width, foot + lean + Vec3::Y * height]);
        mesh.colors.extend([Vec3::splat(0.35 + 0.65 * pick(10)); 3]);
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    mesh
}

/// The outline of a wood at the end of the road.
fn tree_line() -> Mesh {
    const COLUMNS: u32 = 600;
    let height = |x: f32| {
        let hill = 4.0 + 3.0 * (0.012 * x + 0.6).sin() + 1.6 * (0.05 * x).sin();
        // The road leaves a gap.
        let gap = 1.0 - 0.75 * (-(x / 14.0).powi(2)).exp();
        let crown = random((x * 1.7 + 4000.0) as u32, 20) * 1.8 + random((x * 0.4 + 4000.0) as u32, 21) * 2.2;
        (hill + crown) * gap
    };
    Mesh::grid([COLUMNS, 1], |s, t| {
        let x = (s - 0.5) * 300.0;
        Vec3::new(x, -0.5 + t * height(x), -160.0)
    })
}
