//! The albedo by quadrature in double precision: the oracle that everything else is measured against.
//!
//! `1 - rho` rather than `rho` is computed, since narrow lobes lose little. docs/theory.md, section 4.

use core::f64::consts::{FRAC_PI_2, PI};

use super::gauss::Gauss;
use crate::disk::{above_horizon, is_above_horizon, widths};
use crate::{Real, Vec3};

/// Nodes of the rule along the radius of the disk.
const ALONG: usize = 48;

/// The quadrature rules, prepared once for many evaluations.
#[derive(Clone, Debug)]
pub struct Quadrature {
    along: Gauss<ALONG>,
    /// `3 ln(1 - v^2)` at the nodes v along the radius, half of what an evaluation costs.
    logs: [f64; ALONG],
    around: Gauss<32>,
}

impl Default for Quadrature {
    fn default() -> Self {
        Self::new()
    }
}

impl Quadrature {
    /// Computes the nodes.
    #[must_use]
    pub fn new() -> Self {
        let along = Gauss::new();
        let logs = along.nodes.map(|v: f64| 3.0 * (v * v).ln_one_minus(1.0 - v * v));
        Self { along, logs, around: Gauss::new() }
    }

    /// Calls `body` with rules that are prepared once for the whole process, or each time without `std`.
    fn shared<R>(body: impl FnOnce(&Self) -> R) -> R {
        #[cfg(feature = "std")]
        {
            static SHARED: std::sync::LazyLock<Quadrature> = std::sync::LazyLock::new(Quadrature::new);
            body(&SHARED)
        }
        #[cfg(not(feature = "std"))]
        body(&Self::new())
    }

    /// `1 - g(c, n)`: the share that single scattering loses when the disk offset d has the fixed azimuth
    /// whose projection on the direction is `c = o_xy . d / |d|`, in `[-1, 1]`, where the lobe's width is `m
    /// = sqrt(1/(n+1))`, in `(0, 1]`.
    ///
    /// Integrates over `q = (1-t)^(n+1)` with `t = |d|^2`; where c < 0 nothing is lost for `t < c^2`.
    #[must_use]
    pub fn loss_along(&self, c: f64, m: f64) -> f64 {
        let m2 = m * m;
        let c2 = (c * c).min(1.0);
        let top_ln = if c < 0.0 { c2.ln_one_minus(1.0 - c2) / m2 } else { 0.0 };
        if top_ln < -79.0 {
            return 0.0;
        }
        let top = 1.0 + top_ln.exp_m1_nonpositive();
        // q = top (1-v^2)^3 resolves the square root of t at one end and the power of q at the other.
        let mut logs = self.logs.iter();
        self.along.integrate(0.0, 1.0, |v| {
            let rest = 1.0 - v * v;
            let log = logs.next().copied().unwrap_or_default();
            let t = -((top_ln + log) * m2).exp_m1_nonpositive();
            let ratio = (1.0 - t) / (1.0 + t + 2.0 * c * Real::sqrt(t));
            let kept = ratio.min(1.0);
            6.0 * top * v * rest * rest * (1.0 - kept * kept * kept)
        })
    }

    /// `1 - rho(o)` for the widths `[m_u, m_v]` of the lobe and the tangential part `[o_x, o_y]` of the
    /// direction.
    ///
    /// With `e = (m_u cos psi, m_v sin psi)`, rho is the mean over psi of `g(o_xy . e / |e|, 1/|e|^2 - 1)`.
    /// The integrand has kinks where `o_xy . e = 0`, and it is steep where e lies along `o_xy`, for
    /// directions near the horizon, and at the ends of a narrow ellipse: the range is split at all of them.
    #[must_use]
    pub fn loss(&self, [m_u, m_v]: [f64; 2], [x, y]: [f64; 2]) -> f64 {
        // psi in [0, pi] where e lies along o_xy, and where it is perpendicular to it.
        let first_half = |angle: f64, same_signs: bool| if same_signs { angle } else { PI - angle };
        let parallel = first_half(atan2(m_u * y.abs(), m_v * x.abs()), x * y >= 0.0);
        let crossing = first_half(atan2(m_u * x.abs(), m_v * y.abs()), x * y <= 0.0);
        let mut breaks = [0.0, crossing, parallel, FRAC_PI_2, PI];
        breaks.sort_unstable_by(f64::total_cmp);
        let mut sum = 0.0;
        for pair in breaks.windows(2) {
            let (start, range) = (pair[0], pair[1] - pair[0]);
            if range <= 0.0 {
                continue;
            }
            sum += self.around.integrate(0.0, 1.0, |v| {
                // Nodes crowd at both ends.
                let psi = start + range * v * v * (3.0 - 2.0 * v);
                let (sin, cos) = Real::sin_cos(psi);
                let (ex, ey) = (m_u * cos, m_v * sin);
                let m = Real::sqrt(ex * ex + ey * ey);
                let c = (ex * x + ey * y) / m;
                3.0 * range * v * (1.0 - v) * (self.loss_along(c, m) + self.loss_along(-c, m))
            });
        }
        sum / PI
    }

    /// `1 - G(n)`: the cosine-weighted hemispherical mean of `1 - g` for the width m.
    #[must_use]
    fn average_loss_along(&self, m: f64) -> f64 {
        // The tangential part of a cosine-distributed direction is uniform on the disk: c = sin b has density
        // 2/pi cos^2 b. Split at 0, where `loss_along` has its kink, and crowd the nodes there.
        self.around.integrate(0.0, 1.0, |v| {
            let (sin, cos) = Real::sin_cos(FRAC_PI_2 * v * v);
            2.0 * v * cos * cos * (self.loss_along(sin, m) + self.loss_along(-sin, m))
        })
    }

    /// `1 - rho_avg` for the widths of the lobe.
    #[must_use]
    pub fn average_loss(&self, [m_u, m_v]: [f64; 2]) -> f64 {
        self.around.integrate(0.0, 1.0, |v| {
            let (sin, cos) = Real::sin_cos(FRAC_PI_2 * v * v * (3.0 - 2.0 * v));
            let m = Real::sqrt(m_u * m_u * cos * cos + m_v * m_v * sin * sin);
            6.0 * v * (1.0 - v) * self.average_loss_along(m)
        })
    }
}

fn atan2(y: f64, x: f64) -> f64 {
    #[cfg(feature = "std")]
    return y.atan2(x);
    #[cfg(not(feature = "std"))]
    return libm::atan2(y, x);
}

/// Directional albedo rho(o) of single scattering for the roughness pair, each in `[0, inf]`; error below
/// 1e-9.
///
/// 0 below the horizon, 1 where both roughnesses make a Dirac lobe.
#[must_use]
pub fn directional(roughness: [f64; 2], wo: Vec3<f64>) -> f64 {
    if !is_above_horizon(wo) {
        return 0.0;
    }
    widths(roughness).map_or(1.0, |m| 1.0 - Quadrature::shared(|rule| rule.loss(m, [wo.x, wo.y])))
}

/// Cosine-weighted hemispherical mean `rho_avg` of the directional albedo; error below 1e-9.
#[must_use]
pub fn average(roughness: [f64; 2]) -> f64 {
    widths(roughness).map_or(1.0, |m| 1.0 - Quadrature::shared(|rule| rule.average_loss(m)))
}

/// The compensation `f_ms(o,i) = (1-rho(o)) (1-rho(i)) / (pi (1-rho_avg))` in 1/sr, for a multiscatter tint
/// of 1.
///
/// 0 below the horizon and for a Dirac lobe.
#[must_use]
pub fn compensation(roughness: [f64; 2], wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
    let Some(m) = widths(roughness) else { return 0.0 };
    if !above_horizon(wo, wi) {
        return 0.0;
    }
    Quadrature::shared(|rule| {
        rule.loss(m, [wo.x, wo.y]) * rule.loss(m, [wi.x, wi.y]) / (PI * rule.average_loss(m))
    })
}
