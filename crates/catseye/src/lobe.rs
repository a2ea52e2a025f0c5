//! The interface that all lobes share. The contract is stated in the crate's documentation.

use crate::{Real, Vec3};

/// The part of a lobe that a sampled direction came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Single scattering by a rough reflector.
    Single,
    /// The multiple-scattering compensation.
    Multiple,
    /// A perfect reflector: a Dirac distribution that only `sample` can meet.
    Dirac,
}

impl Component {
    /// The name used in CSV output: `single`, `multiple` or `dirac`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::Multiple => "multiple",
            Self::Dirac => "dirac",
        }
    }
}

/// A sampled direction and what a Monte Carlo estimator needs to know of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<T> {
    /// The sampled direction, unit length, pointing away from the surface.
    pub wi: Vec3<T>,
    /// `eval(wo, wi) * wi.z / pdf` per channel; of a Dirac component the reflected share of the energy.
    pub weight: [T; 3],
    /// Density of `wi` per steradian, equal to `pdf(wo, wi)`; 1 where the component is [`Component::Dirac`],
    /// whose density is none: test for the component, not for this number.
    pub pdf: T,
    /// What the direction came from.
    pub component: Component,
}

impl<T: Real> Sample<T> {
    /// The reflection of a perfect retro-reflector.
    pub(crate) fn dirac(wo: Vec3<T>, tint: [T; 3]) -> Self {
        Self { wi: wo, weight: tint, pdf: T::ONE, component: Component::Dirac }
    }
}

/// A BSDF lobe in the local frame.
pub trait Lobe<T: Real> {
    /// The BSDF f(wo, wi) in 1/sr per channel, cosine not included, and the density, per steradian, with
    /// which [`Lobe::sample`] chooses `wi`. Both are 0 below the horizon and for a Dirac lobe.
    #[must_use]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> ([T; 3], T);

    /// The BSDF alone, as in [`Lobe::eval_pdf`].
    #[must_use]
    #[inline(always)]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>) -> [T; 3] {
        self.eval_pdf(wo, wi).0
    }

    /// The density alone, as in [`Lobe::eval_pdf`].
    #[must_use]
    #[inline(always)]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.eval_pdf(wo, wi).1
    }

    /// A direction chosen by three uniform numbers in `[0, 1)`; `None` if `wo` is below the horizon or not a
    /// direction.
    #[must_use]
    fn sample(&self, wo: Vec3<T>, u: [T; 3]) -> Option<Sample<T>>;

    /// Share of the energy arriving along `wo` that is reflected, per channel, in `[0, 1]`. 0 below the
    /// horizon.
    #[must_use]
    fn albedo(&self, wo: Vec3<T>) -> [T; 3];

    /// Whether the lobe is a Dirac distribution, which only `sample` can meet.
    #[must_use]
    fn is_dirac(&self) -> bool;

    /// Calls `visitor` with the lobe in the form that has the fewest decisions left to make, for long loops.
    #[inline(always)]
    fn specialize<V: LobeVisitor<T>>(&self, visitor: V) -> V::Output
    where
        Self: Copy,
    {
        visitor.visit(*self)
    }
}

/// Code that uses a lobe, compiled once for each form of it. See [`Lobe::specialize`].
pub trait LobeVisitor<T: Real> {
    /// What it returns.
    type Output;
    /// Runs it.
    fn visit<L: Lobe<T> + Copy>(self, lobe: L) -> Self::Output;
}
