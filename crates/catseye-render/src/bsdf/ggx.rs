//! The GGX distribution of facet normals.

use std::f32::consts::PI;

use glam::Vec3;

/// Alpha below which facets make a smooth surface: single precision can't resolve the lobe.
pub(crate) const SMOOTH_ALPHA: f32 = 5e-4;

/// Trowbridge and Reitz' distribution (GGX of Walter et al. 2007), anisotropic, with Smith's shadowing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ggx {
    pub(crate) alpha: [f32; 2],
}

impl Ggx {
    /// The density D(m) of facet normals.
    #[inline]
    pub(crate) fn d(&self, m: Vec3) -> f32 {
        let [ax, ay] = self.alpha;
        let (x, y) = (m.x / ax, m.y / ay);
        let e = x * x + y * y + m.z * m.z;
        1.0 / (PI * ax * ay * e * e)
    }

    /// Smith's auxiliary function Lambda.
    #[inline]
    pub(crate) fn lambda(&self, w: Vec3) -> f32 {
        let (x, y) = (w.x * self.alpha[0], w.y * self.alpha[1]);
        let tan2 = (x * x + y * y) / (w.z * w.z).max(1e-20);
        0.5 * ((1.0 + tan2).sqrt() - 1.0)
    }

    /// The share of facets seen from `wo`.
    #[inline]
    pub(crate) fn g1(&self, wo: Vec3) -> f32 {
        1.0 / (1.0 + self.lambda(wo))
    }

    /// The share of facets seen from both directions, their heights correlated (Heitz 2014, Eq. 99).
    #[inline]
    pub(crate) fn g2(&self, wo: Vec3, wi: Vec3) -> f32 {
        1.0 / (1.0 + self.lambda(wo) + self.lambda(wi))
    }

    /// The density of normals as seen from `wo`: what [`Ggx::sample_visible`] draws from.
    #[inline]
    pub(crate) fn d_visible(&self, wo: Vec3, m: Vec3) -> f32 {
        self.g1(wo) * wo.dot(m).max(0.0) * self.d(m) / wo.z
    }

    /// A facet normal as seen from `wo` above the horizon.
    ///
    /// Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", CGF 42(8), 2023.
    #[inline]
    pub(crate) fn sample_visible(&self, wo: Vec3, u: [f32; 2]) -> Vec3 {
        let [ax, ay] = self.alpha;
        let stretched = Vec3::new(wo.x * ax, wo.y * ay, wo.z).normalize();
        let z = (1.0 - u[1]) * (1.0 + stretched.z) - stretched.z;
        let sin_theta = (1.0 - z * z).clamp(0.0, 1.0).sqrt();
        let (sin_phi, cos_phi) = (2.0 * PI * u[0]).sin_cos();
        let half = Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, z) + stretched;
        Vec3::new(half.x * ax, half.y * ay, half.z.max(1e-12)).normalize()
    }
}
