//! The halo around what is bright.

use crate::Image;

/// Widths of the halo's Gaussians relative to the picture's height, and their shares.
const HALO: [(f32, f32); 3] = [(0.0035, 0.5), (0.012, 0.3), (0.045, 0.2)];

impl Image {
    /// The picture as a lens or an eye that scatters `share` of the light sees it: each point loses that share to a
    /// halo around it. The sum of all pixels stays the same but for what the halo carries over the picture's edge.
    #[must_use]
    pub fn with_glare(&self, share: f32) -> Self {
        if share <= 0.0 {
            return self.clone();
        }
        let halos = HALO.map(|(width, part)| (self.blurred(width * self.height() as f32), part * share));
        Self::from_fn(self.width(), self.height(), |x, y| {
            let mut sum = self.pixel(x, y).map(|v| v * (1.0 - share));
            for (halo, part) in &halos {
                for (sum, value) in sum.iter_mut().zip(halo.pixel(x, y)) {
                    *sum += part * value;
                }
            }
            sum
        })
    }

    /// The picture convolved with a Gaussian of the given standard deviation in pixels; black lies around it.
    fn blurred(&self, sigma: f32) -> Self {
        let radius = (3.0 * sigma).ceil() as usize;
        let weight = |i: usize| (-0.5 * (i as f32 - radius as f32).powi(2) / (sigma * sigma).max(1e-6)).exp();
        let kernel: Vec<f32> = (0..=2 * radius).map(weight).collect();
        let total: f32 = kernel.iter().sum();
        let kernel: Vec<f32> = kernel.iter().map(|k| k / total).collect();
        // Twice along the rows, turned in between.
        self.convolved_and_turned(&kernel).convolved_and_turned(&kernel)
    }

    /// Rows convolved with a kernel of odd length; rows become columns.
    fn convolved_and_turned(&self, kernel: &[f32]) -> Self {
        let radius = kernel.len() / 2;
        Self::from_fn(self.height(), self.width(), |y, x| {
            let first = x.saturating_sub(radius);
            let last = (x + radius).min(self.width() - 1);
            let mut sum = [0.0; 3];
            for column in first..=last {
                let k = kernel[column + radius - x];
                for (sum, value) in sum.iter_mut().zip(self.pixel(column, y)) {
                    *sum += k * value;
                }
            }
            sum
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glare_moves_light_but_makes_none() {
        let mut image = Image::new(200, 100);
        image.set_pixel(100, 50, [900.0, 0.0, 30.0]);
        let glaring = image.with_glare(0.2);
        for (before, after) in image.mean().into_iter().zip(glaring.mean()) {
            assert!((before - after).abs() <= 1e-4 * before, "{before} {after}");
        }
        assert!(glaring.pixel(103, 52)[0] > 0.0 && glaring.pixel(100, 50)[0] < 850.0);
    }
}
