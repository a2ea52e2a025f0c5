//! Promise: the rule for apertures sees what an integral over both of them sees.

use catseye::{Lobe as _, Params, Reciprocal, Vec3};
use catseye_photometry::{Apertures, Geometry, Goniometer};

/// Apertures in degrees.
fn apertures(source: f64, receiver: f64) -> Apertures {
    Apertures { source: source.to_radians(), receiver: receiver.to_radians() }
}

/// The mean over four dimensions: a rule for each disk, which has nothing to convolve.
fn mean_of_both(
    apertures: Apertures,
    geometry: Geometry,
    value: impl Fn(Vec3<f64>, Vec3<f64>) -> f64,
) -> f64 {
    let fine = |apertures: Apertures| apertures.rule_of_degree(31).unwrap();
    let receiver = fine(Apertures { source: 0.0, ..apertures });
    let source = fine(Apertures { receiver: 0.0, ..apertures });
    let Geometry { wo, wi } = geometry;
    receiver.mean(wo, wi, |wo_moved, _| source.mean(wo, wi, |_, wi_moved| value(wo_moved, wi_moved)))
}

/// A lobe of the given full width at half maximum over the observation angle, in degrees.
fn lobe(width_deg: f64) -> Reciprocal<f64> {
    // Near its peak the lobe is exp(-(d / m)^2) with d half the observation angle.
    let m2 = (0.25 * width_deg.to_radians()).powi(2) / std::f64::consts::LN_2;
    Reciprocal::new(&Params::isotropic((2.0 * m2 / (1.0 - m2)).sqrt())).unwrap()
}

#[test]
fn the_difference_is_as_good_as_four_dimensions() {
    // As in the documentation: 1e-4 of the value on the axes or of the mean, whichever is greater. What is
    // left out grows with the square of the aperture: 3.2e-4 at 0.3 degrees and an entrance angle of 60.
    for apertures in [apertures(0.1, 0.1), apertures(0.1, 0.04), apertures(0.0, 0.1), apertures(0.3, 0.3)] {
        let widest = apertures.source.max(apertures.receiver).to_degrees();
        let tolerance = if widest > 0.2 { 4e-4 } else { 1e-4 };
        for width in [widest, 3.0 * widest] {
            let lobe = lobe(width);
            let value = |wo: Vec3<f64>, wi: Vec3<f64>| lobe.eval(wo, wi)[0] * wo.z * wi.z;
            for [alpha, beta] in [[0.0, -4.0], [0.1, 5.0], [0.2, 30.0], [0.33, 60.0], [1.0, 40.0]] {
                // A lobe that is 1e-6 of its peak is none.
                if alpha > 2.0 * width {
                    continue;
                }
                let geometry = Geometry::from(Goniometer::from_degrees(alpha, beta, 0.0, 20.0));
                let expected = mean_of_both(apertures, geometry, value);
                let mean = apertures.rule().unwrap().mean(geometry.wo, geometry.wi, value);
                let on_axis = value(geometry.wo, geometry.wi);
                assert!(
                    (mean - expected).abs() < tolerance * expected.max(on_axis),
                    "{apertures:?} {width} {alpha} {beta}: {mean} {expected}"
                );
            }
        }
    }
}

#[test]
fn a_wide_lobe_is_seen_as_it_is() {
    let lobe = lobe(20.0);
    let value = |wo: Vec3<f64>, wi: Vec3<f64>| lobe.eval(wo, wi)[0] * wo.z * wi.z;
    let Geometry { wo, wi } = Geometry::from(Goniometer::from_degrees(0.5, 30.0, 0.0, 0.0));
    let mean = Apertures::ASTM_E810.rule().unwrap().mean(wo, wi, value);
    assert!((mean / value(wo, wi) - 1.0).abs() < 1e-4);
}

#[test]
fn points_see_one_pair_of_directions() {
    let rule = Apertures::both_deg(0.0).rule().unwrap();
    let Geometry { wo, wi } = Geometry::from(Goniometer::from_degrees(0.0, 0.0, 0.0, 0.0));
    let pairs: Vec<_> = rule.directions(wo, wi).collect();
    assert_eq!((rule.count(), pairs), (1, vec![(wo, wi, 1.0)]));
}

#[test]
fn apertures_that_are_none_are_refused_by_name() {
    for (source, receiver, name) in
        [(-0.1, 0.1, "source"), (0.1, f64::NAN, "receiver"), (0.1, 21.0, "receiver")]
    {
        let message = apertures(source, receiver).rule().unwrap_err().to_string();
        assert!(message.contains(name) && message.ends_with("outside [0, 20] degrees"), "{message}");
    }
}
