//! Directional albedos of lobes that have none in closed form.

use glam::Vec3;

/// Entries over the cosine of the direction, and over the azimuth from tangent to bitangent.
const COSINES: usize = 32;
const AZIMUTHS: usize = 5;

/// A function of the direction, tabulated with the symmetry of an anisotropic lobe (both axes mirror).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AlbedoTable {
    /// One row for an isotropic lobe.
    rows: Vec<[f32; COSINES]>,
}

impl AlbedoTable {
    /// Tabulates `albedo(wo)`, once around the normal if the lobe is isotropic.
    pub(crate) fn new(isotropic: bool, albedo: impl Fn(Vec3) -> f32) -> Self {
        let azimuths = if isotropic { 1 } else { AZIMUTHS };
        let row = |i: usize| {
            let azimuth = std::f32::consts::FRAC_PI_2 * i as f32 / (AZIMUTHS - 1) as f32;
            std::array::from_fn(|k| albedo(direction(node(k), azimuth)))
        };
        Self { rows: (0..azimuths).map(row).collect() }
    }

    /// The tabulated value for a direction above the horizon.
    #[inline]
    pub(crate) fn look_up(&self, wo: Vec3) -> f32 {
        // The inverse of `node`.
        let position = wo.z.clamp(0.0, 1.0).sqrt() * (COSINES - 1) as f32;
        let k = (position as usize).min(COSINES - 2);
        let along = |row: &[f32; COSINES]| lerp(row[k], row[k + 1], position - k as f32);
        if let [row] = &self.rows[..] {
            return along(row);
        }
        let azimuth = wo.y.abs().atan2(wo.x.abs()) / std::f32::consts::FRAC_PI_2 * (AZIMUTHS - 1) as f32;
        let i = (azimuth as usize).min(AZIMUTHS - 2);
        lerp(along(&self.rows[i]), along(&self.rows[i + 1]), azimuth - i as f32)
    }
}

/// The cosine of entry `k`: dense towards the horizon, and never on it.
fn node(k: usize) -> f32 {
    let s = k as f32 / (COSINES - 1) as f32;
    (s * s).max(1e-4)
}

fn direction(cos_theta: f32, azimuth: f32) -> Vec3 {
    let sin_theta = (1.0 - cos_theta * cos_theta).sqrt();
    Vec3::new(sin_theta * azimuth.cos(), sin_theta * azimuth.sin(), cos_theta)
}

fn lerp(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// The mean of `value(u)` over a fixed set of well spread points of the unit square.
pub(crate) fn mean_over_square(value: impl Fn([f32; 2]) -> f32) -> f32 {
    const POINTS: u32 = 512;
    let point = |i| [sobol_burley::sample(i, 0, 0), sobol_burley::sample(i, 1, 0)];
    (0..POINTS).map(|i| value(point(i))).sum::<f32>() / POINTS as f32
}
