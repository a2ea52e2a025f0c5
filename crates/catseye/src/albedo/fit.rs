//! The albedo as a polynomial whose coefficients depend on the roughness pair.
//!
//! For the larger width m of the lobe, the ratio k <= 1 of the smaller to it, and x, y along and across the
//! wider axis, the loss is fitted by
//!
//! ```text
//! 1 - rho(o) = m (P0(e') + w P1(e') + w^2 P2(e') + w^3 P3(e'))
//! e^2 = x^2 + k^2 y^2 + KAPPA m^2 (1 + k^2)     e' = e - CENTRE     w = (1 - k^2) y^2
//! ```
//!
//! The loss of a narrow lobe is proportional to the length of (m x, m k y), a cone in the direction, rounded
//! at a distance of m; the hyperbola e has that shape, and the polynomials only bend it. In the isotropic
//! case w = 0. The coefficients of P are sums of `T_a(2 m - 1) T_b(2 k - 1)` over a table, T being Chebyshev
//! polynomials.

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
    /// The fit for the widths `m_u`, `m_v` of the lobe, each in `[0, 1]` and not both 0. See
    /// [`crate::width`].
    #[must_use]
    pub fn new([m_u, m_v]: [T; 2]) -> Self {
        Self::from_table(&FAST, FAST_KAPPA, [m_u, m_v])
    }
}

impl<T: Real> CompactFit<T> {
    /// The fit for the widths `m_u`, `m_v` of the lobe, each in `[0, 1]` and not both 0. See
    /// [`crate::width`].
    #[must_use]
    pub fn new([m_u, m_v]: [T; 2]) -> Self {
        Self::from_table(&COMPACT, COMPACT_KAPPA, [m_u, m_v])
    }
}

impl<T: Real, const A: usize, const B: usize, const C: usize, const D: usize> Fit<T, A, B, C, D> {
    fn from_table<const N_M: usize, const N_K: usize, const N: usize>(
        table: &[[[f32; N]; N_K]; N_M],
        kappa: f32,
        [m_u, m_v]: [T; 2],
    ) -> Self {
        let m = m_u.max(m_v);
        let k = m_u.min(m_v) / m;
        let coefficients =
            if k == T::ONE { contract_isotropic::<_, A, _, _, _>(table, m) } else { contract(table, m, k) };
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
        let w = if ISOTROPIC { T::ZERO } else { self.w_x * x2 + self.w_y * y2 };
        self.polynomial::<ISOTROPIC>(e, w).max(T::ZERO).min(T::ONE)
    }

    /// `P0(e') + w P1(e') + w^2 P2(e') + w^3 P3(e')`
    #[inline(always)]
    fn polynomial<const ISOTROPIC: bool>(&self, e: T, w: T) -> T {
        if ISOTROPIC {
            return horner(&self.p0, e);
        }
        let [p0, p1] = [horner(&self.p0, e), horner(&self.p1, e)];
        let [p2, p3] = [horner(&self.p2, e), horner(&self.p3, e)];
        w.mul_add(w.mul_add(w.mul_add(p3, p2), p1), p0)
    }
}

impl<T: Real> FastFit<T> {
    /// A vector given along the wider and the narrower axis, in the local frame.
    #[inline(always)]
    pub(crate) fn in_frame(&self, [wider, narrower]: [T; 2]) -> [T; 2] {
        if self.e_x < self.e_y { [narrower, wider] } else { [wider, narrower] }
    }

    /// The integral of `loss s ds` along the ray of azimuth (x, y), a unit vector in the plane, s being the
    /// sine.
    ///
    /// In t, see [`Ray`], the integrand is a polynomial of degree 9: five Gauss points are exact.
    #[inline(always)]
    pub(crate) fn energy(&self, [x, y]: [T; 2]) -> T {
        const NODES: [f64; 5] = [
            -0.906_179_845_938_664,
            -0.538_469_310_105_683_1,
            0.0,
            0.538_469_310_105_683_1,
            0.906_179_845_938_664,
        ];
        const WEIGHTS: [f64; 5] = [
            0.236_926_885_056_189_08,
            0.478_628_670_499_366_5,
            0.568_888_888_888_888_9,
            0.478_628_670_499_366_5,
            0.236_926_885_056_189_08,
        ];
        let (x2, y2) = (x * x, y * y);
        let b = self.e_x * x2 + self.e_y * y2;
        let (first, last) = (self.e_0.sqrt(), (b + self.e_0).sqrt());
        let inv_sum = T::ONE / (first + last);
        let [start, range] = [first * inv_sum, b * inv_sum * inv_sum];
        let factor = self.w_x * x2 + self.w_y * y2;
        let mut sum = T::ZERO;
        for (node, weight) in NODES.into_iter().zip(WEIGHTS) {
            let t = T::from_f64(0.5 + 0.5 * node);
            let e = first + b * inv_sum * t - T::from_f64(CENTRE);
            let w = factor * (t * (T::TWO * start + range * t));
            sum += T::from_f64(0.5 * weight) * ((start + range * t) * self.polynomial::<false>(e, w));
        }
        sum
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

/// The loss along a ray from the normal to the horizon, a polynomial in `t = (e - e_first) / (e_last -
/// e_first)`.
///
/// With `b s^2 = e^2 - e_first^2` the squared sine is the parabola `s^2 = t (2 first + range t)`, where
/// `first` and `range` are `e_first` and `e_last - e_first` over the sum of both ends: nothing is divided by
/// b, which may be 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray<T> {
    /// The loss times s ds/dt.
    density: [T; 10],
    /// Its integral from 0 to t, over t.
    cumulated: [T; 10],
    first: T,
    range: T,
    /// The integral over the whole ray.
    pub(crate) energy: T,
    /// The share of `u^(3/4)` in the first guess of `s^2`, beside u.
    bend: T,
}

/// What keeps a quotient finite that is 0 / 0.
const TINY: f64 = 1e-12;

impl<T: Real> Ray<T> {
    #[inline(always)]
    fn new(loss: [T; 9], first: T, range: T) -> Self {
        // s ds = (first + range t) dt
        let mut density = [first * loss[0]; 10];
        for j in 1..9 {
            density[j] = first.mul_add(loss[j], range * loss[j - 1]);
        }
        density[9] = range * loss[8];
        let mut cumulated = density;
        for (j, c) in cumulated.iter_mut().enumerate() {
            *c *= T::from_f64(1.0 / (j + 1) as f64);
        }
        let energy = horner(&cumulated, T::ONE);
        // At the horizon d(s^2)/du is 2 energy / loss, between 2/3 where the loss is proportional to s and 1
        // where it is constant; that of the guess is 1 - bend / 4.
        let slope = T::TWO * energy * (first + range) / horner(&density, T::ONE).max(T::from_f64(TINY));
        let bend = (T::from_f64(4.0) * (T::ONE - slope)).max(T::ZERO).min(T::from_f64(1.4));
        Self { density, cumulated, first, range, energy, bend }
    }

    /// The squared sine below which lies the share u of the energy: a step of Newton's method and one of
    /// higher order, to 4e-7 of the energy.
    #[inline(always)]
    pub(crate) fn sample_squared_sine(&self, u: T) -> T {
        let root = u.sqrt();
        let s2 = root * (root + self.bend * (root.sqrt() - root));
        let t0 = s2 / (self.first + (self.first * self.first + self.range * s2).sqrt());
        let (newton, density_0) = self.step(t0, u);
        let t1 = (t0 - newton).max(T::ZERO).min(T::ONE);
        let (newton, density_1) = self.step(t1, u);
        // The second derivative comes from the change of the density over the first step.
        let change = (density_1 - density_0) * newton;
        let over = T::TWO * density_1 * (t1 - t0);
        let curved = if over == T::ZERO { T::ZERO } else { newton * (change / over) };
        let t = (t1 - newton - curved).max(T::ZERO).min(T::ONE);
        (t * (T::TWO * self.first + self.range * t)).min(T::ONE)
    }

    /// Newton's step from t towards the share u of the energy, to be subtracted, and the density at t.
    #[inline(always)]
    fn step(&self, t: T, u: T) -> (T, T) {
        let density = horner(&self.density, t).max(T::from_f64(TINY));
        ((t * horner(&self.cumulated, t) - u * self.energy) / density, density)
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

/// The coefficients of the fit: the table `[a][b][coefficient]` times m and the Chebyshev polynomials of the
/// width m and of the ratio k.
fn contract<T: Real, const N_M: usize, const N_K: usize, const N: usize>(
    table: &[[[f32; N]; N_K]; N_M],
    m: T,
    k: T,
) -> [T; N] {
    let (t_m, t_k) = (chebyshev::<T, N_M>(m), chebyshev::<T, N_K>(k));
    let mut coefficients = [T::ZERO; N];
    for (rows, t_m) in table.iter().zip(t_m) {
        for (row, t_k) in rows.iter().zip(t_k) {
            let factor = m * t_m * t_k;
            for (sum, &entry) in coefficients.iter_mut().zip(row) {
                *sum += factor * T::from_f32(entry);
            }
        }
    }
    coefficients
}

/// The same for a ratio of 1, where all Chebyshev polynomials are 1, as far as w = 0 leaves the coefficients
/// a meaning: the `N_0` of P0.
fn contract_isotropic<T: Real, const N_0: usize, const N_M: usize, const N_K: usize, const N: usize>(
    table: &[[[f32; N]; N_K]; N_M],
    m: T,
) -> [T; N] {
    let mut coefficients = [T::ZERO; N];
    for (rows, t_m) in table.iter().zip(chebyshev::<T, N_M>(m)) {
        let mut sums = [T::ZERO; N_0];
        for row in rows {
            for (sum, &entry) in sums.iter_mut().zip(row) {
                *sum += T::from_f32(entry);
            }
        }
        for (coefficient, sum) in coefficients.iter_mut().zip(sums) {
            *coefficient += m * t_m * sum;
        }
    }
    coefficients
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
    if N < 2 {
        return coefficients.first().copied().unwrap_or(T::ZERO);
    }
    let x2 = x * x;
    // The last two coefficients begin the chains of their parities.
    let [mut next, mut last] = [coefficients[N - 2], coefficients[N - 1]];
    for &c in coefficients[..N - 2].iter().rev() {
        [next, last] = [last.mul_add(x2, c), next];
    }
    last.mul_add(x, next)
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
                        worst = worst.max((t * horner(&ray.cumulated, t) / ray.energy - u).abs());
                    }
                }
            }
        }
        assert!(worst < 1e-6, "{worst:.1e}");
    }
}
