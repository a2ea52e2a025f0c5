//! A lobe of a node graph as a formula: from its inputs over the viewer's direction to its entrance law.

use catseye::{AnyLobe, Lobe as _, Model, Params, Vec3};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{Dyn, Matrix, OMatrix, OVector, Owned, U3, Vector3};

use crate::entrance::{EntranceLaw, LEAST_COSINE, log_squared_tangent};
use crate::lobe::along_projection;
use crate::luminance;

/// How far inputs may be from the formula, as a share: what single precision leaves of a node graph, with
/// room.
const TOLERANCE: f64 = 2e-4;
/// Where the search for a bend begins: its squared tangent and its sharpness.
const STARTS: [[f64; 2]; 6] = [[1.0, 2.0], [0.4, 3.0], [0.4, 8.0], [2.0, 4.0], [6.0, 3.0], [6.0, 10.0]];

/// What the inputs of a `retro_reflective_bsdf` are for a viewer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LobeSample {
    /// Cosine between viewer and normal.
    pub cosine: f64,
    /// The tint times all weights, linear Rec. 709.
    pub tint: [f64; 3],
    /// Roughness along the viewer's projection on the surface, and across it.
    pub roughness: [f64; 2],
}

/// A `retro_reflective_bsdf` whose inputs depend on the viewer's direction by one of the laws of sheeting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewedLobe {
    /// The tint for a viewer along the normal, linear Rec. 709.
    pub tint: [f64; 3],
    /// The roughness across the viewer's projection.
    pub roughness: f64,
    /// Whether the roughness along the projection, and the tint, are divided by the viewer's cosine, so that
    /// the lobe keeps its angular width; otherwise it is round and narrows.
    pub keeps_width: bool,
    /// What the tint is multiplied with for the viewer's cosine; a power of 0 where with nothing.
    pub law: EntranceLaw,
}

/// Why a lobe is no [`ViewedLobe`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LobeFault {
    /// It is black.
    #[error("returns nothing to a viewer along the normal")]
    Black,
    /// Its hue depends on the viewer.
    #[error("changes its hue with the viewer's direction")]
    Hue,
    /// Its roughness does, in another way than that which keeps its width, or it is of two roughnesses.
    #[error("has two roughnesses, or one that depends on the viewer's direction otherwise than as r / N.V")]
    Roughness,
    /// Its strength does, in another way than sheeting's.
    #[error(
        "depends on the viewer's direction otherwise than by the law of sheeting, docs/theory.md section 10"
    )]
    Law,
}

impl ViewedLobe {
    /// The lobe with these inputs; the first sample is that of a viewer along the normal.
    ///
    /// # Errors
    /// Inputs that are none of such a lobe, to two parts in 10,000.
    pub fn of(samples: &[LobeSample]) -> Result<Self, LobeFault> {
        let Some(LobeSample { tint, roughness: [_, across], .. }) = samples.first().copied() else {
            return Err(LobeFault::Black);
        };
        let strength = luminance(tint);
        if !(strength > 0.0) {
            return Err(LobeFault::Black);
        }
        let alike = |a: f64, b: f64| (a - b).abs() <= TOLERANCE * a.abs().max(b.abs());
        let all = |is_so: &dyn Fn(&LobeSample) -> bool| samples.iter().all(is_so);
        let is_round = all(&|sample| alike(sample.roughness[0], across));
        let keeps_width = !is_round && all(&|sample| alike(sample.roughness[0] * sample.cosine, across));
        if !(all(&|sample| alike(sample.roughness[1], across)) && (is_round || keeps_width)) {
            return Err(LobeFault::Roughness);
        }
        let share = |sample: &LobeSample| luminance(sample.tint) / strength;
        if !all(&|sample| (0..3).all(|c| alike(sample.tint[c], tint[c] * share(sample)))) {
            return Err(LobeFault::Hue);
        }
        let factor = |sample: &LobeSample| share(sample) * if keeps_width { sample.cosine } else { 1.0 };
        let points = samples.iter().map(|sample| [sample.cosine, factor(sample)]).collect::<Vec<_>>();
        let law = law(&points).ok_or(LobeFault::Law)?;
        Ok(Self { tint, roughness: across, keeps_width, law })
    }

    /// The BSDF in 1/sr: that of the node for the inputs that the viewer sees.
    #[must_use]
    pub fn eval(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> [f64; 3] {
        let cosine = wo.z.max(LEAST_COSINE);
        let [along, over] =
            if self.keeps_width { [self.roughness / cosine, cosine] } else { [self.roughness, 1.0] };
        let [wo, wi] = along_projection(wo, wi);
        let lobe = AnyLobe::new(Model::Reciprocal, &Params::anisotropic(along, self.roughness));
        let value = lobe.map_or(0.0, |lobe| lobe.eval(wo, wi)[0]);
        self.tint.map(|tint| tint * self.law.at(wo.z) / over * value)
    }
}

/// The law through points of cosine and factor, if there is one.
fn law(points: &[[f64; 2]]) -> Option<EntranceLaw> {
    if points.iter().any(|[_, factor]| !(*factor > 0.0)) {
        return None;
    }
    let fits =
        |law: &EntranceLaw| points.iter().all(|&[c, factor]| (law.at(c) / factor).ln().abs() <= TOLERANCE);
    // The power from the lowest cosine, where the most of it is.
    let lowest = points.iter().copied().reduce(|a, b| if b[0] < a[0] { b } else { a })?;
    let power = EntranceLaw::power(if lowest[0] < 1.0 { lowest[1].ln() / lowest[0].ln() } else { 0.0 });
    if fits(&power) {
        return Some(power);
    }
    let bent = STARTS.map(|[bend, sharpness]| {
        let start = EntranceLaw { slope: power.slope, bend, sharpness };
        let (problem, _) = LevenbergMarquardt::new().minimize(Bend { points, law: start });
        problem.law
    });
    bent.into_iter().find(fits)
}

/// The search for a law with a bend: the logarithms of law over factor.
struct Bend<'a> {
    points: &'a [[f64; 2]],
    law: EntranceLaw,
}

impl LeastSquaresProblem<f64, Dyn, U3> for Bend<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, U3>;
    type ParameterStorage = Owned<f64, U3>;

    fn set_params(&mut self, x: &Vector3<f64>) {
        self.law = EntranceLaw { slope: x[0], bend: x[1].exp(), sharpness: x[2].exp() };
    }

    fn params(&self) -> Vector3<f64> {
        Vector3::new(self.law.slope, self.law.bend.ln(), self.law.sharpness.ln())
    }

    fn residuals(&self) -> Option<OVector<f64, Dyn>> {
        let residual = |&[cosine, factor]: &[f64; 2]| self.law.at(cosine).ln() - factor.ln();
        Some(OVector::<f64, Dyn>::from_iterator(self.points.len(), self.points.iter().map(residual)))
    }

    fn jacobian(&self) -> Option<OMatrix<f64, Dyn, U3>> {
        let row = |i: usize, j: usize| {
            let gradient = self.law.log_gradient(log_squared_tangent(self.points[i][0]));
            [gradient.by_slope, gradient.by_log_bend, gradient.by_log_sharpness][j]
        };
        Some(Matrix::from_fn_generic(Dyn(self.points.len()), U3, row))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(lobe: &ViewedLobe) -> Vec<LobeSample> {
        let cosines = (0..24).map(|i| 1.0 - f64::from(i) * 0.04);
        let sample = |cosine: f64| {
            let over = if lobe.keeps_width { cosine } else { 1.0 };
            LobeSample {
                cosine,
                tint: lobe.tint.map(|tint| tint * lobe.law.at(cosine) / over),
                roughness: [lobe.roughness / over, lobe.roughness],
            }
        };
        cosines.map(sample).collect()
    }

    #[test]
    fn laws_are_found_again() {
        let bend = |slope, bend, sharpness| EntranceLaw { slope, bend, sharpness };
        for law in
            [EntranceLaw::power(0.0), EntranceLaw::power(3.4), bend(6.0, 0.34, 12.0), bend(2.0, 5.0, 4.0)]
        {
            for keeps_width in [false, true] {
                let lobe = ViewedLobe { tint: [0.06, 0.05, 0.01], roughness: 0.006, keeps_width, law };
                let found = ViewedLobe::of(&samples(&lobe)).unwrap();
                assert_eq!((found.tint, found.keeps_width), (lobe.tint, keeps_width));
                for cosine in [1.0, 0.8, 0.3, 0.1] {
                    let error = found.law.at(cosine) / law.at(cosine) - 1.0;
                    assert!(error.abs() < 3e-4, "{law:?} {cosine} {error}");
                }
            }
        }
    }

    #[test]
    fn what_is_no_law_is_refused() {
        let lobe = ViewedLobe {
            tint: [0.06, 0.05, 0.01],
            roughness: 0.006,
            keeps_width: true,
            law: EntranceLaw::power(3.0),
        };
        let changed = |change: &dyn Fn(&mut LobeSample)| {
            let mut samples = samples(&lobe);
            samples.iter_mut().for_each(change);
            ViewedLobe::of(&samples).unwrap_err()
        };
        assert_eq!(changed(&|sample| sample.tint = [0.0; 3]), LobeFault::Black);
        assert_eq!(changed(&|sample| sample.tint[0] *= sample.cosine), LobeFault::Hue);
        assert_eq!(changed(&|sample| sample.roughness[0] *= 1.01), LobeFault::Roughness);
        let wavy = |sample: &mut LobeSample| {
            let factor = 1.0 + 0.1 * (20.0 * (1.0 - sample.cosine)).sin();
            sample.tint = sample.tint.map(|tint| tint * factor);
        };
        assert_eq!(changed(&wavy), LobeFault::Law);
    }
}
