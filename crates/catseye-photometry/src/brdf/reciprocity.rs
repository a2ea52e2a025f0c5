//! Whether measured values are the BRDF or have a cosine in them: reciprocity tells.
//!
//! f(a, b) = f(b, a), so where a file has both, values that are f agree, and values that are f times the
//! cosine of the receiver differ by the quotient of the cosines. Published files are not always what their
//! header says.

use std::collections::HashMap;
use std::fmt;

use catseye::Vec3;

use super::{Brdf, Cosine};

/// Size of the bins in which directions are taken to be the same, in units of the direction's projection: 0.3
/// degrees.
const BIN: f64 = 5e-3;
/// Cosines nearer than this factor say nothing.
const LEAST_QUOTIENT: f64 = 1.05;
/// Pairs needed for a verdict.
const LEAST_PAIRS: usize = 3;
/// How many times better the other reading must agree for a contradiction, and how well: 28 %.
const CLEAR: f64 = 3.0;
const WELL: f64 = 0.25;

/// How well the values of exchanged directions agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reciprocity {
    /// Pairs of samples with exchanged directions whose cosines differ.
    pub pairs: usize,
    /// Root mean square of the logarithms of their quotients, the values read as they were.
    pub as_read: f64,
    /// The same with each value divided by the receiver's cosine once more.
    pub divided: f64,
    /// The same with each value multiplied by the receiver's cosine.
    pub multiplied: f64,
}

impl Brdf {
    /// Compares the samples with exchanged directions, up to a turn of both about the normal; `None` where
    /// the file has fewer than three.
    #[must_use]
    pub fn reciprocity(&self) -> Option<Reciprocity> {
        let bin = |x: f64| (x / BIN).round() as i64;
        // An isotropic material: polar angles and the angle between the directions say it all.
        let key =
            |a: Vec3<f64>, b: Vec3<f64>| [a.z.acos(), b.z.acos(), a.dot(b).clamp(-1.0, 1.0).acos()].map(bin);
        let differ = |a: f64, b: f64| a.max(b) > LEAST_QUOTIENT * a.min(b);
        let useful = || self.samples.iter().filter(|s| s.luminance() > 0.0 && differ(s.wo.z, s.wi.z));
        let known: HashMap<_, f64> = useful().map(|s| (key(s.wo, s.wi), s.luminance())).collect();
        let (mut pairs, mut sums) = (0, [0.0; 3]);
        for sample in useful().filter(|s| s.wo.z > s.wi.z) {
            let Some(exchanged) = known.get(&key(sample.wi, sample.wo)) else { continue };
            let quotient = (sample.luminance() / exchanged).ln();
            let cosines = (sample.wo.z / sample.wi.z).ln();
            pairs += 1;
            for (sum, shift) in sums.iter_mut().zip([0.0, -cosines, cosines]) {
                *sum += (quotient + shift).powi(2);
            }
        }
        let [as_read, divided, multiplied] = sums.map(|sum| (sum / pairs as f64).sqrt());
        (pairs >= LEAST_PAIRS).then_some(Reciprocity { pairs, as_read, divided, multiplied })
    }
}

impl Reciprocity {
    /// What is wrong where values that were read as `cosine` are clearly something else.
    pub(super) fn contradiction(&self, cosine: Cosine) -> Option<Contradiction> {
        let other = if cosine == Cosine::Included { self.multiplied } else { self.divided };
        let clear = other * CLEAR < self.as_read && other < WELL;
        let included = cosine != Cosine::Included;
        clear.then_some(Contradiction { pairs: self.pairs, as_read: self.as_read, other, included })
    }
}

/// Values that are not what they were read as.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contradiction {
    /// Pairs of samples with exchanged directions.
    pub pairs: usize,
    /// Root mean square of the logarithms of their quotients, as the values were read.
    pub as_read: f64,
    /// The same for the other reading.
    pub other: f64,
    /// Whether the other reading is that of values with the receiver's cosine.
    pub included: bool,
}

impl fmt::Display for Contradiction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [right, wrong] = [self.other, self.as_read].map(|log| 100.0 * log.exp_m1());
        let (right_is, wrong_is) = match self.included {
            true => ("f times the receiver's cosine", "f"),
            false => ("f", "f times the receiver's cosine"),
        };
        write!(
            f,
            "{} pairs of exchanged directions are reciprocal within {right:.0} % if values are {right_is}, \
             and within {wrong:.0} % if they are {wrong_is}, as they were read",
            self.pairs
        )
    }
}
