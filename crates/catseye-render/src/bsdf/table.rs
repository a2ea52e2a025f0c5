//! Directional albedos of families of lobes: functions of a cosine and one parameter, tabulated once for all lobes.

use glam::{Vec2, Vec3};

/// Entries over the cosine and over the parameter.
const COSINES: usize = 32;
const PARAMETERS: usize = 32;

/// A pair of functions of the cosine of the direction and of a parameter in `[0, 1]`.
#[derive(Debug)]
pub(crate) struct FamilyTable {
    entries: Vec<[Vec2; COSINES]>,
}

impl FamilyTable {
    /// Tabulates `value(parameter, wo)`.
    pub(crate) fn new(value: impl Fn(f32, Vec3) -> Vec2) -> Self {
        let row = |p: usize| {
            let parameter = p as f32 / (PARAMETERS - 1) as f32;
            std::array::from_fn(|k| value(parameter, direction(k)))
        };
        Self { entries: (0..PARAMETERS).map(row).collect() }
    }

    /// The tabulated pair.
    #[inline]
    pub(crate) fn look_up(&self, parameter: f32, cos_theta: f32) -> Vec2 {
        // The inverse of `direction`.
        let x = cos_theta.clamp(0.0, 1.0).sqrt() * (COSINES - 1) as f32;
        let y = parameter.clamp(0.0, 1.0) * (PARAMETERS - 1) as f32;
        let (k, p) = ((x as usize).min(COSINES - 2), (y as usize).min(PARAMETERS - 2));
        let along = |row: &[Vec2; COSINES]| row[k].lerp(row[k + 1], x - k as f32);
        along(&self.entries[p]).lerp(along(&self.entries[p + 1]), y - p as f32)
    }
}

/// The direction of entry `k`: dense towards the horizon, and never on it.
fn direction(k: usize) -> Vec3 {
    let s = k as f32 / (COSINES - 1) as f32;
    let cos_theta = (s * s).max(1e-4);
    Vec3::new((1.0 - cos_theta * cos_theta).sqrt(), 0.0, cos_theta)
}
