//! One form fitted to the data: several starts, least squares, then the worst row.

use levenberg_marquardt::LevenbergMarquardt;
use rayon::prelude::*;

use super::form::{Form, Meaning, Unknown};
use super::observation::{Aim, Observation, RETRO_REACH, SAME_ANGLE, weights};
use super::problem::{Problem, aim_weight, excess, log_ratios};
use crate::sheeting::Sheeting;

/// Starting points: what more of them found on the standards' tables was no better.
const STARTS: usize = 24;
/// The same for measurements, whose many rows leave little choice.
const STARTS_OF_MANY: usize = 3;
/// Rounds of weighting the worst rows up, and how many of them without progress end them.
const ROUNDS: usize = 14;
const IDLE_ROUNDS: usize = 4;
/// Progress is a worst error that is this much smaller.
const PROGRESS: f64 = 0.98;
/// Relative accuracy of the sum of squares and of the numbers within one round; rows are off by percents.
const ROUND_ACCURACY: f64 = 1e-6;
/// Evaluations within one round, in multiples of the free numbers plus one.
const PATIENCE: usize = 12;
/// The same for the last round of all.
const POLISH_PATIENCE: usize = 300;
/// How fast a row's weight follows its error: 1 is Lawson's algorithm, which overshoots where rows decide
/// alone.
const WEIGHT_POWER: f64 = 0.7;
/// Least weight of a row beside the worst one, in one round.
const LEAST_WEIGHT: f64 = 0.05;
/// Rows up to which every single one is held to the tolerance; more of them are measurements with noise.
pub(crate) const TABLE_ROWS: usize = 64;
/// What a minimum is exceeded by at least, as a share: a document has six digits, and a renderer single
/// precision.
const LIMIT_MARGIN: f64 = 1e-3;
/// An albedo this far above 1 is rounding.
const ENERGY_SLACK: f64 = 1e-6;

/// A form's best numbers.
#[derive(Clone, Debug)]
pub(crate) struct Solution {
    pub(crate) form: Form,
    pub(crate) x: Vec<f64>,
    pub(crate) sheeting: Sheeting,
    pub(crate) log_ratios: Vec<f64>,
    /// The rows' errors as logarithms: those of limits count more where they are broken, less where there is
    /// some to spare, and those of uncertain values less.
    errors: Vec<f64>,
    /// Whether the values are measurements, that are fitted in the sense of least squares: many, or of stated
    /// uncertainties.
    pub(crate) is_measured: bool,
    /// The greatest error of a row, as a share of its value.
    pub(crate) worst: f64,
    /// Root mean square of the rows' errors, as logarithms.
    pub(crate) rms: f64,
}

/// How far from its aim a row is, as a logarithm.
pub(crate) fn miss(aim: Aim, log_ratio: f64) -> f64 {
    match aim {
        Aim::Equal => log_ratio.abs(),
        Aim::AtLeast => (-log_ratio).max(0.0),
        Aim::AtMost => log_ratio.max(0.0),
    }
}

/// The best of several starts and of what follows from the solutions of simpler forms, so that it is no worse
/// than they are; the first of equals, `None` where none gives finite numbers.
pub(crate) fn solve<'a>(
    form: Form,
    observations: &[Observation],
    channel_peak: f64,
    tolerance: f64,
    simpler: impl Iterator<Item = &'a Solution>,
) -> Option<Solution> {
    let unknowns = form.unknowns();
    let nested: Vec<Vec<f64>> = simpler.filter_map(|known| form.embed(&known.form, &known.x)).collect();
    let count = if observations.len() > TABLE_ROWS { STARTS_OF_MANY } else { STARTS };
    let fresh = (0..count).map(|start| starting_point(form, &unknowns, observations, start));
    let mut starts: Vec<Vec<f64>> = nested.iter().map(|x| apart(&unknowns, x)).chain(fresh).collect();
    let better =
        |best: Solution, next: Solution| if next.is_better_than(&best, tolerance) { next } else { best };
    let best_of = |starts: &[Vec<f64>], observations: &[Observation]| {
        let found = starts.par_iter().map(|x| {
            descend(Problem::new(form, observations, channel_peak, x), observations, channel_peak, tolerance)
        });
        // In the order of the starts, so that the result does not depend on the number of cores.
        found.collect::<Vec<_>>().into_iter().flatten().reduce(better)
    };
    // Apertures change the solution a little and take many times as long: what points say is the start.
    if observations.iter().any(|row| row.views.len() > 1) {
        let points: Vec<Observation> = observations.iter().map(Observation::at_centre).collect();
        starts = best_of(&starts, &points).map(|found| found.x).into_iter().collect();
    }
    let found = best_of(&starts, observations);
    let nested = nested.into_iter().filter_map(|x| solution(form, x, observations, channel_peak));
    nested.chain(found).reduce(better)
}

/// Lobes of the same roughness, which a simpler form's solution leaves, drawn apart: from each other nothing
/// parts them.
fn apart(unknowns: &[Unknown], x: &[f64]) -> Vec<f64> {
    const FACTOR: f64 = 1.5;
    let mut moved = x.to_vec();
    for (k, unknown) in unknowns.iter().enumerate() {
        let Meaning::Roughness(lobe, axis) = unknown.meaning else { continue };
        let twins =
            (0..k).filter(|&j| matches!(unknowns[j].meaning, Meaning::Roughness(_, other) if other == axis));
        if lobe > 0 && twins.clone().any(|j| x[j] == x[k]) {
            moved[k] = (x[k] + FACTOR.ln()).min(unknown.bounds[1]);
        }
    }
    moved
}

/// The best that rounds of least squares find from one start, the worst rows weighing more from round to
/// round.
fn descend(
    mut problem: Problem<'_>,
    observations: &[Observation],
    channel_peak: f64,
    tolerance: f64,
) -> Option<Solution> {
    // Limits are met by strength, not by weights, which would forget the rows that are met.
    let has_limits = observations.iter().any(|row| row.aim == Aim::AtLeast);
    let solver =
        LevenbergMarquardt::new().with_ftol(ROUND_ACCURACY).with_xtol(ROUND_ACCURACY).with_patience(PATIENCE);
    let mut best: Option<Solution> = None;
    let (mut least, mut idle) = (f64::INFINITY, 0);
    for _ in 0..ROUNDS {
        (problem, _) = solver.minimize(problem);
        let Some(solution) = solution(problem.form(), problem.x(), observations, channel_peak) else { break };
        let worst = solution.worst;
        let done = worst <= tolerance || solution.is_measured || has_limits;
        reweight(&mut problem.weights, observations, &solution);
        if best.as_ref().is_none_or(|best| solution.is_better_than(best, tolerance)) {
            best = Some(solution);
        }
        (least, idle) = if worst < PROGRESS * least { (worst, 0) } else { (least, idle + 1) };
        if done || idle == IDLE_ROUNDS {
            break;
        }
    }
    best
}

/// Follows the valley of a table that is met in many ways to where the numbers are least surprising.
pub(crate) fn polish(
    found: Solution,
    observations: &[Observation],
    channel_peak: f64,
    tolerance: f64,
) -> Solution {
    if observations.len() > TABLE_ROWS || found.worst > tolerance {
        return found;
    }
    let problem = Problem::new(found.form, observations, channel_peak, &found.x);
    let (problem, _) = LevenbergMarquardt::new().with_patience(POLISH_PATIENCE).minimize(problem);
    match solution(found.form, problem.x(), observations, channel_peak) {
        Some(polished) if polished.is_better_than(&found, tolerance) => polished,
        _ => found,
    }
}

fn solution(
    form: Form,
    mut x: Vec<f64>,
    observations: &[Observation],
    channel_peak: f64,
) -> Option<Solution> {
    let unknowns = form.unknowns();
    // Limits and the energy are penalties in the problem, and laws here; of the two the energy's is the
    // higher.
    let logs = log_ratios(&form.sheeting(&unknowns, &x), observations)?;
    let at_least = observations.iter().zip(&logs).filter(|(row, _)| row.aim == Aim::AtLeast);
    let missing = at_least.map(|(_, log)| LIMIT_MARGIN - log).fold(0.0, f64::max);
    let mut strengthen = |by: f64| {
        for (x, unknown) in x.iter_mut().zip(&unknowns) {
            if matches!(unknown.meaning, Meaning::Strength(_) | Meaning::Diffuse) {
                *x += by;
            }
        }
        form.sheeting(&unknowns, &x)
    };
    let albedo = 1.0 + excess(&strengthen(missing), channel_peak);
    if albedo > 1.0 + ENERGY_SLACK {
        strengthen(-albedo.ln());
    }
    let sheeting = form.sheeting(&unknowns, &x);
    let log_ratios = log_ratios(&sheeting, observations)?;
    let misses = observations.iter().zip(&log_ratios).map(|(row, &log)| miss(row.aim, log));
    let (weights, is_stated) = weights(observations);
    let errors = observations.iter().zip(&log_ratios).zip(weights);
    let errors = errors.map(|((row, &log), weight)| weight * aim_weight(row.aim, log) * log).collect();
    let is_measured = is_stated || observations.len() > TABLE_ROWS;
    let worst = misses.clone().fold(0.0, f64::max).exp_m1();
    let rms = (misses.map(|miss| miss * miss).sum::<f64>() / observations.len() as f64).sqrt();
    let solution = Solution { form, x, sheeting, log_ratios, errors, is_measured, worst, rms };
    worst.is_finite().then_some(solution)
}

impl Solution {
    /// Of two that meet the tolerance the more probable one is better, taking the tolerance for the standard
    /// deviation: a table of few rows is met in many ways, most of them odd.
    fn is_better_than(&self, other: &Self, tolerance: f64) -> bool {
        if self.is_measured {
            self.squares() < other.squares()
        } else if self.worst.max(other.worst) <= tolerance {
            self.cost(tolerance) < other.cost(tolerance)
        } else {
            self.worst < other.worst
        }
    }

    /// Sum of the squared errors in units of the tolerance, and of the squared surprises.
    pub(crate) fn cost(&self, tolerance: f64) -> f64 {
        let rows: f64 = self.errors.iter().map(|error| (error / tolerance).powi(2)).sum();
        let numbers = self.form.unknowns().into_iter().zip(&self.x);
        rows + numbers.map(|(unknown, x)| unknown.prior_residual(*x).powi(2)).sum::<f64>()
    }

    /// Sum of the squared errors, those of uncertain values counting less.
    pub(crate) fn squares(&self) -> f64 {
        self.errors.iter().map(|error| error * error).sum()
    }

    /// The numbers that were free.
    pub(crate) fn unknowns(&self) -> usize {
        self.x.len()
    }
}

/// Gives weight to the rows that are far off.
fn reweight(weights: &mut [f64], observations: &[Observation], solution: &Solution) {
    let rows = observations.iter().zip(&solution.log_ratios);
    let worst = solution.worst.ln_1p();
    for (weight, (row, &log)) in weights.iter_mut().zip(rows) {
        *weight *= (miss(row.aim, log) / worst).max(LEAST_WEIGHT).powf(WEIGHT_POWER);
    }
    let most = weights.iter().copied().fold(0.0, f64::max);
    weights.iter_mut().for_each(|weight| *weight /= most);
}

/// A start: widths spread over the observation angles, strengths to match, the rest around where ignorance
/// puts it.
fn starting_point(form: Form, unknowns: &[Unknown], observations: &[Observation], start: usize) -> Vec<f64> {
    let angles = observations.iter().map(|row| row.centre().observation());
    // The retro direction itself is no lobe's width, even where rounding makes it an angle, nor is the angle of
    // a luminance factor.
    let angles = angles.filter(|angle| (SAME_ANGLE..=RETRO_REACH).contains(angle));
    let (least, most) = angles.fold((f64::INFINITY, 0.0_f64), |(low, high), a| (low.min(a), high.max(a)));
    let reach = (1.5 * most / least).ln();
    // A sequence of low discrepancy, another one for each number; the first start is in the middle.
    let jitter = |k: usize| {
        let golden = (start as f64 * (k as f64 + 2.0).sqrt()).fract();
        if start == 0 { 0.0 } else { golden - 0.5 }
    };
    let lobes = form.lobes as f64;
    let mut x: Vec<f64> = unknowns
        .iter()
        .enumerate()
        .map(|(k, unknown)| match unknown.meaning {
            // exp(-(angle / roughness)^2 / 2) at the angle, half way through the lobe's part of the range.
            Meaning::Roughness(i, _) => least.ln() + reach * (i as f64 + 0.5 + jitter(k)) / lobes,
            Meaning::Strength(_) => (0.1 / lobes).ln() + 2.0 * jitter(k),
            _ => unknown.prior[0] + unknown.prior[1] * jitter(k),
        })
        .collect();
    for (x, unknown) in x.iter_mut().zip(unknowns) {
        *x = x.clamp(unknown.bounds[0], unknown.bounds[1]);
    }
    if let Some(logs) = log_ratios(&form.sheeting(unknowns, &x), observations) {
        let mean = logs.iter().sum::<f64>() / logs.len() as f64;
        let strengths = unknowns.iter().zip(&mut x);
        for (unknown, x) in strengths.filter(|(unknown, _)| matches!(unknown.meaning, Meaning::Strength(_))) {
            *x = (*x - mean).clamp(unknown.bounds[0], unknown.bounds[1]);
        }
    }
    x
}
