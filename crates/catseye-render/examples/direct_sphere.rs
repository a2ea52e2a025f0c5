//! A sphere in direct light, to be compared with other renderers' pictures of it.
//!
//! `cargo run --release -p catseye-render --example direct_sphere -- MATERIAL.mtlx PIXELS sphere.exr`
//!
//! The unit sphere around the origin is seen from (0, 0, 5) with a field of view of 26 degrees.
//! Light of irradiance 3 comes from a direction 3 degrees to the right of the view's axis.

use catseye::Model;
use catseye_materialx::Document;
use catseye_render::glam::Vec3;
use catseye_render::light::DistantLight;
use catseye_render::{Camera, Filter, PictureInfo, RenderSettings, SceneBuilder, Sphere, encode_exr, render};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [material, pixels, output] = arguments.as_slice() else {
        return Err("usage: direct_sphere MATERIAL.mtlx PIXELS OUTPUT.exr".into());
    };
    let pixels = pixels.parse()?;

    let camera = Camera::perspective(Vec3::Z * 5.0, Vec3::ZERO, Vec3::Y, 26.0_f32.to_radians());
    let mut scene = SceneBuilder::new(camera);
    let material = scene.materialx(&Document::load(material)?.material(None)?, Model::Reciprocal)?;
    scene.sphere(Sphere { centre: Vec3::ZERO, radius: 1.0 }, material);
    let angle = 3.0_f32.to_radians();
    scene.light(DistantLight::new(Vec3::new(angle.sin(), 0.0, angle.cos()), 1e-4, Vec3::splat(3.0)));

    let (spp, filter) = (64, Filter::pixel());
    let settings = RenderSettings {
        width: pixels,
        height: pixels,
        spp,
        max_depth: 1,
        filter,
        ..RenderSettings::default()
    };
    let image = render(&scene.build()?, &settings, &|_| ())?;
    std::fs::write(output, encode_exr(&image, &PictureInfo::default())?)?;
    Ok(())
}
