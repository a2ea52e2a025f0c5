//! Promise: half-power angle, peak and roughness are those of the lobe itself.

use std::f64::consts::FRAC_PI_2;

use catseye::{Lobe as _, Params, Reciprocal};
use catseye_photometry::half_power::{
    half_power_angle, peak_coefficient, relative_coefficient, roughness_from_half_power_angle,
    tint_from_peak, widest_half_power_angle,
};
use catseye_photometry::{Geometry, Goniometer, Quantity};

const ROUGHNESSES: [f64; 9] = [1e-4, 0.003, 0.0057, 0.02, 0.15, 0.7, 1.0, 5.0, f64::INFINITY];

fn r_a(roughness: f64, observation: f64) -> f64 {
    let lobe = Reciprocal::<f64>::new(&Params::isotropic(roughness)).unwrap();
    let angles = Goniometer { observation, entrance_1: 0.0, entrance_2: 0.0, rotation: 0.0 };
    let geometry = Geometry::from(angles);
    let f = lobe.eval(geometry.wo, geometry.wi)[0];
    Quantity::RetroReflectionCoefficient.of_brdf(f, &geometry).unwrap()
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
    let message = roughness_from_half_power_angle(FRAC_PI_2).unwrap_err().to_string();
    assert_eq!(message, "the half-power angle is 90, outside (0, 44.2] degrees");
    assert!(half_power_angle(-1.0).is_err() && half_power_angle(f64::NAN).is_err());
    assert_eq!(half_power_angle(0.0).unwrap(), 0.0);
}
