//! The least worst error: Newton's method on a maximum that is made smooth, and less and less so.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::problem::{Linear, Problem};

/// The smoothing, as a share of the worst error: at first, from stage to stage, and at last.
const SMOOTHING: [f64; 3] = [0.3, 0.4, 1e-4];
/// Newton steps in one stage.
const STEPS: usize = 10;
/// A step that gains less than this share of the smoothing ends its stage.
const GAIN: f64 = 1e-3;
/// How much more than a row's error what is beyond a wall counts.
const WALL_WEIGHT: f64 = 10.0;
/// Weight of the priors: they decide only what no row decides.
const PRIOR_WEIGHT: f64 = 1e-4;
/// The damping at first, and its bounds.
const DAMPING: [f64; 3] = [1e-2, 1e-8, 1e6];

/// A smooth maximum, and its gradient and curvature.
struct Smooth {
    value: f64,
    gradient: DVector<f64>,
    curvature: DMatrix<f64>,
}

/// Moves the problem to where the worst row's error is least, or at most `enough`.
///
/// The maximum of some `a` is approached by t ln sum exp(a / t) with t towards 0, from above and by t
/// ln(count) at most. Its curvature is that of the weights exp(a / t) as long as the rows are linear: a
/// vertex of the linear problem, where as many rows are equally far off as there are numbers, is approached
/// quadratically.
pub(crate) fn minimax(problem: &mut Problem<'_>, enough: f64) {
    let Some(mut here) = problem.linear() else { return };
    let [first, shrink, last] = SMOOTHING;
    let mut share = first;
    let [mut damping, least, most] = DAMPING;
    while share > last {
        let worst = here.worst();
        if worst <= enough {
            return;
        }
        let t = share * worst;
        for _ in 0..STEPS {
            let Smooth { value, gradient, mut curvature } = here.smooth(t, worst);
            for k in 0..gradient.len() {
                curvature[(k, k)] += damping;
            }
            let Some(step) = Cholesky::new(curvature).map(|factors| factors.solve(&-gradient)) else {
                damping = (damping * 10.0).min(most);
                continue;
            };
            let next = problem.moved(&step);
            let Some(there) = next.linear() else { return };
            let gain = value - there.smooth_value(t, worst);
            if gain > 0.0 {
                damping = (damping * 0.2).max(least);
                (*problem, here) = (next, there);
            } else {
                damping = (damping * 8.0).min(most);
            }
            if gain >= 0.0 && gain < GAIN * t {
                break;
            }
        }
        share *= shrink;
    }
}

impl Linear {
    fn worst(&self) -> f64 {
        self.sides().flatten().fold(0.0, f64::max)
    }

    /// How far above and below its value each row is; below a maximum is no error.
    fn sides(&self) -> impl Iterator<Item = [f64; 2]> {
        let below = |(log, is_maximum): (&f64, &bool)| if *is_maximum { f64::NEG_INFINITY } else { -log };
        self.logs.iter().zip(&self.are_maxima).map(move |row| [*row.0, below(row)])
    }

    /// The errors either way, and the walls as if a material on a wall had the error `worst`.
    fn levels(&self, worst: f64) -> impl Iterator<Item = f64> {
        self.sides().flatten().chain(self.walls.iter().map(move |(beyond, _)| worst + WALL_WEIGHT * beyond))
    }

    fn prior_cost(&self) -> f64 {
        0.5 * PRIOR_WEIGHT * self.priors.iter().map(|[residual, _]| residual * residual).sum::<f64>()
    }

    fn smooth_value(&self, t: f64, worst: f64) -> f64 {
        let most = self.levels(worst).fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = self.levels(worst).map(|level| ((level - most) / t).exp()).sum();
        most + t * sum.ln() + self.prior_cost()
    }

    fn smooth(&self, t: f64, worst: f64) -> Smooth {
        let value = self.smooth_value(t, worst);
        let total = value - self.prior_cost();
        let weights: Vec<f64> = self.levels(worst).map(|level| ((level - total) / t).exp()).collect();
        let count = self.jacobian.ncols();
        let mut gradient = DVector::zeros(count);
        let mut curvature = DMatrix::zeros(count, count);
        let mut add = |slopes: &DVector<f64>, signed: f64, weight: f64| {
            gradient.axpy(signed, slopes, 1.0);
            curvature.ger(weight / t, slopes, slopes, 1.0);
        };
        for (j, pair) in weights[..2 * self.logs.len()].chunks(2).enumerate() {
            if pair[0] + pair[1] > f64::EPSILON {
                add(&self.jacobian.row(j).transpose(), pair[0] - pair[1], pair[0] + pair[1]);
            }
        }
        for ((_, slopes), weight) in self.walls.iter().zip(&weights[2 * self.logs.len()..]) {
            add(slopes, WALL_WEIGHT * weight, WALL_WEIGHT * WALL_WEIGHT * weight);
        }
        let outer = &gradient * gradient.transpose();
        curvature -= outer / t;
        for (k, [residual, slope]) in self.priors.iter().enumerate() {
            gradient[k] += PRIOR_WEIGHT * residual * slope;
            curvature[(k, k)] += PRIOR_WEIGHT * slope * slope;
        }
        Smooth { value, gradient, curvature }
    }
}
