//! A warning sign on its post.

use glam::{Affine3A, Vec2, Vec3};

use super::cat;
use super::materials::{CAT_GREEN, Finish, RED, WHITE};
use crate::mesh::polygon::{regular, rounded};
use crate::{Bsdf, Error, Mesh, SceneBuilder};

/// Radius of the circle around the triangle, before its corners are rounded.
const RADIUS: f32 = 0.95;
/// Height of the panel's centre above the ground.
const HEIGHT: f32 = 1.95;
/// Distance between layers of sheeting: thicker than in life, so that they can be told apart in single
/// precision.
const LAYER: f32 = 0.003;

/// Adds a triangular warning sign whose post stands at `foot`, turned to the camera.
pub(crate) fn add(builder: &mut SceneBuilder, foot: Vec3, finish: &Finish) -> Result<(), Error> {
    let metal = builder.material(Bsdf::matte(Vec3::splat(0.32)));
    let black = builder.material(Bsdf::matte(Vec3::splat(0.012)));
    let white = finish.material(builder, WHITE)?;
    let red = finish.material(builder, RED)?;
    let green = finish.material(builder, CAT_GREEN)?;

    // Signs are turned a little away from the traffic, against mirror reflections.
    let place = Affine3A::from_translation(foot) * Affine3A::from_rotation_y(-0.06 * foot.x.signum());
    let top = HEIGHT + 0.6 * RADIUS;
    let post = Mesh::lathe(&[[0.0382, 0.0], [0.0382, top], [0.0, top + 0.02]], 32);
    builder.mesh(post.transformed(place), metal);

    let outline =
        |radius: f32, corner: f32| rounded(&regular(3, radius, std::f32::consts::FRAC_PI_2), corner, 10);
    let panel = place * Affine3A::from_translation(Vec3::new(0.0, HEIGHT, 0.06));
    let raised = |mesh: Mesh, layers: f32| {
        mesh.transformed(panel * Affine3A::from_translation(Vec3::Z * (LAYER * layers)))
    };
    builder.mesh(raised(Mesh::plate(&outline(RADIUS, 0.09), 0.02), 0.0), metal);
    builder
        .mesh(raised(Mesh::border(&outline(RADIUS - 0.02, 0.08), &outline(RADIUS - 0.25, 0.02)), 1.0), red);
    builder.mesh(raised(Mesh::polygon(&outline(RADIUS - 0.25, 0.02)), 1.0), white);

    let scaled =
        |points: Vec<Vec2>| -> Vec<Vec2> { points.into_iter().map(|p| p * 0.235 - Vec2::Y * 0.07).collect() };
    builder.mesh(raised(Mesh::polygon(&scaled(cat::head())), 2.0), black);
    for side in [-1.0, 1.0] {
        builder.mesh(raised(Mesh::polygon(&scaled(cat::eye(side))), 3.0), green);
        builder.mesh(raised(Mesh::polygon(&scaled(cat::pupil(side))), 4.0), black);
    }
    Ok(())
}
