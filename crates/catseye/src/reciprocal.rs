//! The reciprocal retro-reflective lobe of the MaterialX proposal.

use crate::disk::{Disk, offset};
use crate::{Lobe, LobeKind, ParamError, Params, Real, Sample, Vec3, albedo};

/// The BSDF of the `retro_reflective_bsdf` node: Edwards' lobe made reciprocal, and its compensation.
#[derive(Clone, Copy, Debug)]
pub struct Reciprocal<T> {
    disk: Option<Disk<T>>,
    tint: [T; 3],
    multiscatter_tint: [T; 3],
}

impl<T: Real> Reciprocal<T> {
    /// Validates and prepares the parameters.
    ///
    /// # Errors
    /// The first parameter that is out of its range.
    pub fn new(params: &Params<T>) -> Result<Self, ParamError> {
        params.validate()?;
        Ok(Self {
            disk: Disk::new(params.roughness()),
            tint: params.tint,
            multiscatter_tint: params.multiscatter_tint,
        })
    }

    fn rho(&self, w: Vec3<T>) -> T {
        self.disk.map_or(T::ONE, |disk| T::from_f64(albedo::exact::directional(disk.m_u.to_f64(), disk.m_v.to_f64(), [w.x.to_f64(), w.y.to_f64()])))
    }
}

impl<T: Real> Lobe<T> for Reciprocal<T> {
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>) -> [T; 3] {
        let Some(disk) = &self.disk else { return [T::ZERO; 3] };
        if !(wo.z > T::ZERO && wi.z > T::ZERO) { return [T::ZERO; 3] }
        let (lo, hi) = (wo.z.min(wi.z), wo.z.max(wi.z));
        let f = disk.lump(wo, wi) * lo / (hi * hi * (wo.z + wi.z));
        self.tint.map(|t| t * f)
    }

    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        let Some(disk) = &self.disk else { return T::ZERO };
        if !(wo.z > T::ZERO && wi.z > T::ZERO) { return T::ZERO }
        disk.lump(wo, wi) * wo.z / (wi.z * (wo.z + wi.z))
    }

    fn sample(&self, wo: Vec3<T>, u: [T; 3]) -> Option<Sample<T>> {
        if !(wo.z > T::ZERO) { return None }
        let Some(disk) = &self.disk else {
            return Some(Sample { wi: wo, weight: self.tint, pdf: T::ONE, lobe: LobeKind::Dirac });
        };
        let (sin_psi, cos_psi) = (u[0] * T::from_f64(core::f64::consts::TAU)).sin_cos();
        let (ex, ey) = (disk.m_u * cos_psi, disk.m_v * sin_psi);
        let m2 = ex * ex + ey * ey;
        let d2 = -((-u[1]).ln_1p() * m2).exp_m1();
        let scale = (d2 / m2).sqrt();
        let (dx, dy) = (ex * scale, ey * scale);
        let a = wo.x * dx + wo.y * dy;
        let hh = T::ONE + a + a + d2;
        let k = T::from_f64(2.0) * (T::ONE + a) / hh;
        let wi = Vec3::new(k * (wo.x + dx) - wo.x, k * (wo.y + dy) - wo.y, wo.z * (T::ONE - d2) / hh);
        let ratio = (wi.z / wo.z).min(T::ONE);
        let w = ratio * ratio * ratio;
        let _ = offset(wo, wi);
        Some(Sample { wi, weight: self.tint.map(|t| t * w), pdf: self.pdf(wo, wi), lobe: LobeKind::Single })
    }

    fn albedo(&self, wo: Vec3<T>) -> [T; 3] {
        if !(wo.z > T::ZERO) { return [T::ZERO; 3] }
        let rho = self.rho(wo);
        let mut out = [T::ZERO; 3];
        for ((out, t), m) in out.iter_mut().zip(self.tint).zip(self.multiscatter_tint) {
            *out = t * rho + m * (T::ONE - rho);
        }
        out
    }

    fn is_dirac(&self) -> bool {
        self.disk.is_none()
    }
}
