//! The white furnace: what returns all energy can't be seen.

use catseye::{AnyLobe, Lobe as _, Model, Params};
use catseye_materialx::ScatterMode;
use catseye_render::{Bsdf, furnace};

use crate::common::{SMALL, dielectric, diffuse, layer, picture, retro};

/// The largest distance of any pixel from 1.
fn visibility(bsdf: Bsdf, spp: u32, depth: u32) -> f32 {
    let image = picture(&furnace::scene(bsdf).expect("a furnace"), SMALL, spp, depth);
    image.pixels().iter().flatten().map(|v| (v - 1.0).abs()).fold(0.0, f32::max)
}

#[test]
fn white_lobes_vanish() {
    // Perfect importance sampling: every sample's weight is 1 within 5e-3.
    for roughness in [0.0, 0.006, 0.1, 0.5, 0.9, 3.0, f32::INFINITY] {
        let params = Params::isotropic(roughness).with_multiscatter_tint([1.0; 3]);
        let seen = visibility(Bsdf::new(&retro(params)).unwrap(), 16, 4);
        assert!(seen < 5e-3, "roughness {roughness}: {seen}");
    }
    let anisotropic = Params::anisotropic(1.0, 0.05).with_multiscatter_tint([1.0; 3]);
    assert!(visibility(Bsdf::new(&retro(anisotropic)).unwrap(), 16, 4) < 5e-3);
}

#[test]
fn white_diffuse_vanishes() {
    for roughness in [0.0, 0.5, 1.0] {
        let seen = visibility(Bsdf::new(&diffuse(1.0, roughness)).unwrap(), 1024, 4);
        // 1024 samples of a weight that varies by some tenths.
        assert!(seen < 0.05, "roughness {roughness}: {seen}");
    }
}

#[test]
fn smooth_glass_vanishes() {
    let glass = dielectric([0.0, 0.0], ScatterMode::ReflectTransmit);
    assert!(visibility(Bsdf::new(&glass).unwrap(), 64, 64) < 1e-3);
}

#[test]
fn a_coat_on_white_loses_a_little_and_gains_nothing() {
    let coated = layer(dielectric([0.05, 0.05], ScatterMode::Reflect), diffuse(1.0, 0.0));
    let image = picture(&furnace::scene(Bsdf::new(&coated).unwrap()).unwrap(), SMALL, 1024, 4);
    let mean = image.mean()[0];
    assert!(mean < 1.002 && mean > 0.97, "{mean}");
}

#[test]
fn the_mean_over_the_sphere_is_the_average_albedo() {
    for (roughness, multiscatter) in [(0.1, 0.0), (0.5, 0.0), (0.9, 0.0), (0.9, 0.5)] {
        let params = Params::isotropic(roughness).with_multiscatter_tint([multiscatter; 3]);
        let lobe = AnyLobe::<f32>::new(Model::Reciprocal, &params).unwrap();
        // Projected area on the sphere is uniform in the squared sine.
        let expected: f32 = (0..256)
            .map(|i| {
                let sin2 = (i as f32 + 0.5) / 256.0;
                lobe.albedo(catseye::Vec3::new(sin2.sqrt(), 0.0, (1.0 - sin2).sqrt()))[0] / 256.0
            })
            .sum();
        let mean = furnace::mean_albedo(lobe, 1 << 18).unwrap()[0];
        assert!((mean - expected).abs() < 2e-3, "roughness {roughness}: {mean}, expected {expected}");
    }
}

#[test]
fn single_scattering_shows() {
    let lobe = AnyLobe::<f32>::new(Model::Reciprocal, &Params::isotropic(0.9)).unwrap();
    let image = furnace::sphere(lobe, 33, 64).unwrap();
    let [head_on, corner] = [image.pixel(16, 16)[0], image.pixel(0, 0)[0]];
    assert!(head_on < 0.8 && (corner - 1.0).abs() < 1e-6, "{head_on} {corner}");
}
