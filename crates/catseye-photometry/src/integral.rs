//! The quantities that are integrals over directions: fractional retro-reflectance and diffuse illumination.
//!
//! Lobes are a hundredth of a degree to a hemisphere wide, and the integrand is not told how wide. Both
//! integrals run in polar coordinates about the retro direction over the logarithm of the angle, which gives
//! every width its points.

use std::f64::consts::{PI, TAU};

use catseye::Vec3;

use crate::Geometry;

/// The smallest angle from the retro direction, in radians; within it the integrand is taken as constant. A
/// tenth of the width of the narrowest lobe that is not Dirac, roughness 1e-4.
const SMALLEST: f64 = 1e-5;
/// Intervals of the angle's logarithm, and of the azimuth. Checked against closed forms below: 1e-4.
const ANGLES: usize = 240;
const AZIMUTHS: usize = 48;

/// `R_T`: the share of the flux from the source that leaves within `observation` of the direction back to it,
/// whatever the azimuth (ASTM E808), for a source at the polar angle `entrance` in the plane of the datum
/// axis. Radians.
///
/// `brdf` gives f in 1/sr. The result has a relative error of 1e-4 for smooth lobes; the rest of a cone that
/// the horizon cuts is left out.
pub fn fractional_retro_reflectance(brdf: impl Fn(&Geometry) -> f64, entrance: f64, observation: f64) -> f64 {
    let wi = Vec3::from_angles(entrance, 0.0);
    cone(wi, observation.clamp(0.0, PI), |wo| brdf(&Geometry { wo, wi }) * wo.z)
}

/// `Q_d` in cd/lx/m2: luminance per illuminance on the surface under an evenly bright sky (EN 1436), for a
/// receiver at the polar angle `viewing` in the plane of the datum axis, in radians; EN 1436 has 87.71
/// degrees.
///
/// `brdf` gives f in 1/sr. A perfect white diffuser has 1/pi = 0.318.
pub fn diffuse_luminance_coefficient(brdf: impl Fn(&Geometry) -> f64, viewing: f64) -> f64 {
    let wo = Vec3::from_angles(viewing, 0.0);
    // The sky of luminance L makes the illuminance pi L.
    cone(wo, PI, |wi| brdf(&Geometry { wo, wi }) * wi.z) / PI
}

/// The integral of `value(w)` over the directions above the horizon within `radius` of `axis`.
fn cone(axis: Vec3<f64>, radius: f64, value: impl Fn(Vec3<f64>) -> f64) -> f64 {
    if !(radius > 0.0) {
        return 0.0;
    }
    let [x, y] = tangents(axis);
    let ring = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let at = |k: usize| {
            let (sin_phi, cos_phi) = ((k as f64 + 0.5) / AZIMUTHS as f64 * TAU).sin_cos();
            let w = axis * cos + x * (sin * cos_phi) + y * (sin * sin_phi);
            if w.z > 0.0 { value(w) } else { 0.0 }
        };
        (0..AZIMUTHS).map(at).sum::<f64>() / AZIMUTHS as f64 * TAU * sin
    };
    let smallest = SMALLEST.min(radius);
    let inner = 0.5 * smallest * ring(smallest);
    let span = (radius / smallest).ln() / ANGLES as f64;
    let step = |i: usize| {
        // The two points of Gauss in each interval.
        let offsets = [-0.5, 0.5].map(|side: f64| side / 3.0_f64.sqrt() + 0.5);
        offsets
            .into_iter()
            .map(|offset| {
                let angle = smallest * ((i as f64 + offset) * span).exp();
                0.5 * angle * ring(angle)
            })
            .sum::<f64>()
            * span
    };
    inner + (0..ANGLES).map(step).sum::<f64>()
}

/// Two unit vectors that are at right angles to a third and to each other.
fn tangents(w: Vec3<f64>) -> [Vec3<f64>; 2] {
    // Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
    let sign = 1.0_f64.copysign(w.z);
    let a = -1.0 / (sign + w.z);
    let b = w.x * w.y * a;
    [Vec3::new(1.0 + sign * w.x * w.x * a, sign * b, -sign * w.x), Vec3::new(b, sign + w.y * w.y * a, -w.y)]
}
