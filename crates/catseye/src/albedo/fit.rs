//! The albedo as a polynomial whose coefficients depend on the roughness pair.
//!
//! For the larger width m of the lobe, the ratio k <= 1 of the smaller to it, and x, y along and across the wider
//! axis, the loss is fitted by
//!
//! ```text
//! 1 - rho(o) = m (P0(e') + w P1(e') + w^2 P2(e') + w^3 P3(e'))
//! e^2 = x^2 + k^2 y^2 + KAPPA m^2 (1 + k^2)     e' = e - CENTRE     w = (1 - k^2) y^2
//! ```
//!
//! The loss of a narrow lobe is proportional to the length of (m x, m k y), a cone in the direction, rounded at a
//! distance of m; the hyperbola e has that shape, and the polynomials only bend it. In the isotropic case w = 0. The
//! coefficients of P are sums of `T_a(2 m - 1) T_b(2 k - 1)` over a table, T being Chebyshev polynomials.

use super::tables::{CENTRE, COMPACT, COMPACT_KAPPA, FAST, FAST_KAPPA};
use crate::Real;

/// The fit for one roughness pair, with A, B, C and D coefficients in P0 to P3.
#[derive(Clone, Copy, Debug)]
pub struct Fit<T, const A: usize, const B: usize, const C: usize, const D: usize> {
    p0: [T; A],
    p1: [T; B],
    p2: [T; C],
    p3: [T; D],
    /// `e^2 = e_x x^2 + e_y y^2 + e_0` in the lobe's own axes.
    e_x: T,
    e_y: T,
    e_0: T,
    /// `w = w_x x^2 + w_y y^2`: only the narrower axis has a factor.
    w_x: T,
    w_y: T,
    pub(crate) isotropic: bool,
}

/// The fit that eval and sample use: error at most 1e-4 isotropic, 1e-3 anisotropic.
pub type FastFit<T> = Fit<T, 9, 6, 4, 3>;

/// The small fit for shading languages: error at most 2e-3 isotropic, 5e-3 anisotropic.
pub type CompactFit<T> = Fit<T, 5, 3, 1, 0>;

impl<T: Real> FastFit<T> {
    /// The fit for the widths `m_u`, `m_v` of the lobe, each in `[0, 1]` and not both 0. See [`crate::width`].
    #[must_use]
    pub fn new([m_u, m_v]: [T; 2]) -> Self {
        Self::from_table(&FAST, FAST_KAPPA, [m_u, m_v])
    }
}

impl<T: Real> CompactFit<T> {
    /// The fit for the widths `m_u`, `m_v` of the lobe, each in `[0, 1]` and not both 0. See [`crate::width`].
    #[must_use]
    pub fn new([m_u, m_v]: [T; 2]) -> Self {
        Self::from_table(&COMPACT, COMPACT_KAPPA, [m_u, m_v])
    }
}

impl<T: Real, const A: usize, const B: usize, const C: usize, const D: usize> Fit<T, A, B, C, D> {
    /// Contracts the table `[a][b][coefficient]` with the Chebyshev polynomials of the widths.
    fn from_table<const N_M: usize, const N_K: usize, const N: usize>(
        table: &[[[f32; N]; N_K]; N_M],
        kappa: f32,
        [m_u, m_v]: [T; 2],
    ) -> Self {
        let m = m_u.max(m_v);
        let k = m_u.min(m_v) / m;
        let (t_m, t_k) = (chebyshev::<T, N_M>(m), chebyshev::<T, N_K>(k));
        let mut coefficients = [T::ZERO; N];
        for (rows, t_m) in table.iter().zip(t_m) {
            let t_m = t_m * m;
            for (row, t_k) in rows.iter().zip(t_k) {
                let factor = t_m * t_k;
                for (sum, &entry) in coefficients.iter_mut().zip(row) {
                    *sum += factor * T::from_f32(entry);
                }
            }
        }
        let mut coefficients = coefficients.into_iter();
        let mut next = || coefficients.next().unwrap_or(T::ZERO);
        let (k2, rest) = (k * k, T::ONE - k * k);
        let u_wider = m_u > m_v;
        Self {
            p0: [(); A].map(|()| next()),
            p1: [(); B].map(|()| next()),
            p2: [(); C].map(|()| next()),
            p3: [(); D].map(|()| next()),
            e_x: if u_wider { T::ONE } else { k2 },
            e_y: if u_wider { k2 } else { T::ONE },
            e_0: T::from_f32(kappa) * m * m * (T::ONE + k2),
            w_x: if u_wider { T::ZERO } else { rest },
            w_y: if u_wider { rest } else { T::ZERO },
            isotropic: k == T::ONE,
        }
    }

    /// `1 - rho(o)`, in `[0, 1]`, for the tangential part of the unit vector o.
    #[inline(always)]
    #[must_use]
    pub fn loss(&self, x: T, y: T) -> T {
        self.loss_as::<false>(x, y)
    }

    /// [`Fit::loss`]; where the fit is known to be isotropic, at compile time, for less.
    #[inline(always)]
    pub(crate) fn loss_as<const ISOTROPIC: bool>(&self, x: T, y: T) -> T {
        let (x2, y2) = (x * x, y * y);
        let e = (self.e_x * x2 + self.e_y * y2 + self.e_0).sqrt() - T::from_f64(CENTRE);
        let mut loss = horner(&self.p0, e);
        if !ISOTROPIC {
            let w = self.w_x * x2 + self.w_y * y2;
            loss += w * (horner(&self.p1, e) + w * (horner(&self.p2, e) + w * horner(&self.p3, e)));
        }
        loss.max(T::ZERO).min(T::ONE)
    }
}

impl<T: Real> FastFit<T> {
    /// A vector given along the wider and the narrower axis, in the local frame.
    #[inline(always)]
    pub(crate) fn in_frame(&self, [wider, narrower]: [T; 2]) -> [T; 2] {
        if self.e_x < self.e_y { [narrower, wider] } else { [wider, narrower] }
    }

    /// The loss along the ray of azimuth (x, y), a unit vector in the plane.
    #[inline(always)]
    pub(crate) fn ray(&self, [x, y]: [T; 2]) -> Ray<T> {
        let (x2, y2) = (x * x, y * y);
        let b = self.e_x * x2 + self.e_y * y2;
        let (first, last) = (self.e_0.sqrt(), (b + self.e_0).sqrt());
        let inv_sum = T::ONE / (first + last);
        let range = b * inv_sum;
        let start = first - T::from_f64(CENTRE);
        let mut loss = substitute(&self.p0, start, range);
        if !self.isotropic {
            // w = (w_x x^2 + w_y y^2) s^2, a parabola in t.
            let factor = (self.w_x * x2 + self.w_y * y2) * inv_sum;
            let w = [factor * T::TWO * first, factor * range];
            let p2: [T; 5] =
                add_product(&substitute(&self.p2, start, range), w, &substitute(&self.p3, start, range));
            let p1: [T; 7] = add_product(&substitute(&self.p1, start, range), w, &p2);
            loss = add_product(&loss, w, &p1);
        }
        Ray::new(loss, first * inv_sum, range * inv_sum)
    }
}

/// The loss along a ray from the normal to the horizon, a polynomial in `t = (e - e_first) / (e_last - e_first)`.
///
/// With `b s^2 = e^2 - e_first^2` the squared sine is the parabola `s^2 = t (2 first + range t)`, where `first` and
/// `range` are `e_first` and `e_last - e_first` over the sum of both ends: nothing is divided by b, which may be 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray<T> {
    /// The loss times s ds/dt.
    density: [T; 10],
    /// Its integral from 0 to t, over t.
    cumulated: [T; 10],
    first: T,
    range: T,
}

/// Newton steps to invert the radial distribution. The start is within a factor of 2 and each step squares the error.
const NEWTON_STEPS: usize = 3;

impl<T: Real> Ray<T> {
    #[inline(always)]
    fn new(loss: [T; 9], first: T, range: T) -> Self {
        // s ds = (first + range t) dt
        let mut density = [T::ZERO; 10];
        for (j, &c) in loss.iter().enumerate() {
            density[j] += first * c;
            density[j + 1] += range * c;
        }
        let mut cumulated = density;
        for (j, c) in cumulated.iter_mut().enumerate() {
            *c *= T::from_f64(1.0 / (j + 1) as f64);
        }
        Self { density, cumulated, first, range }
    }

    /// The integral of `loss s ds` over the ray.
    #[inline(always)]
    pub(crate) fn energy(&self) -> T {
        horner(&self.cumulated, T::ONE)
    }

    /// The squared sine below which lies the share u of the energy.
    #[inline(always)]
    pub(crate) fn sample_squared_sine(&self, u: T) -> T {
        let target = u * self.energy();
        // Start from s^2 between u, right for a constant loss, and u^(2/3), right for one proportional to s.
        let root = u.sqrt();
        let start = root * root.sqrt();
        let mut t = start / (self.first + (self.first * self.first + self.range * start).sqrt());
        for _ in 0..NEWTON_STEPS {
            let excess = t * horner(&self.cumulated, t) - target;
            t -= excess / horner(&self.density, t).max(T::from_f64(1e-12));
            t = t.max(T::ZERO).min(T::ONE);
        }
        (t * (T::TWO * self.first + self.range * t)).min(T::ONE)
    }
}

/// The coefficients of `p(start + range t)` as a polynomial in t.
#[inline(always)]
fn substitute<T: Real, const N: usize>(p: &[T; N], start: T, range: T) -> [T; N] {
    let mut q = *p;
    for i in 0..N - 1 {
        for j in (i..N - 1).rev() {
            q[j] += start * q[j + 1];
        }
    }
    let mut power = T::ONE;
    for c in &mut q {
        *c *= power;
        power *= range;
    }
    q
}

/// The polynomial `a + (w[0] t + w[1] t^2) b` with R = max(N, M + 2) coefficients.
#[inline(always)]
fn add_product<T: Real, const N: usize, const M: usize, const R: usize>(
    a: &[T; N],
    w: [T; 2],
    b: &[T; M],
) -> [T; R] {
    let mut sum = [T::ZERO; R];
    sum[..N].copy_from_slice(a);
    for (i, &b) in b.iter().enumerate() {
        sum[i + 1] += w[0] * b;
        sum[i + 2] += w[1] * b;
    }
    sum
}

/// Chebyshev polynomials `T_0 ... T_(N-1)` at `2 x - 1`.
fn chebyshev<T: Real, const N: usize>(x: T) -> [T; N] {
    let x = x + x - T::ONE;
    let mut values = [T::ONE; N];
    for i in 1..N {
        values[i] = if i == 1 { x } else { T::TWO * x * values[i - 1] - values[i - 2] };
    }
    values
}

/// The polynomial with the given coefficients, lowest first; its even and odd parts are independent chains.
#[inline(always)]
fn horner<T: Real, const N: usize>(coefficients: &[T; N], x: T) -> T {
    let x2 = x * x;
    let (mut even, mut odd) = (T::ZERO, T::ZERO);
    for (j, &c) in coefficients.iter().enumerate().rev() {
        if j % 2 == 0 {
            even = even * x2 + c;
        } else {
            odd = odd * x2 + c;
        }
    }
    even + x * odd
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest error, as a share of the energy, of the inverted radial distribution.
    #[test]
    fn newton_converges() {
        // The width of `DIRAC_ROUGHNESS` is the narrowest there is.
        const NARROWEST: f64 = 7.07e-5;
        let mut worst = 0.0_f64;
        for m_u in [1e-4, 0.004, 0.03, 0.1, 0.3, 0.6, 0.9, 1.0] {
            for k in [1e-3, 0.05, 0.2, 0.5, 1.0] {
                let fit = FastFit::<f64>::new([m_u, (k * m_u).max(NARROWEST)]);
                for phi in [0.0_f64, 0.4, 0.8, 1.2, 1.5, 1.57] {
                    let ray = fit.ray([phi.cos(), phi.sin()]);
                    for i in 0..1000 {
                        let u = (f64::from(i) + 0.5) / 1000.0;
                        let s2 = ray.sample_squared_sine(u);
                        let t = s2 / (ray.first + (ray.first * ray.first + ray.range * s2).sqrt());
                        worst = worst.max((t * horner(&ray.cumulated, t) / ray.energy() - u).abs());
                    }
                }
            }
        }
        assert!(worst < 1e-6, "{worst:.1e}");
    }
}
