//! The choice among the lobes at run time.

use crate::albedo::exact;
use crate::disk::{is_above_horizon, width};
use crate::lobe::LobeVisitor;
use crate::{BackVector, Edwards, Lobe, ParamError, Params, Real, Reciprocal, Sample, Vec3};

/// Cosines and azimuths of the directions that the mean of other models than the reciprocal one is taken
/// over.
const AVERAGE: [u32; 2] = [128, 16];

/// The lobes that can be chosen by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Model {
    /// The proposal's lobe: Edwards' made reciprocal, with compensation. See [`Reciprocal`].
    #[default]
    Reciprocal,
    /// The paper's own lobe: albedo exactly 1, not reciprocal.
    Edwards,
    /// The microfacet lobe of MaterialX 1.39.5 with `retroreflective = true`, of the same peak. See
    /// [`AnyLobe::new`].
    BackVector,
}

impl Model {
    /// Every model, the default first.
    pub const ALL: [Self; 3] = [Self::Reciprocal, Self::Edwards, Self::BackVector];

    /// The name on the command line: `reciprocal`, `edwards` or `back-vector`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Reciprocal => "reciprocal",
            Self::Edwards => "edwards",
            Self::BackVector => "back-vector",
        }
    }
}

/// A lobe of any model.
#[derive(Clone, Copy, Debug)]
pub enum AnyLobe<T> {
    /// See [`Reciprocal`].
    Reciprocal(Reciprocal<T>),
    /// See [`Edwards`].
    Edwards(Edwards<T>),
    /// See [`BackVector`].
    BackVector(BackVector<T>),
}

impl<T: Real> AnyLobe<T> {
    /// Validates and prepares the parameters for the model.
    ///
    /// The roughness is the proposal's for every model. For the back-vector model it becomes GGX's alpha by
    /// [`width`], which gives all three lobes the same value at normal incidence in the retro direction:
    /// alpha is roughness / sqrt(2) where that is small, and 1 for an infinite roughness. That model has no
    /// compensation.
    ///
    /// # Errors
    /// The first parameter that is NaN or out of its range.
    pub fn new(model: Model, params: &Params<T>) -> Result<Self, ParamError> {
        params.validate()?;
        Ok(match model {
            Model::Reciprocal => Self::Reciprocal(Reciprocal::new(params)?),
            Model::Edwards => Self::Edwards(Edwards::new(params)?),
            Model::BackVector => {
                Self::BackVector(BackVector::new(params.roughness().map(width), params.tint)?)
            }
        })
    }
}

impl Model {
    /// The albedo along `wo` per channel by quadrature, without the fits that [`Lobe::albedo`] uses: 0 below
    /// the horizon. The error is below 1e-9, for the back-vector model below 1e-4.
    ///
    /// # Errors
    /// The first parameter that is NaN or out of its range.
    pub fn exact_albedo(self, params: &Params<f64>, wo: Vec3<f64>) -> Result<[f64; 3], ParamError> {
        if self != Self::Reciprocal {
            return Ok(AnyLobe::new(self, params)?.albedo(wo));
        }
        params.validate()?;
        if !is_above_horizon(wo) {
            return Ok([0.0; 3]);
        }
        Ok(params.albedo(exact::directional(params.roughness(), wo)))
    }

    /// The cosine-weighted mean of [`Model::exact_albedo`] over the hemisphere, per channel: the share of
    /// diffuse light that is reflected. The error is below 1e-9, for the back-vector model below 1e-3.
    ///
    /// # Errors
    /// The first parameter that is NaN or out of its range.
    pub fn exact_average_albedo(self, params: &Params<f64>) -> Result<[f64; 3], ParamError> {
        if self == Self::Reciprocal {
            params.validate()?;
            return Ok(params.albedo(exact::average(params.roughness())));
        }
        let lobe = AnyLobe::new(self, params)?;
        let [cosines, azimuths] = AVERAGE.map(f64::from);
        let mut mean = [0.0; 3];
        for i in 0..AVERAGE[0] {
            for k in 0..AVERAGE[1] {
                // Midpoints, evenly spread over the disk that the hemisphere is seen as.
                let cos_theta = Real::sqrt((f64::from(i) + 0.5) / cosines);
                let sin_theta = Real::sqrt(1.0 - cos_theta * cos_theta);
                let (sin_phi, cos_phi) = ((f64::from(k) + 0.5) / azimuths).sin_cos_turns();
                let albedo = lobe.albedo(Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta));
                mean = [0, 1, 2].map(|c| mean[c] + albedo[c] / (cosines * azimuths));
            }
        }
        Ok(mean)
    }
}

/// Calls the same method of whichever lobe it is.
macro_rules! forward {
    ($self:ident, $lobe:ident => $call:expr) => {
        match $self {
            AnyLobe::Reciprocal($lobe) => $call,
            AnyLobe::Edwards($lobe) => $call,
            AnyLobe::BackVector($lobe) => $call,
        }
    };
}

impl<T: Real> Lobe<T> for AnyLobe<T> {
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> ([T; 3], T) {
        forward!(self, lobe => lobe.eval_pdf(wo, wi))
    }

    fn sample(&self, wo: Vec3<T>, u: [T; 3]) -> Option<Sample<T>> {
        forward!(self, lobe => lobe.sample(wo, u))
    }

    fn albedo(&self, wo: Vec3<T>) -> [T; 3] {
        forward!(self, lobe => lobe.albedo(wo))
    }

    fn is_dirac(&self) -> bool {
        forward!(self, lobe => lobe.is_dirac())
    }

    fn specialize<V: LobeVisitor<T>>(&self, visitor: V) -> V::Output {
        forward!(self, lobe => lobe.specialize(visitor))
    }
}
