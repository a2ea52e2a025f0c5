//! The node `retro_reflective_bsdf` beside MaterialX's `retroreflective`, at the same peak.
//!
//! `cargo run --release -p catseye-render --example back_vector -- back_vector.png`
//!
//! Spheres of roughness 0.05, 0.15 and 0.5; above this node, below the back vector. Each has a lamp of its own half way to
//! the camera, so that the angle between lamp and eye grows away from the bright spot.

use catseye::{Model, Params};
use catseye_materialx::{Closure, Material};
use catseye_render::light::SphereLight;
use catseye_render::{
    Camera, Error, Image, RenderSettings, SceneBuilder, Sphere, ToneMap, encode_png, glam::Vec3, render,
};

/// Columns and rows of a sphere's picture.
const PIXELS: usize = 240;
const EYE: Vec3 = Vec3::new(0.0, 0.0, 6.0);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let Some(output) = std::env::args().nth(1) else { return Err("usage: back_vector OUTPUT.png".into()) };
    let mut sheet = Image::new(3 * PIXELS, 2 * PIXELS);
    for (column, roughness) in [0.05, 0.15, 0.5_f32].into_iter().enumerate() {
        let r2 = roughness * roughness;
        // The peak of both at normal incidence is (2 / r^2 + 1) / (4 pi).
        let exposure_ev = 1.8 - (2.0 / r2 + 1.0).log2();
        for (row, model) in [Model::Reciprocal, Model::BackVector].into_iter().enumerate() {
            let shown = sphere(model, roughness, exposure_ev)?;
            sheet.paste(&shown, column * PIXELS, row * PIXELS);
        }
    }
    std::fs::write(output, encode_png(&sheet, &ToneMap::LINEAR)?)?;
    Ok(())
}

fn sphere(model: Model, roughness: f32, exposure_ev: f32) -> Result<Image, Error> {
    let mut scene = SceneBuilder::new(Camera::perspective(EYE, Vec3::ZERO, Vec3::Y, 0.4));
    let gold = [0.95, 0.8, 0.45];
    let params = Params::isotropic(roughness).with_tint(gold).with_multiscatter_tint(gold);
    let bsdf = Closure::RetroReflective { weight: 1.0, params };
    let material = scene.materialx(&Material::of(bsdf), model)?;
    scene.sphere(Sphere { centre: Vec3::ZERO, radius: 1.0 }, material);
    let lamp = Sphere { centre: Vec3::new(-0.12, 0.12, 2.5), radius: 0.01 };
    scene.light(SphereLight::new(lamp, Vec3::splat(4e4)));
    let settings = RenderSettings {
        width: 2 * PIXELS,
        height: 2 * PIXELS,
        spp: 16,
        max_depth: 1,
        ..RenderSettings::default()
    };
    let image = render(&scene.build()?, &settings, &|_| ())?;
    Ok(image.toned(&ToneMap { exposure_ev, ..ToneMap::default() }).reduced(2))
}
