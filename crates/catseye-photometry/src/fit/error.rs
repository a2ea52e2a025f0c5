//! Why data can't be fitted.

use super::select::MAX_LOBES;
use super::{FitOptions, Observation};
use crate::significant;

/// Values that a fit takes. More of them say nothing that these don't, and so many already take a minute
/// or more.
pub const MAX_VALUES: usize = 10_000;

/// Why there is no fit: what is wrong with the data or the options, and the way out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// No observations.
    #[error("there are no values to fit")]
    Empty,
    /// More values than a fit takes.
    #[error("{values} values are more than the {MAX_VALUES} that are fitted; keep one row in {}", values.div_ceil(MAX_VALUES))]
    TooMany {
        /// The values.
        values: usize,
    },
    /// A value that has no logarithm, or directions below the horizon.
    #[error("value {row} is {value}: only finite values above 0 can be fitted")]
    NotPositive {
        /// Number of the observation, from 1.
        row: usize,
        /// The value.
        value: f64,
    },
    /// A geometry that no sheeting sends light back in.
    #[error("value {row} is measured from below the surface")]
    BelowHorizon {
        /// Number of the observation, from 1.
        row: usize,
    },
    /// Luminance factors alone, for instance.
    #[error("no value is within 30 deg of the retro direction: nothing says what comes back")]
    NotRetro,
    /// All values are at one observation angle, so nothing says how wide the lobe is.
    #[error(
        "all values are at the observation angle {angle_deg:.3} deg: the width of a lobe can't be determined; \
         give its half-power angle, or values at another observation angle"
    )]
    OneObservationAngle {
        /// The angle.
        angle_deg: f64,
    },
    /// An option is out of its range.
    #[error("{name} is {}: it must be in {range}", significant(*value, 6))]
    Option {
        /// Name of the option.
        name: &'static str,
        /// Its value; the tolerance in percent.
        value: f64,
        /// The range, and the unit.
        range: &'static str,
    },
    /// A given width and several lobes.
    #[error("a given roughness is that of a single lobe, and {lobes} are asked for")]
    RoughnessOfMany {
        /// The lobes asked for.
        lobes: usize,
    },
    /// The best model is no retro-reflector.
    #[error("no lobe stands out of the values near the retro direction: they are those of a diffuse surface")]
    NoLobe,
    /// Nothing came out.
    #[error("no start of any form leads to finite numbers; check the table's units")]
    NoSolution,
}

/// Checks values and options.
pub(super) fn check(observations: &[Observation], options: &FitOptions) -> Result<(), FitError> {
    if observations.is_empty() {
        return Err(FitError::Empty);
    }
    if observations.len() > MAX_VALUES {
        return Err(FitError::TooMany { values: observations.len() });
    }
    for (i, observation) in observations.iter().enumerate() {
        if !(observation.value > 0.0 && observation.value.is_finite()) {
            return Err(FitError::NotPositive { row: i + 1, value: observation.value });
        }
        if !observation.views.iter().all(|view| view.wo.z > 0.0 && view.wi.z > 0.0) {
            return Err(FitError::BelowHorizon { row: i + 1 });
        }
    }
    let option = |name, value, range, good: bool| {
        if good { Ok(()) } else { Err(FitError::Option { name, value, range }) }
    };
    let lobes = options.lobes.unwrap_or(1);
    option("the number of lobes", lobes as f64, "[1, 3]", (1..=MAX_LOBES).contains(&lobes))?;
    let roughness = options.roughness.unwrap_or(1.0);
    option("the roughness", roughness, "(0, inf)", roughness > 0.0 && roughness.is_finite())?;
    let ior = options.coat_ior.unwrap_or(1.5);
    option("the coat's index of refraction", ior, "(1, 4]", ior > 1.0 && ior <= 4.0)?;
    let percent = 100.0 * options.tolerance;
    option("the tolerance", percent, "(0, 100] %", percent > 0.0 && percent <= 100.0)?;
    let peak = options.channel_peak;
    option(
        "a colour's greatest channel over its luminance",
        peak,
        "[1, inf)",
        peak >= 1.0 && peak.is_finite(),
    )?;
    if options.roughness.is_some() && lobes > 1 {
        return Err(FitError::RoughnessOfMany { lobes });
    }
    Ok(())
}
