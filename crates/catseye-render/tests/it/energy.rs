//! BSDFs: sampling agrees with evaluation, densities are densities, no energy is made.

use catseye_render::{Bsdf, Frame};
use glam::Vec3;

use crate::common::{outgoing, points, sphere_direction, zoo};

const FRAME: Frame = Frame { x: Vec3::X, y: Vec3::Y, z: Vec3::Z };

#[test]
fn sample_weight_times_pdf_is_eval() {
    for (name, closure) in zoo() {
        let bsdf = Bsdf::new(&closure).unwrap();
        for wo in outgoing() {
            let shading = bsdf.at(FRAME, wo, false);
            for sample in points(200).filter_map(|u| shading.sample(u)) {
                if sample.is_dirac {
                    continue;
                }
                let pdf = sample.pdf;
                let (f_cos, pdf_again) = shading.eval_pdf(sample.wi);
                let tolerance = 2e-3 * (1.0 + sample.weight.max_element()) * pdf;
                assert!((pdf - pdf_again).abs() <= 2e-3 * pdf, "{name} {wo}: pdf {pdf} {pdf_again}");
                let difference = (sample.weight * pdf - f_cos).abs().max_element();
                assert!(difference <= tolerance, "{name} {wo}: {} {f_cos}", sample.weight * pdf);
            }
        }
    }
}

#[test]
fn pdf_integrates_to_what_is_sampled() {
    const COUNT: u32 = 200_000;
    for (name, closure) in zoo() {
        let bsdf = Bsdf::new(&closure).unwrap();
        for wo in &outgoing()[..3] {
            let shading = bsdf.at(FRAME, *wo, false);
            let mean: f32 =
                points(COUNT).map(|u| shading.eval_pdf(sphere_direction(u)).1).sum::<f32>() / COUNT as f32;
            let integral = mean * 4.0 * std::f32::consts::PI;
            let kept = points(4096).filter(|&u| shading.sample(u).is_some()).count() as f32 / 4096.0;
            // Uniform points resolve lobes of these widths to about a percent.
            assert!(
                (integral - kept).abs() < 0.02,
                "{name} {wo}: pdf integrates to {integral}, {kept} is sampled"
            );
        }
    }
}

#[test]
fn no_energy_is_made() {
    for (name, closure) in zoo() {
        let bsdf = Bsdf::new(&closure).unwrap();
        for wo in outgoing() {
            for inside in [false, true] {
                let shading = bsdf.at(FRAME, wo, inside);
                let sum: Vec3 = points(4096).filter_map(|u| shading.sample(u)).map(|s| s.weight).sum();
                let energy = (sum / 4096.0).max_element();
                assert!(energy < 1.01, "{name} {wo} inside {inside}: {energy}");
            }
        }
    }
}

#[test]
fn albedo_is_the_mean_weight() {
    for (name, closure) in zoo() {
        let bsdf = Bsdf::new(&closure).unwrap();
        for wo in &outgoing()[..3] {
            let shading = bsdf.at(FRAME, *wo, false);
            let mean =
                points(8192).filter_map(|u| shading.sample(u)).map(|s| s.weight).sum::<Vec3>() / 8192.0;
            let difference = (mean - shading.albedo()).abs().max_element();
            // The quadrature of the dielectric's tables, and theirs of the rays.
            // Schlick's curve in the place of a metal's own.
            let tolerance = if name.contains("metal") { 0.03 } else { 0.01 };
            assert!(difference < tolerance, "{name} {wo}: {mean} {}", shading.albedo());
        }
    }
}
