//! Between what a lobe looks like in a photometer and its parameters: width and height.
//!
//! At entrance angle 0 the disk lobe has a closed form over the observation angle alpha (docs/theory.md, section 10). With
//! s = tan(alpha/2)^2, the square of the disk offset there:
//!
//! ```text
//! R_A(alpha) = R_A(0) (1-s)^(n+3) / (1+s)        R_A(0) = tint (n+1) / (4 pi)
//! ```
//!
//! so that the half-power angle and the exponent n = 2/r^2 follow from each other without approximation:
//! `(1-s)^(n+3) = (1+s)/2`.
//!
//! The half-power angle is the observation angle at which `R_A` has fallen to half of its peak: half of the full width at
//! half maximum, as the peak is at 0. It is the input `half_power_angle` of the node `retro_sheeting_surface`, in radians
//! here; the node's factor of 0.014823438 per degree is the limit of narrow lobes, r = alpha / sqrt(2 ln 2).

use std::f64::consts::{FRAC_PI_2, LN_2, PI};

use catseye::width;

use crate::Error;

/// tan^2 of half the half-power angle of the widest lobe, n = 0: the root of (1-s)^3 = (1+s)/2.
const WIDEST: f64 = 0.164_877_651_518_633_5;
/// Newton steps: from its start the iteration doubles its digits, and has them all after five at any roughness.
const STEPS: usize = 8;

/// The roughness of the lobe whose half-power angle at entrance angle 0 is `angle`, in radians.
///
/// # Errors
/// An angle outside `(0, widest_half_power_angle()]`, or NaN.
pub fn roughness_from_half_power_angle(angle: f64) -> Result<f64, Error> {
    if !(angle > 0.0 && angle <= widest_half_power_angle()) {
        let range = "(0, 0.7714] radians, which is (0, 44.2] degrees";
        return Err(Error::Range { name: "the half-power angle", value: angle, range });
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

/// The greatest coefficient of retro-reflection, `R_A` at observation angle 0 in cd/lx/m2, of a lobe with luminance `tint`
/// and roughnesses along and across the tangent: `tint sqrt((n_u+1)(n_v+1)) / (4 pi)`, at every entrance angle.
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

/// The tint that gives a lobe the greatest coefficient `r_a` in cd/lx/m2: the inverse of [`peak_coefficient`].
///
/// More than 1 is no tint: no lobe of that width returns so much light.
#[must_use]
pub fn tint_from_peak(r_a: f64, [u, v]: [f64; 2]) -> f64 {
    if !(r_a >= 0.0 && u >= 0.0 && v >= 0.0) {
        return f64::NAN;
    }
    r_a * 4.0 * PI * width(u) * width(v)
}

/// `R_A` at entrance angle 0 and an observation angle in radians, relative to its peak, for a roughness in `(0, inf]`.
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

#[cfg(test)]
mod tests {
    use catseye::{Lobe as _, Params, Reciprocal};

    use super::*;
    use crate::{Geometry, Goniometer, Quantity};

    const ROUGHNESSES: [f64; 9] = [1e-4, 0.003, 0.0057, 0.02, 0.15, 0.7, 1.0, 5.0, f64::INFINITY];

    fn r_a(roughness: f64, observation: f64) -> f64 {
        let lobe = Reciprocal::<f64>::new(&Params::isotropic(roughness)).unwrap();
        let angles = Goniometer { observation, entrance_1: 0.0, entrance_2: 0.0, rotation: 0.0 };
        let geometry = Geometry::from(angles);
        let f = lobe.eval(geometry.wo, geometry.wi)[0];
        Quantity::RetroReflectionCoefficient.from_brdf(f, &geometry).unwrap()
    }

    #[test]
    fn the_lobe_itself_has_half_of_its_peak_at_the_half_power_angle() {
        for roughness in ROUGHNESSES {
            let angle = half_power_angle(roughness).unwrap();
            let half = r_a(roughness, angle) / r_a(roughness, 0.0);
            // The direction's rounding, 1e-16, moves a narrow lobe by a share of its width.
            assert!((half - 0.5).abs() < 1e-13 + 1e-15 / angle, "{roughness}: {half}");
        }
    }

    #[test]
    fn roughness_and_half_power_angle_are_inverse() {
        for roughness in ROUGHNESSES {
            let angle = half_power_angle(roughness).unwrap();
            let back = roughness_from_half_power_angle(angle).unwrap();
            // Wide lobes hardly change their half-power angle with roughness: dn is what stays small.
            let [n, n_back] = [roughness, back].map(|r| 2.0 / (r * r));
            assert!((n - n_back).abs() < 1e-13 * (n + 10.0), "{roughness} became {back}");
        }
    }

    #[test]
    fn the_peak_is_what_the_lobe_has_at_observation_angle_0() {
        for roughness in &ROUGHNESSES[..] {
            let peak = peak_coefficient(1.0, [*roughness; 2]);
            assert!((r_a(*roughness, 0.0) / peak - 1.0).abs() < 1e-12, "{roughness}");
            assert!((tint_from_peak(peak, [*roughness; 2]) - 1.0).abs() < 1e-15);
        }
        assert_eq!(peak_coefficient(1.0, [0.0; 2]), f64::INFINITY);
    }

    #[test]
    fn the_closed_form_is_the_lobe() {
        for roughness in ROUGHNESSES {
            for factor in [0.1, 0.5, 1.0, 2.0] {
                let angle = factor * half_power_angle(roughness).unwrap();
                let relative = r_a(roughness, angle) / r_a(roughness, 0.0);
                let closed = relative_coefficient(roughness, angle);
                assert!((relative / closed - 1.0).abs() < 1e-11, "{roughness} {angle}: {relative} {closed}");
            }
        }
    }

    #[test]
    fn the_library_node_has_the_limit_of_narrow_lobes() {
        // catseye_ng.mtlx: roughness = half_power_angle in degrees * 0.014823438.
        for deg in [0.2_f64, 0.5, 2.0] {
            let angle = deg.to_radians();
            let roughness = roughness_from_half_power_angle(angle).unwrap();
            // Both differ by the square of the angle, 1e-5 at 0.2 degree.
            let error = (roughness / (deg * 0.014_823_438) - 1.0).abs();
            assert!(error < 1.1 * angle * angle, "{deg}: {roughness}");
        }
    }

    #[test]
    fn angles_that_no_lobe_has_are_refused() {
        let widest = widest_half_power_angle();
        assert!((widest.to_degrees() - 44.199).abs() < 0.001, "{}", widest.to_degrees());
        assert!((half_power_angle(f64::INFINITY).unwrap() - widest).abs() < 1e-15);
        for angle in [0.0, -0.1, widest * 1.001, f64::NAN] {
            assert!(roughness_from_half_power_angle(angle).is_err(), "{angle}");
        }
        assert!(half_power_angle(-1.0).is_err() && half_power_angle(f64::NAN).is_err());
        assert_eq!(half_power_angle(0.0).unwrap(), 0.0);
    }
}
