//! Directional albedos of lobes that have none in closed form: tables over the cosine and one parameter.

use std::f32::consts::FRAC_PI_2;
use std::ops::{Add, Mul, Sub};

use glam::Vec3;

/// Entries over the cosine of the direction.
const COSINES: usize = 32;
/// Rows over the azimuth from tangent to bitangent.
const AZIMUTHS: usize = 5;

/// A function of the cosine of the direction, in each row for another value of a parameter in `[0, 1]`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AlbedoTable<T = f32> {
    rows: Vec<[T; COSINES]>,
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f32, Output = T>> AlbedoTable<T> {
    /// Tabulates `value(parameter, wo)` in so many rows, for directions above the tangent.
    pub(crate) fn new(rows: usize, value: impl Fn(f32, Vec3) -> T) -> Self {
        let row = |i: usize| {
            let parameter = i as f32 / (rows - 1).max(1) as f32;
            std::array::from_fn(|k| value(parameter, direction(cosine(k), 0.0)))
        };
        Self { rows: (0..rows).map(row).collect() }
    }

    /// The tabulated value.
    #[inline]
    pub(crate) fn look_up(&self, parameter: f32, cos_theta: f32) -> T {
        // The inverse of `cosine`.
        let x = cos_theta.clamp(0.0, 1.0).sqrt() * (COSINES - 1) as f32;
        let k = (x as usize).min(COSINES - 2);
        let along = |row: &[T; COSINES]| lerp(row[k], row[k + 1], x - k as f32);
        if let [row] = &self.rows[..] {
            return along(row);
        }
        let y = parameter.clamp(0.0, 1.0) * (self.rows.len() - 1) as f32;
        let i = (y as usize).min(self.rows.len() - 2);
        lerp(along(&self.rows[i]), along(&self.rows[i + 1]), y - i as f32)
    }
}

impl AlbedoTable {
    /// Tabulates `albedo(wo)` of a lobe that both axes mirror; an isotropic one once around the normal.
    pub(crate) fn of_directions(isotropic: bool, albedo: impl Fn(Vec3) -> f32) -> Self {
        let rows = if isotropic { 1 } else { AZIMUTHS };
        Self::new(rows, |quarter, wo| albedo(direction(wo.z, quarter * FRAC_PI_2)))
    }

    /// The value of [`AlbedoTable::of_directions`] for a direction above the horizon.
    #[inline]
    pub(crate) fn look_up_direction(&self, wo: Vec3) -> f32 {
        let quarter = if self.rows.len() == 1 { 0.0 } else { wo.y.abs().atan2(wo.x.abs()) / FRAC_PI_2 };
        self.look_up(quarter, wo.z)
    }
}

/// The cosine of entry `k`: dense towards the horizon, and never on it.
fn cosine(k: usize) -> f32 {
    let s = k as f32 / (COSINES - 1) as f32;
    (s * s).max(1e-4)
}

fn direction(cos_theta: f32, azimuth: f32) -> Vec3 {
    let sin_theta = (1.0 - cos_theta * cos_theta).sqrt();
    Vec3::new(sin_theta * azimuth.cos(), sin_theta * azimuth.sin(), cos_theta)
}

fn lerp<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f32, Output = T>>(a: T, b: T, t: f32) -> T {
    a + (b - a) * t
}

/// The mean of `value(u)` over a fixed set of well spread points of the unit square.
pub(crate) fn mean_over_square(value: impl Fn([f32; 2]) -> f32) -> f32 {
    const POINTS: u32 = 512;
    let point = |i| [sobol_burley::sample(i, 0, 0), sobol_burley::sample(i, 1, 0)];
    (0..POINTS).map(|i| value(point(i))).sum::<f32>() / POINTS as f32
}
