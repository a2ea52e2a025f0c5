//! The directional albedo by quadrature in double precision: the oracle.

use super::gauss::Gauss;
use crate::Real as _;

/// `1 - g(c, n)` with `m^2 = 1/(n+1)`.
pub fn loss(c: f64, m: f64) -> f64 {
    let rule = Gauss::<48>::new();
    loss_with(&rule, c, m)
}

fn loss_with(rule: &Gauss<48>, c: f64, m: f64) -> f64 {
    let m2 = m * m;
    // q = (1-t)^(n+1); the integrand is zero for t < c^2 where c < 0.
    let top = if c < 0.0 { ((-c * c).ln_1p() / m2).exp() } else { 1.0 };
    // q = v^2-type substitution resolves the square root of t at q = top.
    rule.integrate(0.0, 1.0, |v| {
        let q = top * (1.0 - v * v);
        let t = -(q.ln() * m2).exp_m1();
        let w = (1.0 - t) / (1.0 + t + 2.0 * c * t.sqrt());
        2.0 * v * top * (1.0 - w.min(1.0).powi(3))
    })
}

/// Directional albedo for the lobe widths `m_u`, `m_v` and the tangential part of the direction.
pub fn directional(m_u: f64, m_v: f64, [x, y]: [f64; 2]) -> f64 {
    let rule = Gauss::<48>::new();
    let outer = Gauss::<32>::new();
    let mut sum = 0.0;
    for k in 0..8 {
        let a = core::f64::consts::FRAC_PI_4 * f64::from(k);
        sum += outer.integrate(a, a + core::f64::consts::FRAC_PI_4, |psi| {
            let (s, co) = psi.sin_cos();
            let (ex, ey) = (m_u * co, m_v * s);
            let m = (ex * ex + ey * ey).sqrt();
            loss_with(&rule, (ex * x + ey * y) / m, m)
        });
    }
    1.0 - sum / core::f64::consts::TAU
}
