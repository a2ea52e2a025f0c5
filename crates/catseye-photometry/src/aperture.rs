//! The finite apertures of source and receiver: what an instrument sees is a mean over both.
//!
//! An instrument's lamp and photoreceptor stand behind round apertures (CIE 54.2, ASTM E810: at most 0.1
//! degrees as seen from the specimen), and so are lobes as narrow as an aperture measured wider than they
//! are. A model that is fitted to such data is blurred in the same way by [`ApertureRule::mean`]; the data
//! are not sharpened.
//!
//! # The rule
//!
//! With offsets x and y, evenly spread over disks of radii a (source) and b (receiver), the mean is an
//! integral over four dimensions. A retro lobe depends strongly on the difference y - x only; along with x +
//! y it changes as slowly as cosines do. So the rule integrates over the difference, whose density is the
//! area that the two disks have in common when one is displaced by it, and puts x and y at their means given
//! the difference: the centroid of that common area. What is left out is of second order, the variance of x
//! given the difference times the curvature along x + y. For apertures of 0.1 degrees and lobes no narrower
//! than they are it is below 1e-4 up to entrance angles of 60 degrees, and grows with the square of the
//! aperture. In the 30 m geometry of road markings it is 1e-4 for lobes that send light there, and a few per
//! cent in the tails of those that don't.
//!
//! Along the radius s of the difference the nodes are those of Gauss' quadrature in s^2 with the weight of
//! that density, around it they are evenly spaced.

use std::f64::consts::TAU;

use catseye::Vec3;

use crate::Error;
use crate::gauss::gauss;

/// The widest aperture, radians: the rule is made for small angles.
const MAX_DIAMETER: f64 = 0.35;
/// Degree of the polynomials that the rule is exact for.
const DEGREE: usize = 15;
/// The highest degree that Gauss' nodes are computed for: 24 of them.
const MAX_DEGREE: usize = 95;
/// Sines below which two directions have no plane of their own.
const PARALLEL: f64 = 1e-12;

/// The apertures of an instrument: full angles that their diameters subtend at the specimen, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apertures {
    /// The source's. 0 is a point; at most 0.35.
    pub source: f64,
    /// The receiver's. 0 is a point; at most 0.35.
    pub receiver: f64,
}

impl Apertures {
    /// The widest that ASTM E810 allows: 0.1 degrees each.
    pub const ASTM_E810: Self = {
        let tenth_of_a_degree = TAU / 3600.0;
        Self { source: tenth_of_a_degree, receiver: tenth_of_a_degree }
    };

    /// Both of the same full angle, in degrees.
    #[must_use]
    pub fn both_deg(diameter_deg: f64) -> Self {
        let diameter = diameter_deg.to_radians();
        Self { source: diameter, receiver: diameter }
    }

    /// The quadrature rule for these apertures: 64 points, or one where both are points.
    ///
    /// # Errors
    /// An aperture that is negative, NaN or above 0.35 (20 degrees).
    pub fn rule(self) -> Result<ApertureRule, Error> {
        self.rule_of_degree(DEGREE)
    }

    /// The rule that is exact for polynomials up to a degree, at most 95, which takes about a quarter of its
    /// square of points. Degree 7, 16 points, is within 1e-4 for lobes twice as wide as the aperture, and
    /// 4e-3 for those as wide.
    ///
    /// # Errors
    /// As [`Apertures::rule`].
    pub fn rule_of_degree(self, degree: usize) -> Result<ApertureRule, Error> {
        let degree = degree.min(MAX_DEGREE);
        // Odd powers of the radius vanish around the circle: n nodes in its square are exact to the power 4 n
        // - 2.
        let (radii, azimuths) = ((degree / 2 + 2) / 2, degree + 1);
        for (name, diameter) in
            [("the source's aperture", self.source), ("the receiver's aperture", self.receiver)]
        {
            if !(0.0..=MAX_DIAMETER).contains(&diameter) {
                let value = diameter.to_degrees();
                return Err(Error::Range { name, value, range: "[0, 20] degrees" });
            }
        }
        let disks = Disks { source: 0.5 * self.source, receiver: 0.5 * self.receiver };
        if disks.reach() == 0.0 {
            return Ok(ApertureRule {
                points: vec![Point { source: [0.0; 2], receiver: [0.0; 2], weight: 1.0 }],
            });
        }
        let mut points = Vec::with_capacity(radii * azimuths);
        for (squared, weight) in gauss(&disks.density(), radii) {
            let s = squared.sqrt();
            let source = disks.source_at(s);
            for i in 0..azimuths {
                let (sin, cos) = (TAU * (i as f64 + 0.5) / azimuths as f64).sin_cos();
                let at = |r: f64| [r * cos, r * sin];
                points.push(Point {
                    source: at(source),
                    receiver: at(source + s),
                    weight: weight / azimuths as f64,
                });
            }
        }
        Ok(ApertureRule { points })
    }
}

/// Offsets in units of the distance, across the axes.
#[derive(Clone, Copy, Debug)]
struct Point {
    source: [f64; 2],
    receiver: [f64; 2],
    weight: f64,
}

/// Where to evaluate a BSDF to know what an instrument sees. Made by [`Apertures::rule`].
#[derive(Clone, Debug)]
pub struct ApertureRule {
    points: Vec<Point>,
}

impl ApertureRule {
    /// Pairs of directions (receiver, source) around the axes `wo` and `wi` (unit vectors), and their
    /// weights, which add up to 1.
    ///
    /// Exact for polynomials in the difference of the two offsets up to the rule's degree, 15 (for equal
    /// apertures also times a linear function of their sum).
    pub fn directions(
        &self,
        wo: Vec3<f64>,
        wi: Vec3<f64>,
    ) -> impl Iterator<Item = (Vec3<f64>, Vec3<f64>, f64)> + '_ {
        let out_of_plane = common_normal(wo, wi);
        let [receiver, source] = [wo, wi].map(|axis| (axis, out_of_plane.cross(axis)));
        let moved = move |(axis, in_plane): (Vec3<f64>, Vec3<f64>), [x, y]: [f64; 2]| {
            (axis + in_plane * x + out_of_plane * y).normalized()
        };
        self.points.iter().map(move |p| (moved(receiver, p.receiver), moved(source, p.source), p.weight))
    }

    /// The mean of `value(wo, wi)` over both apertures.
    ///
    /// Of f cos cos it is the `R_A` that the instrument reads. Where the lobe's full width at half maximum is
    /// at least the wider aperture's diameter the error is below 1e-4 of the mean or of the value on the
    /// axes, down to 1e-6 of the peak.
    pub fn mean(
        &self,
        wo: Vec3<f64>,
        wi: Vec3<f64>,
        mut value: impl FnMut(Vec3<f64>, Vec3<f64>) -> f64,
    ) -> f64 {
        self.directions(wo, wi).map(|(wo, wi, weight)| weight * value(wo, wi)).sum()
    }

    /// How many evaluations a mean takes.
    #[must_use]
    pub fn count(&self) -> usize {
        self.points.len()
    }
}

/// A unit vector at right angles to both directions.
fn common_normal(wo: Vec3<f64>, wi: Vec3<f64>) -> Vec3<f64> {
    let normal = wo.cross(wi);
    if normal.dot(normal) > PARALLEL * PARALLEL {
        return normal.normalized();
    }
    let other = if wo.x.abs() < 0.5 { Vec3::new(1.0, 0.0, 0.0) } else { Vec3::new(0.0, 1.0, 0.0) };
    wo.cross(other).normalized()
}

/// Both disks' radii.
#[derive(Clone, Copy, Debug)]
struct Disks {
    source: f64,
    receiver: f64,
}

impl Disks {
    /// The largest difference.
    fn reach(self) -> f64 {
        self.source + self.receiver
    }

    /// Areas of the two segments that make up what the disks have in common at a distance s of their centres:
    /// the source's beyond the common chord, the receiver's before it. Inside one another, one is 0 and the
    /// other a disk.
    fn segments(self, s: f64) -> [f64; 2] {
        let (a, b) = (self.source, self.receiver);
        // Distance of the chord from the source's centre.
        let chord = (s * s + a * a - b * b) / (2.0 * s);
        [(a, chord), (b, s - chord)].map(|(radius, distance)| {
            if radius == 0.0 {
                return 0.0;
            }
            let cos = (distance / radius).clamp(-1.0, 1.0);
            radius * radius * (cos.acos() - cos * (1.0 - cos * cos).sqrt())
        })
    }

    /// The area that the disks have in common.
    fn overlap(self, s: f64) -> f64 {
        self.segments(s).iter().sum()
    }

    /// The mean of the source's offset along the difference, given its length s.
    ///
    /// The source's disk and the receiver's, displaced by -s, meet around it: the first moment of their
    /// common area about the source's centre is s times the receiver's segment, as those of the chord cancel.
    fn source_at(self, s: f64) -> f64 {
        if self.source == 0.0 || s == 0.0 {
            return 0.0;
        }
        if self.receiver == 0.0 {
            return -s;
        }
        let [source, receiver] = self.segments(s);
        -s * receiver / (source + receiver)
    }

    /// The density of the squared difference, as many points (squared, weight) whose weights add up to 1.
    fn density(self) -> Vec<(f64, f64)> {
        /// Points of each piece: the Gauss nodes made of them are exact to 1e-12.
        const POINTS: u32 = 200;
        let point_like = self.source.min(self.receiver) == 0.0;
        let inner = (self.source - self.receiver).abs();
        let mut points = Vec::new();
        // Up to `inner` one disk lies within the other. At the ends of both pieces the overlap has roots,
        // which a substitution that leaves them slowly takes away: its derivative is 630 (u (1 - u))^4.
        for (from, to) in [(0.0, inner), (inner, self.reach())].into_iter().filter(|(from, to)| to > from) {
            for i in 0..POINTS {
                let u = (f64::from(i) + 0.5) / f64::from(POINTS);
                let part = u.powi(5) * (126.0 + u * (-420.0 + u * (540.0 + u * (-315.0 + 70.0 * u))));
                let s = from + (to - from) * part;
                let overlap = if point_like { 1.0 } else { self.overlap(s) };
                points.push((s * s, overlap * s * (u * (1.0 - u)).powi(4) * (to - from)));
            }
        }
        let total: f64 = points.iter().map(|(_, weight)| weight).sum();
        points.retain(|(_, weight)| *weight > 0.0);
        points.iter_mut().for_each(|(_, weight)| *weight /= total);
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_of_the_difference_are_exact() {
        // Of two disks of radii a and b: mean square (a^2 + b^2) / 2, and
        // mean fourth power (a^4 + b^4) / 3 + a^2 b^2 for independent offsets without a preferred direction.
        for (a, b) in [(0.05_f64, 0.05_f64), (0.05, 0.02), (0.03, 0.0), (0.0, 0.04)] {
            let rule = Apertures { source: 2.0 * a, receiver: 2.0 * b }.rule().unwrap();
            let mean = |f: &dyn Fn([f64; 2]) -> f64| -> f64 {
                let difference = |p: &Point| [0, 1].map(|i| p.receiver[i] - p.source[i]);
                rule.points.iter().map(|p| p.weight * f(difference(p))).sum()
            };
            let squared = |[x, y]: [f64; 2]| x * x + y * y;
            assert!((mean(&|_| 1.0) - 1.0).abs() < 1e-12);
            assert!(mean(&|d| d[0]).abs() < 1e-12 && mean(&|d| d[1]).abs() < 1e-12);
            let expected = 0.5 * (a * a + b * b);
            assert!((mean(&squared) / expected - 1.0).abs() < 1e-9, "{a} {b}");
            let expected = (a.powi(4) + b.powi(4)) / 3.0 + a * a * b * b;
            assert!((mean(&|d| squared(d).powi(2)) / expected - 1.0).abs() < 1e-9, "{a} {b}");
        }
    }
}
