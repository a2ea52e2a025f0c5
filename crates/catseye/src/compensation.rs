//! The diffuse-like lobe that returns what single scattering loses.

use core::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI};

use crate::albedo::FastFit;
use crate::{Real, Vec3};

/// Nodes of the table of the azimuthal density over a quarter turn.
const NODES: usize = 17;

/// Multiplies u1 so that the digits left behind the point are as good as fresh ones. Not a whole number, so that
/// regular grids of u1 do not fold onto few values.
const FRESH_DIGITS: f64 = 1021.618;

/// The lobe q(i) = (1-rho(i)) / (pi (1-rho_avg)), whose product with cosine integrates to 1.
///
/// On the unit disk of (`i_x`, `i_y`), where the cosine is the area element, its density is proportional to the loss.
/// Along a ray of constant azimuth the loss is a polynomial in e, and s ds is proportional to e de: the radial
/// distribution is a polynomial too, inverted by Newton's method. The azimuthal one is tabulated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Compensation<T> {
    fit: FastFit<T>,
    /// `1 / (pi (1 - rho_avg))`.
    norm: T,
    /// Cumulated azimuthal density at the nodes, 0 first and 1 last.
    cumulated: [T; NODES],
    /// Azimuthal density at the nodes, in units of the table's parameter in `[0, 1]`.
    density: [T; NODES],
}

impl<T: Real> Compensation<T> {
    /// Prepares the lobe for the widths of the disk distribution.
    pub(crate) fn new(widths: [T; 2]) -> Self {
        let fit = FastFit::fast(widths);
        let mut lobe = Self { fit, norm: T::ZERO, cumulated: [T::ZERO; NODES], density: [T::ZERO; NODES] };
        let quarter = if fit.isotropic {
            lobe.fit.ray([T::ONE, T::ZERO]).energy() * T::from_f64(FRAC_PI_2)
        } else {
            lobe.tabulate()
        };
        lobe.norm = T::from_f64(0.25) / quarter;
        lobe
    }

    /// Fills the azimuthal table and returns the integral of the loss over a quarter of the disk.
    fn tabulate(&mut self) -> T {
        let step = T::from_f64(1.0 / (NODES - 1) as f64);
        let mut integral = T::ZERO;
        for i in 0..NODES {
            let (phi, slope) = azimuth(step * T::from_f64(i as f64));
            let (sin, cos) = phi.sin_cos();
            self.density[i] = self.fit.ray(self.fit.from_axes([cos, sin])).energy() * slope;
            // Simpson's rule for the norm, the trapezoid rule for what is sampled: the table is linear between nodes.
            let simpson = if i == 0 || i == NODES - 1 { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
            integral += self.density[i] * step * T::from_f64(simpson / 3.0);
            if i > 0 {
                let area = (self.density[i - 1] + self.density[i]) * step * T::from_f64(0.5);
                self.cumulated[i] = self.cumulated[i - 1] + area;
            }
        }
        let inv_total = T::ONE / self.cumulated[NODES - 1];
        self.cumulated = self.cumulated.map(|x| x * inv_total);
        self.density = self.density.map(|x| x * inv_total);
        integral
    }

    /// The share `1 - rho` that single scattering loses along w.
    #[inline(always)]
    pub(crate) fn loss(&self, w: Vec3<T>) -> T {
        self.fit.loss(w.x, w.y)
    }

    /// The lobe q in 1/sr.
    #[inline(always)]
    pub(crate) fn lobe(&self, w: Vec3<T>) -> T {
        self.loss(w) * self.norm
    }

    /// Draws a direction with the density `q cos`, from a fresh uniform number and the digits of u1 that the first use
    /// has not seen.
    #[inline(always)]
    pub(crate) fn sample(&self, fresh: T, u1: T) -> Vec3<T> {
        let turn = (u1 * T::from_f64(FRESH_DIGITS)).fract();
        let (x, y) = if self.fit.isotropic {
            let (sin, cos) = turn.sin_cos_turns();
            (cos, sin)
        } else {
            self.sample_azimuth(turn)
        };
        let s2 = self.fit.ray([x, y]).sample_squared_sine(fresh);
        let s = s2.sqrt();
        Vec3::new(s * x, s * y, (T::ONE - s2).sqrt())
    }

    /// Draws a unit vector in the plane from the azimuthal table.
    #[inline(always)]
    fn sample_azimuth(&self, turn: T) -> (T, T) {
        let four = turn * T::from_f64(4.0);
        let u = four.fract();
        let quadrant = four - u;
        let mut i = 0;
        for &cumulated in &self.cumulated[1..NODES - 1] {
            i += usize::from(cumulated <= u);
        }
        let (low, high) = (self.density[i], self.density[i + 1]);
        let area = (u - self.cumulated[i]) * T::from_f64((NODES - 1) as f64);
        let root = (low * low + T::TWO * (high - low) * area).greater(T::ZERO).sqrt();
        let inside = (T::TWO * area / (low + root).greater(T::from_f64(1e-30))).lesser(T::ONE);
        let node = (T::from_f64(i as f64) + inside) * T::from_f64(1.0 / (NODES - 1) as f64);
        let (sin, cos) = (azimuth(node).0 * T::from_f64(0.5 * FRAC_1_PI)).sin_cos_turns();
        let [x, y] = self.fit.from_axes([cos, sin]);
        // Quadrants 0 to 3: (+, +), (-, +), (-, -), (+, -).
        let x_negative = quadrant == T::ONE || quadrant == T::TWO;
        (if x_negative { -x } else { x }, if quadrant > T::from_f64(1.5) { -y } else { y })
    }
}

/// Azimuth from the wider axis at the parameter in `[0, 1]` of the table, and its derivative. The nodes crowd towards
/// the narrower axis, where the loss has a bend.
#[inline(always)]
fn azimuth<T: Real>(parameter: T) -> (T, T) {
    let rest = T::ONE - parameter;
    (T::from_f64(FRAC_PI_2) * (T::ONE - rest * rest), T::from_f64(PI) * rest)
}
