//! Spheres of this node's lobe above spheres of MaterialX's, each in the light of a lamp of its own.

use catseye::{Model, Params};
use catseye_materialx::{Closure, Material};
use catseye_render::light::SphereLight;
use catseye_render::{
    Camera, RenderSettings, SceneBuilder, Sphere, ToneMap, encode_srgb, glam::Vec3, render,
};

use super::sheet::{Sheet, Tile};

/// Columns and rows of a sphere's picture.
const PIXELS: usize = 480;
const EYE: Vec3 = Vec3::new(0.0, 0.0, 6.0);
/// The lamp, half way to the camera: the angle between lamp and eye grows away from the bright spot.
const LAMP: Sphere = Sphere { centre: Vec3::new(-0.12, 0.12, 2.5), radius: 0.01 };
const MODELS: [(Model, &str); 2] =
    [(Model::Reciprocal, "retro_reflective_bsdf"), (Model::BackVector, "MaterialX 1.39.5, same peak")];

/// A column for each roughness.
pub(crate) fn figure(roughnesses: &[f32]) -> anyhow::Result<Sheet> {
    let mut tiles = Vec::new();
    for (model, name) in MODELS {
        for &roughness in roughnesses {
            let lines = vec![format!("roughness {roughness}"), name.to_owned()];
            tiles.push(Tile { rgb: sphere(model, roughness)?, lines });
        }
    }
    Ok(Sheet {
        title: "The node's lobe above, MaterialX's retroreflective GGX below".to_owned(),
        notes: vec![
            "A lamp half way to the camera; each column is exposed so that the common peak looks the same."
                .to_owned(),
        ],
        pixels: [PIXELS; 2],
        columns: roughnesses.len(),
        tiles,
    })
}

fn sphere(model: Model, roughness: f32) -> anyhow::Result<Vec<u8>> {
    let mut scene = SceneBuilder::new(Camera::perspective(EYE, Vec3::ZERO, Vec3::Y, 0.36));
    let gold = [0.95, 0.64, 0.16];
    let params = Params::isotropic(roughness).with_tint(gold).with_multiscatter_tint(gold);
    let bsdf = Closure::RetroReflective { weight: 1.0, params };
    let material = scene.materialx(&Material::of(bsdf), model)?;
    scene.sphere(Sphere { centre: Vec3::ZERO, radius: 1.0 }, material);
    scene.light(SphereLight::new(LAMP, Vec3::splat(4e4)));
    let side = 2 * PIXELS;
    let settings =
        RenderSettings { width: side, height: side, spp: 4, max_depth: 1, ..RenderSettings::default() };
    let image = render(&scene.build()?, &settings, &|_| ())?;
    // The peak at normal incidence is (2 / r^2 + 1) / (4 pi).
    let exposure_ev = 3.4 - (2.0 / (roughness * roughness) + 1.0).log2();
    let shown = image.toned(&ToneMap { exposure_ev, ..ToneMap::default() }).reduced(2);
    Ok(shown.pixels().iter().flat_map(|pixel| pixel.map(encode_srgb)).collect())
}
