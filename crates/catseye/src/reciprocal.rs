//! The reciprocal retro-reflective lobe of the MaterialX proposal.

use crate::compensation::Compensation;
use crate::disk::{Disk, above_horizon, is_above_horizon};
use crate::{Component, Lobe, LobeVisitor, ParamError, Params, Real, Sample, Vec3};

/// The BSDF of the `retro_reflective_bsdf` node: Edwards' lobe made reciprocal, plus the compensation of the energy
/// it loses.
///
/// With the lump B of the halfway-vector disk and the albedo rho of single scattering (docs/theory.md, sections 2
/// and 5):
///
/// ```text
/// f     = B min(z_o, z_i) / (max(z_o, z_i)^2 (z_o + z_i))
/// f_ms  = (1 - rho(o)) (1 - rho(i)) / (pi (1 - rho_avg))
/// total = tint f + multiscatter_tint f_ms
/// ```
///
/// Sampling draws from the disk and passes what single scattering rejects to the compensation. Where both tints are
/// the same grey, its density is the BSDF times cosine: every sample weighs the same.
#[derive(Clone, Copy, Debug)]
pub struct Reciprocal<T> {
    disk: Option<Disk<T>>,
    compensation: Compensation<T>,
    params: Params<T>,
    /// Means of the tints over the channels, which lobes are chosen by.
    single: T,
    multiple: T,
}

/// How `sample` divides its samples: a disk sample of acceptance weight w is kept with the probability
/// `base + slope w`, and the rest goes to the compensation.
#[derive(Clone, Copy, Debug)]
struct Split<T> {
    base: T,
    slope: T,
    /// Probability of the compensation.
    multiple: T,
}

impl<T: Real> Reciprocal<T> {
    /// Validates and prepares the parameters.
    ///
    /// # Errors
    /// The first parameter that is NaN or out of its range.
    pub fn new(params: &Params<T>) -> Result<Self, ParamError> {
        params.validate()?;
        let disk = Disk::new(params.roughness());
        let mean = |[r, g, b]: [T; 3]| (r + g + b) * T::from_f64(1.0 / 3.0);
        Ok(Self {
            disk,
            compensation: Compensation::new(disk.map_or([T::ONE; 2], |disk| [disk.m_u, disk.m_v])),
            params: *params,
            single: mean(params.tint),
            multiple: mean(params.multiscatter_tint),
        })
    }

    /// The cosine-weighted hemispherical mean of [`Lobe::albedo`], per channel: the share of diffuse light that is
    /// reflected. As exact as the fit that it is the integral of.
    #[must_use]
    pub fn average_albedo(&self) -> [T; 3] {
        let loss = if self.disk.is_some() { self.compensation.average_loss() } else { T::ZERO };
        self.params.albedo(T::ONE - loss)
    }

    /// The split for a direction that loses the share `loss`: in proportion to the energy of both lobes.
    #[inline(always)]
    fn split(&self, loss: T) -> Split<T> {
        let kept = T::ONE - loss;
        let energy = self.multiple + (self.single - self.multiple) * kept;
        // With as much tint as compensation, base = 0 and slope = 1 make f cos itself the density of what is kept.
        // More tint keeps some of the rejected samples, less tint rejects some of the accepted ones.
        let least = self.single.min(self.multiple);
        let slope = (least / energy.max(T::from_f64(1e-30))).min(T::ONE);
        let less_tint = self.single < self.multiple;
        let base = if less_tint { T::ZERO } else { T::ONE - slope };
        let rejected = if less_tint { T::ONE - slope } else { T::ZERO };
        Split { base, slope, multiple: rejected + slope * loss }
    }

    /// BSDF and density for two directions above the horizon, given the disk's power for them.
    #[inline(always)]
    fn eval_pdf_with<const COMPENSATED: bool, const ISOTROPIC: bool>(
        &self,
        norm: T,
        power: T,
        wo: Vec3<T>,
        wi: Vec3<T>,
    ) -> ([T; 3], T) {
        // All quotients come from one division, in factors that stay in range; low / high^2 is
        // low sum (low / product)^2 / sum. They are finished while the power is still being computed.
        let (sum, product, low) = (wo.z + wi.z, wo.z * wi.z, wo.z.min(wi.z));
        let inv = T::ONE / (sum * product);
        let steep = low * inv;
        let f = power * (norm * (low * sum) * (steep * steep));
        let pdf_single = power * (norm * inv * (wo.z * wo.z));
        if !COMPENSATED {
            return (self.params.tint.map(|t| t * f), pdf_single);
        }
        let loss_o = self.compensation.loss::<ISOTROPIC>(wo);
        let q = self.compensation.lobe::<ISOTROPIC>(wi);
        let split = self.split(loss_o);
        let f_ms = loss_o * q;
        let [t, m] = [self.params.tint, self.params.multiscatter_tint];
        let total = [t[0] * f + m[0] * f_ms, t[1] * f + m[1] * f_ms, t[2] * f + m[2] * f_ms];
        let pdf = split.base * pdf_single + (split.slope * f + split.multiple * q) * wi.z;
        (total, pdf)
    }

    #[inline(always)]
    fn eval_pdf_as<const COMPENSATED: bool, const ISOTROPIC: bool>(
        &self,
        wo: Vec3<T>,
        wi: Vec3<T>,
    ) -> ([T; 3], T) {
        let Some(disk) = &self.disk else { return ([T::ZERO; 3], T::ZERO) };
        if !above_horizon(wo, wi) {
            return ([T::ZERO; 3], T::ZERO);
        }
        self.eval_pdf_with::<COMPENSATED, ISOTROPIC>(disk.norm, disk.power::<ISOTROPIC>(wo, wi), wo, wi)
    }

    #[inline(always)]
    fn sample_as<const COMPENSATED: bool, const ISOTROPIC: bool>(
        &self,
        wo: Vec3<T>,
        [u1, u2, u3]: [T; 3],
    ) -> Option<Sample<T>> {
        if !is_above_horizon(wo) {
            return None;
        }
        let Some(disk) = &self.disk else {
            return Some(Sample {
                wi: wo,
                weight: self.params.tint,
                pdf: T::ONE,
                component: Component::Dirac,
            });
        };
        let mut drawn = disk.sample(wo, u1, u2);
        let mut component = Component::Single;
        // The quotient of f cos and the density drawn from is min(1, z_i/z_o)^3.
        let ratio = (drawn.wi.z / wo.z).min(T::ONE);
        if !COMPENSATED {
            if !above_horizon(wo, drawn.wi) {
                return None;
            }
            let pdf = disk.density(drawn.power, wo, drawn.wi);
            let weight = self.params.tint.map(|t| t * (ratio * ratio * ratio));
            return Some(Sample { wi: drawn.wi, weight, pdf, component });
        }
        let split = self.split(self.compensation.loss::<ISOTROPIC>(wo));
        let keep = split.base + split.slope * (ratio * ratio * ratio);
        if u3 >= keep {
            let fresh = ((u3 - keep) / (T::ONE - keep)).min(T::ONE);
            drawn.wi = self.compensation.sample::<ISOTROPIC>(fresh, u1);
            drawn.power = disk.power::<ISOTROPIC>(wo, drawn.wi);
            component = Component::Multiple;
        }
        if !above_horizon(wo, drawn.wi) {
            return None;
        }
        let (f, pdf) = self.eval_pdf_with::<COMPENSATED, ISOTROPIC>(disk.norm, drawn.power, wo, drawn.wi);
        let scale = drawn.wi.z / pdf;
        Some(Sample { wi: drawn.wi, weight: f.map(|f| f * scale), pdf, component })
    }

    #[inline(always)]
    fn is_compensated(&self) -> bool {
        self.multiple > T::ZERO
    }
}

/// The lobe with its decisions made: whether it is compensated, and whether it is isotropic.
#[derive(Clone, Copy, Debug)]
struct Form<T, const COMPENSATED: bool, const ISOTROPIC: bool>(Reciprocal<T>);

impl<T: Real> Lobe<T> for Reciprocal<T> {
    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> ([T; 3], T) {
        match (self.is_compensated(), self.compensation.is_isotropic()) {
            (false, true) => self.eval_pdf_as::<false, true>(wo, wi),
            (false, false) => self.eval_pdf_as::<false, false>(wo, wi),
            (true, true) => self.eval_pdf_as::<true, true>(wo, wi),
            (true, false) => self.eval_pdf_as::<true, false>(wo, wi),
        }
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3]) -> Option<Sample<T>> {
        match (self.is_compensated(), self.compensation.is_isotropic()) {
            (false, true) => self.sample_as::<false, true>(wo, u),
            (false, false) => self.sample_as::<false, false>(wo, u),
            (true, true) => self.sample_as::<true, true>(wo, u),
            (true, false) => self.sample_as::<true, false>(wo, u),
        }
    }

    #[inline]
    fn albedo(&self, wo: Vec3<T>) -> [T; 3] {
        if !is_above_horizon(wo) {
            return [T::ZERO; 3];
        }
        let loss = if self.disk.is_some() { self.compensation.loss::<false>(wo) } else { T::ZERO };
        self.params.albedo(T::ONE - loss)
    }

    fn is_dirac(&self) -> bool {
        self.disk.is_none()
    }

    #[inline(always)]
    fn specialize<V: LobeVisitor<T>>(&self, visitor: V) {
        match (self.is_compensated(), self.compensation.is_isotropic()) {
            (false, true) => visitor.visit(Form::<T, false, true>(*self)),
            (false, false) => visitor.visit(Form::<T, false, false>(*self)),
            (true, true) => visitor.visit(Form::<T, true, true>(*self)),
            (true, false) => visitor.visit(Form::<T, true, false>(*self)),
        }
    }
}

impl<T: Real, const COMPENSATED: bool, const ISOTROPIC: bool> Lobe<T> for Form<T, COMPENSATED, ISOTROPIC> {
    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> ([T; 3], T) {
        self.0.eval_pdf_as::<COMPENSATED, ISOTROPIC>(wo, wi)
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3]) -> Option<Sample<T>> {
        self.0.sample_as::<COMPENSATED, ISOTROPIC>(wo, u)
    }

    #[inline]
    fn albedo(&self, wo: Vec3<T>) -> [T; 3] {
        self.0.albedo(wo)
    }

    fn is_dirac(&self) -> bool {
        self.0.is_dirac()
    }
}
