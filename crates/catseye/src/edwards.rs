//! The asymmetric lobe of the halfway-vector-disk paper.

use crate::disk::{Disk, above_horizon, density, is_above_horizon};
use crate::{Component, Lobe, ParamError, Params, Real, Sample, Vec3};

/// The lobe of Edwards et al. 2006 as published: `f = B z_o / (z_i^2 (z_o + z_i))`, the density of its
/// samples over the cosine.
///
/// Its albedo is exactly the tint for every direction and roughness, but `f(o, i)` differs from `f(i, o)`. It
/// has nothing to compensate: `multiscatter_tint` is not used.
#[derive(Clone, Copy, Debug)]
pub struct Edwards<T> {
    disk: Option<Disk<T>>,
    tint: [T; 3],
}

impl<T: Real> Edwards<T> {
    /// Validates and prepares the parameters.
    ///
    /// # Errors
    /// The first parameter that is NaN or out of its range.
    pub fn new(params: &Params<T>) -> Result<Self, ParamError> {
        params.validate()?;
        Ok(Self { disk: Disk::new(params.roughness()), tint: params.tint })
    }
}

impl<T: Real> Lobe<T> for Edwards<T> {
    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> ([T; 3], T) {
        let Some(disk) = &self.disk else { return ([T::ZERO; 3], T::ZERO) };
        if !above_horizon(wo, wi) {
            return ([T::ZERO; 3], T::ZERO);
        }
        let pdf = density(disk.lump::<false>(wo, wi), wo, wi);
        (self.tint.map(|t| t * pdf / wi.z), pdf)
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, [u1, u2, _]: [T; 3]) -> Option<Sample<T>> {
        if !is_above_horizon(wo) {
            return None;
        }
        let Some(disk) = &self.disk else {
            return Some(Sample::dirac(wo, self.tint));
        };
        let drawn = disk.sample::<false>(wo, u1, u2);
        if !above_horizon(wo, drawn.wi) {
            return None;
        }
        let pdf = drawn.density();
        Some(Sample { wi: drawn.wi, weight: self.tint, pdf, component: Component::Single })
    }

    #[inline]
    fn albedo(&self, wo: Vec3<T>) -> [T; 3] {
        if is_above_horizon(wo) { self.tint } else { [T::ZERO; 3] }
    }

    fn is_dirac(&self) -> bool {
        self.disk.is_none()
    }
}
