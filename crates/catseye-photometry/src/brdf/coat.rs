//! The mirror peak of a measured BRDF, as the surface of a rough dielectric coat.

use super::selection::rows;
use super::{Brdf, Region, Selection};
use crate::fit::Observation;
use crate::sheeting::Surface;
use crate::{Apertures, Error};

/// Indices and roughnesses that are looked for.
const IOR: [f64; 2] = [1.05, 3.0];
const ROUGHNESS: [f64; 2] = [1e-3, 0.5];
/// How far above the base a value is that is of the peak, and how many make one.
const ABOVE_BASE: f64 = 3.0;
const LEAST_SAMPLES: usize = 8;
/// Narrowest peak in terms of the aperture: the rule is exact to 1 % for it.
const LEAST_PER_APERTURE: f64 = 0.25;
/// Degree of the rule: peaks are narrower than lobes.
const DEGREE: usize = 23;
/// Samples around the mirror direction that are looked at.
const SAMPLES: usize = 400;
/// The greatest part of the squared logarithms that a coat may leave of those without one.
const LEFT: f64 = 0.5;
/// Values of a number that are tried at once, and how often the range between the best one's neighbours is
/// divided again: to 0.4 % of the range.
const GRID: usize = 7;
const ROUNDS: usize = 5;

/// A rough dielectric surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coat {
    /// Its index of refraction.
    pub ior: f64,
    /// GGX's alpha.
    pub roughness: f64,
}

impl Brdf {
    /// The coat whose reflection on the base is nearest to the values around the mirror direction. The index
    /// may be given.
    ///
    /// `None` where fewer than eight values are three times as high as the base, and, if no index is given,
    /// where the peak is none of a dielectric: the coat would leave more than half of the squared logarithms.
    ///
    /// # Errors
    /// Apertures out of range.
    pub fn coat(
        &self,
        selection: &Selection,
        apertures: Apertures,
        ior: Option<f64>,
    ) -> Result<Option<Coat>, Error> {
        let base = self.base(selection);
        let peak = selection.samples(self, Region::Mirror).filter(|s| s.luminance() > ABOVE_BASE * base);
        if peak.take(LEAST_SAMPLES).count() < LEAST_SAMPLES {
            return Ok(None);
        }
        let samples = Selection { count: SAMPLES, ..*selection }.of_mirror(self);
        let rows = rows(samples, &apertures.rule_of_degree(DEGREE)?);
        let least = LEAST_PER_APERTURE * apertures.source.max(apertures.receiver);
        let roughness = [ROUGHNESS[0].max(least), ROUGHNESS[1]].map(f64::ln);
        let best = |ior: f64| nearest(roughness, |roughness| error(&rows, base, [ior, roughness.exp()]));
        let free = ior.is_none();
        let ior = ior.unwrap_or_else(|| nearest(IOR.map(f64::ln), |ior| best(ior.exp()).1).0.exp());
        let (roughness, left) = best(ior);
        let without: f64 = rows.iter().map(|row| (base / row.value).ln().powi(2)).sum();
        Ok((!free || left < LEFT * without).then_some(Coat { ior, roughness: roughness.exp() }))
    }

    /// The median of the values that are neither near the incident nor near the mirror direction, or else the
    /// least near the latter.
    fn base(&self, selection: &Selection) -> f64 {
        let mut values: Vec<f64> = selection.of_base(self).iter().map(|s| s.luminance()).collect();
        values.sort_by(f64::total_cmp);
        let least = || selection.of_mirror(self).iter().map(|s| s.luminance()).fold(f64::INFINITY, f64::min);
        values.get(values.len() / 2).copied().unwrap_or_else(least)
    }
}

/// The place of the least error in a range, and that error, by a grid that closes in.
fn nearest([mut low, mut high]: [f64; 2], error: impl Fn(f64) -> f64) -> (f64, f64) {
    let mut best = (low, f64::INFINITY);
    for _ in 0..ROUNDS {
        let step = (high - low) / (GRID - 1) as f64;
        for place in (0..GRID).map(|i| low + step * i as f64) {
            let found = error(place);
            if found < best.1 {
                best = (place, found);
            }
        }
        (low, high) = ((best.0 - step).max(low), (best.0 + step).min(high));
    }
    best
}

/// The sum of the squared logarithms of model over value.
fn error(rows: &[Observation], base: f64, [ior, roughness]: [f64; 2]) -> f64 {
    let Ok(surface) = Surface::new(ior, roughness) else { return f64::INFINITY };
    let square = |row: &Observation| ((base + surface.mean(row)) / row.value).ln().powi(2);
    rows.iter().map(square).sum()
}

impl Surface {
    /// What an instrument sees of the surface.
    pub(super) fn mean(&self, row: &Observation) -> f64 {
        row.views.iter().map(|view| view.factor * self.eval(view.wo, view.wi)).sum()
    }
}
