//! The choice among the lobes at run time.

use crate::{Lobe, ParamError, Params, Real, Reciprocal, Sample, Vec3};

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
}

impl<T: Real> AnyLobe<T> {
    /// Validates and prepares the parameters for the model.
    ///
    /// # Errors
    /// The first parameter that is out of its range.
    pub fn new(_model: Model, params: &Params<T>) -> Result<Self, ParamError> {
        Ok(Self::Reciprocal(Reciprocal::new(params)?))
    }

    fn inner(&self) -> &dyn Lobe<T> {
        match self {
            Self::Reciprocal(lobe) => lobe,
        }
    }
}

impl<T: Real> Lobe<T> for AnyLobe<T> {
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>) -> [T; 3] {
        self.inner().eval(wo, wi)
    }
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.inner().pdf(wo, wi)
    }
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> ([T; 3], T) {
        self.inner().eval_pdf(wo, wi)
    }
    fn sample(&self, wo: Vec3<T>, u: [T; 3]) -> Option<Sample<T>> {
        self.inner().sample(wo, u)
    }
    fn albedo(&self, wo: Vec3<T>) -> [T; 3] {
        self.inner().albedo(wo)
    }
    fn is_dirac(&self) -> bool {
        self.inner().is_dirac()
    }
}
