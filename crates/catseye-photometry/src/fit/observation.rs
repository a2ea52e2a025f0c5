//! What was measured, as a fit sees it.

use catseye::Vec3;

use crate::{ApertureRule, Geometry, Quantity, Row};

/// Whether a value is met or only bounded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Aim {
    /// The value itself.
    #[default]
    Equal,
    /// At least the value: the minimum of a standard.
    AtLeast,
    /// At most the value.
    AtMost,
}

/// A pair of directions and what its BSDF counts for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Towards the receiver.
    pub wo: Vec3<f64>,
    /// Towards the source.
    pub wi: Vec3<f64>,
    /// What the BSDF is multiplied by: the cosines of the quantity, and the weight within an aperture.
    pub factor: f64,
}

/// A value and the directions it was measured in: one pair, or a sum over an instrument's apertures.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// The value in the SI unit of its quantity, above 0.
    pub value: f64,
    /// One standard deviation of it as a share of it; 0 where the value is given, not measured.
    pub uncertainty: Option<f64>,
    /// Whether the value is met or only bounded.
    pub aim: Aim,
    /// The directions.
    pub views: Vec<View>,
}

impl Observation {
    /// The value of a table's row; `area_m2` is that of the whole reflector, which `R_I` is a quantity of.
    ///
    /// # Errors
    /// A row without a value, and a quantity that the geometry doesn't determine.
    pub fn from_row(row: &Row, aim: Aim, area_m2: Option<f64>) -> Result<Self, RowError> {
        let geometry = row.geometry();
        let (quantity, area) = match (row.quantity, area_m2) {
            (Quantity::LuminousIntensity, Some(area)) => (Quantity::RetroReflectionCoefficient, area),
            (Quantity::LuminousIntensity, None) => return Err(RowError::NeedsArea),
            (quantity, _) => (quantity, 1.0),
        };
        let Some(factor) = quantity.of_brdf(area, &geometry) else {
            return Err(RowError::Integral { quantity });
        };
        let value = row.value.ok_or(RowError::NoValue)?;
        let uncertainty = row.uncertainty.map(|uncertainty| uncertainty / value);
        let views = vec![View { wo: geometry.wo, wi: geometry.wi, factor }];
        Ok(Self { value, uncertainty, aim, views })
    }
}

impl Observation {
    /// The same value as the mean over an instrument's apertures instead of between points.
    #[must_use]
    pub fn through(&self, apertures: &ApertureRule) -> Self {
        let spread = |view: &View| {
            let factor = view.factor;
            let directions = apertures.directions(view.wo, view.wi);
            directions
                .map(move |(wo, wi, weight)| View { wo, wi, factor: factor * weight })
                .collect::<Vec<_>>()
        };
        Self { views: self.views.iter().flat_map(spread).collect(), ..self.clone() }
    }
}

/// Angle from the retro direction beyond which a value is of the diffuse base, not of the lobes: a luminance
/// factor.
pub(crate) const RETRO_REACH: f64 = 30.0 * core::f64::consts::PI / 180.0;
/// Angles that differ by less than this are one: a hundredth of a degree.
pub(crate) const SAME_ANGLE: f64 = 1.8e-4;

impl Observation {
    /// The middle of the directions: to the receiver, to the source. An aperture's views surround what is
    /// meant.
    #[must_use]
    pub fn centre(&self) -> Geometry {
        let mean = |of: fn(&View) -> Vec3<f64>| {
            self.views.iter().map(of).fold(Vec3::default(), |sum, w| sum + w).normalized()
        };
        Geometry { wo: mean(|view| view.wo), wi: mean(|view| view.wi) }
    }

    /// The same value as if it were measured between points.
    pub(crate) fn at_centre(&self) -> Self {
        let Geometry { wo, wi } = self.centre();
        let factor = self.views.iter().map(|view| view.factor).sum();
        Self { views: vec![View { wo, wi, factor }], ..*self }
    }

    /// Whether the value says something about the lobes: it is within 30 degrees of the retro direction.
    #[must_use]
    pub fn is_retro(&self) -> bool {
        self.centre().observation() <= RETRO_REACH
    }
}

/// How much the values count in a sum of squares: as the inverse of their uncertainty, the least uncertain
/// one and what is given as 1. All alike where some have none. Beside it, whether all have one.
pub(crate) fn weights(observations: &[Observation]) -> (Vec<f64>, bool) {
    let measured = || observations.iter().filter(|row| row.uncertainty != Some(0.0));
    let is_stated = measured().all(|row| row.uncertainty.is_some()) && measured().next().is_some();
    if !is_stated {
        return (vec![1.0; observations.len()], false);
    }
    let least = measured().filter_map(|row| row.uncertainty).fold(f64::INFINITY, f64::min);
    let weight = |row: &Observation| row.uncertainty.filter(|share| *share > 0.0).map_or(1.0, |s| least / s);
    (observations.iter().map(weight).collect(), true)
}

/// Why a row can't be fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RowError {
    /// The intensity of a whole reflector.
    #[error("R_I is of a whole reflector; give its area to fit it as a surface")]
    NeedsArea,
    /// A quantity that is an integral over directions.
    #[error("{quantity} is an integral over directions and says little about any; leave it out")]
    Integral {
        /// The quantity.
        quantity: Quantity,
    },
    /// A row that was read for its geometry only.
    #[error("has no value")]
    NoValue,
}
