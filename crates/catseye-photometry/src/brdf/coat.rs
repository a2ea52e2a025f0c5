//! The mirror peak of a measured BRDF, as the surface of a rough dielectric coat.

use super::selection::rows;
use super::{Brdf, Selection};
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
/// Samples of the peak that are looked at.
const SAMPLES: usize = 200;
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
    /// The coat whose reflection is nearest to the values around the mirror direction that are three times as
    /// high as the base; `None` where there are fewer than eight. The index may be given.
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
        let selection = Selection { count: SAMPLES, ..*selection };
        let peak = selection.of_mirror(self, ABOVE_BASE * base);
        let rows = rows(peak, &apertures.rule_of_degree(DEGREE)?);
        if rows.len() < LEAST_SAMPLES {
            return Ok(None);
        }
        let least = LEAST_PER_APERTURE * apertures.source.max(apertures.receiver);
        let roughness = [ROUGHNESS[0].max(least), ROUGHNESS[1]].map(f64::ln);
        let best = |ior: f64| nearest(roughness, |roughness| error(&rows, base, [ior, roughness.exp()]));
        let (ior, _) = match ior {
            Some(ior) => (ior.ln(), 0.0),
            None => nearest(IOR.map(f64::ln), |ior| best(ior.exp()).1),
        };
        let ior = ior.exp();
        Ok(Some(Coat { ior, roughness: best(ior).0.exp() }))
    }

    /// The median of the values that are neither near the incident nor near the mirror direction, or else the
    /// least near the latter.
    fn base(&self, selection: &Selection) -> f64 {
        let mut values: Vec<f64> = selection.of_base(self).iter().map(|s| s.luminance()).collect();
        values.sort_by(f64::total_cmp);
        let least =
            || selection.of_mirror(self, 0.0).iter().map(|s| s.luminance()).fold(f64::INFINITY, f64::min);
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
