//! Fits: from photometric values to the lobes of a material.
//!
//! A model of 1 to 3 lobes with entrance laws ([`Form`]) is fitted to the logarithms of the values by
//! Levenberg and Marquardt's method. Every number is kept within bounds, the albedo of every direction at 1
//! or less, and a number that the data leave open near a weak prior, with a warning. Where a table's worst
//! row is beyond the tolerance the worst error itself is made least. Each form starts from many places and
//! from what simpler forms found. Without a wish, the form with the fewest numbers that meets the tolerance
//! is chosen.

mod error;
mod form;
#[cfg(test)]
mod leave_one_out;
mod minimax;
mod observation;
mod outlier;
mod physical;
mod problem;
mod rows;
mod select;
mod shape;
mod solve;
mod starts;
mod uncertainty;
mod walls;

pub use error::{FitError, MAX_VALUES};
pub use form::{EntranceKind, Form, Meaning};
pub(crate) use observation::RETRO_REACH;
pub use observation::{Aim, Observation, RowError, View};
pub use outlier::Outlier;
pub use physical::Fault;
pub use select::MAX_LOBES;
pub use shape::ShapeBound;
pub use uncertainty::{Deviation, Estimate};

use catseye::Model;

use crate::sheeting::Sheeting;
use solve::{Solution, TABLE_ROWS};

/// The worst error of a row that a fit may have: values on data sheets are not better than that.
pub const TOLERANCE: f64 = 0.05;

/// What a fit may do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitOptions {
    /// Which lobe model.
    pub model: Model,
    /// Lobes, 1 to [`MAX_LOBES`]; `None` chooses.
    pub lobes: Option<usize>,
    /// How the strength depends on the entrance angle; `None` chooses.
    pub entrance: Option<EntranceKind>,
    /// The roughness of a single lobe where the data can't tell it.
    pub roughness: Option<f64>,
    /// Whether the data hold for every orientation of the sample, so that lobes have one roughness.
    pub isotropic: bool,
    /// Whether the model has a diffuse base.
    pub diffuse: bool,
    /// Refractive index of a clear coat over the lobes, if there is one.
    pub coat_ior: Option<f64>,
    /// The error that is accepted, as a share of the value: of the worst row.
    pub tolerance: f64,
    /// Whether the tolerance is of the rows' root mean square instead: for measurements with noise.
    pub of_rms: bool,
    /// Greatest channel of the material's colour over its luminance: energy is conserved in each channel.
    pub channel_peak: f64,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self {
            model: Model::Reciprocal,
            lobes: None,
            entrance: None,
            roughness: None,
            isotropic: false,
            diffuse: false,
            coat_ior: None,
            tolerance: TOLERANCE,
            of_rms: false,
            channel_peak: 1.0,
        }
    }
}

/// A form that was tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// The form.
    pub form: Form,
    /// Its free numbers.
    pub unknowns: usize,
    /// The greatest error of a row, as a share of its value.
    pub worst: f64,
    /// Root mean square of the rows' errors, as logarithms.
    pub rms: f64,
    /// Where over the entrance angle it is not what sheeting can be, if anywhere.
    pub fault: Option<Fault>,
}

/// A fitted material and how good it is.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The form that was chosen.
    pub form: Form,
    /// The fitted material.
    pub sheeting: Sheeting,
    /// The fitted numbers with their uncertainties.
    pub estimates: Vec<Estimate>,
    /// Where those come from.
    pub deviation: Deviation,
    /// Values unlike the others, those farthest off first; none where every row is within the tolerance.
    pub outliers: Vec<Outlier>,
    /// Model over value for each observation.
    pub ratios: Vec<f64>,
    /// The greatest error of a row, as a share of its value; for a bound, by how much it is broken.
    pub worst: f64,
    /// Root mean square of the rows' errors, as logarithms.
    pub rms: f64,
    /// Whether every row is within the tolerance, or the root mean square where the options say so, and the
    /// material is physical between and beyond the rows.
    pub acceptable: bool,
    /// Where between or beyond the rows the material is not what sheeting can be, if anywhere.
    pub fault: Option<Fault>,
    /// What no sum of lobes can do better, where the table has such rows.
    pub shape: Option<ShapeBound>,
    /// The forms that were tried, in order.
    pub trials: Vec<Trial>,
    /// What the reader should know; of a single number [`Estimate::warning`] says it.
    pub warnings: Vec<String>,
}

/// Fits a material to observations.
///
/// # Errors
/// Data that can't determine any form, values that aren't positive numbers, options out of range.
pub fn fit(observations: &[Observation], options: &FitOptions) -> Result<Fit, FitError> {
    error::check(observations, options)?;
    let span = select::Span::of(observations);
    span.check(options)?;
    let forms = span.forms(options, observations.len());
    let (solution, trials) = select::choose(observations, options, &span, &forms)?;
    if greatest_share(&solution.sheeting, observations) < LEAST_SHARE {
        return Err(FitError::NoLobe);
    }
    let (estimates, deviation) = uncertainty::estimates(&solution, observations, options);
    let mut warnings = span.warnings(options, observations.len(), solution.unknowns());
    warnings.extend(deviation.warning(observations.len(), solution.unknowns()));
    let outliers = outlier::outliers(&solution, observations, options);
    // The noise of measurements is not log-convex either.
    let is_table = observations.len() <= TABLE_ROWS;
    let shape = (is_table && options.model == Model::Reciprocal)
        .then(|| shape::shape_bound(observations, options))
        .flatten();
    let fault = span.fault(&solution);
    Ok(Fit {
        form: solution.form,
        estimates,
        deviation,
        outliers,
        ratios: solution.log_ratios.iter().map(|log| log.exp()).collect(),
        worst: solution.worst,
        rms: solution.rms,
        acceptable: fault.is_none() && is_acceptable(&solution, options),
        fault,
        shape: shape.filter(|bound| bound.error > options.tolerance),
        trials,
        warnings,
        sheeting: solution.sheeting,
    })
}

/// The least part of two values near the retro direction that lobes must have, and the roughness beyond which
/// a lobe is none: its half-power angle is 45 degrees.
const LEAST_SHARE: f64 = 0.2;
const WIDEST: f64 = 1.0;

/// The greatest part that lobes which are some have of the model's values near the retro direction, but for
/// one value where there are more: a lobe that only one of them sees is its noise.
fn greatest_share(sheeting: &Sheeting, observations: &[Observation]) -> f64 {
    let lobes = sheeting.lobes.iter().filter(|lobe| lobe.roughness[0].min(lobe.roughness[1]) < WIDEST);
    let lobes = Sheeting { lobes: lobes.copied().collect(), diffuse: 0.0, ..sheeting.clone() };
    let (Ok(whole), Ok(lobes)) = (sheeting.prepare(), lobes.prepare()) else { return 0.0 };
    let share = |view: &View| lobes.eval(view.wo, view.wi) / whole.eval(view.wo, view.wi);
    let retro = observations.iter().filter(|row| row.is_retro());
    let mut shares: Vec<f64> = retro.map(|row| row.views.iter().map(share).fold(0.0, f64::max)).collect();
    shares.sort_by(|a, b| b.total_cmp(a));
    shares.get(1).or(shares.first()).copied().unwrap_or(0.0)
}

fn is_acceptable(solution: &Solution, options: &FitOptions) -> bool {
    let error = if options.of_rms { solution.rms } else { solution.worst };
    error <= options.tolerance
}

impl Fit {
    /// By how much, as a share, the BSDF of an observation differs at most where viewer and light change
    /// places: what it costs that a node graph knows only the direction to the viewer.
    #[must_use]
    pub fn reciprocity_cost(&self, observations: &[Observation]) -> f64 {
        let Ok(prepared) = self.sheeting.prepare() else { return f64::NAN };
        let ratio =
            |view: &View| (prepared.eval(view.wo, view.wi) / prepared.eval(view.wi, view.wo)).ln().abs();
        let retro = observations.iter().filter(|row| row.is_retro());
        retro.flat_map(|row| &row.views).map(ratio).fold(0.0, f64::max).exp_m1()
    }
}
