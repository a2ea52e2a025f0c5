//! How well the data determine the fitted numbers.

use nalgebra::DMatrix;

use super::form::Meaning;
use super::solve::Solution;
use super::{FitOptions, Observation};
use crate::fit::problem::Problem;
use crate::significant;

/// A posterior of more than this share of the prior's width says that the data know little.
const UNDETERMINED: f64 = 0.5;
/// How close to a bound, as a share of the range, a number counts as being at it.
const AT_BOUND: f64 = 5e-3;

/// A fitted number.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// What it is.
    pub meaning: Meaning,
    /// Its value; the quantity itself, not its logarithm.
    pub value: f64,
    /// One standard deviation below and above.
    pub interval: [f64; 2],
    /// Whether the data determine it; if not, a weak prior does.
    pub determined: bool,
    /// Whether it is at the end of the range that is looked in.
    pub at_bound: bool,
}

impl Estimate {
    /// What the reader should know of the number, if anything.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        let name = self.meaning.name();
        let [low, value, high] = [self.interval[0], self.value, self.interval[1]].map(|x| significant(x, 3));
        if !self.determined {
            return Some(format!("the data don't determine {name}: {value} could be {low} to {high}"));
        }
        self.at_bound.then(|| format!("{name} is {value}, the end of the range that is looked in"))
    }
}

/// The numbers and their standard deviations, from the curvature of the sum of squares and the prior.
///
/// Rows are taken to be off by the tolerance, or by what they are off, if that is more.
pub(super) fn estimates(
    solution: &Solution,
    observations: &[Observation],
    options: &FitOptions,
) -> Vec<Estimate> {
    let unknowns = solution.form.unknowns();
    let problem = Problem::new(solution.form, observations, options.channel_peak, &solution.x);
    let spare = observations.len().saturating_sub(unknowns.len()).max(1) as f64;
    let scatter = solution.rms * (observations.len() as f64 / spare).sqrt();
    let sigma = options.tolerance.max(scatter);
    let jacobian =
        problem.log_jacobian().unwrap_or_else(|| DMatrix::zeros(observations.len(), unknowns.len()));
    let mut precision = jacobian.transpose() * &jacobian / (sigma * sigma);
    for (k, unknown) in unknowns.iter().enumerate() {
        precision[(k, k)] += unknown.prior[1].powi(-2);
    }
    let covariance = precision.try_inverse();
    let estimate = |(k, unknown): (usize, &super::form::Unknown)| {
        let width = unknown.prior[1];
        let deviation = covariance.as_ref().map_or(width, |covariance| covariance[(k, k)].max(0.0).sqrt());
        let (x, [low, high]) = (solution.x[k], unknown.bounds);
        let value = |x: f64| unknown.meaning.quantity(x);
        Estimate {
            meaning: unknown.meaning,
            value: value(x),
            interval: [x - deviation, x + deviation].map(|x| value(x.clamp(low, high))),
            determined: deviation < UNDETERMINED * width,
            at_bound: (x - low).min(high - x) < AT_BOUND * (high - low),
        }
    };
    unknowns.iter().enumerate().map(estimate).collect()
}
