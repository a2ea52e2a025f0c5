//! The halfway-vector disk: Edwards' distribution of scaled half vectors, in a form without cancellation.

use crate::{Real, Vec3};

/// Roughness below which the lobe is a Dirac distribution: `f32` directions can't resolve it.
pub const DIRAC_ROUGHNESS: f64 = 1e-4;

/// Cosine below which a direction counts as below the horizon, so that quotients of cosines stay finite in
/// `f32`.
const HORIZON: f64 = 1e-9;

/// Whether the direction is above the horizon. False for NaN.
#[inline(always)]
pub(crate) fn is_above_horizon<T: Real>(w: Vec3<T>) -> bool {
    w.z > T::from_f64(HORIZON)
}

/// The density of disk samples per steradian, for the lump B of two directions above the horizon.
#[inline(always)]
pub(crate) fn density<T: Real>(lump: T, wo: Vec3<T>, wi: Vec3<T>) -> T {
    lump * (wo.z / (wi.z * (wo.z + wi.z))) // B z_o / (z_i (z_o + z_i))
}

/// Whether both directions are above the horizon. False for NaN.
#[inline(always)]
pub(crate) fn above_horizon<T: Real>(wo: Vec3<T>, wi: Vec3<T>) -> bool {
    wo.z.min(wi.z) > T::from_f64(HORIZON)
}

/// The lobe's width `m = sqrt(1 / (n + 1)) = sqrt(r^2 / (r^2 + 2))` for the roughness `r` in `[0, inf]`.
///
/// It runs from 0 to 1 over all roughnesses, and turns the exponents `n_u`, `n_v` of the paper into the half
/// axes `m_u`, `m_v` of an ellipse (docs/theory.md, section 2).
#[inline]
#[must_use]
pub fn width<T: Real>(roughness: T) -> T {
    // 2 / r^2 is 0 for an infinite r and infinite for 0: both ends come out right without a branch.
    T::ONE / (T::ONE + T::TWO / (roughness * roughness)).sqrt()
}

/// The widths for both roughnesses, or `None` where they make a Dirac lobe; a single one below the threshold
/// is raised.
pub(crate) fn widths<T: Real>(roughness: [T; 2]) -> Option<[T; 2]> {
    let threshold = T::from_f64(DIRAC_ROUGHNESS);
    let dirac = roughness.iter().all(|&r| r < threshold);
    (!dirac).then(|| roughness.map(|r| width(r.max(threshold))))
}

/// The anisotropic disk distribution of Edwards et al. 2006, Eq. 26 and 32 with R = 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Disk<T> {
    pub(crate) m_u: T,
    pub(crate) m_v: T,
    /// `n_u + 1` and `n_v + 1`.
    exponents: [T; 2],
    /// `1 / (2 pi m_u m_v) = sqrt((n_u+1)(n_v+1)) / (2 pi)`, the factor of B.
    norm: T,
}

/// A disk offset drawn from the distribution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DiskSample<T> {
    pub(crate) wi: Vec3<T>,
    /// `z_i / z_o`.
    pub(crate) ratio: T,
    /// [`Disk::lump`] of the pair of directions, exact for the drawn offset where `wi` has been rounded.
    pub(crate) lump: T,
}

impl<T: Real> DiskSample<T> {
    /// The density of disk samples per steradian at the drawn direction: `B z_o / (z_i (z_o + z_i))`.
    #[inline(always)]
    pub(crate) fn density(&self) -> T {
        self.lump / (self.wi.z * (T::ONE + self.ratio)) // z_o + z_i = z_o (1 + z_i / z_o)
    }
}

impl<T: Real> Disk<T> {
    /// The distribution for both roughnesses, or `None` where they make a Dirac lobe.
    pub(crate) fn new(roughness: [T; 2]) -> Option<Self> {
        let [m_u, m_v] = widths(roughness)?;
        let inv = [T::ONE / m_u, T::ONE / m_v];
        let norm = T::from_f64(0.5 * core::f64::consts::FRAC_1_PI) * (inv[0] * inv[1]);
        Some(Self { m_u, m_v, exponents: inv.map(|x| x * x), norm })
    }

    /// The lump `B = sqrt((n_u+1)(n_v+1)) / (2 pi) (1-|d|^2)^(n+1)` for two directions above the horizon: Eq.
    /// 26 and 32, as theory.md section 2 rewrites them.
    ///
    /// The exponent is `n + 1 = ((n_u+1) d_x^2 + (n_v+1) d_y^2) / |d|^2`; in the isotropic case it is a
    /// constant. Everything is scaled by `z_o + z_i`, which spares a division.
    #[inline(always)]
    pub(crate) fn lump<const ISOTROPIC: bool>(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        // (1 - |d|^2) (z_o + z_i)^2 = z_o z_i |wo + wi|^2, accurate where |d| is near 1. Above the horizon it
        // is a normal number.
        let (sx, sy, sz) = (wo.x + wi.x, wo.y + wi.y, wo.z + wi.z);
        let whole = sz * sz;
        let part = (wo.z * wi.z) * (sy.mul_add(sy, sx * sx) + whole);
        // d (z_o + z_i) = z_o i_xy - z_i o_xy, written with differences that are exact near the retro
        // direction (Sterbenz), where the lobe lives.
        let dz = wi.z - wo.z;
        let dx = wo.z * (wi.x - wo.x) - dz * wo.x;
        let dy = wo.z * (wi.y - wo.y) - dz * wo.y;
        let d2 = dy.mul_add(dy, dx * dx);
        let [n_u, n_v] = self.exponents;
        let exponent = if ISOTROPIC {
            n_u
        } else {
            // At d = 0 the quotient is 0 and the power 1, as it should be.
            (n_u * (dx * dx) + n_v * (dy * dy)) / d2.max(T::from_f64(1e-36)) // n + 1
        };
        d2.log2_power(exponent, part, whole).exp2_nonpositive(self.norm) // norm (1 - |d|^2)^(n+1)
    }

    /// Draws an offset d from the distribution and reflects `wo` about the half vector `(o_xy + d, z_o)`.
    ///
    /// With the ellipse's point `e = (m_u cos 2 pi u1, m_v sin 2 pi u1)` the exponent along the drawn azimuth
    /// is `n + 1 = 1 / |e|^2`, and `d = e sqrt(|d|^2 / |e|^2)` with `|d|^2 = 1 - (1 - u2)^(1/(n+1))`.
    #[inline(always)]
    pub(crate) fn sample<const ISOTROPIC: bool>(&self, wo: Vec3<T>, u1: T, u2: T) -> DiskSample<T> {
        // Draw the offset.
        let (sin, cos) = u1.sin_cos_turns();
        let rest = T::ONE - u2;
        let log = u2.ln_one_minus(rest);
        let (dx, dy, d2) = if ISOTROPIC {
            let d2 = -(log * (self.m_u * self.m_u)).exp_m1_nonpositive();
            let d = d2.sqrt();
            (d * cos, d * sin, d2)
        } else {
            let (ex, ey) = (self.m_u * cos, self.m_v * sin);
            let e2 = ex * ex + ey * ey;
            let d2 = -(log * e2).exp_m1_nonpositive();
            let scale = (d2 / e2).sqrt();
            (ex * scale, ey * scale, d2)
        };
        // Reflect: i = 2 (o.h)/(h.h) h - o, arranged as o plus a small step so that narrow lobes keep their
        // digits.
        let (hx, hy) = (wo.x + dx, wo.y + dy);
        let inv = T::ONE / (hx * hx + hy * hy + wo.z * wo.z);
        let a = wo.x * dx + wo.y * dy;
        let k = T::TWO * (T::ONE + a) * inv;
        let step = -T::TWO * (a + d2) * inv;
        let ratio = (T::ONE - d2) * inv;
        let wi = Vec3::new(wo.x + (k * dx + step * wo.x), wo.y + (k * dy + step * wo.y), wo.z * ratio);
        DiskSample { wi, ratio, lump: self.norm * rest }
    }
}
