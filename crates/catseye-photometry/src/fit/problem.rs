//! The least-squares problem: logarithms of model over value, with bounds and the conservation of energy.

use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::{DMatrix, DVector, Dyn, Owned};

use super::form::{Form, Meaning, Unknown};
use super::observation::{Aim, Observation, View, weights};
use crate::entrance::{LogGradient, log_squared_tangent};
use crate::sheeting::{RetroLobe, Sheeting, UnitLobe};

/// Step of the logarithm of a roughness in the difference quotients: their error is below 1e-8.
const ROUGHNESS_STEP: f64 = 1e-4;
/// Weight of the priors beside a row that is a factor of e off: they decide only what no row decides.
const PRIOR_WEIGHT: f64 = 1e-3;
/// Weight of an albedo above 1.
const ENERGY_WEIGHT: f64 = 100.0;
/// Weight of a limit that is broken, and of a minimum that is met with something to spare.
const BROKEN_WEIGHT: f64 = 10.0;
const SPARE_WEIGHT: f64 = 0.5;
/// The model's values are kept above this share of the observed one, so that logarithms stay finite.
const LEAST_RATIO: f64 = 1e-12;

/// A form, the data, and the point where the model is.
#[derive(Clone, Debug)]
pub(crate) struct Problem<'a> {
    form: Form,
    unknowns: Vec<Unknown>,
    observations: &'a [Observation],
    /// The rows' weights.
    pub(crate) weights: Vec<f64>,
    /// Greatest channel of the tint over its luminance: what the energy in that channel is.
    channel_peak: f64,
    /// The vector on the unbounded scale.
    free: DVector<f64>,
}

/// What a lobe sends along the views of an observation, without its strength and entrance factor.
struct UnitLobes {
    middle: UnitLobe,
    /// With the roughness a step up and down, for each axis or both.
    stepped: Vec<(Option<usize>, [UnitLobe; 2])>,
}

impl<'a> Problem<'a> {
    pub(crate) fn new(form: Form, observations: &'a [Observation], channel_peak: f64, start: &[f64]) -> Self {
        let unknowns = form.unknowns();
        let free = unknowns.iter().zip(start).map(|(unknown, &x)| logit(unknown.bounds, x));
        let free = DVector::from_iterator(unknowns.len(), free);
        Self { form, observations, weights: weights(observations).0, channel_peak, free, unknowns }
    }

    pub(crate) fn form(&self) -> Form {
        self.form
    }

    /// The vector within its bounds.
    pub(crate) fn x(&self) -> Vec<f64> {
        self.unknowns.iter().zip(&self.free).map(|(unknown, &free)| logistic(unknown.bounds, free)).collect()
    }

    /// The sheeting at the present point.
    pub(crate) fn sheeting(&self) -> Sheeting {
        self.form.sheeting(&self.unknowns, &self.x())
    }

    /// Logarithms of model over value, not weighted.
    pub(crate) fn log_ratios(&self) -> Option<Vec<f64>> {
        log_ratios(&self.sheeting(), self.observations)
    }

    /// How much an observation's logarithm counts.
    fn weight(&self, row: usize, log_ratio: f64) -> f64 {
        self.weights[row] * aim_weight(self.observations[row].aim, log_ratio)
    }

    /// Rows of the residuals: the observations, the energy, the priors.
    fn rows(&self) -> usize {
        self.observations.len() + 1 + self.unknowns.len()
    }

    /// The rows' derivatives by the numbers within their bounds, not weighted.
    pub(crate) fn log_jacobian(&self) -> Option<DMatrix<f64>> {
        let sheeting = self.sheeting();
        let lobes = sheeting.lobes.iter().enumerate();
        let lobes: Vec<_> = lobes.map(|(i, lobe)| self.unit_lobes(i, lobe)).collect::<Option<_>>()?;
        let mut jacobian = DMatrix::zeros(self.observations.len(), self.unknowns.len());
        let mut row = vec![0.0; self.unknowns.len()];
        for (j, observation) in self.observations.iter().enumerate() {
            row.fill(0.0);
            let mut total = 0.0;
            for view in &observation.views {
                total += self.accumulate(&sheeting, &lobes, view, &mut row);
            }
            let total = total.max(observation.value * LEAST_RATIO);
            for (k, derivative) in row.iter().enumerate() {
                jacobian[(j, k)] = derivative / total;
            }
        }
        Some(jacobian)
    }

    fn unit_lobes(&self, lobe: usize, own: &RetroLobe) -> Option<UnitLobes> {
        let with = |axis: Option<usize>, step: f64| {
            let moved = |i: usize| if axis.is_none_or(|axis| axis == i) { step.exp() } else { 1.0 };
            let roughness = [0, 1].map(|i| own.roughness[i] * moved(i));
            UnitLobe::new(self.form.model, &RetroLobe { roughness, ..*own }).ok()
        };
        let axes = self.unknowns.iter().filter_map(|unknown| match unknown.meaning {
            Meaning::Roughness(i, axis) if i == lobe => Some(axis),
            _ => None,
        });
        let stepped = axes.map(|axis| {
            let pair = [with(axis, ROUGHNESS_STEP)?, with(axis, -ROUGHNESS_STEP)?];
            Some((axis, pair))
        });
        Some(UnitLobes { middle: with(None, 0.0)?, stepped: stepped.collect::<Option<_>>()? })
    }

    /// Adds a view's derivatives to `row`; returns its value.
    fn accumulate(&self, sheeting: &Sheeting, lobes: &[UnitLobes], view: &View, row: &mut [f64]) -> f64 {
        let View { wo, wi, factor } = *view;
        let factor = factor * sheeting.transmitted(wo);
        let log_tangent = log_squared_tangent(wo.z);
        let mut total = 0.0;
        for (i, (own, lobe)) in sheeting.lobes.iter().zip(lobes).enumerate() {
            let gradient = own.entrance.map(|law| law.log_gradient(log_tangent));
            let common = factor * own.strength * own.factor(self.form.model, wo.z);
            let value = common * lobe.middle.eval(wo, wi);
            total += value;
            for (unknown, slot) in self.unknowns.iter().zip(&mut *row) {
                if unknown.meaning.concerns(i) {
                    *slot += match unknown.meaning {
                        Meaning::Roughness(_, axis) => common * lobe.slope(axis, view),
                        meaning => value * by(meaning, gradient),
                    };
                }
            }
        }
        let base = factor * sheeting.diffuse / core::f64::consts::PI;
        for (unknown, slot) in self.unknowns.iter().zip(row) {
            if unknown.meaning == Meaning::Diffuse {
                *slot += base;
            }
        }
        total + base
    }

    /// By how much the albedo may exceed 1, in the channel with the most of it.
    fn energy_excess(&self) -> f64 {
        excess(&self.sheeting(), self.channel_peak)
    }
}

impl UnitLobes {
    /// The derivative of the BSDF by the logarithm of the roughness.
    fn slope(&self, axis: Option<usize>, view: &View) -> f64 {
        let found = self.stepped.iter().find(|(of, _)| *of == axis);
        let difference = |[up, down]: &[UnitLobe; 2]| {
            (up.eval(view.wo, view.wi) - down.eval(view.wo, view.wi)) / (2.0 * ROUGHNESS_STEP)
        };
        found.map_or(0.0, |(_, pair)| difference(pair))
    }
}

/// The derivative of a lobe's logarithm by a number that is not its roughness.
fn by(meaning: Meaning, gradient: Option<LogGradient>) -> f64 {
    match (meaning, gradient) {
        (Meaning::Power(_), Some(gradient)) => gradient.by_slope,
        (Meaning::Bend, Some(gradient)) => gradient.by_log_bend,
        (Meaning::Sharpness, Some(gradient)) => gradient.by_log_sharpness,
        _ => 1.0,
    }
}

/// The logarithms of model over value; `None` where a roughness is out of range.
pub(crate) fn log_ratios(sheeting: &Sheeting, observations: &[Observation]) -> Option<Vec<f64>> {
    let prepared = sheeting.prepare().ok()?;
    let ratio = |observation: &Observation| {
        let views = observation.views.iter();
        let value: f64 = views.map(|view| view.factor * prepared.eval(view.wo, view.wi)).sum();
        (value / observation.value).max(LEAST_RATIO).ln()
    };
    Some(observations.iter().map(ratio).collect())
}

/// By how much the albedo may exceed 1, in the channel with the most of it.
pub(crate) fn excess(sheeting: &Sheeting, channel_peak: f64) -> f64 {
    (sheeting.albedo_bound() * channel_peak - 1.0).max(0.0)
}

/// How much a row's logarithm counts.
pub(crate) fn aim_weight(aim: Aim, log_ratio: f64) -> f64 {
    match (aim, log_ratio >= 0.0) {
        (Aim::Equal, _) => 1.0,
        // The least that meets a standard is what a class means; below a maximum is nowhere in particular.
        (Aim::AtLeast, true) => SPARE_WEIGHT,
        (Aim::AtMost, false) => 0.0,
        (Aim::AtLeast, false) | (Aim::AtMost, true) => BROKEN_WEIGHT,
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.free.copy_from(x);
    }

    fn params(&self) -> DVector<f64> {
        self.free.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let logs = self.log_ratios()?;
        let data = logs.iter().enumerate().map(|(row, &log)| self.weight(row, log) * log);
        let energy = ENERGY_WEIGHT * self.energy_excess();
        let x = self.x();
        let prior_residual = |(unknown, x): (&Unknown, &f64)| PRIOR_WEIGHT * unknown.prior_residual(*x);
        let priors = self.unknowns.iter().zip(&x).map(prior_residual);
        Some(DVector::from_iterator(self.rows(), data.chain([energy]).chain(priors)))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let data = self.log_jacobian()?;
        let logs = self.log_ratios()?;
        let (rows, columns) = data.shape();
        let mut jacobian = DMatrix::zeros(self.rows(), columns);
        for (k, unknown) in self.unknowns.iter().enumerate() {
            let slope = logistic_slope(unknown.bounds, self.free[k]);
            for j in 0..rows {
                jacobian[(j, k)] = self.weight(j, logs[j]) * data[(j, k)] * slope;
            }
            jacobian[(rows, k)] = ENERGY_WEIGHT * self.energy_slope(k);
            jacobian[(rows + 1 + k, k)] = PRIOR_WEIGHT / unknown.prior[1] * slope;
        }
        Some(jacobian)
    }
}

impl Problem<'_> {
    /// The energy's derivative by a free number: one-sided, as it is 0 where the energy is conserved.
    fn energy_slope(&self, k: usize) -> f64 {
        const STEP: f64 = 1e-6;
        let here = self.energy_excess();
        if here == 0.0 {
            return 0.0;
        }
        let mut moved = self.clone();
        moved.free[k] += STEP;
        (moved.energy_excess() - here) / STEP
    }
}

/// The number within its bounds, from the unbounded scale.
fn logistic([low, high]: [f64; 2], free: f64) -> f64 {
    low + (high - low) / (1.0 + (-free).exp())
}

fn logistic_slope([low, high]: [f64; 2], free: f64) -> f64 {
    let share = 1.0 / (1.0 + (-free).exp());
    (high - low) * share * (1.0 - share)
}

/// The inverse of [`logistic`], a little inside the bounds, where the slope is not 0.
fn logit([low, high]: [f64; 2], x: f64) -> f64 {
    const INSIDE: f64 = 1e-3;
    let share = ((x - low) / (high - low)).clamp(INSIDE, 1.0 - INSIDE);
    (share / (1.0 - share)).ln()
}
