//! A lower beam from the test points of FMVSS 108.

/// Steps of the horizontal angle that count as one of the vertical angle: headlamps' beams are about four
/// times as wide as high (assumed).
const HEIGHT_TO_WIDTH: f64 = 4.0;

/// Where a value of [`LOW_BEAM`] comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// The standard's minimum at this test point.
    Minimum,
    /// No test point is here; the value is ours.
    Assumed,
}

/// An intensity at a test point, on a test line or in a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestPoint {
    /// From and to, in degrees to the right.
    pub right_deg: [f64; 2],
    /// From and to, in degrees upwards.
    pub up_deg: [f64; 2],
    /// Intensity in cd.
    pub intensity_cd: f64,
    /// Who says so.
    pub basis: Basis,
}

/// What the built-in lower beam goes through: the minima of 49 CFR 571.108 (FMVSS 108), Table XIX, column
/// LB2V (visually aimed, two lamps), read in a public transcription of the edition of 1 October 2025, pages
/// 480 to 482, not in the Code itself.
///
/// A lamp that is sold is brighter. Between the points the logarithm of the intensity is their mean, weighted
/// by the fourth power of the inverse distance (Shepard 1968), a degree up counting as four to the side; a
/// test checks every minimum and maximum of the column. Above 10 degrees up, where the standard has a
/// maximum of 125 cd and no minimum, far to the sides and near the ground the values are assumed.
pub const LOW_BEAM: &[TestPoint] = &[
    minimum([-8.0; 2], 4.0, 64.0),
    minimum([8.0; 2], 4.0, 64.0),
    minimum([-4.0; 2], 2.0, 135.0),
    minimum([1.0, 3.0], 1.5, 200.0),
    minimum([1.0, 3.0], 0.5, 500.0),
    minimum([-4.0; 2], 0.0, 135.0),
    minimum([-8.0; 2], 0.0, 64.0),
    minimum([1.3; 2], -0.6, 10_000.0),
    minimum([0.0; 2], -0.86, 4500.0),
    minimum([-3.5; 2], -0.86, 1800.0),
    minimum([2.0; 2], -1.5, 15_000.0),
    minimum([-9.0; 2], -2.0, 1250.0),
    minimum([9.0; 2], -2.0, 1250.0),
    minimum([-15.0; 2], -2.0, 1000.0),
    minimum([15.0; 2], -2.0, 1000.0),
    minimum([-20.0; 2], -4.0, 300.0),
    minimum([20.0; 2], -4.0, 300.0),
    assumed([-90.0, 90.0], [10.0, 90.0], 64.0),
    assumed([-90.0, -45.0], [-5.0, 10.0], 64.0),
    assumed([45.0, 90.0], [-5.0, 10.0], 64.0),
    assumed([-90.0, 90.0], [-90.0, -10.0], 300.0),
];

const fn minimum(right_deg: [f64; 2], up_deg: f64, intensity_cd: f64) -> TestPoint {
    TestPoint { right_deg, up_deg: [up_deg; 2], intensity_cd, basis: Basis::Minimum }
}

const fn assumed(right_deg: [f64; 2], up_deg: [f64; 2], intensity_cd: f64) -> TestPoint {
    TestPoint { right_deg, up_deg, intensity_cd, basis: Basis::Assumed }
}

/// The beam through [`LOW_BEAM`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LowBeam;

impl LowBeam {
    pub(super) fn intensity_cd(self, right_deg: f64, up_deg: f64) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for point in LOW_BEAM {
            let aside = outside(right_deg, point.right_deg);
            let above = HEIGHT_TO_WIDTH * outside(up_deg, point.up_deg);
            let squared = aside * aside + above * above;
            if squared == 0.0 {
                return point.intensity_cd;
            }
            let weight = 1.0 / (squared * squared);
            sum += weight * point.intensity_cd.ln();
            weights += weight;
        }
        (sum / weights).exp()
    }
}

/// How far a value is outside an interval.
fn outside(x: f64, [from, to]: [f64; 2]) -> f64 {
    (from - x).max(x - to).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Table XIX, column LB2V, of 49 CFR 571.108, in its order; the source is that of [`LOW_BEAM`].
    #[test]
    fn every_minimum_and_maximum_of_the_standard_is_kept() {
        const FAR: f64 = 90.0;
        const NONE: f64 = f64::INFINITY;
        let column: [([f64; 2], [f64; 2], [f64; 2]); 24] = [
            ([-90.0, 90.0], [10.0, 90.0], [0.0, 125.0]),
            ([-8.0; 2], [4.0; 2], [64.0, NONE]),
            ([8.0; 2], [4.0; 2], [64.0, NONE]),
            ([-4.0; 2], [2.0; 2], [135.0, NONE]),
            ([1.0, 3.0], [1.5; 2], [200.0, NONE]),
            ([1.0, FAR], [1.5; 2], [0.0, 1400.0]),
            ([-FAR, -1.5], [1.0; 2], [0.0, 700.0]),
            ([-FAR, -1.5], [0.5; 2], [0.0, 1000.0]),
            ([1.0, 3.0], [0.5; 2], [500.0, 2700.0]),
            ([-4.0; 2], [0.0; 2], [135.0, NONE]),
            ([-8.0; 2], [0.0; 2], [64.0, NONE]),
            ([1.3; 2], [-0.6; 2], [10_000.0, NONE]),
            ([0.0; 2], [-0.86; 2], [4500.0, NONE]),
            ([-3.5; 2], [-0.86; 2], [1800.0, 12_000.0]),
            ([2.0; 2], [-1.5; 2], [15_000.0, NONE]),
            ([-9.0; 2], [-2.0; 2], [1250.0, NONE]),
            ([9.0; 2], [-2.0; 2], [1250.0, NONE]),
            ([-15.0; 2], [-2.0; 2], [1000.0, NONE]),
            ([15.0; 2], [-2.0; 2], [1000.0, NONE]),
            ([4.0; 2], [-4.0; 2], [0.0, 12_500.0]),
            ([-20.0; 2], [-4.0; 2], [300.0, NONE]),
            ([20.0; 2], [-4.0; 2], [300.0, NONE]),
            ([-90.0, 90.0], [-90.0, 90.0], [60.0, 15_000.0]),
            ([0.0; 2], [0.0; 2], [500.0, 5000.0]),
        ];
        for (right, up, [least, most]) in column {
            for i in 0..=100 {
                for j in 0..=100 {
                    let at = |[from, to]: [f64; 2], i: i32| from + (to - from) * f64::from(i) / 100.0;
                    let (right, up) = (at(right, i), at(up, j));
                    let found = LowBeam.intensity_cd(right, up);
                    let legal = found >= least * (1.0 - 1e-12) && found <= most;
                    assert!(legal, "{right} right, {up} up: {found}, not in {least} to {most}");
                }
            }
        }
    }
}
