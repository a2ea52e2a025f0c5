//! Pictures in linear light.

use crate::ToneMap;

/// A picture: linear Rec. 709 radiance, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: usize,
    height: usize,
    pixels: Vec<[f32; 3]>,
}

impl Image {
    /// A black picture.
    #[must_use]
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, height, pixels: vec![[0.0; 3]; width * height] }
    }

    /// A picture whose pixels are `value(x, y)`.
    #[must_use]
    pub fn from_fn(width: usize, height: usize, mut value: impl FnMut(usize, usize) -> [f32; 3]) -> Self {
        let pixels = (0..width * height).map(|i| value(i % width, i / width)).collect();
        Self { width, height, pixels }
    }

    /// Number of columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// All pixels, row by row from the top left.
    #[must_use]
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }

    pub(crate) fn pixels_mut(&mut self) -> &mut [[f32; 3]] {
        &mut self.pixels
    }

    /// The pixel in column `x` and row `y`.
    ///
    /// # Panics
    /// If the pixel is outside the picture.
    #[must_use]
    pub fn pixel(&self, x: usize, y: usize) -> [f32; 3] {
        assert!(x < self.width && y < self.height, "pixel ({x}, {y}) is outside the picture");
        self.pixels[y * self.width + x]
    }

    /// Sets the pixel in column `x` and row `y`.
    ///
    /// # Panics
    /// If the pixel is outside the picture.
    pub fn set_pixel(&mut self, x: usize, y: usize, value: [f32; 3]) {
        assert!(x < self.width && y < self.height, "pixel ({x}, {y}) is outside the picture");
        self.pixels[y * self.width + x] = value;
    }

    /// Copies another picture into this one, its top left corner at `(left, top)`; what sticks out is
    /// dropped.
    pub fn paste(&mut self, other: &Self, left: usize, top: usize) {
        let columns = other.width.min(self.width.saturating_sub(left));
        for y in 0..other.height.min(self.height.saturating_sub(top)) {
            let to = (top + y) * self.width + left;
            let from = y * other.width;
            self.pixels[to..to + columns].copy_from_slice(&other.pixels[from..from + columns]);
        }
    }

    /// The picture as the screen shows it, still linear: with glare, through the tone curve.
    #[must_use]
    pub fn toned(&self, tone_map: &ToneMap) -> Self {
        let mut shown = self.with_glare(tone_map.glare);
        shown.pixels.iter_mut().for_each(|pixel| *pixel = tone_map.apply(*pixel));
        shown
    }

    /// The picture with each block of `factor` by `factor` pixels made one; what doesn't fill a block is
    /// dropped.
    ///
    /// # Panics
    /// If the factor is 0.
    #[must_use]
    pub fn reduced(&self, factor: usize) -> Self {
        let scale = 1.0 / (factor * factor) as f32;
        Self::from_fn(self.width / factor, self.height / factor, |x, y| {
            let mut sum = [0.0; 3];
            for i in 0..factor * factor {
                let pixel = self.pixel(x * factor + i % factor, y * factor + i / factor);
                sum.iter_mut().zip(pixel).for_each(|(sum, value)| *sum += value);
            }
            sum.map(|s| s * scale)
        })
    }

    /// The mean of all pixels, per channel; 0 for a picture without pixels.
    #[must_use]
    pub fn mean(&self) -> [f32; 3] {
        let mut sum = [0.0_f64; 3];
        for pixel in &self.pixels {
            for (sum, value) in sum.iter_mut().zip(pixel) {
                *sum += f64::from(*value);
            }
        }
        sum.map(|s| (s / self.pixels.len().max(1) as f64) as f32)
    }
}
