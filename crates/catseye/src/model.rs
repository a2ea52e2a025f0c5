//! The choice among the lobes at run time.

use crate::albedo::exact;
use crate::disk::is_above_horizon;
use crate::{BackVector, Edwards, Lobe, LobeVisitor, ParamError, Params, Real, Reciprocal, Sample, Vec3};

/// The lobes that can be chosen by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Model {
    /// The proposal's lobe: Edwards' made reciprocal, with compensation. See [`Reciprocal`].
    #[default]
    Reciprocal,
    /// The paper's own lobe: albedo exactly 1, not reciprocal.
    Edwards,
    /// The microfacet lobe of MaterialX 1.39.5 with `retroreflective = true`. The roughness is GGX's alpha.
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
    /// # Errors
    /// The first parameter that is NaN or out of its range.
    pub fn new(model: Model, params: &Params<T>) -> Result<Self, ParamError> {
        Ok(match model {
            Model::Reciprocal => Self::Reciprocal(Reciprocal::new(params)?),
            Model::Edwards => Self::Edwards(Edwards::new(params)?),
            Model::BackVector => Self::BackVector(BackVector::new(params)?),
        })
    }
}

impl Model {
    /// The albedo along `wo` per channel by quadrature, without the fits that [`Lobe::albedo`] uses: 0 below the
    /// horizon. The error is below 1e-9, for the back-vector model below 1e-4.
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
        let rho = exact::directional(params.roughness(), wo);
        Ok([0, 1, 2].map(|c| params.tint[c] * rho + params.multiscatter_tint[c] * (1.0 - rho)))
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

    fn specialize<V: LobeVisitor<T>>(&self, visitor: V) {
        forward!(self, lobe => lobe.specialize(visitor));
    }
}
