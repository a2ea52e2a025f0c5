//! The least-squares problem: logarithms of model over value, with bounds, walls and priors.

use std::sync::Arc;

use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::{DMatrix, DVector, Dyn, Owned};

use super::form::{Form, Unknown};
use super::observation::{Aim, Observation, weights};
use super::rows::Rows;
use super::walls::Walls;
use crate::sheeting::Sheeting;

/// Weight of the priors beside a row that is a factor of e off: they decide only what no row decides.
pub(crate) const PRIOR_WEIGHT: f64 = 1e-3;
/// Weight of what is beyond a wall, beside a row that is off by a factor of e.
const WALL_WEIGHT: f64 = 100.0;
/// Weight of a limit that is broken, and of a minimum that is met with something to spare.
const BROKEN_WEIGHT: f64 = 10.0;
const SPARE_WEIGHT: f64 = 0.5;
/// How much more the part of a row's error counts that is beyond the tolerance.
const HINGE_WEIGHT: f64 = 30.0;

/// A form, the data, and the point where the model is.
#[derive(Clone, Debug)]
pub(crate) struct Problem<'a> {
    form: Form,
    pub(crate) unknowns: Arc<[Unknown]>,
    pub(crate) rows: Arc<Rows<'a>>,
    pub(crate) walls: Arc<Walls>,
    /// The rows' weights.
    pub(crate) weights: Vec<f64>,
    /// The error of a row, as a logarithm, beyond which it counts more.
    hinge: f64,
    /// The vector on the unbounded scale.
    free: DVector<f64>,
}

/// The problem at a point, and how it changes there with the vector on the unbounded scale.
pub(crate) struct Linear {
    pub(crate) logs: Vec<f64>,
    /// Whether each row is a maximum.
    pub(crate) are_maxima: Vec<bool>,
    pub(crate) jacobian: DMatrix<f64>,
    /// What is before and beyond the walls that are near.
    pub(crate) walls: Vec<(f64, DVector<f64>)>,
    /// The priors' residuals and their derivatives.
    pub(crate) priors: Vec<[f64; 2]>,
}

impl<'a> Problem<'a> {
    pub(crate) fn new(form: Form, observations: &'a [Observation], channel_peak: f64, x: &[f64]) -> Self {
        let unknowns: Arc<[Unknown]> = form.unknowns().into();
        Self {
            form,
            rows: Arc::new(Rows::new(&form, observations)),
            weights: weights(observations).0,
            walls: Arc::new(Walls::new(channel_peak)),
            hinge: f64::INFINITY,
            free: free(&unknowns, x),
            unknowns,
        }
    }

    /// The same problem with the model elsewhere.
    pub(crate) fn at(&self, x: &[f64]) -> Self {
        Self { free: free(&self.unknowns, x), ..self.clone() }
    }

    /// The same problem with the model a step away on the unbounded scale.
    pub(crate) fn moved(&self, step: &DVector<f64>) -> Self {
        Self { free: &self.free + step, ..self.clone() }
    }

    /// The same problem with rows that count more beyond this logarithm.
    pub(crate) fn held(&self, hinge: f64) -> Self {
        Self { hinge, ..self.clone() }
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

    /// The rows' derivatives by the numbers within their bounds, not weighted.
    pub(crate) fn log_jacobian(&self) -> Option<DMatrix<f64>> {
        Some(self.rows.log_jacobian(&self.sheeting(), &self.unknowns)?.1)
    }

    /// The problem and its derivatives at the present point.
    pub(crate) fn linear(&self) -> Option<Linear> {
        let sheeting = self.sheeting();
        let (logs, mut jacobian) = self.rows.log_jacobian(&sheeting, &self.unknowns)?;
        let numbers = self.unknowns.iter().zip(&self.free);
        let slopes: Vec<f64> = numbers.map(|(unknown, &free)| logistic_slope(unknown.bounds, free)).collect();
        for (mut column, slope) in jacobian.column_iter_mut().zip(&slopes) {
            column *= *slope;
        }
        let walls = self.walls.beyond(&sheeting, &self.unknowns).into_iter().map(|beyond| {
            let by_free = beyond.slopes.iter().zip(&slopes).map(|(a, b)| a * b);
            (beyond.by, DVector::from_iterator(slopes.len(), by_free))
        });
        let priors = self.priors().into_iter().zip(self.unknowns.iter().zip(&slopes));
        let priors = priors.map(|(residual, (unknown, slope))| [residual, slope / unknown.prior[1]]);
        let are_maxima = self.rows.observations.iter().map(|row| row.aim == Aim::AtMost).collect();
        Some(Linear { logs, are_maxima, jacobian, walls: walls.collect(), priors: priors.collect() })
    }

    fn priors(&self) -> Vec<f64> {
        self.unknowns.iter().zip(self.x()).map(|(unknown, x)| unknown.prior_residual(x)).collect()
    }

    /// A row's residual and its derivative by the logarithm.
    fn residual(&self, row: usize, log: f64) -> (f64, f64) {
        let weight = self.weights[row] * aim_weight(self.rows.observations[row].aim, log);
        let beyond = (log.abs() - self.hinge).max(0.0);
        let steep = if beyond > 0.0 { 1.0 + HINGE_WEIGHT } else { 1.0 };
        (weight * (log + HINGE_WEIGHT * beyond.copysign(log)), weight * steep)
    }
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

/// The residuals are those of the observations, of all walls together, and of the priors.
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
        let sheeting = self.sheeting();
        let logs = self.rows.log_ratios(&sheeting)?;
        let data = logs.iter().enumerate().map(|(row, &log)| self.residual(row, log).0);
        let beyond = self.walls.beyond(&sheeting, &self.unknowns).into_iter().map(|wall| wall.by.max(0.0));
        let wall = WALL_WEIGHT * beyond.map(|by| by * by).sum::<f64>().sqrt();
        let priors = self.priors().into_iter().map(|prior| PRIOR_WEIGHT * prior);
        let count = logs.len() + 1 + self.unknowns.len();
        Some(DVector::from_iterator(count, data.chain([wall]).chain(priors)))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let Linear { logs, jacobian: data, walls, priors, .. } = self.linear()?;
        let (rows, columns) = data.shape();
        let mut jacobian = DMatrix::zeros(rows + 1 + columns, columns);
        jacobian.rows_mut(0, rows).copy_from(&data);
        for (j, &log) in logs.iter().enumerate() {
            jacobian.row_mut(j).scale_mut(self.residual(j, log).1);
        }
        let beyond: Vec<_> = walls.into_iter().filter(|(by, _)| *by > 0.0).collect();
        let norm = beyond.iter().map(|(by, _)| by * by).sum::<f64>().sqrt();
        for (by, slopes) in &beyond {
            for (k, slope) in slopes.iter().enumerate() {
                jacobian[(rows, k)] += WALL_WEIGHT * by / norm * slope;
            }
        }
        for (k, [_, slope]) in priors.into_iter().enumerate() {
            jacobian[(rows + 1 + k, k)] = PRIOR_WEIGHT * slope;
        }
        Some(jacobian)
    }
}

/// The vector on the unbounded scale.
fn free(unknowns: &[Unknown], x: &[f64]) -> DVector<f64> {
    let free = unknowns.iter().zip(x).map(|(unknown, &x)| logit(unknown.bounds, x));
    DVector::from_iterator(unknowns.len(), free)
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

#[cfg(test)]
mod tests {
    use catseye::Model;

    use super::*;
    use crate::fit::EntranceKind;
    use crate::{Row, Table};

    /// Every number of every kind of form, against difference quotients.
    #[test]
    fn derivatives_are_those_of_the_values() {
        let csv = "observation_deg,entrance_deg,value\n0.2,-4,300\n0.5,30,40\n1,45,9\n0.3,20,120\n";
        let table = Table::parse_values(csv.as_bytes(), "t").unwrap();
        let row = |row: &Row| Observation::from_row(row, Aim::Equal, None).unwrap();
        let observations: Vec<Observation> = table.rows().iter().map(row).collect();
        for model in [Model::Reciprocal, Model::BackVector] {
            for (entrance, shared) in [(EntranceKind::Constant, true), (EntranceKind::Bend, false)] {
                for anisotropic in [false, true] {
                    let form = Form {
                        model,
                        lobes: 2,
                        entrance,
                        shared,
                        anisotropic,
                        diffuse: true,
                        roughness: None,
                        coat_ior: Some(1.5),
                    };
                    // Lobes of two roughnesses that are the same keep their width.
                    let place = |(k, unknown): (usize, &Unknown)| unknown.prior[0] + 0.1 + 0.02 * k as f64;
                    let x: Vec<f64> = form.unknowns().iter().enumerate().map(place).collect();
                    // The energy's wall is near at a peak of 8.
                    let problem = Problem::new(form, &observations, 8.0, &x);
                    let jacobian = problem.jacobian().unwrap();
                    for k in 0..x.len() {
                        let step = |by: f64| {
                            let mut step = DVector::zeros(x.len());
                            step[k] = by;
                            problem.moved(&step).residuals().unwrap()
                        };
                        let quotient = (step(1e-5) - step(-1e-5)) / 2e-5;
                        let apart = (jacobian.column(k) - &quotient).amax();
                        assert!(apart < 1e-5 * (1.0 + quotient.amax()), "{form:?} {k}: {apart}");
                    }
                }
            }
        }
    }
}
