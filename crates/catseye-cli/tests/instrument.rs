//! Promise: the ray-traced retroreflectometer and the quadrature over its apertures are one instrument, within 1 %.

use catseye::{AnyLobe, Lobe as _, Model, Params};
use catseye_materialx::{Closure, Material};
use catseye_photometry::{Apertures, Geometry, Goniometer, LUMINANCE, Quantity};
use catseye_render::Retroreflectometer;

/// Paths of a measurement: enough for a standard error of 0.3 %.
const SAMPLES: u32 = 1 << 16;

fn retro(params: Params<f32>) -> Closure {
    Closure::RetroReflective { weight: 1.0, params, tangent_u: None }
}

fn lobe(params: Params<f32>) -> AnyLobe<f64> {
    let [u, v] = params.roughness().map(f64::from);
    AnyLobe::new(Model::Reciprocal, &Params::anisotropic(u, v).with_tint(params.tint.map(f64::from)))
        .expect("legal parameters")
}

#[test]
fn rays_and_quadrature_agree() {
    let distance_m = 15.0;
    let closures: [Vec<Params<f32>>; 3] = [
        vec![Params::isotropic(0.006).with_tint([0.06; 3])],
        vec![Params::isotropic(0.005).with_tint([0.05; 3]), Params::isotropic(0.02).with_tint([0.1; 3])],
        vec![Params::anisotropic(0.008, 0.03).with_tint([0.2; 3])],
    ];
    for (number, lobes) in closures.into_iter().enumerate() {
        let sum = lobes.iter().map(|params| retro(*params));
        let bsdf =
            sum.reduce(|a, b| Closure::Add { a: Box::new(a), b: Box::new(b) }).expect("a lobe at least");
        let material = Material { bsdf, ..Material::default() };
        let lobes: Vec<AnyLobe<f64>> = lobes.into_iter().map(lobe).collect();
        // Unequal apertures, half and a quarter of a degree: the signs of both offsets matter.
        let apertures = Apertures { source: 0.5_f64.to_radians(), receiver: 0.25_f64.to_radians() };
        let instrument = Retroreflectometer {
            distance_m,
            specimen_side_m: 0.02,
            source_aperture_m: 2.0 * distance_m * (0.5 * apertures.source).tan() as f32,
            receiver_aperture_m: 2.0 * distance_m * (0.5 * apertures.receiver).tan() as f32,
        };
        for [alpha, beta, epsilon] in
            [[0.2, -4.0, 0.0], [0.33, 30.0, 90.0], [0.5, 40.0, 0.0], [1.0, -4.0, 90.0], [2.0, 30.0, 90.0]]
        {
            let geometry = Geometry::from(Goniometer::from_degrees(alpha, beta, 0.0, epsilon));
            let Geometry { wo, wi } = geometry;
            let rule = apertures.rule().expect("legal apertures");
            let expected = rule.mean(wo, wi, |wo, wi| {
                let f = lobes.iter().map(|lobe| lobe.eval(wo, wi)[1]).sum();
                let r_a = Quantity::RetroReflectionCoefficient;
                r_a.of_brdf(f, &Geometry { wo, wi }).expect("needs no integral")
            });
            if expected < 1e-3 {
                // Below what ASTM E810 measures, by a factor of 100.
                continue;
            }
            let reading = instrument.measure(&material, Model::Reciprocal, [wo, wi], SAMPLES, 0);
            let read = reading.expect("a legal measurement").r_a(LUMINANCE);
            let what = format!("material {number}, {alpha} {beta} {epsilon}: {read:?}, {expected}");
            assert!((read.value / expected - 1.0).abs() < 0.01, "{what}");
        }
    }
}
