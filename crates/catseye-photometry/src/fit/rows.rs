//! The observations as a fit evaluates them again and again: model over value, and how it changes.

use core::f64::consts::PI;

use nalgebra::DMatrix;

use super::form::{Form, Meaning, Unknown};
use super::observation::Observation;
use crate::entrance::{EntranceLaw, LogGradient};
use crate::lobe::{Pair, UnitLobe};
use crate::sheeting::{RetroLobe, Sheeting};

/// The model's values are kept above this share of the observed one, so that logarithms stay finite.
const LEAST_RATIO: f64 = 1e-12;

/// Observations, and what all materials of a model and a coat have in common there.
#[derive(Clone, Debug)]
pub(crate) struct Rows<'a> {
    pub(crate) observations: &'a [Observation],
    views: Vec<Seen>,
    /// Where the views of each observation end.
    ends: Vec<usize>,
}

/// A view, its factor over the observation's value, and what a base of albedo 1 adds.
#[derive(Clone, Copy, Debug)]
struct Seen {
    pair: Pair,
    factor: f64,
    base: f64,
}

impl<'a> Rows<'a> {
    pub(crate) fn new(form: &Form, observations: &'a [Observation]) -> Self {
        let coat = Sheeting { coat_ior: form.coat_ior, ..Sheeting::default() };
        let mut views = Vec::new();
        let mut ends = Vec::new();
        for observation in observations {
            views.extend(observation.views.iter().map(|view| {
                let factor = view.factor * coat.transmitted(view.wo) / observation.value;
                let is_above = view.wo.z.min(view.wi.z) > 0.0;
                let base = if is_above { factor / PI } else { 0.0 };
                Seen { pair: Pair::new(form.model, view.wo, view.wi), factor, base }
            }));
            ends.push(views.len());
        }
        Self { observations, views, ends }
    }

    /// The number of views of all observations.
    pub(crate) fn views(&self) -> usize {
        self.views.len()
    }

    fn of_each(&self) -> impl Iterator<Item = &[Seen]> {
        let starts = core::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.views[start..end])
    }

    /// The logarithms of model over value; `None` where a roughness is out of range.
    pub(crate) fn log_ratios(&self, sheeting: &Sheeting) -> Option<Vec<f64>> {
        let lobes = unit_lobes(sheeting)?;
        let at = |seen: &Seen| {
            let mut law = Laws::default();
            let lobe = |(own, lobe): (&RetroLobe, &UnitLobe)| {
                own.strength * law.factor(sheeting, own, &seen.pair).0 * lobe.eval(&seen.pair)
            };
            let retro: f64 = sheeting.lobes.iter().zip(&lobes).map(lobe).sum();
            seen.factor * retro + seen.base * sheeting.diffuse
        };
        let log = |views: &[Seen]| views.iter().map(at).sum::<f64>().max(LEAST_RATIO).ln();
        Some(self.of_each().map(log).collect())
    }

    /// What each lobe of strength 1, and then a base of albedo 1, adds to the ratios.
    pub(crate) fn columns(&self, sheeting: &Sheeting) -> Option<Vec<Vec<f64>>> {
        let lobes = unit_lobes(sheeting)?;
        let of_lobe = |(own, lobe): (&RetroLobe, &UnitLobe)| -> Vec<f64> {
            let at = |seen: &Seen| {
                seen.factor * Laws::default().factor(sheeting, own, &seen.pair).0 * lobe.eval(&seen.pair)
            };
            self.of_each().map(|views| views.iter().map(at).sum()).collect()
        };
        let base = self.of_each().map(|views| views.iter().map(|seen| seen.base).sum()).collect();
        Some(sheeting.lobes.iter().zip(&lobes).map(of_lobe).chain([base]).collect())
    }

    /// The logarithms of model over value, and their derivatives by the numbers within their bounds.
    pub(crate) fn log_jacobian(
        &self,
        sheeting: &Sheeting,
        unknowns: &[Unknown],
    ) -> Option<(Vec<f64>, DMatrix<f64>)> {
        let lobes = unit_lobes(sheeting)?;
        let mut jacobian = DMatrix::zeros(self.observations.len(), unknowns.len());
        let mut logs = Vec::with_capacity(self.observations.len());
        let mut row = vec![0.0; unknowns.len()];
        for (j, views) in self.of_each().enumerate() {
            row.fill(0.0);
            let mut total = 0.0;
            for seen in views {
                total += seen.accumulate(sheeting, &lobes, unknowns, &mut row);
            }
            let total = total.max(LEAST_RATIO);
            logs.push(total.ln());
            for (k, derivative) in row.iter().enumerate() {
                jacobian[(j, k)] = derivative / total;
            }
        }
        Some((logs, jacobian))
    }
}

impl Seen {
    /// Adds the derivatives to `row`; returns the value.
    fn accumulate(
        &self,
        sheeting: &Sheeting,
        lobes: &[UnitLobe],
        unknowns: &[Unknown],
        row: &mut [f64],
    ) -> f64 {
        let base = self.base * sheeting.diffuse;
        let mut total = base;
        let mut laws = Laws::default();
        for (i, (own, lobe)) in sheeting.lobes.iter().zip(lobes).enumerate() {
            let (factor, gradient) = laws.factor(sheeting, own, &self.pair);
            let common = self.factor * own.strength * factor;
            let (value, slopes) = lobe.with_slopes(&self.pair);
            total += common * value;
            for (unknown, slot) in unknowns.iter().zip(&mut *row) {
                if unknown.meaning.concerns(i) {
                    *slot += common
                        * match unknown.meaning {
                            Meaning::Roughness(_, None) => slopes[0] + slopes[1],
                            Meaning::Roughness(_, Some(axis)) => slopes[axis],
                            meaning => value * by(meaning, gradient),
                        };
                }
            }
        }
        for (unknown, slot) in unknowns.iter().zip(row) {
            if unknown.meaning == Meaning::Diffuse {
                *slot += base;
            }
        }
        total
    }
}

/// The law that was evaluated last: lobes often share it.
#[derive(Default)]
struct Laws {
    last: Option<(EntranceLaw, LogGradient, f64)>,
}

impl Laws {
    /// A lobe's factor for a direction to the viewer, and the gradient of its law.
    fn factor(&mut self, sheeting: &Sheeting, lobe: &RetroLobe, pair: &Pair) -> (f64, Option<LogGradient>) {
        let Some(law) = lobe.entrance else { return (1.0, None) };
        let (gradient, factor) = match self.last {
            Some((last, gradient, factor)) if last == law => (gradient, factor),
            _ => {
                let gradient = law.log_gradient(pair.log_tangent);
                (gradient, gradient.log.exp())
            }
        };
        self.last = Some((law, gradient, factor));
        let keeps_width = lobe.keeps_width(sheeting.model);
        (if keeps_width { factor / pair.cosine } else { factor }, Some(gradient))
    }
}

/// The derivative of a lobe's logarithm by a number that is not its roughness.
pub(crate) fn by(meaning: Meaning, gradient: Option<LogGradient>) -> f64 {
    match (meaning, gradient) {
        (Meaning::Power(_), Some(gradient)) => gradient.by_slope,
        (Meaning::Bend, Some(gradient)) => gradient.by_log_bend,
        (Meaning::Sharpness, Some(gradient)) => gradient.by_log_sharpness,
        _ => 1.0,
    }
}

fn unit_lobes(sheeting: &Sheeting) -> Option<Vec<UnitLobe>> {
    sheeting.lobes.iter().map(|lobe| UnitLobe::new(sheeting.model, lobe).ok()).collect()
}
