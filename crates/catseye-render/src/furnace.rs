//! The white furnace: a sphere in light that is the same from everywhere.
//!
//! A surface that returns all energy can't be seen in it: the radiance is 1 in every direction. What it loses
//! makes it darker than the background.

use catseye::AnyLobe;
use glam::Vec3;

use crate::light::Environment;
use crate::{
    Bsdf, Camera, Error, Filter, Image, RenderSettings, Scene, SceneBuilder, Sphere, ToneMap, render,
};

/// Height of the picture over the diameter of the sphere.
const MARGIN: f32 = 1.15;

/// A unit sphere of the given BSDF in an environment of radiance 1, seen by a parallel projection.
///
/// # Errors
/// None for any BSDF; the type is that of all scenes.
pub fn scene(bsdf: Bsdf) -> Result<Scene, Error> {
    framed_scene(bsdf, 2.0 * MARGIN)
}

fn framed_scene(bsdf: Bsdf, height: f32) -> Result<Scene, Error> {
    let camera = Camera::orthographic(Vec3::Z * 4.0, Vec3::ZERO, Vec3::Y, height);
    let mut builder = SceneBuilder::new(camera);
    let material = builder.material(bsdf);
    builder.sphere(Sphere { centre: Vec3::ZERO, radius: 1.0 }, material);
    builder.light(Environment::Constant(Vec3::ONE));
    builder.tone_map(ToneMap::LINEAR);
    builder.build()
}

/// The picture of a sphere with one retro-reflective lobe in the furnace, `size` pixels square.
///
/// # Errors
/// A size or number of samples out of range.
pub fn sphere(lobe: AnyLobe<f32>, size: usize, spp: u32) -> Result<Image, Error> {
    let settings =
        RenderSettings { width: size, height: size, spp, max_depth: 2, ..RenderSettings::default() };
    render(&scene(Bsdf::from_lobe(lobe))?, &settings, &|_| ())
}

/// The mean radiance over the disk that the sphere covers, per channel: by Lambert's projection the
/// hemispherical (cosine-weighted) mean of the directional albedo.
///
/// It is estimated from `samples` paths (at least 1); the error falls about as 1 / samples.
///
/// # Errors
/// Too many samples for a picture.
pub fn mean_albedo(lobe: AnyLobe<f32>, samples: u32) -> Result<[f32; 3], Error> {
    // A square inscribed in the disk would miss its rim: render the bounding square, and take the corners,
    // where the radiance is exactly 1, off again.
    let side = 64;
    let settings = RenderSettings {
        width: side,
        height: side,
        spp: samples.div_ceil((side * side) as u32).max(1),
        max_depth: 2,
        filter: Filter::pixel(),
        ..RenderSettings::default()
    };
    let image = render(&framed_scene(Bsdf::from_lobe(lobe), 2.0)?, &settings, &|_| ())?;
    let covered = std::f32::consts::FRAC_PI_4;
    Ok(image.mean().map(|mean| (mean - (1.0 - covered)) / covered))
}
