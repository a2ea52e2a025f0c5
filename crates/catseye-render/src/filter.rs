//! The reconstruction filter.

/// Entries of the table that inverts the filter's distribution.
const TABLE_SIZE: usize = 64;

/// A separable filter that samples of a pixel are distributed by.
///
/// Where samples are drawn from the filter all of them count alike, and no sample belongs to two pixels:
/// pixels stay independent, and so do threads (Ernst et al., "Filter Importance Sampling", 2006).
#[derive(Clone, Debug, PartialEq)]
pub struct Filter {
    /// The inverse of the cumulative distribution at `i / TABLE_SIZE`, in pixels.
    quantiles: [f32; TABLE_SIZE + 1],
}

impl Filter {
    /// The Blackman-Harris window of the given radius in pixels: close to a Gaussian, without its cut.
    #[must_use]
    pub fn blackman_harris(radius: f32) -> Self {
        use std::f32::consts::PI;
        Self::tabulate(radius, |x| {
            let a = PI * (x / radius + 1.0);
            0.35875 - 0.48829 * a.cos() + 0.14128 * (2.0 * a).cos() - 0.01168 * (3.0 * a).cos()
        })
    }

    /// The pixel itself, without overlap.
    #[must_use]
    pub fn pixel() -> Self {
        Self::tabulate(0.5, |_| 1.0)
    }

    /// Inverts the integral of `weight` over `[-radius, radius]` numerically.
    fn tabulate(radius: f32, weight: impl Fn(f32) -> f32) -> Self {
        const STEPS: usize = 4096;
        let step = 2.0 * radius / STEPS as f32;
        let total: f32 = (0..STEPS).map(|i| weight(-radius + (i as f32 + 0.5) * step)).sum();
        let mut quantiles = [radius; TABLE_SIZE + 1];
        quantiles[0] = -radius;
        let (mut sum, mut entry) = (0.0, 1);
        for i in 0..STEPS {
            let x = -radius + i as f32 * step;
            let share = weight(x + 0.5 * step) / total;
            while entry < TABLE_SIZE && sum + share >= entry as f32 / TABLE_SIZE as f32 {
                quantiles[entry] = x + step * (entry as f32 / TABLE_SIZE as f32 - sum) / share;
                entry += 1;
            }
            sum += share;
        }
        Self { quantiles }
    }

    /// An offset from the pixel's centre in pixels, for `u` in `[0, 1)`.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: f32) -> f32 {
        let position = u * TABLE_SIZE as f32;
        let entry = (position as usize).min(TABLE_SIZE - 1);
        let (low, high) = (self.quantiles[entry], self.quantiles[entry + 1]);
        low + (high - low) * (position - entry as f32)
    }
}

impl Default for Filter {
    /// Blackman-Harris over 1.5 pixels to each side.
    fn default() -> Self {
        Self::blackman_harris(1.5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_symmetric_and_rise() {
        for filter in [Filter::default(), Filter::pixel()] {
            let q = filter.quantiles;
            assert!(q.windows(2).all(|w| w[0] < w[1]), "{q:?}");
            for i in 0..=TABLE_SIZE {
                assert!((q[i] + q[TABLE_SIZE - i]).abs() < 2e-3, "{i}: {} {}", q[i], q[TABLE_SIZE - i]);
            }
        }
    }
}
