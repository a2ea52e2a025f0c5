//! The halo around what is bright.

use crate::Image;

/// Widths of the halo's Gaussians relative to the picture's height, and their shares.
const HALO: [(f32, f32); 3] = [(0.0035, 0.5), (0.012, 0.3), (0.045, 0.2)];
/// Boxes that make a Gaussian.
const BOXES: usize = 3;

impl Image {
    /// The picture as a lens or an eye that scatters `share` of the light sees it: each point loses that
    /// share to a halo around it. The sum of all pixels stays the same but for what the halo carries over the
    /// picture's edge.
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

    /// The picture convolved with about a Gaussian of the given standard deviation in pixels; black lies
    /// around it.
    ///
    /// Three boxes one after another (Wells, "Efficient Synthesis of Gaussian Filters by Cascaded Uniform
    /// Filters", PAMI 8(2), 1986) along the rows, then along the columns: the time doesn't depend on the
    /// width.
    fn blurred(&self, sigma: f32) -> Self {
        // A box of 2 r + 1 pixels has the variance r (r + 1) / 3.
        let radius = (0.5 * ((4.0 * sigma * sigma + 1.0).sqrt() - 1.0)).round().max(1.0) as usize;
        let filtered = |image: Self| (0..BOXES).fold(image, |image, _| image.box_filtered(radius));
        filtered(filtered(self.turned()).turned())
    }

    /// Each pixel becomes the mean of those up to `radius` above and below it. Columns are summed side by
    /// side: rows are read and written from end to end.
    fn box_filtered(&self, radius: usize) -> Self {
        let (width, height) = (self.width(), self.height());
        let scale = 1.0 / (2 * radius + 1) as f64;
        let mut sums = vec![[0.0_f64; 3]; width];
        let add = |sums: &mut [[f64; 3]], y: usize, sign: f64| {
            let row = &self.pixels()[y * width..][..width];
            for (sum, value) in sums.as_flattened_mut().iter_mut().zip(row.as_flattened()) {
                *sum += sign * f64::from(*value);
            }
        };
        (0..radius.min(height)).for_each(|y| add(&mut sums, y, 1.0));
        let mut filtered = Self::new(width, height);
        for (y, row) in filtered.pixels_mut().chunks_exact_mut(width.max(1)).enumerate() {
            if y + radius < height {
                add(&mut sums, y + radius, 1.0);
            }
            if y > radius {
                add(&mut sums, y - radius - 1, -1.0);
            }
            for (mean, sum) in row.as_flattened_mut().iter_mut().zip(sums.as_flattened()) {
                // What is left of bright pixels that went out is rounding.
                *mean = (sum * scale).max(0.0) as f32;
            }
        }
        filtered
    }

    /// Rows become columns.
    fn turned(&self) -> Self {
        Self::from_fn(self.height(), self.width(), |y, x| self.pixel(x, y))
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
