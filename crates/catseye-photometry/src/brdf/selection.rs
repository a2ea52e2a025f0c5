//! What of a measured BRDF a fit looks at.

use super::{Brdf, BrdfSample};
use crate::fit::{Aim, Observation, View};
use crate::{ApertureRule, Geometry};

/// Which samples are rows of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Selection {
    /// The greatest angle between receiver and source, radians.
    pub observation: f64,
    /// The greatest angle between the normal and either of them, radians.
    pub zenith: f64,
    /// The least value, as a share of the greatest: below it is what the instrument doesn't see.
    pub floor: f64,
    /// The most samples; of more, as many are taken, evenly in the order of the observation angle.
    pub count: usize,
}

impl Default for Selection {
    /// Around the retro direction, to 20 degrees; not near the horizon, where measurements are bad; above
    /// 1e-5 of the peak.
    fn default() -> Self {
        Self { observation: 20_f64.to_radians(), zenith: 80_f64.to_radians(), floor: 1e-5, count: 2000 }
    }
}

impl Selection {
    /// The samples of a BRDF that are selected, by rising observation angle.
    #[must_use]
    pub fn of<'a>(&self, brdf: &'a Brdf) -> Vec<&'a BrdfSample> {
        let peak = brdf.samples.iter().map(BrdfSample::luminance).fold(0.0, f64::max);
        let cosine = self.zenith.cos();
        let mut chosen: Vec<(f64, &BrdfSample)> = brdf
            .samples
            .iter()
            .filter(|s| s.wo.z.min(s.wi.z) >= cosine && s.luminance() > self.floor * peak)
            .map(|s| (Geometry { wo: s.wo, wi: s.wi }.observation(), s))
            .filter(|(observation, _)| *observation <= self.observation)
            .collect();
        chosen.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let step = (chosen.len() as f64 / self.count.max(1) as f64).max(1.0);
        let taken = (0..).map(|i| (f64::from(i) * step) as usize).take_while(|&i| i < chosen.len());
        taken.map(|i| chosen[i].1).collect()
    }

    /// Rows of a fit to the luminance of a BRDF, in 1/sr, as an instrument with these apertures sees it.
    ///
    /// Each row is f averaged over the apertures. They are dropped where an aperture reaches below the
    /// surface.
    #[must_use]
    pub fn observations(&self, brdf: &Brdf, apertures: &ApertureRule) -> Vec<Observation> {
        let rows = self.of(brdf).into_iter().map(|sample| Observation {
            value: sample.luminance(),
            aim: Aim::Equal,
            views: apertures
                .directions(sample.wo, sample.wi)
                .map(|(wo, wi, factor)| View { wo, wi, factor })
                .collect(),
        });
        rows.filter(|row| row.views.iter().all(|view| view.wo.z > 0.0 && view.wi.z > 0.0)).collect()
    }
}
