//! A bead on white paint: light is focused on the back, scattered there, and collimated again.

use std::f64::consts::{FRAC_PI_2, PI};

use super::fresnel::transmitted;

/// The mean of K(y) K(y turned by alpha) over the bead's back, where K is the irradiance there over that
/// before the bead, as a sum of Legendre polynomials (docs/optics.md, section 3).
#[derive(Clone, Debug)]
pub(crate) struct DiffuseBack {
    /// Factors of the Legendre polynomials in `R_A` over the packing.
    terms: Vec<f64>,
}

impl DiffuseBack {
    /// `size` is k R, the bead's circumference in wavelengths.
    pub(crate) fn new(index: f64, reflectance: f64, size: f64) -> Self {
        // The irradiance has no finer detail than two waves of opposite edge rays make.
        let last = (2.0 * size).ceil() as usize;
        let count = 200 + 2 * last;
        let mut moments = vec![0.0; last + 1];
        for step in 0..count {
            let (x, cos) = (FRAC_PI_2 * (step as f64 + 0.5) / count as f64).sin_cos();
            let [s, p] = transmitted(x, index);
            let weight = 0.5 * (s + p) * x * cos * FRAC_PI_2 / count as f64;
            let landing = x.asin() - 2.0 * (x / index).asin();
            legendre(landing.cos(), last, |l, value| moments[l] += weight * value);
        }
        let scale = reflectance / (PI * index * index);
        let term = |(l, moment): (usize, f64)| {
            scale * (2 * l + 1) as f64 * (moment * contrast(l as f64 / (2.0 * size))).powi(2)
        };
        Self { terms: moments.into_iter().enumerate().map(term).collect() }
    }

    /// `R_A` over the packing, at an observation angle in radians.
    pub(crate) fn coefficient(&self, angle: f64) -> f64 {
        let mut sum = 0.0;
        legendre(angle.cos(), self.terms.len() - 1, |l, value| sum += self.terms[l] * value);
        sum
    }
}

/// What diffraction at a round pupil leaves of the contrast at a frequency, in units of the highest one: the
/// overlap of two disks (Born and Wolf, section 9.5).
fn contrast(frequency: f64) -> f64 {
    let f = frequency.min(1.0);
    2.0 / PI * (f.acos() - f * (1.0 - f * f).sqrt())
}

/// The Legendre polynomials at t, by their recurrence.
fn legendre(t: f64, last: usize, mut each: impl FnMut(usize, f64)) {
    let (mut before, mut value) = (0.0, 1.0);
    for l in 0..=last {
        each(l, value);
        let next = ((2 * l + 1) as f64 * t * value - l as f64 * before) / (l + 1) as f64;
        (before, value) = (value, next);
    }
}
