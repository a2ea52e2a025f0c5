//! Which forms are tried, and which one is chosen.

use super::form::{EntranceKind, Form};
use super::observation::{Aim, Observation, SAME_ANGLE, weights};
use super::physical::Fault;
use super::solve::{Solution, TABLE_ROWS, solve};
use super::{FitError, FitOptions, Trial, is_acceptable};
use crate::Geometry;

/// Most lobes of a fit.
pub const MAX_LOBES: usize = 3;
/// Most lobes that a table of a few rows is given without being asked: a third one hardly ever helps.
const MAX_LOBES_OF_TABLE: usize = 2;

/// Which angles the values near the retro direction cover.
#[derive(Clone, Debug)]
pub(crate) struct Span {
    observation: Vec<f64>,
    entrance: Vec<f64>,
    /// Whether the offset from the retro direction points more than one way: the sample was turned.
    turned: bool,
}

impl Span {
    pub(crate) fn of(observations: &[Observation]) -> Self {
        let seen: Vec<Geometry> =
            observations.iter().filter(|row| row.is_retro()).map(Observation::centre).collect();
        let planes = distinct(seen.iter().map(Geometry::offset_plane));
        Self {
            observation: distinct(seen.iter().map(Geometry::observation)),
            entrance: distinct(seen.iter().map(Geometry::entrance)),
            turned: planes.len() > 1,
        }
    }

    pub(crate) fn check(&self, options: &FitOptions) -> Result<(), FitError> {
        match self.observation[..] {
            [] => Err(FitError::NotRetro),
            [only] if options.roughness.is_none() => {
                Err(FitError::OneObservationAngle { angle_deg: only.to_degrees() })
            }
            _ => Ok(()),
        }
    }

    /// Whether there are two observation angles and two entrance angles at least.
    #[cfg(test)]
    pub(crate) fn is_grid(&self) -> bool {
        self.observation.len() > 1 && self.entrance.len() > 1
    }

    /// Whether an observation's angles are within those.
    #[cfg(test)]
    pub(crate) fn holds(&self, row: &Observation) -> bool {
        let centre = row.centre();
        let is_within = |angles: &[f64], angle: f64| {
            angle > angles[0] - SAME_ANGLE && angle < angles[angles.len() - 1] + SAME_ANGLE
        };
        is_within(&self.observation, centre.observation()) && is_within(&self.entrance, centre.entrance())
    }

    /// What the data leave open whatever the form.
    pub(crate) fn warnings(&self, options: &FitOptions, rows: usize, unknowns: usize) -> Vec<String> {
        let mut warnings = Vec::new();
        if let [only] = self.entrance[..] {
            let angle_deg = only.to_degrees();
            warnings.push(format!(
                "all values are at the entrance angle {angle_deg:.1} deg: how the material loses light with that \
                 angle is not determined, and not modelled"
            ));
        }
        if unknowns > rows {
            warnings.push(format!(
                "{rows} values can't determine {unknowns} numbers: another material fits them as well"
            ));
        }
        if !options.diffuse {
            warnings.push(
                "no luminance factor is given: the material has no diffuse base and is black by day"
                    .to_owned(),
            );
        }
        warnings
    }

    /// Where a solution is not what sheeting can be. One that models nothing over the entrance angle is not
    /// asked: the warning of values at a single entrance angle says so.
    pub(crate) fn fault(&self, solution: &Solution) -> Option<Fault> {
        let is_modelled = solution.form.entrance != EntranceKind::Constant;
        is_modelled.then(|| solution.sheeting.fault(&self.observation)).flatten()
    }

    /// The forms to try for so many rows, those with fewer numbers first.
    pub(crate) fn forms(&self, options: &FitOptions, rows: usize) -> Vec<Form> {
        let lobes = options.lobes.or(options.roughness.map(|_| 1));
        let most = if rows > TABLE_ROWS { MAX_LOBES } else { MAX_LOBES_OF_TABLE };
        let lobes = lobes.map_or(1..=most, |lobes| lobes..=lobes);
        let kinds = match options.entrance {
            Some(kind) => vec![kind],
            None if self.entrance.len() == 1 => vec![EntranceKind::Constant],
            None => vec![EntranceKind::Power, EntranceKind::Bend],
        };
        let mut forms = Vec::new();
        for lobes in lobes {
            for &entrance in &kinds {
                let own = lobes > 1 && entrance != EntranceKind::Constant;
                for shared in if own { vec![true, false] } else { vec![true] } {
                    forms.push(Form {
                        model: options.model,
                        lobes,
                        entrance,
                        shared,
                        anisotropic: self.turned && !options.isotropic,
                        diffuse: options.diffuse,
                        roughness: options.roughness,
                        coat_ior: options.coat_ior,
                    });
                }
            }
        }
        // A bend where a power does would be read as a measured one.
        forms.sort_by_key(|form| (form.unknowns().len(), form.entrance, form.lobes));
        forms
    }
}

fn distinct(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup_by(|a, b| (*a - *b).abs() < SAME_ANGLE);
    values
}

/// The simplest form that meets the tolerance, or the best one; for measurements with noise and for limits,
/// the one of the least Bayesian information criterion.
pub(crate) fn choose(
    observations: &[Observation],
    options: &FitOptions,
    span: &Span,
    forms: &[Form],
) -> Result<(Solution, Vec<Trial>), FitError> {
    let rows = observations.len();
    let judged = match observations.iter().any(|row| row.aim == Aim::AtLeast) {
        true => Judged::Limits(options.tolerance),
        false if rows <= TABLE_ROWS && !weights(observations).1 => Judged::Worst,
        false => Judged::Noise,
    };
    let mut trials = Vec::new();
    let mut found: Vec<(Solution, (bool, bool))> = Vec::new();
    for &form in forms {
        let simpler = found.iter().map(|(solution, _)| solution);
        let Some(solution) = solve(form, observations, options.channel_peak, options.tolerance, simpler)
        else {
            continue;
        };
        let (unknowns, worst, rms) = (solution.unknowns(), solution.worst, solution.rms);
        let fault = span.fault(&solution);
        trials.push(Trial { form, unknowns, worst, rms, fault });
        let is_met = fault.is_none() && is_acceptable(&solution, options);
        found.push((solution, (is_met, fault.is_none())));
        if judged == Judged::Worst && is_met {
            break;
        }
    }
    // What is accepted before what isn't, what is physical between the rows before what isn't.
    let better = |a: &(Solution, (bool, bool)), b: &(Solution, (bool, bool))| {
        b.1.cmp(&a.1).then(judged.score(&a.0).total_cmp(&judged.score(&b.0)))
    };
    let (best, _) = found.into_iter().min_by(better).ok_or(FitError::NoSolution)?;
    Ok((best, trials))
}

/// What makes a form better than another one. The last two are Bayesian information criteria, of limits with
/// the prior: there is much that meets them.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Judged {
    /// The worst row of a table; the first form that meets the tolerance will do.
    Worst,
    /// Errors of unknown size.
    Noise,
    /// Limits with the least to spare, in units of this tolerance: with strength enough every form meets a
    /// minimum.
    Limits(f64),
}

impl Judged {
    /// Less is better.
    fn score(self, solution: &Solution) -> f64 {
        let rows = solution.log_ratios.len() as f64;
        let price = solution.unknowns() as f64 * rows.ln();
        match self {
            Self::Worst => solution.worst,
            Self::Noise => rows * (solution.squares() / rows).max(f64::MIN_POSITIVE).ln() + price,
            Self::Limits(tolerance) => solution.cost(tolerance) + price,
        }
    }
}
