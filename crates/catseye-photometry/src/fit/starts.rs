//! Where a search starts: many places, spread evenly, each with the strengths that suit it best.

use rayon::prelude::*;

use super::form::{Form, Meaning, Unknown};
use super::observation::{Aim, Observation, RETRO_REACH, SAME_ANGLE};
use super::problem::Problem;
use super::rows::Rows;
use super::solve::TABLE_ROWS;

/// Evaluations of a lobe that the search for starts may cost, and the places that are looked at for one
/// start.
const EVALUATIONS: usize = 200_000;
const PLACES: [usize; 2] = [8, 128];
/// Widths beyond the observation angles of the table, as a factor.
const BEYOND: f64 = 2.5;
/// Steps towards the best strengths.
const STEPS: usize = 30;

/// As many starts as asked for, each the best of its share of a sequence of low discrepancy.
///
/// The strengths enter linearly, and the best ones for the rest of the numbers are found at once; the rest
/// are few enough to be looked for everywhere.
pub(crate) fn starts(problem: &Problem<'_>, count: usize) -> Vec<Vec<f64>> {
    let (form, rows) = (problem.form(), &problem.rows);
    let ranges = ranges(&problem.unknowns, rows);
    let cost = rows.views() * form.lobes * count;
    let places = (EVALUATIONS / cost.max(1)).clamp(PLACES[0], PLACES[1]);
    let generators = generators(ranges.len());
    let best = |start: usize| {
        let tried = (start * places..(start + 1) * places).filter_map(|i| {
            let share = |k: usize| ((i + 1) as f64 * generators[k]).fract();
            let mut x: Vec<f64> = ranges.iter().enumerate().map(|(k, range)| mix(*range, share(k))).collect();
            sort_widths(&problem.unknowns, &mut x);
            let score = strengthen(form, &problem.unknowns, rows, &mut x)?;
            Some((score, x))
        });
        tried.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, x)| x)
    };
    (0..count).into_par_iter().filter_map(best).collect()
}

fn mix([low, high]: [f64; 2], share: f64) -> f64 {
    low + share * (high - low)
}

/// The generalised golden ratios' inverses: the powers of 1/g, g^(d+1) = g + 1. Their multiples' fractions
/// fill the cube of d dimensions evenly.
fn generators(dimensions: usize) -> Vec<f64> {
    let mut g = 1.5_f64;
    for _ in 0..50 {
        g = (1.0 + g).powf(1.0 / (dimensions as f64 + 1.0));
    }
    (1..=dimensions).map(|k| g.powi(-(k as i32))).collect()
}

/// Where each number is looked for: widths around the observation angles, all else within its bounds.
fn ranges(unknowns: &[Unknown], rows: &Rows<'_>) -> Vec<[f64; 2]> {
    let angles = rows.observations.iter().map(|row| row.centre().observation());
    // The retro direction itself is no lobe's width, even where rounding makes it an angle, nor is the angle
    // of a luminance factor.
    let angles = angles.filter(|angle| (SAME_ANGLE..=RETRO_REACH).contains(angle));
    let (least, most) = angles.fold((f64::INFINITY, 0.0_f64), |(low, high), a| (low.min(a), high.max(a)));
    let widths = [least / BEYOND, most * BEYOND].map(f64::ln);
    let range = |unknown: &Unknown| match unknown.meaning {
        Meaning::Roughness(..) if most > 0.0 => widths.map(|x| x.clamp(unknown.bounds[0], unknown.bounds[1])),
        _ => unknown.bounds,
    };
    unknowns.iter().map(range).collect()
}

/// The lobes in the order of their widths, so that no place is looked at twice.
fn sort_widths(unknowns: &[Unknown], x: &mut [f64]) {
    for axis in [None, Some(0), Some(1)] {
        let of_axis = |unknown: &Unknown| matches!(unknown.meaning, Meaning::Roughness(_, a) if a == axis);
        let places: Vec<usize> = (0..x.len()).filter(|&k| of_axis(&unknowns[k])).collect();
        let mut widths: Vec<f64> = places.iter().map(|&k| x[k]).collect();
        widths.sort_by(f64::total_cmp);
        places.into_iter().zip(widths).for_each(|(k, width)| x[k] = width);
    }
}

/// Puts in the strengths that suit the other numbers best; returns how far off the rows are then.
///
/// They minimise the sum of ratio - ln ratio, which is convex in the strengths and least where no ratio
/// differs from 1. Each step multiplies a strength by the mean of 1 / ratio, weighted by its lobe's part in
/// the rows; it stays positive, and the sum falls (Richardson and Lucy's algorithm).
fn strengthen(form: Form, unknowns: &[Unknown], rows: &Rows<'_>, x: &mut [f64]) -> Option<f64> {
    let mut columns = rows.columns(&form.sheeting(unknowns, x))?;
    columns.truncate(form.lobes + usize::from(form.diffuse));
    // Below a maximum is nowhere in particular.
    let counts = |row: &Observation| row.aim != Aim::AtMost;
    let rows_that_count: Vec<usize> =
        (0..rows.observations.len()).filter(|&j| counts(&rows.observations[j])).collect();
    for column in &mut columns {
        *column = rows_that_count.iter().map(|&j| column[j]).collect();
    }
    let sums: Vec<f64> = columns.iter().map(|column| column.iter().sum()).collect();
    let count = rows_that_count.len() as f64;
    let mut strengths: Vec<f64> =
        sums.iter().map(|sum| count / (sum * columns.len() as f64)).map(|s| s.min(1.0)).collect();
    let mut ratios = vec![0.0; rows_that_count.len()];
    for _ in 0..STEPS {
        for (j, ratio) in ratios.iter_mut().enumerate() {
            let parts = columns.iter().zip(&strengths).map(|(column, strength)| strength * column[j]);
            *ratio = parts.sum::<f64>().max(f64::MIN_POSITIVE);
        }
        for ((strength, column), sum) in strengths.iter_mut().zip(&columns).zip(&sums) {
            let weighted: f64 = column.iter().zip(&ratios).map(|(part, ratio)| part / ratio).sum();
            *strength = (*strength * weighted / sum).clamp(f64::MIN_POSITIVE, 1.0);
        }
    }
    for (unknown, x) in unknowns.iter().zip(&mut *x) {
        let strength = match unknown.meaning {
            Meaning::Strength(lobe) => strengths[lobe],
            Meaning::Diffuse => strengths[form.lobes],
            _ => continue,
        };
        *x = strength.ln().clamp(unknown.bounds[0], unknown.bounds[1]);
    }
    let logs = rows.log_ratios(&form.sheeting(unknowns, x))?;
    Some(spread(&rows_that_count.iter().map(|&j| logs[j]).collect::<Vec<_>>()))
}

/// How far from each other the logarithms are: of a table the extremes, of measurements all of them.
fn spread(logs: &[f64]) -> f64 {
    if logs.len() <= TABLE_ROWS {
        let extreme = |better: fn(f64, f64) -> f64| logs.iter().copied().fold(logs[0], better);
        return extreme(f64::max) - extreme(f64::min);
    }
    let mean = logs.iter().sum::<f64>() / logs.len() as f64;
    logs.iter().map(|log| (log - mean).powi(2)).sum()
}
