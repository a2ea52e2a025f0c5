//! A picture of the surroundings as a source of light.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use super::strength;
use crate::Image;

/// A latitude-longitude picture of the sphere of directions: its middle looks along -z, its right half is +x,
/// its top +y.
#[derive(Clone, Debug)]
pub struct LatLong {
    image: Image,
    /// Running sum of the rows' weights, from 0 to their total.
    rows: Vec<f32>,
    /// For each row the running sum of its pixels' weights.
    columns: Vec<f32>,
}

impl LatLong {
    /// Prepares a picture of linear radiance for sampling.
    #[must_use]
    pub fn new(image: Image) -> Self {
        let (width, height) = (image.width(), image.height());
        let mut rows = vec![0.0];
        let mut columns = Vec::with_capacity((width + 1) * height);
        let mut total = 0.0;
        for y in 0..height {
            // Bilinear look-up reaches into the next pixels: they count too.
            let sin_theta = ((y as f32 + 0.5) * PI / height as f32).sin();
            let mut sum = 0.0;
            columns.push(sum);
            for x in 0..width {
                sum += sin_theta * neighbourhood(&image, x, y);
                columns.push(sum);
            }
            total += sum;
            rows.push(total);
        }
        Self { image, rows, columns }
    }

    /// The radiance from a direction, interpolated.
    pub(crate) fn radiance(&self, direction: Vec3) -> Vec3 {
        let (width, height) = (self.image.width(), self.image.height());
        let [x, y] = self.position(direction).map(|p| p - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (s, t) = (x - left, y - top);
        let pixel = |dx: i64, dy: i64| {
            let column = (left as i64 + dx).rem_euclid(width as i64) as usize;
            let row = (top as i64 + dy).clamp(0, height as i64 - 1) as usize;
            Vec3::from(self.image.pixel(column, row))
        };
        pixel(0, 0).lerp(pixel(1, 0), s).lerp(pixel(0, 1).lerp(pixel(1, 1), s), t)
    }

    /// The mean radiance over all directions.
    pub(crate) fn mean(&self) -> f32 {
        let pixels = (self.image.width() * self.image.height()) as f32;
        // The mean of sin(theta) over the rows is 2/pi.
        self.total() / pixels * (0.5 * PI)
    }

    /// A direction distributed about as the radiance, and its density; `None` for a black picture.
    pub(crate) fn sample(&self, u: [f32; 2]) -> Option<(Vec3, f32)> {
        if self.total() <= 0.0 {
            return None;
        }
        let y = invert(&self.rows, u[1]);
        let x = invert(self.row(y as usize), u[0]);
        let (width, height) = (self.image.width() as f32, self.image.height() as f32);
        let (sin_theta, cos_theta) = (PI * y / height).sin_cos();
        let (sin_phi, cos_phi) = (TAU * (x / width - 0.5)).sin_cos();
        let direction = Vec3::new(sin_theta * sin_phi, cos_theta, -sin_theta * cos_phi);
        let pdf = self.pdf(direction);
        (pdf > 0.0).then_some((direction, pdf))
    }

    /// The density of [`LatLong::sample`] per steradian.
    pub(crate) fn pdf(&self, direction: Vec3) -> f32 {
        let (width, height) = (self.image.width(), self.image.height());
        let [x, y] = self.position(direction);
        let (x, y) = ((x as usize).min(width - 1), (y as usize).min(height - 1));
        let row = self.row(y);
        let sin_theta = (1.0 - direction.y * direction.y).max(1e-12).sqrt();
        let pixels = (width * height) as f32;
        (row[x + 1] - row[x]) / self.total().max(f32::MIN_POSITIVE) * pixels / (TAU * PI * sin_theta)
    }

    /// Pixel coordinates of a direction.
    fn position(&self, direction: Vec3) -> [f32; 2] {
        let u = direction.x.atan2(-direction.z) / TAU + 0.5;
        let v = direction.y.clamp(-1.0, 1.0).acos() / PI;
        [u * self.image.width() as f32, v * self.image.height() as f32]
    }

    fn row(&self, y: usize) -> &[f32] {
        let stride = self.image.width() + 1;
        &self.columns[y * stride..][..stride]
    }

    fn total(&self) -> f32 {
        self.rows[self.rows.len() - 1]
    }
}

/// The mean strength of a pixel and those around it.
fn neighbourhood(image: &Image, x: usize, y: usize) -> f32 {
    let (width, height) = (image.width(), image.height());
    let mut sum = 0.0;
    for row in y.saturating_sub(1)..=(y + 1).min(height - 1) {
        for dx in [width - 1, 0, 1] {
            sum += strength(Vec3::from(image.pixel((x + dx) % width, row)));
        }
    }
    sum / 9.0
}

/// Where the running sum reaches the share `u` of its total: an index and the way to the next.
fn invert(sums: &[f32], u: f32) -> f32 {
    let target = u * sums[sums.len() - 1];
    let i = sums.partition_point(|&s| s <= target).clamp(1, sums.len() - 1) - 1;
    let step = sums[i + 1] - sums[i];
    let within = if step > 0.0 { ((target - sums[i]) / step).clamp(0.0, 0.999_999) } else { 0.5 };
    i as f32 + within
}
