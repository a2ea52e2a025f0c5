//! A traffic cone.

use glam::Vec3;

use super::materials::{Finish, WHITE};
use crate::{Bsdf, Error, Mesh, SceneBuilder};

/// Fluorescent orange, without the fluorescence.
const ORANGE: Vec3 = Vec3::new(0.85, 0.16, 0.015);

/// Adds a cone 0.75 m high with two white bands at `foot`.
pub(crate) fn add(builder: &mut SceneBuilder, foot: Vec3, finish: &Finish) -> Result<(), Error> {
    /// Heights where the cone changes from plastic to band and back.
    const EDGES: [f32; 6] = [0.045, 0.26, 0.42, 0.52, 0.62, 0.75];
    let plastic = builder.material(Bsdf::matte(ORANGE));
    let rubber = builder.material(Bsdf::matte(Vec3::splat(0.035)));
    let band = finish.material(builder, WHITE)?;

    let base = Mesh::cuboid(Vec3::Y * 0.02, Vec3::new(0.44, 0.04, 0.44)).rotated(Vec3::Y, 0.35);
    builder.mesh(base.translated(foot), rubber);
    let at = |y: f32| [0.165 - 0.173 * y, y];
    for (i, edge) in EDGES.windows(2).enumerate() {
        let part = Mesh::lathe(&[at(edge[0]), at(edge[1])], 64).translated(foot);
        builder.mesh(part, if i % 2 == 0 { plastic } else { band });
    }
    let rim = Mesh::lathe(&[[0.19, 0.04], [0.19, 0.05], at(0.06)], 64);
    let tip = Mesh::lathe(&[at(0.75), [0.0, 0.752]], 64);
    builder.mesh(rim.merged(&tip).translated(foot), plastic);
    Ok(())
}
