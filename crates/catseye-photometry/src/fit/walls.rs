//! What a material must not do whatever the rows say: reflect more than all light.

use super::form::{Meaning, Unknown};
use super::rows::by;
use crate::sheeting::Sheeting;

/// The walls for a table.
#[derive(Clone, Debug)]
pub(crate) struct Walls {
    /// Greatest channel of the tint over its luminance: what the energy in that channel is.
    channel_peak: f64,
}

/// How far beyond a wall a material is, above 0, or before it; and how that changes with the numbers.
#[derive(Clone, Debug)]
pub(crate) struct Beyond {
    pub(crate) by: f64,
    pub(crate) slopes: Vec<f64>,
}

impl Walls {
    pub(crate) fn new(channel_peak: f64) -> Self {
        Self { channel_peak }
    }

    /// By how much the albedo may exceed 1, in the channel with the most of it.
    pub(crate) fn excess(&self, sheeting: &Sheeting) -> f64 {
        (sheeting.albedo_bound() * self.channel_peak - 1.0).max(0.0)
    }

    /// The walls that are near.
    pub(crate) fn beyond(&self, sheeting: &Sheeting, unknowns: &[Unknown]) -> Vec<Beyond> {
        self.energy(sheeting, unknowns).into_iter().collect()
    }

    fn energy(&self, sheeting: &Sheeting, unknowns: &[Unknown]) -> Option<Beyond> {
        if !sheeting.may_exceed(1.0 / self.channel_peak) {
            return None;
        }
        let (bound, log_tangent) = sheeting.greatest_albedo();
        let tints: Vec<_> = sheeting.tints(log_tangent).collect();
        let slope = |unknown: &Unknown| {
            let of_lobes: f64 = tints
                .iter()
                .enumerate()
                .filter(|(i, _)| unknown.meaning.concerns(*i))
                .map(|(_, (tint, gradient))| match unknown.meaning {
                    Meaning::Roughness(..) => 0.0,
                    meaning => tint * by(meaning, *gradient),
                })
                .sum();
            let base = if unknown.meaning == Meaning::Diffuse { sheeting.diffuse } else { 0.0 };
            self.channel_peak * (of_lobes + base)
        };
        Some(Beyond { by: self.channel_peak * bound - 1.0, slopes: unknowns.iter().map(slope).collect() })
    }
}
