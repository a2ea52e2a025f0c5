//! The back-vector microfacet lobe of MaterialX 1.39.5, `OpenPBR` 1.2 and the glTF draft, for comparison.

use crate::albedo::Gauss;
use crate::disk::{DIRAC_ROUGHNESS, above_horizon, is_above_horizon};
use crate::params::{validate_colour, validate_share};
use crate::{Component, Lobe, ParamError, Real, Sample, Vec3};

/// GGX reflection with the view direction mirrored about the normal: what `conductor_bsdf` with
/// `retroreflective = true` does, for a Fresnel factor equal to the tint.
///
/// Portsmouth et al., "The Minimal Retroreflective Microfacet Model", JCGT 15(1), 2026. The distribution is
/// the anisotropic one of Walter et al. 2007, shadowing the height-correlated one of Heitz 2014, sampling
/// that of the visible normals as spherical caps, Dupuy and Benyoub 2023. Its roughness is GGX's alpha;
/// [`crate::AnyLobe`] has the conversion from the proposal's.
#[derive(Clone, Copy, Debug)]
pub struct BackVector<T> {
    alpha_u: T,
    alpha_v: T,
    tint: [T; 3],
    dirac: bool,
}

impl<T: Real> BackVector<T> {
    /// The lobe of GGX's alpha along and across `tangent_u`, in `[0, 1]`, and of a tint in `[0, 1]` per
    /// channel.
    ///
    /// # Errors
    /// The first of them that is NaN or out of its range.
    pub fn new([alpha_u, alpha_v]: [T; 2], tint: [T; 3]) -> Result<Self, ParamError> {
        validate_share("alpha_u", None, alpha_u)?;
        validate_share("alpha_v", None, alpha_v)?;
        validate_colour("tint", tint)?;
        let threshold = T::from_f64(DIRAC_ROUGHNESS);
        Ok(Self {
            alpha_u: alpha_u.max(threshold),
            alpha_v: alpha_v.max(threshold),
            tint,
            dirac: alpha_u < threshold && alpha_v < threshold,
        })
    }

    /// Smith's Lambda of a direction above the horizon.
    #[inline(always)]
    fn lambda(&self, w: Vec3<T>) -> T {
        let (x, y) = (self.alpha_u * w.x / w.z, self.alpha_v * w.y / w.z);
        let t2 = x * x + y * y;
        // (sqrt(1 + t2) - 1) / 2 without cancellation
        T::from_f64(0.5) * t2 / (T::ONE + (T::ONE + t2).sqrt())
    }

    /// The distribution of normals at the half vector of the mirrored `wo` and `wi`.
    #[inline(always)]
    fn distribution(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        let (dx, dy, sz) = (wi.x - wo.x, wi.y - wo.y, wi.z + wo.z);
        let (slope_x, slope_y) = (dx / (sz * self.alpha_u), dy / (sz * self.alpha_v));
        let tail = T::ONE + slope_x * slope_x + slope_y * slope_y;
        // 1 / cos^4 of the half vector's polar angle
        let inv_cos2 = T::ONE + (dx * dx + dy * dy) / (sz * sz);
        inv_cos2 * inv_cos2 * T::FRAC_1_PI / (self.alpha_u * self.alpha_v * tail * tail)
    }

    /// The sampled direction; its z may be below the horizon.
    #[inline(always)]
    fn sample_direction(&self, wo: Vec3<T>, u1: T, u2: T) -> Vec3<T> {
        // The mirrored direction, stretched to the unit hemisphere.
        let stretched = Vec3::new(-self.alpha_u * wo.x, -self.alpha_v * wo.y, wo.z).normalized();
        let (sin_phi, cos_phi) = u1.sin_cos_turns();
        let z = (T::ONE - u2) * (T::ONE + stretched.z) - stretched.z;
        let sin_theta = (T::ONE - z * z).max(T::ZERO).sqrt();
        let h = Vec3::new(
            self.alpha_u * (sin_theta * cos_phi + stretched.x),
            self.alpha_v * (sin_theta * sin_phi + stretched.y),
            (z + stretched.z).max(T::from_f64(1e-12)),
        );
        // Reflect the mirrored direction (-x, -y, z) about h: i = 2 (o'.h) h / (h.h) - o'.
        let k = T::TWO * (wo.z * h.z - wo.x * h.x - wo.y * h.y) / h.dot(h);
        Vec3::new(k * h.x + wo.x, k * h.y + wo.y, k * h.z - wo.z)
    }
}

impl<T: Real> Lobe<T> for BackVector<T> {
    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> ([T; 3], T) {
        if self.dirac || !above_horizon(wo, wi) {
            return ([T::ZERO; 3], T::ZERO);
        }
        let (lambda_o, lambda_i) = (self.lambda(wo), self.lambda(wi));
        let quarter = T::from_f64(0.25) * self.distribution(wo, wi) / wo.z;
        let f = quarter / (wi.z * (T::ONE + lambda_o + lambda_i));
        (self.tint.map(|t| t * f), quarter / (T::ONE + lambda_o))
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, [u1, u2, _]: [T; 3]) -> Option<Sample<T>> {
        if !is_above_horizon(wo) {
            return None;
        }
        if self.dirac {
            return Some(Sample::dirac(wo, self.tint));
        }
        let wi = self.sample_direction(wo, u1, u2);
        if !above_horizon(wo, wi) {
            return None;
        }
        let (f, pdf) = self.eval_pdf(wo, wi);
        if pdf <= T::ZERO {
            return None;
        }
        let scale = wi.z / pdf;
        Some(Sample { wi, weight: f.map(|f| f * scale), pdf, component: Component::Single })
    }

    /// By quadrature over the sampler, to about 1e-4: unlike the other lobes' it is slow.
    fn albedo(&self, wo: Vec3<T>) -> [T; 3] {
        /// Azimuths of the quadrature.
        const AROUND: usize = 64;
        if !is_above_horizon(wo) {
            return [T::ZERO; 3];
        }
        if self.dirac {
            return self.tint;
        }
        let lambda_o = self.lambda(wo);
        let rule = Gauss::<48>::new();
        let mut rho = T::ZERO;
        for i in 0..AROUND {
            let u1 = T::from_f64((i as f64 + 0.5) / AROUND as f64);
            // Nodes crowd at u2 = 1, the tail of the distribution, where the weight falls to 0.
            let weight = |v: f64| {
                let wi = self.sample_direction(wo, u1, T::from_f64(1.0 - v * v * v));
                if !above_horizon(wo, wi) {
                    return 0.0;
                }
                3.0 * v * v * ((T::ONE + lambda_o) / (T::ONE + lambda_o + self.lambda(wi))).to_f64()
            };
            rho += T::from_f64(rule.integrate(0.0, 1.0, weight) / AROUND as f64);
        }
        self.tint.map(|t| t * rho)
    }

    fn is_dirac(&self) -> bool {
        self.dirac
    }
}
