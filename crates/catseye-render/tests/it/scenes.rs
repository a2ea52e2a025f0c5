//! The scenes that come with the crate show what they are for.

use catseye::{Model, Params};
use catseye_materialx::{Closure, Material, ScatterMode};
use catseye_render::{Image, Scene};

use crate::common::{dielectric, diffuse, layer, picture, retro, zoo};

const SIZE: [usize; 2] = [96, 54];
/// Pixels of the signs' white, left and right.
const SIGNS: [[usize; 2]; 2] = [[15, 12], [80, 12]];

fn material(bsdf: Closure) -> Material {
    Material { name: "test".to_owned(), ..Material::of(bsdf) }
}

fn luminance(image: &Image, [x, y]: [usize; 2]) -> f32 {
    image.pixel(x, y).iter().sum::<f32>() / 3.0
}

#[test]
fn the_left_sign_outshines_the_right_one() {
    for model in Model::ALL {
        let image = picture(&Scene::builtin(None, model).unwrap(), SIZE, 4, 3);
        let [left, right] = SIGNS.map(|p| luminance(&image, p));
        // By some thirty times at 1.4 degrees; models differ.
        assert!(left > 10.0 * right && right > 0.0, "{model:?}: {left} {right}");
    }
}

#[test]
fn another_material_replaces_the_sheeting() {
    let matte = material(diffuse(0.8, 0.2));
    let image = picture(&Scene::builtin(Some(&matte), Model::Reciprocal).unwrap(), SIZE, 16, 3);
    let [left, right] = SIGNS.map(|p| luminance(&image, p));
    assert!((left / right - 1.0).abs() < 0.1, "{left} {right}");
}

#[test]
fn the_preview_shows_every_material_in_range() {
    let mut closures = zoo();
    closures.push(("default node", retro(Params::default())));
    closures.push(("sheeting", retro(Params::isotropic(0.006).with_tint([0.06; 3]))));
    closures.push((
        "coated sheeting",
        layer(dielectric([0.0; 2], ScatterMode::Reflect), retro(Params::isotropic(0.003))),
    ));
    for (name, closure) in closures {
        let scene = Scene::preview(&material(closure), Model::Reciprocal).unwrap();
        let image = picture(&scene, SIZE, 16, 6);
        // The middle of the sphere, after the tone map.
        let shown = scene.tone_map().apply(image.pixel(26, 24)).iter().sum::<f32>() / 3.0;
        // Fibres alone shine at the rim, not in the middle.
        let least = if name == "sheen" { 0.005 } else { 0.02 };
        assert!((least..0.95).contains(&shown), "{name}: {shown}");
    }
}

#[test]
fn too_many_lobes_are_an_error() {
    let many = (0..17)
        .fold(Closure::None, |sum, _| Closure::Add { a: Box::new(sum), b: Box::new(diffuse(0.01, 0.0)) });
    let error = Scene::preview(&material(many), Model::Reciprocal).unwrap_err().to_string();
    assert!(error.contains("17 lobes"), "{error}");
}
