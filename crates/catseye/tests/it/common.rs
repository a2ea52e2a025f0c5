//! What several tests share: fixed random numbers, directions, and the cases.

use catseye::Vec3;
use std::f64::consts::TAU;

/// Roughness pairs from sheeting to infinity, isotropic and anisotropic.
pub(crate) const ROUGHNESS: [[f64; 2]; 12] = [
    [0.006, 0.006],
    [0.05, 0.05],
    [0.3, 0.3],
    [1.0, 1.0],
    [5.0, 5.0],
    [f64::INFINITY, f64::INFINITY],
    [0.3, 0.1],
    [1.0, 0.05],
    [0.05, 1.0],
    [2.0, 0.5],
    [0.01, 0.003],
    [f64::INFINITY, 0.02],
];

/// Directions in the upper hemisphere, from the normal to near grazing.
pub(crate) fn directions() -> Vec<Vec3<f64>> {
    [(0.0, 0.0), (0.5, 0.3), (1.0, 2.0), (1.3, -1.2), (1.5, 0.8)]
        .into_iter()
        .map(|(theta, phi)| Vec3::from_angles(theta, phi))
        .collect()
}

/// The direction in single precision.
pub(crate) fn to_f32(w: Vec3<f64>) -> Vec3<f32> {
    Vec3::new(w.x as f32, w.y as f32, w.z as f32)
}

/// `SplitMix64`: fixed seeds, the same numbers everywhere.
#[derive(Debug)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// Uniform in `[0, 1)`.
    pub(crate) fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in `[0, 1)`, exact in single precision.
    pub(crate) fn uniform_f32(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1_u32 << 24) as f32
    }

    pub(crate) fn triple(&mut self) -> [f64; 3] {
        [self.uniform(), self.uniform(), self.uniform()]
    }

    /// Uniform on the upper hemisphere.
    pub(crate) fn direction(&mut self) -> Vec3<f64> {
        let z = 1.0 - self.uniform();
        let (sin, cos) = (TAU * self.uniform()).sin_cos();
        let s = (1.0 - z * z).sqrt();
        Vec3::new(s * cos, s * sin, z)
    }

    /// Log-uniform roughness from 0.003 to 30.
    pub(crate) fn roughness(&mut self) -> f64 {
        10.0_f64.powf(-2.5 + 4.0 * self.uniform())
    }
}
