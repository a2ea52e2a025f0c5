//! Between what a lobe looks like in a photometer and its parameters: width and height.
//!
//! At entrance angle 0 the disk lobe has a closed form over the observation angle alpha (docs/theory.md,
//! section 10). With s = tan(alpha/2)^2, the square of the disk offset there:
//!
//! ```text
//! R_A(alpha) = R_A(0) (1-s)^(n+3) / (1+s)        R_A(0) = tint (n+1) / (4 pi)
//! ```
//!
//! so that the half-power angle and the exponent n = 2/r^2 follow from each other without approximation:
//! `(1-s)^(n+3) = (1+s)/2`.
//!
//! The half-power angle is the observation angle at which `R_A` has fallen to half of its peak: half of the
//! full width at half maximum, as the peak is at 0. It is the input `half_power_angle` of the node
//! `retro_sheeting_surface`, in radians here; the node's factor of 0.014823438 per degree is the limit of
//! narrow lobes, r = alpha / sqrt(2 ln 2).

use std::f64::consts::{FRAC_PI_2, LN_2, PI};

use catseye::width;

use crate::Error;

/// tan^2 of half the half-power angle of the widest lobe, n = 0: the root of (1-s)^3 = (1+s)/2.
const WIDEST: f64 = 0.164_877_651_518_633_5;
/// Newton steps: from its start the iteration doubles its digits, and has them all after five at any
/// roughness.
const STEPS: usize = 8;

/// The roughness of the lobe whose half-power angle at entrance angle 0 is `angle`, in radians.
///
/// # Errors
/// An angle outside `(0, widest_half_power_angle()]`, or NaN.
pub fn roughness_from_half_power_angle(angle: f64) -> Result<f64, Error> {
    if !(angle > 0.0 && angle <= widest_half_power_angle()) {
        let (name, value) = ("the half-power angle", angle.to_degrees());
        return Err(Error::Range { name, value, range: "(0, 44.2] degrees" });
    }
    let s = (0.5 * angle).tan().powi(2);
    let n = (s.ln_1p() - LN_2) / (-s).ln_1p() - 3.0;
    // At the widest angle n is 0 to rounding, and infinite roughness legal.
    Ok((2.0 / n.max(0.0)).sqrt())
}

/// The half-power angle at entrance angle 0 of a lobe, in radians; 0 for roughness 0, and
/// [`widest_half_power_angle`] for infinite roughness.
///
/// # Errors
/// A roughness that is negative or NaN.
pub fn half_power_angle(roughness: f64) -> Result<f64, Error> {
    if !(roughness >= 0.0) {
        return Err(Error::Range { name: "the roughness", value: roughness, range: "[0, inf]" });
    }
    let exponent = 2.0 / (roughness * roughness) + 3.0;
    if exponent == f64::INFINITY {
        return Ok(0.0);
    }
    // Decreasing and concave in s, and not above 0 at the start: Newton's method converges from one side.
    let mut s = LN_2 / exponent;
    for _ in 0..STEPS {
        let value = exponent * (-s).ln_1p() - s.ln_1p() + LN_2;
        let slope = -exponent / (1.0 - s) - 1.0 / (1.0 + s);
        s -= value / slope;
    }
    Ok(2.0 * s.sqrt().atan())
}

/// The half-power angle that no lobe exceeds, in radians: that of infinite roughness, 44.2 degrees.
#[must_use]
pub fn widest_half_power_angle() -> f64 {
    2.0 * WIDEST.sqrt().atan()
}

/// The greatest coefficient of retro-reflection, `R_A` at observation angle 0 in cd/lx/m2, of a lobe with
/// luminance `tint` and roughnesses along and across the tangent: `tint sqrt((n_u+1)(n_v+1)) / (4 pi)`, at
/// every entrance angle.
///
/// Infinite for roughness 0, a Dirac lobe. NaN for what is negative or NaN.
#[must_use]
pub fn peak_coefficient(tint: f64, [u, v]: [f64; 2]) -> f64 {
    if !(tint >= 0.0 && u >= 0.0 && v >= 0.0) {
        return f64::NAN;
    }
    // docs/theory.md, section 10, in the widths of section 2: m_u = 1 / sqrt(n_u + 1).
    tint / (4.0 * PI * width(u) * width(v))
}

/// The tint that gives a lobe the greatest coefficient `r_a` in cd/lx/m2: the inverse of
/// [`peak_coefficient`].
///
/// More than 1 is no tint: no lobe of that width returns so much light.
#[must_use]
pub fn tint_from_peak(r_a: f64, [u, v]: [f64; 2]) -> f64 {
    if !(r_a >= 0.0 && u >= 0.0 && v >= 0.0) {
        return f64::NAN;
    }
    r_a * 4.0 * PI * width(u) * width(v)
}

/// `R_A` at entrance angle 0 and an observation angle in radians, relative to its peak, for a roughness in
/// `(0, inf]`.
///
/// 0 from 90 degrees on, where the receiver is behind the surface.
#[must_use]
pub fn relative_coefficient(roughness: f64, observation: f64) -> f64 {
    if observation.abs() >= FRAC_PI_2 {
        return 0.0;
    }
    let s = (0.5 * observation).tan().powi(2);
    let exponent = 2.0 / (roughness * roughness) + 3.0;
    (exponent * (-s).ln_1p() - s.ln_1p()).exp()
}
