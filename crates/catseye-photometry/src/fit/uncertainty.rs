//! How well the data determine the fitted numbers.

use nalgebra::DMatrix;

use super::form::{Meaning, Unknown};
use super::solve::Solution;
use super::{Aim, FitOptions, Observation};
use crate::fit::problem::Problem;
use crate::significant;

/// A posterior of more than this share of the prior's width says that the data know little.
const UNDETERMINED: f64 = 0.5;
/// How close to a bound, as a share of the range, a number counts as being at it.
const AT_BOUND: f64 = 5e-3;
/// The standard deviation of a value that is given and not measured, as a share.
const EXACT: f64 = 1e-4;
/// Standard deviations of the mean square of residuals from which on they are not what was stated.
const SURPRISE: f64 = 3.0;

/// Where the standard deviations of the fitted numbers come from. Never from the tolerance, which is a wish.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Deviation {
    /// Every value has its own uncertainty.
    Stated {
        /// Root mean square of the errors in units of the uncertainties, corrected for the fitted numbers: 1
        /// where model and uncertainties are right. `None` where no value is to spare.
        scatter: Option<f64>,
    },
    /// The values scatter around the model: one standard deviation of a value, as a share of it.
    Scatter {
        /// The standard deviation.
        share: f64,
        /// Values beyond those that the numbers take: the degrees of freedom.
        spare: usize,
    },
    /// No value is to spare, and none has an uncertainty.
    NoneToSpare,
    /// The values are limits, which say nothing of how well they were measured.
    Limits,
}

/// A fitted number.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// What it is.
    pub meaning: Meaning,
    /// Its value; the quantity itself, not its logarithm.
    pub value: f64,
    /// One standard deviation below and above: 68 % of such intervals hold the truth, if the form is right.
    /// From the scatter of few values it is that times Student's factor. `None` where it is not known.
    pub interval: Option<[f64; 2]>,
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
        let short = |x: f64| significant(x, 3);
        let value = short(self.value);
        match self.interval {
            Some([low, high]) if !self.determined => Some(format!(
                "the data don't determine {name}: {value} could be {} to {}",
                short(low),
                short(high)
            )),
            None if !self.determined => Some(format!("the data don't determine {name}: {value} is a guess")),
            _ => self.at_bound.then(|| format!("{name} is {value}, the end of the range that is looked in")),
        }
    }
}

impl Deviation {
    /// Where the deviations come from, for people.
    #[must_use]
    pub fn origin(&self) -> String {
        match self {
            Self::Stated { .. } => "from the values' own uncertainties".to_owned(),
            Self::Scatter { share, spare } => {
                let noun = if *spare == 1 { "value" } else { "values" };
                format!("from the scatter, {} % with {spare} {noun} to spare", significant(100.0 * share, 2))
            }
            Self::NoneToSpare => {
                "not known: no value is to spare, and none has an uncertainty of its own".to_owned()
            }
            Self::Limits => "not known: limits say nothing of it".to_owned(),
        }
    }

    /// What the reader should know of it.
    pub(crate) fn warning(&self, rows: usize, unknowns: usize) -> Option<String> {
        let Self::Stated { scatter: Some(scatter) } = *self else { return None };
        let spare = rows.saturating_sub(unknowns) as f64;
        (scatter * scatter > 1.0 + SURPRISE * (2.0 / spare).sqrt()).then(|| {
            format!(
                "the values are off by {} times their uncertainties: the model is not all there is to them, or \
                 the uncertainties are too small, and so are the intervals",
                significant(scatter, 2)
            )
        })
    }

    fn of(solution: &Solution, observations: &[Observation]) -> Self {
        if observations.iter().any(|row| row.aim == Aim::AtLeast) {
            return Self::Limits;
        }
        let values =
            || observations.iter().zip(&solution.log_ratios).filter(|(row, _)| row.aim == Aim::Equal);
        let count = values().count();
        let spare = count.saturating_sub(solution.unknowns());
        // Of values without an uncertainty, else in units of it.
        let unit = |row: &Observation| row.uncertainty.map_or(1.0, |share| share.max(EXACT));
        let is_stated = values().all(|(row, _)| row.uncertainty.is_some());
        let of_scatter = values().filter(|(row, _)| is_stated || row.uncertainty.is_none());
        let squares: f64 = of_scatter.map(|(row, log)| (log / unit(row)).powi(2)).sum();
        let share = (spare > 0).then(|| (squares / spare as f64).sqrt());
        match share {
            scatter if is_stated => Self::Stated { scatter },
            Some(share) => Self::Scatter { share, spare },
            None => Self::NoneToSpare,
        }
    }

    /// The standard deviation of a value without an uncertainty of its own.
    fn share(self) -> Option<f64> {
        match self {
            Self::Stated { .. } => Some(EXACT),
            Self::Scatter { share, spare } => Some(share.max(EXACT) * student(spare)),
            Self::NoneToSpare | Self::Limits => None,
        }
    }
}

/// How much wider than one standard deviation an interval has to be, that 68.27 % of them hold the truth
/// where the deviation itself is from so many spare values: the quantile of Student's distribution, by its
/// series around the normal one (Abramowitz and Stegun 26.7.5), 1.4 % too small for a single value.
fn student(spare: usize) -> f64 {
    let inverse = 1.0 / spare as f64;
    1.0 + inverse * (0.5 + inverse * (0.25 + inverse * 0.0625))
}

/// The numbers and their standard deviations, from the curvature of the sum of squares and the prior.
pub(super) fn estimates(
    solution: &Solution,
    observations: &[Observation],
    options: &FitOptions,
) -> (Vec<Estimate>, Deviation) {
    let unknowns = solution.form.unknowns();
    let deviation = Deviation::of(solution, observations);
    // Whether a number is determined has an answer even so: values are off by what they are off, or may be.
    let share = deviation.share().unwrap_or_else(|| options.tolerance.max(solution.rms));
    let covariance = covariance(solution, observations, options, &unknowns, share);
    let estimate = |(k, unknown): (usize, &Unknown)| {
        let width = unknown.prior[1];
        let sigma = covariance.as_ref().map_or(width, |covariance| covariance[(k, k)].max(0.0).sqrt());
        let (x, [low, high]) = (solution.x[k], unknown.bounds);
        let value = |x: f64| unknown.meaning.quantity(x);
        let interval = [x - sigma, x + sigma].map(|x| value(x.clamp(low, high)));
        Estimate {
            meaning: unknown.meaning,
            value: value(x),
            interval: deviation.share().map(|_| interval),
            determined: sigma < UNDETERMINED * width,
            at_bound: (x - low).min(high - x) < AT_BOUND * (high - low),
        }
    };
    (unknowns.iter().enumerate().map(estimate).collect(), deviation)
}

fn covariance(
    solution: &Solution,
    observations: &[Observation],
    options: &FitOptions,
    unknowns: &[Unknown],
    share: f64,
) -> Option<DMatrix<f64>> {
    let problem = Problem::new(solution.form, observations, options.channel_peak, &solution.x);
    let mut jacobian =
        problem.log_jacobian().unwrap_or_else(|| DMatrix::zeros(observations.len(), unknowns.len()));
    for (mut row, observation) in jacobian.row_iter_mut().zip(observations) {
        // A limit that isn't touched says nothing.
        let is_value = observation.aim != Aim::AtMost;
        let sigma = observation.uncertainty.map_or(share, |share| share.max(EXACT));
        row *= if is_value { 1.0 / sigma } else { 0.0 };
    }
    let mut precision = jacobian.transpose() * &jacobian;
    for (k, unknown) in unknowns.iter().enumerate() {
        precision[(k, k)] += unknown.prior[1].powi(-2);
    }
    precision.try_inverse()
}
