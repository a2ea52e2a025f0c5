//! Which values are unlike the others.

use nalgebra::{DMatrix, DVector};

use super::form::Unknown;
use super::problem::Problem;
use super::solve::Solution;
use super::{Aim, FitOptions, Observation};

/// Values that a fit has beyond its numbers where a value can be told to be unlike the others.
const LEAST_SPARE: usize = 3;
/// Times the scatter of the others that an outlier is off by (Iglewicz and Hoaglin 1993), and by how much
/// more than the greatest of so many normal residuals, about sqrt(2 ln n): one table of noise in thirty names
/// one.
const OUTLYING: f64 = 3.5;
const BEYOND_GREATEST: f64 = 0.5;
/// From the median of absolute residuals to the standard deviation of normal ones.
const MEDIAN_TO_SIGMA: f64 = 1.4826;
/// The scale of Cauchy's weights in standard deviations: 95 % efficient for normal residuals.
const CAUCHY: f64 = 2.385;
/// Rounds of weighting, and the shortest and longest step of a logarithm in one of them.
const ROUNDS: usize = 30;
const SHORTEST_STEP: f64 = 1e-4;
const LONGEST_STEP: f64 = 0.3;
/// Weight of the priors beside a value, and the least scatter that residuals are compared with.
const PRIOR_WEIGHT: f64 = 1e-3;
const LEAST_SCATTER: f64 = 1e-3;

/// A value that is unlike the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlier {
    /// The observation, counted from 0.
    pub row: usize,
    /// The value over what the others say.
    pub ratio: f64,
    /// How many times the scatter of the others it is off by.
    pub times: f64,
}

/// The values that a fit by Cauchy's weights, which hardly listens to what is far off, leaves more than 3.5
/// times their scatter (4.4 times of 2000 values) and more than the tolerance off; those farthest off first.
///
/// A fit to all values would hide them: it is drawn towards them, and where the worst error counts it makes
/// all errors alike.
pub(super) fn outliers(
    solution: &Solution,
    observations: &[Observation],
    options: &FitOptions,
) -> Vec<Outlier> {
    let is_of_limits = observations.iter().any(|row| row.aim != Aim::Equal);
    let is_met = solution.worst <= options.tolerance;
    if is_met || is_of_limits || observations.len() < solution.unknowns() + LEAST_SPARE {
        return Vec::new();
    }
    let Some((errors, scatter)) = robust_errors(solution, observations, options) else { return Vec::new() };
    let least = OUTLYING.max((2.0 * (errors.len() as f64).ln()).sqrt() + BEYOND_GREATEST);
    let outlier = |(row, &error): (usize, &f64)| {
        let times = error.abs() / unit(&observations[row]) / scatter;
        let is_far = times > least && error.abs().exp_m1() > options.tolerance;
        is_far.then(|| Outlier { row, ratio: (-error).exp(), times })
    };
    let mut found: Vec<Outlier> = errors.iter().enumerate().filter_map(outlier).collect();
    found.sort_by(|a, b| b.times.total_cmp(&a.times));
    found
}

/// The unit that an error is counted in.
fn unit(observation: &Observation) -> f64 {
    observation.uncertainty.map_or(1.0, |share| share.max(LEAST_SCATTER))
}

/// The logarithms of model over value where values far off count little, and the scatter of most of them.
fn robust_errors(
    solution: &Solution,
    observations: &[Observation],
    options: &FitOptions,
) -> Option<(Vec<f64>, f64)> {
    let unknowns = solution.form.unknowns();
    let mut x = solution.x.clone();
    let mut errors = solution.log_ratios.clone();
    for _ in 0..ROUNDS {
        let scatter = scatter(&errors, observations);
        let problem = Problem::new(solution.form, observations, options.channel_peak, &x);
        let step = step(&problem.log_jacobian()?, &errors, observations, scatter, &unknowns, &x)?;
        if step.amax() < SHORTEST_STEP {
            break;
        }
        for ((x, unknown), step) in x.iter_mut().zip(&unknowns).zip(step.iter()) {
            let [low, high] = unknown.bounds;
            *x = (*x + step.clamp(-LONGEST_STEP, LONGEST_STEP)).clamp(low, high);
        }
        let sheeting = solution.form.sheeting(&unknowns, &x);
        let prepared = sheeting.prepare().ok()?;
        let error = |row: &Observation| {
            let views = row.views.iter();
            let value: f64 = views.map(|view| view.factor * prepared.eval(view.wo, view.wi)).sum();
            (value / row.value).max(f64::MIN_POSITIVE).ln()
        };
        errors = observations.iter().map(error).collect();
    }
    let scatter = scatter(&errors, observations);
    Some((errors, scatter))
}

fn scatter(errors: &[f64], observations: &[Observation]) -> f64 {
    let mut sizes: Vec<f64> =
        errors.iter().zip(observations).map(|(error, row)| error.abs() / unit(row)).collect();
    let middle = sizes.len() / 2;
    let (_, median, _) = sizes.select_nth_unstable_by(middle, f64::total_cmp);
    let least = if observations[0].uncertainty.is_some() { 1.0 } else { LEAST_SCATTER };
    (MEDIAN_TO_SIGMA * *median).max(least)
}

/// A step of Gauss and Newton's method with Cauchy's weights.
fn step(
    jacobian: &DMatrix<f64>,
    errors: &[f64],
    observations: &[Observation],
    scatter: f64,
    unknowns: &[Unknown],
    x: &[f64],
) -> Option<DVector<f64>> {
    let (mut weighted, mut right) = (jacobian.clone(), DVector::zeros(unknowns.len()));
    for (j, (error, observation)) in errors.iter().zip(observations).enumerate() {
        let size = unit(observation);
        let weight = 1.0 / (1.0 + (error / (size * scatter * CAUCHY)).powi(2)) / (size * size);
        weighted.row_mut(j).scale_mut(weight);
        right -= weighted.row(j).transpose() * *error;
    }
    let mut normal = jacobian.transpose() * weighted;
    for (k, (unknown, x)) in unknowns.iter().zip(x).enumerate() {
        let weight = (PRIOR_WEIGHT / unknown.prior[1]).powi(2);
        normal[(k, k)] += weight;
        right[k] += weight * (unknown.prior[0] - x);
    }
    normal.try_inverse().map(|inverse| inverse * right)
}
