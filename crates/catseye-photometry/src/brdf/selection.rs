//! What of a measured BRDF a fit looks at, and the regions that it is judged in.

use catseye::Vec3;

use super::{Brdf, BrdfSample};
use crate::fit::{Aim, Observation, View};
use crate::{ApertureRule, Geometry};

/// Angle from the incident and from the mirror direction beyond which values are of the base, radians: what a
/// fit takes for no retro-reflection.
const AWAY: f64 = crate::fit::RETRO_REACH;

/// Which samples are rows of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Selection {
    /// The greatest angle between receiver and source, radians; also that around the mirror direction.
    pub observation: f64,
    /// The greatest angle between the normal and either of them, radians.
    pub zenith: f64,
    /// The least value, as a share of the greatest: below it is what the instrument doesn't see.
    pub floor: f64,
    /// The most samples of a region; of more, as many are taken, evenly in the order of the angle.
    pub count: usize,
}

impl Default for Selection {
    /// Around the retro direction, to 20 degrees; not near the horizon, where measurements are bad; above
    /// 1e-5 of the peak.
    fn default() -> Self {
        Self { observation: 20_f64.to_radians(), zenith: 80_f64.to_radians(), floor: 1e-5, count: 2000 }
    }
}

/// A part of a measured BRDF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// Around the incident direction.
    Retro,
    /// Around the direction of the mirror image, where it is farther from the incident one.
    Mirror,
    /// Neither.
    Elsewhere,
    /// All samples above 0, whatever the selection leaves out.
    File,
}

impl BrdfSample {
    /// Angle between receiver and source.
    pub(super) fn observation(&self) -> f64 {
        Geometry { wo: self.wo, wi: self.wi }.observation()
    }

    /// Angle between the receiver and the mirror image of the source.
    pub(super) fn off_mirror(&self) -> f64 {
        Geometry { wo: self.wo, wi: Vec3::new(-self.wi.x, -self.wi.y, self.wi.z) }.observation()
    }
}

impl Region {
    /// All, in the order in which they are told.
    pub const ALL: [Self; 4] = [Self::Retro, Self::Mirror, Self::Elsewhere, Self::File];

    /// Where it is, in words.
    #[must_use]
    pub fn name(self, selection: &Selection) -> String {
        let (reach, zenith) = (selection.observation.to_degrees(), selection.zenith.to_degrees());
        match self {
            Self::Retro => format!("within {reach:.0} deg of the incident direction"),
            Self::Mirror => format!("within {reach:.0} deg of the mirror direction"),
            Self::Elsewhere => format!("elsewhere, to {zenith:.0} deg from the normal"),
            Self::File => "the whole file".to_owned(),
        }
    }
}

impl Selection {
    /// All samples of a region, in the order of the file.
    pub fn samples<'a>(
        &self,
        brdf: &'a Brdf,
        region: Region,
    ) -> impl Iterator<Item = &'a BrdfSample> + use<'a> {
        let peak = brdf.samples.iter().map(BrdfSample::luminance).fold(0.0, f64::max);
        let (cosine, floor, reach) = (self.zenith.cos(), self.floor * peak, self.observation);
        brdf.samples.iter().filter(move |sample| {
            let (retro, mirror) = (sample.observation(), sample.off_mirror());
            let own = match region {
                Region::File => return sample.luminance() > 0.0,
                Region::Retro => retro <= reach,
                Region::Mirror => retro > reach && mirror <= reach,
                Region::Elsewhere => retro > reach && mirror > reach,
            };
            own && sample.wo.z.min(sample.wi.z) >= cosine && sample.luminance() > floor
        })
    }

    /// The samples that are fitted to around the incident direction, by rising observation angle.
    #[must_use]
    pub fn of<'a>(&self, brdf: &'a Brdf) -> Vec<&'a BrdfSample> {
        evenly(self.samples(brdf, Region::Retro), BrdfSample::observation, self.count)
    }

    /// Those around the mirror direction.
    pub(super) fn of_mirror<'a>(&self, brdf: &'a Brdf) -> Vec<&'a BrdfSample> {
        evenly(self.samples(brdf, Region::Mirror), BrdfSample::off_mirror, self.count)
    }

    /// Those that are 30 degrees away from both, a quarter as many at most: the base has one number.
    pub(super) fn of_base<'a>(&self, brdf: &'a Brdf) -> Vec<&'a BrdfSample> {
        let away = |sample: &&BrdfSample| sample.observation().min(sample.off_mirror()) > AWAY;
        let samples = self.samples(brdf, Region::Elsewhere).filter(away);
        evenly(samples, BrdfSample::observation, self.count.div_ceil(4))
    }

    /// Rows of a fit to the luminance of a BRDF, in 1/sr, as an instrument with these apertures sees it.
    ///
    /// Each row is f averaged over the apertures. They are dropped where an aperture reaches below the
    /// surface.
    #[must_use]
    pub fn observations(&self, brdf: &Brdf, apertures: &ApertureRule) -> Vec<Observation> {
        rows(self.of(brdf), apertures)
    }
}

/// Samples as rows of a fit.
pub(super) fn rows(samples: Vec<&BrdfSample>, apertures: &ApertureRule) -> Vec<Observation> {
    let row = |sample: &BrdfSample| Observation {
        value: sample.luminance(),
        uncertainty: None,
        aim: Aim::Equal,
        views: apertures
            .directions(sample.wo, sample.wi)
            .map(|(wo, wi, factor)| View { wo, wi, factor })
            .collect(),
    };
    let rows = samples.into_iter().map(row);
    rows.filter(|row| row.views.iter().all(|view| view.wo.z > 0.0 && view.wi.z > 0.0)).collect()
}

/// So many of the samples at most, evenly in the order of an angle.
fn evenly<'a>(
    samples: impl Iterator<Item = &'a BrdfSample>,
    angle: impl Fn(&BrdfSample) -> f64,
    count: usize,
) -> Vec<&'a BrdfSample> {
    let mut sorted: Vec<(f64, &BrdfSample)> = samples.map(|sample| (angle(sample), sample)).collect();
    sorted.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let step = (sorted.len() as f64 / count.max(1) as f64).max(1.0);
    let taken = (0..).map(|i| (f64::from(i) * step) as usize).take_while(|&i| i < sorted.len());
    taken.map(|i| sorted[i].1).collect()
}
