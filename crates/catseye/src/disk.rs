//! The halfway-vector disk: Edwards' distribution of scaled half vectors, in a form without cancellation.

use crate::{Real, Vec3};

/// Roughness below which the lobe is a Dirac distribution: `f32` directions can't resolve it.
pub const DIRAC_ROUGHNESS: f64 = 1e-4;

/// The lobe's width `m = sqrt(1 / (n + 1)) = sqrt(r^2 / (r^2 + 2))` for the roughness `r` in `[0, inf]`.
///
/// It runs from 0 to 1 over all roughnesses, and turns the sums over the exponents `n_u + 1`, `n_v + 1` of the paper
/// into the points of an ellipse with the half axes `m_u`, `m_v` (docs/theory.md, section 2).
#[inline]
#[must_use]
pub fn width<T: Real>(roughness: T) -> T {
    // 2 / r^2 is 0 for an infinite r and infinite for 0: both ends come out right without a branch.
    T::ONE / (T::ONE + T::from_f64(2.0) / (roughness * roughness)).sqrt()
}

/// The anisotropic disk distribution of Edwards et al. 2006, Eq. 26 and 32 with R = 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Disk<T> {
    pub(crate) m_u: T,
    pub(crate) m_v: T,
    inv_m_u: T,
    inv_m_v: T,
    /// `1 / (2 pi m_u m_v)`, the factor of B in docs/theory.md.
    norm: T,
}

impl<T: Real> Disk<T> {
    /// The distribution for both roughnesses, or `None` where they make a Dirac lobe.
    pub(crate) fn new([roughness_u, roughness_v]: [T; 2]) -> Option<Self> {
        let threshold = T::from_f64(DIRAC_ROUGHNESS);
        if roughness_u < threshold && roughness_v < threshold {
            return None;
        }
        let m_u = width(roughness_u.max(threshold));
        let m_v = width(roughness_v.max(threshold));
        let norm = T::from_f64(0.5 / core::f64::consts::PI) / (m_u * m_v);
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
        self.norm * ((ex * ex + ey * ey) * log_ratio(d2, complement(wo, wi))).exp()
    }
}

/// The disk offset `d = (z_o i_xy - z_i o_xy) / (z_o + z_i)` of the half vector from `wo`.
///
/// Written with differences that are exact near the retro direction (Sterbenz), where the lobe lives.
#[inline(always)]
pub(crate) fn offset<T: Real>(wo: Vec3<T>, wi: Vec3<T>) -> (T, T) {
    let inv = T::ONE / (wo.z + wi.z);
    let dz = wi.z - wo.z;
    ((wo.z * (wi.x - wo.x) - dz * wo.x) * inv, (wo.z * (wi.y - wo.y) - dz * wo.y) * inv)
}

/// `1 - |d|^2 = z_o z_i |wo + wi|^2 / (z_o + z_i)^2`, accurate where |d| is near 1.
#[inline(always)]
fn complement<T: Real>(wo: Vec3<T>, wi: Vec3<T>) -> T {
    let (sx, sy, sz) = (wo.x + wi.x, wo.y + wi.y, wo.z + wi.z);
    wo.z * wi.z * (sx * sx + sy * sy + sz * sz) / (sz * sz)
}

/// `ln(1 - x) / x` for x in `[0, 1)`, given also `y = 1 - x`; -1 at x = 0.
#[inline(always)]
fn log_ratio<T: Real>(x: T, y: T) -> T {
    if x == T::ZERO {
        -T::ONE
    } else if x < T::from_f64(0.25) {
        (-x).ln_1p() / x
    } else {
        y.max(T::from_f64(1e-30)).ln() / x
    }
}
