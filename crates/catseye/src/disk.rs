//! The halfway-vector disk: Edwards' distribution of scaled half vectors, in a form without cancellation.

use crate::{Real, Vec3};

/// Roughness below which the lobe is a Dirac distribution: `f32` directions can't resolve it.
pub const DIRAC_ROUGHNESS: f64 = 1e-4;

/// Cosine below which a direction counts as below the horizon, so that quotients of cosines stay finite in `f32`.
pub(crate) const HORIZON: f64 = 1e-12;

/// Whether both directions are above the horizon. False for NaN.
#[inline(always)]
pub(crate) fn above_horizon<T: Real>(wo: Vec3<T>, wi: Vec3<T>) -> bool {
    wo.z.lesser(wi.z) > T::from_f64(HORIZON)
}

/// The lobe's width `m = sqrt(1 / (n + 1)) = sqrt(r^2 / (r^2 + 2))` for the roughness `r` in `[0, inf]`.
///
/// It runs from 0 to 1 over all roughnesses, and turns the exponents `n_u`, `n_v` of the paper into the half axes
/// `m_u`, `m_v` of an ellipse (docs/theory.md, section 2).
#[inline]
#[must_use]
pub fn width<T: Real>(roughness: T) -> T {
    // 2 / r^2 is 0 for an infinite r and infinite for 0: both ends come out right without a branch.
    T::ONE / (T::ONE + T::TWO / (roughness * roughness)).sqrt()
}

/// The anisotropic disk distribution of Edwards et al. 2006, Eq. 26 and 32 with R = 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Disk<T> {
    pub(crate) m_u: T,
    pub(crate) m_v: T,
    inv_m_u: T,
    inv_m_v: T,
    /// `1 / (2 pi m_u m_v)`.
    norm: T,
}

/// A disk offset drawn from the distribution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DiskSample<T> {
    pub(crate) wi: Vec3<T>,
    /// B for the pair of directions, exact for the drawn offset where `wi` has been rounded.
    pub(crate) lump: T,
}

impl<T: Real> Disk<T> {
    /// The distribution for both roughnesses, or `None` where they make a Dirac lobe.
    pub(crate) fn new([roughness_u, roughness_v]: [T; 2]) -> Option<Self> {
        let threshold = T::from_f64(DIRAC_ROUGHNESS);
        if roughness_u < threshold && roughness_v < threshold {
            return None;
        }
        let m_u = width(roughness_u.greater(threshold));
        let m_v = width(roughness_v.greater(threshold));
        let norm = T::from_f64(0.5 * core::f64::consts::FRAC_1_PI) / (m_u * m_v);
        Some(Self { m_u, m_v, inv_m_u: T::ONE / m_u, inv_m_v: T::ONE / m_v, norm })
    }

    /// `B = sqrt((n_u+1)(n_v+1)) / (2 pi) * (1-|d|^2)^(n+1)` for two directions above the horizon.
    ///
    /// With `e = (d_x/m_u, d_y/m_v)` the power is `exp(|e|^2 ln(1-|d|^2) / |d|^2)`: a Gaussian with a correction that
    /// tends to 1 for small d, so nothing is undefined at d = 0.
    #[inline(always)]
    pub(crate) fn lump(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        let (dx, dy) = offset(wo, wi);
        let d2 = dx * dx + dy * dy;
        let (ex, ey) = (dx * self.inv_m_u, dy * self.inv_m_v);
        self.norm * ((ex * ex + ey * ey) * log_ratio(d2, complement(wo, wi))).exp_falling()
    }

    /// Draws an offset d from the distribution and reflects `wo` about the half vector `(o_xy + d, z_o)`.
    ///
    /// With the ellipse's point `e = (m_u cos 2 pi u1, m_v sin 2 pi u1)` the exponent along the drawn azimuth is
    /// `n + 1 = 1 / |e|^2`, and `d = e sqrt(|d|^2 / |e|^2)` with `|d|^2 = 1 - (1 - u2)^(1/(n+1))`.
    #[inline(always)]
    pub(crate) fn sample(&self, wo: Vec3<T>, u1: T, u2: T) -> DiskSample<T> {
        let (sin, cos) = u1.sin_cos_turns();
        let (ex, ey) = (self.m_u * cos, self.m_v * sin);
        let m2 = ex * ex + ey * ey;
        let rest = T::ONE - u2;
        let d2 = -(u2.ln_one_minus(rest) * m2).exp_m1_falling();
        let scale = (d2 / m2).sqrt();
        let (dx, dy) = (ex * scale, ey * scale);
        // i = 2 (o.h)/(h.h) h - o, arranged as o plus a small step so that narrow lobes keep their digits.
        let (hx, hy) = (wo.x + dx, wo.y + dy);
        let inv = T::ONE / (hx * hx + hy * hy + wo.z * wo.z);
        let a = wo.x * dx + wo.y * dy;
        let k = T::TWO * (T::ONE + a) * inv;
        let step = -T::TWO * (a + d2) * inv;
        let wi = Vec3::new(
            wo.x + (k * dx + step * wo.x),
            wo.y + (k * dy + step * wo.y),
            wo.z * (T::ONE - d2) * inv,
        );
        DiskSample { wi, lump: self.norm * rest }
    }
}

/// The disk offset `d = (z_o i_xy - z_i o_xy) / (z_o + z_i)` of the half vector from `wo`.
///
/// Written with differences that are exact near the retro direction (Sterbenz), where the lobe lives.
#[inline(always)]
fn offset<T: Real>(wo: Vec3<T>, wi: Vec3<T>) -> (T, T) {
    let inv = T::ONE / (wo.z + wi.z);
    let dz = wi.z - wo.z;
    ((wo.z * (wi.x - wo.x) - dz * wo.x) * inv, (wo.z * (wi.y - wo.y) - dz * wo.y) * inv)
}

/// `1 - |d|^2 = z_o z_i |wo + wi|^2 / (z_o + z_i)^2`, accurate where |d| is near 1.
#[inline(always)]
fn complement<T: Real>(wo: Vec3<T>, wi: Vec3<T>) -> T {
    let (sx, sy, sz) = (wo.x + wi.x, wo.y + wi.y, wo.z + wi.z);
    (wo.z / sz) * (wi.z / sz) * (sx * sx + sy * sy + sz * sz)
}

/// `ln(1 - x) / x` for x in `[0, 1)`, given also `1 - x`; -1 at x = 0.
#[inline(always)]
fn log_ratio<T: Real>(x: T, complement: T) -> T {
    // Below 1e-30 the power is 0 for every exponent that matters, and the logarithm stays finite.
    let tiny = T::from_f64(1e-30);
    let ratio = x.ln_one_minus(complement.greater(tiny)) / x.greater(tiny);
    if x > tiny { ratio } else { -T::ONE }
}
