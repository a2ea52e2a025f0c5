//! The reciprocal retro-reflective lobe of the MaterialX proposal.

use crate::compensation::Compensation;
use crate::disk::{Disk, above_horizon, is_above_horizon};
use crate::lobe::LobeVisitor;
use crate::{Component, Lobe, ParamError, Params, Real, Sample, Vec3};

/// The BSDF of the `retro_reflective_bsdf` node: Edwards' lobe made reciprocal, plus the compensation of the
/// energy it loses.
///
/// With the lump B of the halfway-vector disk and the albedo rho of single scattering (docs/theory.md,
/// sections 2 and 5):
///
/// ```text
/// f     = B min(z_o, z_i) / (max(z_o, z_i)^2 (z_o + z_i))
/// f_ms  = (1 - rho(o)) (1 - rho(i)) / (pi (1 - rho_avg))
/// total = tint f + multiscatter_tint f_ms
/// ```
///
/// Sampling draws from the disk and passes what single scattering rejects to the compensation. Where both
/// tints are the same grey, its density is the BSDF times cosine: every sample weighs the same.
#[derive(Clone, Copy, Debug)]
pub struct Reciprocal<T> {
    disk: Option<Disk<T>>,
    compensation: Compensation<T>,
    params: Params<T>,
    /// Means of `tint` and `multiscatter_tint` over the channels, which the lobes are chosen by.
    energies: [T; 2],
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
        let energies = [mean(params.tint), mean(params.multiscatter_tint)];
        let widths = disk.map_or([T::ONE; 2], |disk| [disk.m_u, disk.m_v]);
        let compensation = Compensation::new(widths, energies[1] > T::ZERO);
        Ok(Self { disk, compensation, params: *params, energies })
    }

    /// The cosine-weighted hemispherical mean of [`Lobe::albedo`], per channel: the share of diffuse light
    /// that is reflected. As exact as the fit that it is the integral of.
    #[must_use]
    pub fn average_albedo(&self) -> [T; 3] {
        let loss = if self.disk.is_some() { self.compensation.average_loss() } else { T::ZERO };
        self.params.albedo(T::ONE - loss)
    }

    /// Calls `visitor` with the lobe's decisions made.
    #[inline(always)]
    fn decided<V: LobeVisitor<T>>(&self, visitor: V) -> V::Output {
        match (self.energies[1] > T::ZERO, self.compensation.is_isotropic()) {
            (false, true) => visitor.visit(Form::<T, false, true>(self)),
            (false, false) => visitor.visit(Form::<T, false, false>(self)),
            (true, true) => visitor.visit(Form::<T, true, true>(self)),
            (true, false) => visitor.visit(Form::<T, true, false>(self)),
        }
    }
}

/// f of single scattering without its tint, in 1/sr, and the density of disk samples per steradian, for the
/// lump B.
#[inline(always)]
fn single<T: Real>(lump: T, wo: Vec3<T>, wi: Vec3<T>) -> (T, T) {
    // All quotients come from one division, in factors that stay in range. They are finished while the lump
    // is still being computed.
    let (sum, product, low) = (wo.z + wi.z, wo.z * wi.z, wo.z.min(wi.z));
    let inv = T::ONE / (sum * product);
    let steep = low * inv;
    let f = lump * ((low * sum) * (steep * steep)); // B min(z_o, z_i) / (max(z_o, z_i)^2 (z_o + z_i))
    let pdf = lump * (inv * (wo.z * wo.z)); // B z_o / (z_i (z_o + z_i))
    (f, pdf)
}

/// f of the compensation without its tint, in 1/sr, and the lobe q of its samples, whose density is q cos;
/// `loss_o` is what single scattering loses along the outgoing direction.
#[inline(always)]
fn multiple<T: Real, const ISOTROPIC: bool>(
    compensation: &Compensation<T>,
    loss_o: T,
    wi: Vec3<T>,
) -> (T, T) {
    let q = compensation.loss::<ISOTROPIC>(wi) * compensation.norm; // (1 - rho(i)) / (pi (1 - rho_avg))
    (loss_o * q, q) // (1 - rho(o)) (1 - rho(i)) / (pi (1 - rho_avg))
}

/// How samples are divided for an outgoing direction: a disk sample that single scattering accepts with the
/// probability w is kept with the probability `base + slope w`, and the rest goes to the compensation.
#[derive(Clone, Copy, Debug)]
struct Split<T> {
    base: T,
    slope: T,
    /// Probability of the compensation.
    multiple: T,
}

/// The split for a direction that loses the share `loss`: in proportion to the energy of both lobes.
#[inline(always)]
fn split<T: Real>([single, multiple]: [T; 2], loss: T) -> Split<T> {
    let energy = single + (multiple - single) * loss; // single rho + multiple (1 - rho)
    // With as much tint as compensation, base = 0 and slope = 1 make f cos itself the density of what is
    // kept. More tint keeps some of the rejected samples, less tint rejects some of the accepted ones.
    let slope = (single.min(multiple) / energy.max(T::from_f64(1e-30))).min(T::ONE);
    let less_tint = single < multiple;
    let base = if less_tint { T::ZERO } else { T::ONE - slope };
    let rejected = if less_tint { T::ONE - slope } else { T::ZERO };
    Split { base, slope, multiple: rejected + slope * loss }
}

/// The lobe with its decisions made: whether it is compensated, and whether it is isotropic.
#[derive(Clone, Copy, Debug)]
struct Form<'a, T, const COMPENSATED: bool, const ISOTROPIC: bool>(&'a Reciprocal<T>);

impl<T: Real, const COMPENSATED: bool, const ISOTROPIC: bool> Form<'_, T, COMPENSATED, ISOTROPIC> {
    /// BSDF and density for two directions above the horizon and their lump.
    #[inline(always)]
    fn combine(&self, lump: T, wo: Vec3<T>, wi: Vec3<T>) -> ([T; 3], T) {
        let Reciprocal { compensation, params, energies, .. } = self.0;
        let (f, pdf_disk) = single(lump, wo, wi);
        if !COMPENSATED {
            return (params.tint.map(|t| t * f), pdf_disk);
        }
        let loss = compensation.loss::<ISOTROPIC>(wo);
        let (f_ms, q) = multiple::<T, ISOTROPIC>(compensation, loss, wi);
        let [t, m] = [params.tint, params.multiscatter_tint];
        let total = [t[0] * f + m[0] * f_ms, t[1] * f + m[1] * f_ms, t[2] * f + m[2] * f_ms];
        let split = split(*energies, loss);
        (total, split.base * pdf_disk + (split.slope * f + split.multiple * q) * wi.z)
    }

    /// Edwards' sample, weighted by the quotient of f cos and its density.
    #[inline(always)]
    fn sample_single(&self, disk: &Disk<T>, wo: Vec3<T>, [u1, u2, _]: [T; 3]) -> Option<Sample<T>> {
        let drawn = disk.sample::<ISOTROPIC>(wo, u1, u2);
        if !above_horizon(wo, drawn.wi) {
            return None;
        }
        let accepted = acceptance(drawn.ratio);
        let weight = self.0.params.tint.map(|t| t * accepted);
        Some(Sample { wi: drawn.wi, weight, pdf: drawn.density(), component: Component::Single })
    }

    /// Edwards' sample where it is kept, and a sample of the compensation where it is not.
    #[inline(always)]
    fn sample_compensated(&self, disk: &Disk<T>, wo: Vec3<T>, [u1, u2, u3]: [T; 3]) -> Option<Sample<T>> {
        let Reciprocal { compensation, energies, .. } = self.0;
        // Draw from the disk.
        let mut drawn = disk.sample::<ISOTROPIC>(wo, u1, u2);
        let mut component = Component::Single;
        // Decide whether it is kept.
        let split = split(*energies, compensation.loss::<ISOTROPIC>(wo));
        let keep = split.base + split.slope * acceptance(drawn.ratio);
        // Draw from the compensation instead, with what the decision has left of u3.
        if u3 >= keep {
            let fresh = ((u3 - keep) / (T::ONE - keep)).min(T::ONE);
            drawn.wi = compensation.sample::<ISOTROPIC>(fresh, u1);
            drawn.lump = disk.lump::<ISOTROPIC>(wo, drawn.wi);
            component = Component::Multiple;
        }
        if !above_horizon(wo, drawn.wi) {
            return None;
        }
        // Weigh by both together.
        let (f, pdf) = self.combine(drawn.lump, wo, drawn.wi);
        let scale = drawn.wi.z / pdf;
        Some(Sample { wi: drawn.wi, weight: f.map(|f| f * scale), pdf, component })
    }
}

/// The quotient of f cos and the density of disk samples, given `z_i / z_o`.
#[inline(always)]
fn acceptance<T: Real>(ratio: T) -> T {
    let ratio = ratio.min(T::ONE);
    ratio * ratio * ratio // min(1, z_i/z_o)^3
}

impl<T: Real, const COMPENSATED: bool, const ISOTROPIC: bool> Lobe<T>
    for Form<'_, T, COMPENSATED, ISOTROPIC>
{
    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> ([T; 3], T) {
        let Some(disk) = &self.0.disk else { return ([T::ZERO; 3], T::ZERO) };
        if !above_horizon(wo, wi) {
            return ([T::ZERO; 3], T::ZERO);
        }
        self.combine(disk.lump::<ISOTROPIC>(wo, wi), wo, wi)
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3]) -> Option<Sample<T>> {
        if !is_above_horizon(wo) {
            return None;
        }
        match &self.0.disk {
            None => Some(Sample::dirac(wo, self.0.params.tint)),
            Some(disk) if COMPENSATED => self.sample_compensated(disk, wo, u),
            Some(disk) => self.sample_single(disk, wo, u),
        }
    }

    #[inline]
    fn albedo(&self, wo: Vec3<T>) -> [T; 3] {
        if !is_above_horizon(wo) {
            return [T::ZERO; 3];
        }
        let Reciprocal { disk, compensation, params, .. } = self.0;
        let loss = if disk.is_some() { compensation.loss::<ISOTROPIC>(wo) } else { T::ZERO };
        params.albedo(T::ONE - loss)
    }

    fn is_dirac(&self) -> bool {
        self.0.disk.is_none()
    }
}

impl<T: Real> Lobe<T> for Reciprocal<T> {
    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> ([T; 3], T) {
        self.decided(EvalPdf(wo, wi))
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3]) -> Option<Sample<T>> {
        self.decided(Draw(wo, u))
    }

    #[inline]
    fn albedo(&self, wo: Vec3<T>) -> [T; 3] {
        Form::<T, true, false>(self).albedo(wo)
    }

    fn is_dirac(&self) -> bool {
        self.disk.is_none()
    }

    #[inline(always)]
    fn specialize<V: LobeVisitor<T>>(&self, visitor: V) -> V::Output {
        // A copy of its own, for loops: the compiler knows that nothing changes it, and may read it at any
        // time.
        let lobe = *self;
        lobe.decided(visitor)
    }
}

struct EvalPdf<T>(Vec3<T>, Vec3<T>);
struct Draw<T>(Vec3<T>, [T; 3]);

impl<T: Real> LobeVisitor<T> for EvalPdf<T> {
    type Output = ([T; 3], T);
    #[inline(always)]
    fn visit<L: Lobe<T> + Copy>(self, lobe: L) -> Self::Output {
        lobe.eval_pdf(self.0, self.1)
    }
}

impl<T: Real> LobeVisitor<T> for Draw<T> {
    type Output = Option<Sample<T>>;
    #[inline(always)]
    fn visit<L: Lobe<T> + Copy>(self, lobe: L) -> Self::Output {
        lobe.sample(self.0, self.1)
    }
}
