//! The diffuse-like lobe that returns what single scattering loses.

use core::f64::consts::{FRAC_PI_2, PI};

use crate::albedo::{FastFit, Ray};
use crate::{Real, Vec3};

/// Nodes of the table of the azimuthal density over a quarter turn.
const NODES: usize = 17;

/// Multiplies u1 so that the digits left behind the point are as good as fresh ones. Not a whole number, so
/// that regular grids of u1 do not fold onto few values.
const FRESH_DIGITS: f64 = 1021.618;

/// The lobe q(i) = (1-rho(i)) / (pi (1-rho_avg)), whose product with cosine integrates to 1.
///
/// On the unit disk of (`i_x`, `i_y`), where the cosine is the area element, its density is proportional to
/// the loss. Along a ray of constant azimuth the loss is a polynomial in e, and s ds is proportional to e de:
/// the radial distribution is a polynomial too, inverted by Newton's method. The azimuthal one is tabulated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Compensation<T> {
    fit: FastFit<T>,
    /// `1 / (pi (1 - rho_avg))`.
    pub(crate) norm: T,
    /// The radial distribution along `tangent_u`; the only one in the isotropic case.
    first_ray: Ray<T>,
    /// Cumulated azimuthal density at the nodes, 0 first and 1 last.
    cumulated: [T; NODES],
    /// Azimuthal density at the nodes, in units of the table's parameter in `[0, 1]`.
    density: [T; NODES],
}

impl<T: Real> Compensation<T> {
    /// Prepares the lobe for the widths of the disk distribution. Where nothing is compensated only its
    /// losses are asked for: its norm is 0, and the table of its samples empty, which takes most of the time.
    pub(crate) fn new(widths: [T; 2], is_used: bool) -> Self {
        let fit = FastFit::new(widths);
        let table = [T::ZERO; NODES];
        let first_ray = fit.ray([T::ONE, T::ZERO]);
        let lobe = Self { fit, norm: T::ZERO, first_ray, cumulated: table, density: table };
        if is_used { lobe.normalized() } else { lobe }
    }

    /// The lobe with its norm and its table.
    fn normalized(mut self) -> Self {
        let quarter =
            if self.fit.isotropic { self.first_ray.energy * T::from_f64(FRAC_PI_2) } else { self.tabulate() };
        self.norm = T::from_f64(0.25) / quarter;
        self
    }

    /// Fills the azimuthal table and returns the integral of the loss over a quarter of the disk.
    fn tabulate(&mut self) -> T {
        let step = T::from_f64(1.0 / (NODES - 1) as f64);
        // The nodes don't need each other: the compiler does several at once.
        for (i, density) in self.density.iter_mut().enumerate() {
            let (turn, slope) = azimuth(step * T::from_f64(i as f64));
            let (sin, cos) = turn.sin_cos_turns();
            *density = self.fit.energy(self.fit.in_frame([cos, sin])) * slope;
        }
        let mut integral = T::ZERO;
        for i in 0..NODES {
            // Simpson's rule for the norm, the trapezoid rule for what is sampled: the table is linear
            // between nodes.
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

    #[inline(always)]
    pub(crate) fn is_isotropic(&self) -> bool {
        self.fit.isotropic
    }

    /// `1 - rho_avg`.
    pub(crate) fn average_loss(&self) -> T {
        let norm = if self.norm > T::ZERO { self.norm } else { self.normalized().norm };
        T::FRAC_1_PI / norm
    }

    /// The share `1 - rho` that single scattering loses along w.
    #[inline(always)]
    pub(crate) fn loss<const ISOTROPIC: bool>(&self, w: Vec3<T>) -> T {
        self.fit.loss_as::<ISOTROPIC>(w.x, w.y)
    }

    /// Draws a direction with the density `q cos`, from a fresh uniform number and the digits of u1 that the
    /// first use has not seen.
    #[inline(always)]
    pub(crate) fn sample<const ISOTROPIC: bool>(&self, fresh: T, u1: T) -> Vec3<T> {
        let turn = (u1 * T::from_f64(FRESH_DIGITS)).fract();
        let ([x, y], s2) = if ISOTROPIC {
            let (sin, cos) = turn.sin_cos_turns();
            ([cos, sin], self.first_ray.sample_squared_sine(fresh))
        } else {
            let direction = self.sample_azimuth(turn);
            (direction, self.fit.ray(direction).sample_squared_sine(fresh))
        };
        let s = s2.sqrt();
        Vec3::new(s * x, s * y, (T::ONE - s2).sqrt())
    }

    /// Draws a unit vector in the plane from the azimuthal table.
    #[inline(always)]
    fn sample_azimuth(&self, turn: T) -> [T; 2] {
        let four = turn * T::from_f64(4.0);
        let u = four.fract();
        let quadrant = four - u;
        // The last node that is not beyond u, found without a look-up so that it works in vector registers.
        let [mut node, mut start, mut low, mut high] = [T::ZERO, T::ZERO, self.density[0], self.density[1]];
        for i in 1..NODES - 1 {
            if self.cumulated[i] <= u {
                [node, start] = [T::from_f64(i as f64), self.cumulated[i]];
                [low, high] = [self.density[i], self.density[i + 1]];
            }
        }
        let area = (u - start) * T::from_f64((NODES - 1) as f64);
        let root = (low * low + T::TWO * (high - low) * area).max(T::ZERO).sqrt();
        let inside = (T::TWO * area / (low + root).max(T::from_f64(1e-30))).min(T::ONE);
        let parameter = (node + inside) * T::from_f64(1.0 / (NODES - 1) as f64);
        let (sin, cos) = azimuth(parameter).0.sin_cos_turns();
        let [x, y] = self.fit.in_frame([cos, sin]);
        // Quadrants 0 to 3: (+, +), (-, +), (-, -), (+, -).
        let x_negative = quadrant == T::ONE || quadrant == T::TWO;
        [if x_negative { -x } else { x }, if quadrant > T::from_f64(1.5) { -y } else { y }]
    }
}

/// Azimuth from the wider axis, in turns, at the parameter in `[0, 1]` of the table, and its derivative in
/// radians. The nodes crowd towards the narrower axis, where the loss has a bend.
#[inline(always)]
fn azimuth<T: Real>(parameter: T) -> (T, T) {
    let rest = T::ONE - parameter;
    (T::from_f64(0.25) * (T::ONE - rest * rest), T::from_f64(PI) * rest)
}
