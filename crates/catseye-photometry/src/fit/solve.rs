//! One form fitted to the data from several starts: least squares, and where a row is beyond the tolerance
//! the least worst error.

use levenberg_marquardt::LevenbergMarquardt;
use rayon::prelude::*;

use super::form::{Form, Meaning, Unknown};
use super::minimax::minimax;
use super::observation::{Aim, Observation, RETRO_REACH, weights};
use super::problem::{PRIOR_WEIGHT, Problem, aim_weight};
use super::starts::starts;
use crate::sheeting::Sheeting;

/// Starting points: with 24 of them no standard's table is met better by more than 0.02 points.
const STARTS: usize = 12;
/// The same for measurements, whose many rows leave little choice.
const STARTS_OF_MANY: usize = 4;
/// Rows that a search looks at: of more, so many all over the table find the place that all of them descend
/// from.
const SEARCHED_ROWS: usize = 200;
/// Relative accuracy of the sum of squares and of the numbers.
const ACCURACY: f64 = 1e-9;
/// Evaluations in multiples of the free numbers plus one.
const PATIENCE: usize = 40;
/// The part of the tolerance within which a row's error is as good as any, but for its square.
const HINGE: f64 = 0.97;
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
    let nested: Vec<Vec<f64>> = simpler.filter_map(|known| form.embed(&known.form, &known.x)).collect();
    let priors: Vec<f64> = form.unknowns().iter().map(|unknown| unknown.prior[0]).collect();
    let problem = Problem::new(form, observations, channel_peak, &priors);
    let better =
        |best: Solution, next: Solution| if next.is_better_than(&best, tolerance) { next } else { best };
    let best_of = |problem: &Problem<'_>, starts: &[Vec<f64>]| {
        let found = starts.par_iter().map(|x| descend(problem.at(x), tolerance));
        // In the order of the starts, so that the result does not depend on the number of cores.
        found.collect::<Vec<_>>().into_iter().flatten().reduce(better)
    };
    let search = |problem: &Problem<'_>| {
        let count = if observations.len() > TABLE_ROWS { STARTS_OF_MANY } else { STARTS };
        let apart = nested.iter().map(|x| apart(&problem.unknowns, x));
        best_of(problem, &apart.chain(starts(problem, count)).collect::<Vec<_>>())
    };
    // Apertures and thousands of rows change the solution a little and take many times as long: what points
    // of some rows say is the start.
    let has_apertures = observations.iter().any(|row| row.views.len() > 1);
    let found = if has_apertures || observations.len() > SEARCHED_ROWS {
        let points: Vec<Observation> = some_of(observations).map(Observation::at_centre).collect();
        let start = search(&Problem::new(form, &points, channel_peak, &priors))?;
        best_of(&problem, &[start.x])
    } else {
        search(&problem)
    };
    let nested = nested.iter().filter_map(|x| solution(&problem, x.clone()));
    nested.chain(found).reduce(better)
}

/// All rows, or of many of them about [`SEARCHED_ROWS`] and those that the base is seen in.
fn some_of(observations: &[Observation]) -> impl Iterator<Item = &Observation> {
    /// The golden ratio's inverse, whose multiples keep clear of any period in the rows' order.
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let share = SEARCHED_ROWS as f64 / observations.len() as f64;
    let chosen = move |(i, row): (usize, &Observation)| {
        (i as f64 * GOLDEN).fract() < share || row.centre().observation() > RETRO_REACH
    };
    observations.iter().enumerate().filter(move |pair| chosen(*pair)).map(|(_, row)| row)
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

/// The best that is found downhill from one start.
fn descend(start: Problem<'_>, tolerance: f64) -> Option<Solution> {
    let observations = start.rows.observations;
    // Limits are met by strength; measurements have noise.
    let is_table = observations.len() <= TABLE_ROWS
        && !weights(observations).1
        && observations.iter().all(|row| row.aim != Aim::AtLeast);
    let least_squares = |problem: Problem<'_>| {
        let problem = if is_table { problem.held(HINGE * tolerance.ln_1p()) } else { problem };
        let solver =
            LevenbergMarquardt::new().with_ftol(ACCURACY).with_xtol(ACCURACY).with_patience(PATIENCE);
        let (problem, _) = solver.minimize(problem);
        solution(&problem, problem.x()).map(|found| (problem.x(), found))
    };
    let (x, found) = least_squares(start.clone())?;
    if !is_table || found.worst <= tolerance {
        return Some(found);
    }
    let mut problem = start.at(&x);
    minimax(&mut problem, HINGE * tolerance.ln_1p());
    let least = solution(&problem, problem.x())?;
    if least.worst > tolerance {
        return Some(least);
    }
    let (_, met) = least_squares(problem)?;
    Some(if met.is_better_than(&least, tolerance) { met } else { least })
}

fn solution(problem: &Problem<'_>, mut x: Vec<f64>) -> Option<Solution> {
    let (form, unknowns, rows) = (problem.form(), &problem.unknowns, &problem.rows);
    // Limits and the energy are penalties in the problem, and laws here; of the two the energy's is the
    // higher.
    let observations = rows.observations;
    let logs = rows.log_ratios(&form.sheeting(unknowns, &x))?;
    let at_least = observations.iter().zip(&logs).filter(|(row, _)| row.aim == Aim::AtLeast);
    let missing = at_least.map(|(_, log)| LIMIT_MARGIN - log).fold(0.0, f64::max);
    let mut strengthen = |by: f64| {
        for (x, unknown) in x.iter_mut().zip(unknowns.iter()) {
            if matches!(unknown.meaning, Meaning::Strength(_) | Meaning::Diffuse) {
                *x += by;
            }
        }
        form.sheeting(unknowns, &x)
    };
    let albedo = 1.0 + problem.walls.excess(&strengthen(missing));
    if albedo > 1.0 + ENERGY_SLACK {
        strengthen(-albedo.ln());
    }
    let sheeting = form.sheeting(unknowns, &x);
    let log_ratios = rows.log_ratios(&sheeting)?;
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
    /// Of two that meet the tolerance the one of the least squares is better, the priors' included.
    fn is_better_than(&self, other: &Self, tolerance: f64) -> bool {
        if self.is_measured {
            self.squares() < other.squares()
        } else if self.worst.max(other.worst) <= tolerance {
            self.cost(PRIOR_WEIGHT) < other.cost(PRIOR_WEIGHT)
        } else {
            self.worst < other.worst
        }
    }

    /// Sum of the squared errors in units of `sigma`, and of the squared surprises.
    pub(crate) fn cost(&self, sigma: f64) -> f64 {
        let rows: f64 = self.errors.iter().map(|error| (error / sigma).powi(2)).sum();
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
