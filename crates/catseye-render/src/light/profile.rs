//! Lights without extent whose intensity depends on the direction.

use std::fmt;

use glam::Vec3;

use super::{Light, LightSample, PointLight};
use crate::Ray;

/// A light that shines from one point with an intensity that is a function of the direction: a headlamp from
/// a photometric file, for instance.
pub struct ProfileLight {
    position: Vec3,
    intensity: Box<dyn Fn(Vec3) -> Vec3 + Send + Sync>,
}

impl ProfileLight {
    /// The intensity (flux per steradian, candela in photometric units) is given for unit vectors that point
    /// away from the light, world space; it must be finite and not negative.
    #[must_use]
    pub fn new(position: Vec3, intensity: impl Fn(Vec3) -> Vec3 + Send + Sync + 'static) -> Self {
        Self { position, intensity: Box::new(intensity) }
    }

    /// What lights a place like it: a light of the same intensity in all directions.
    fn towards(&self, position: Vec3) -> PointLight {
        let direction = (position - self.position).normalize_or_zero();
        PointLight { position: self.position, intensity: (self.intensity)(direction) }
    }
}

impl fmt::Debug for ProfileLight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ProfileLight").field("position", &self.position).finish_non_exhaustive()
    }
}

impl Light for ProfileLight {
    fn sample(&self, position: Vec3, u: [f32; 2]) -> Option<LightSample> {
        self.towards(position).sample(position, u)
    }

    fn distance(&self, _ray: &Ray) -> Option<f32> {
        None
    }

    fn radiance_pdf(&self, _position: Vec3, _wi: Vec3) -> (Vec3, f32) {
        (Vec3::ZERO, 0.0)
    }

    fn importance(&self, position: Vec3) -> f32 {
        self.towards(position).importance(position)
    }
}
