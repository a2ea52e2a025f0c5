//! Lights without extent.

use glam::Vec3;

use super::{Light, LightSample, direction_and_distance, strength};
use crate::Ray;

/// A light that shines from one point alike in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// Where it is, world space.
    pub position: Vec3,
    /// Its intensity: radiant flux per steradian.
    pub intensity: Vec3,
}

impl Light for PointLight {
    fn sample(&self, position: Vec3, _u: [f32; 2]) -> Option<LightSample> {
        let (wi, distance) = direction_and_distance(position, self.position)?;
        Some(LightSample {
            wi,
            distance,
            radiance_over_pdf: self.intensity / (distance * distance),
            pdf: 1.0,
            is_dirac: true,
        })
    }

    fn distance(&self, _ray: &Ray) -> Option<f32> {
        None
    }

    fn radiance_pdf(&self, _position: Vec3, _wi: Vec3) -> (Vec3, f32) {
        (Vec3::ZERO, 0.0)
    }

    fn importance(&self, position: Vec3) -> f32 {
        strength(self.intensity) / self.position.distance_squared(position).max(f32::MIN_POSITIVE)
    }
}
