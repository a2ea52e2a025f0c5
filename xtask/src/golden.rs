//! Writes the project's own conformance vectors, in double precision, from the exact albedo where there is a
//! choice.

use std::fmt::Write as _;

use anyhow::Result;
use catseye::albedo::exact;
use catseye::{Lobe as _, Params, Reciprocal, Vec3};

/// The generated files, from the workspace's root, with their texts.
pub(crate) fn generate() -> Result<Vec<(&'static str, String)>> {
    Ok(vec![
        ("conformance/eval.csv", eval()?),
        ("conformance/sample.csv", sample()?),
        ("conformance/albedo.csv", albedo()?),
    ])
}

/// Van der Corput's radical inverse: dimension d of Halton's sequence with the d-th prime as its base.
fn halton(mut index: u32, dimension: usize) -> f64 {
    const PRIMES: [u32; 14] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43];
    let base = PRIMES[dimension];
    let (mut value, mut scale) = (0.0, 1.0);
    while index > 0 {
        scale /= f64::from(base);
        value += scale * f64::from(index % base);
        index /= base;
    }
    value
}

/// Roughness from 0.003 to 30, log-uniform; a few of them infinite.
fn roughness(u: f64) -> f64 {
    if u > 0.97 { f64::INFINITY } else { 10.0_f64.powf(-2.5 + 4.0 * u / 0.97) }
}

/// Isotropic in one case of four.
fn roughness_pair(i: u32) -> [f64; 2] {
    let u = roughness(halton(i, 0));
    [u, if i.is_multiple_of(4) { u } else { roughness(halton(i, 1)) }]
}

/// Uniform on the hemisphere.
fn direction(u: f64, v: f64) -> Vec3<f64> {
    let z = 1.0 - u;
    let (sin, cos) = (std::f64::consts::TAU * v).sin_cos();
    let s = (1.0 - z * z).sqrt();
    Vec3::new(s * cos, s * sin, z)
}

/// BSDF values with both tints. Half of the directions are samples of the lobe, so that narrow lobes are
/// seen.
fn eval() -> Result<String> {
    let mut out = String::from(
        "roughness_u,roughness_v,tint_r,tint_g,tint_b,multiscatter_tint_r,multiscatter_tint_g,multiscatter_tint_b,\
         wo_x,wo_y,wo_z,wi_x,wi_y,wi_z,f_r,f_g,f_b\n",
    );
    for i in 1..=400 {
        let [u, v] = roughness_pair(i);
        let tint = [2, 3, 4].map(|d| halton(i, d));
        let multiscatter_tint = [5, 6, 7].map(|d| halton(i, d));
        let wo = direction(halton(i, 8), halton(i, 9));
        let single = Reciprocal::new(&Params::anisotropic(u, v))?;
        let numbers = [halton(i, 10), halton(i, 11), 0.0];
        let drawn = single.sample(wo, numbers).map_or(wo, |s| s.wi);
        let wi = if i % 2 == 0 { drawn } else { direction(numbers[0], numbers[1]) };
        let f = single.eval(wo, wi)[0];
        let f_ms = exact::compensation([u, v], wo, wi);
        write!(out, "{u},{v}")?;
        for x in tint.into_iter().chain(multiscatter_tint).chain([wo.x, wo.y, wo.z, wi.x, wi.y, wi.z]) {
            write!(out, ",{x}")?;
        }
        for c in 0..3 {
            write!(out, ",{:e}", tint[c] * f + multiscatter_tint[c] * f_ms)?;
        }
        out.push('\n');
    }
    Ok(out)
}

/// Samples of single scattering, and of the compensated lobe as this implementation draws them.
fn sample() -> Result<String> {
    let mut out = String::from(
        "roughness_u,roughness_v,multiscatter_tint_r,multiscatter_tint_g,multiscatter_tint_b,wo_x,wo_y,wo_z,u1,u2,u3,\
         wi_x,wi_y,wi_z,weight_r,weight_g,weight_b,pdf,lobe\n",
    );
    for i in 1..=400 {
        let [u, v] = roughness_pair(i);
        let multiscatter_tint = if i <= 200 { 0.0 } else { 1.0 };
        let lobe =
            Reciprocal::new(&Params::anisotropic(u, v).with_multiscatter_tint([multiscatter_tint; 3]))?;
        let wo = direction(halton(i, 8), halton(i, 9));
        let numbers = [10, 11, 12].map(|d| halton(i, d));
        let Some(s) = lobe.sample(wo, numbers) else { continue };
        write!(out, "{u},{v},{multiscatter_tint},{multiscatter_tint},{multiscatter_tint}")?;
        let columns =
            [wo.x, wo.y, wo.z].into_iter().chain(numbers).chain([s.wi.x, s.wi.y, s.wi.z]).chain(s.weight);
        for x in columns {
            write!(out, ",{x}")?;
        }
        writeln!(out, ",{:e},{}", s.pdf, s.component.name())?;
    }
    Ok(out)
}

/// Directional and average albedo of single scattering by quadrature.
fn albedo() -> Result<String> {
    let mut out = String::from("roughness_u,roughness_v,wo_x,wo_y,wo_z,albedo_single,albedo_average\n");
    for i in 1..=300 {
        let [u, v] = roughness_pair(i);
        let wo = direction(halton(i, 8), halton(i, 9));
        let (directional, average) = (exact::directional([u, v], wo), exact::average([u, v]));
        writeln!(out, "{u},{v},{},{},{},{directional:.12},{average:.12}", wo.x, wo.y, wo.z)?;
    }
    Ok(out)
}
