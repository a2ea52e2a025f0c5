//! The halfway-vector disk: Edwards' distribution of scaled half vectors, in a form without cancellation.

use crate::{Real, Vec3};

/// Roughness below which the lobe is a Dirac distribution: `f32` directions can't resolve it.
pub const DIRAC_ROUGHNESS: f64 = 1e-4;

/// Cosine below which a direction counts as below the horizon, so that quotients of cosines stay finite in `f32`.
const HORIZON: f64 = 1e-9;

/// Whether the direction is above the horizon. False for NaN.
#[inline(always)]
pub(crate) fn is_above_horizon<T: Real>(w: Vec3<T>) -> bool {
    w.z > T::from_f64(HORIZON)
}

/// Whether both directions are above the horizon. False for NaN.
#[inline(always)]
pub(crate) fn above_horizon<T: Real>(wo: Vec3<T>, wi: Vec3<T>) -> bool {
    wo.z.min(wi.z) > T::from_f64(HORIZON)
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

/// The widths for both roughnesses, or `None` where they make a Dirac lobe; a single one below the threshold is raised.
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
    inv_m_u: T,
    inv_m_v: T,
    /// `1 / (2 pi m_u m_v) = sqrt((n_u+1)(n_v+1)) / (2 pi)`, the factor of B.
    pub(crate) norm: T,
}

/// A disk offset drawn from the distribution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DiskSample<T> {
    pub(crate) wi: Vec3<T>,
    /// [`Disk::power`] of the pair of directions, exact for the drawn offset where `wi` has been rounded.
    pub(crate) power: T,
}

impl<T: Real> Disk<T> {
    /// The distribution for both roughnesses, or `None` where they make a Dirac lobe.
    pub(crate) fn new(roughness: [T; 2]) -> Option<Self> {
        let [m_u, m_v] = widths(roughness)?;
        let norm = T::from_f64(0.5 * core::f64::consts::FRAC_1_PI) / (m_u * m_v);
        Some(Self { m_u, m_v, inv_m_u: T::ONE / m_u, inv_m_v: T::ONE / m_v, norm })
    }

    /// The power `(1-|d|^2)^(n+1)` for two directions above the horizon: B is it times [`Disk::norm`].
    ///
    /// With `e = (d_x/m_u, d_y/m_v)` the power is `exp(|e|^2 / |d|^2 ln(1-|d|^2))`: a Gaussian with a correction that
    /// tends to 1 for small d. In the isotropic case the first quotient is the constant `n + 1`. Everything is scaled
    /// by `z_o + z_i`, which spares a division.
    #[inline(always)]
    pub(crate) fn power<const ISOTROPIC: bool>(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        // d (z_o + z_i) = z_o i_xy - z_i o_xy, written with differences that are exact near the retro direction
        // (Sterbenz), where the lobe lives.
        let dz = wi.z - wo.z;
        let dx = wo.z * (wi.x - wo.x) - dz * wo.x;
        let dy = wo.z * (wi.y - wo.y) - dz * wo.y;
        let d2 = dx * dx + dy * dy;
        // (1 - |d|^2) (z_o + z_i)^2 = z_o z_i |wo + wi|^2, accurate where |d| is near 1.
        let (sx, sy, sz) = (wo.x + wi.x, wo.y + wi.y, wo.z + wi.z);
        let whole = sz * sz;
        let part = (wo.z * wi.z) * (sx * sx + sy * sy + whole);
        // At d = 0 the quotient is 0 and the power 1, as it should be. Where part is tiny, the power is 0.
        let tiny = T::from_f64(1e-36);
        let exponent = if ISOTROPIC {
            self.inv_m_u * self.inv_m_u
        } else {
            let (ex, ey) = (dx * self.inv_m_u, dy * self.inv_m_v);
            (ex * ex + ey * ey) / d2.max(tiny)
        };
        d2.log2_power(exponent, part.max(tiny), whole).exp2_nonpositive()
    }

    /// The density `pdf_ss = B z_o / (z_i (z_o+z_i))` of the drawn direction, given the power for the pair.
    #[inline(always)]
    pub(crate) fn density(&self, power: T, wo: Vec3<T>, wi: Vec3<T>) -> T {
        power * (self.norm * wo.z / (wi.z * (wo.z + wi.z)))
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
        let d2 = -(u2.ln_one_minus(rest) * m2).exp_m1_nonpositive();
        let scale = (d2 * (T::ONE / m2)).sqrt();
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
        DiskSample { wi, power: rest }
    }
}
