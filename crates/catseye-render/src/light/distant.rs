//! Sun and moon.

use std::f32::consts::PI;

use glam::Vec3;

use super::{Light, LightSample, strength};
use crate::{Frame, Ray};

/// A disk so far away that it lies in the same direction from everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistantLight {
    /// Unit vector to the disk's centre.
    direction: Vec3,
    radiance: Vec3,
    one_minus_cos_max: f32,
}

impl DistantLight {
    /// A disk in the given direction (unit vector towards it) of the given angular radius (radians, above 0;
    /// the moon's is 0.0045), which brings `irradiance` to a plane that faces it.
    #[must_use]
    pub fn new(direction: Vec3, angular_radius: f32, irradiance: Vec3) -> Self {
        let half_sin = (0.5 * angular_radius).sin();
        // The projected solid angle of the cone.
        let projected = PI * angular_radius.sin().powi(2);
        Self { direction, radiance: irradiance / projected, one_minus_cos_max: 2.0 * half_sin * half_sin }
    }
}

impl Light for DistantLight {
    fn sample(&self, _position: Vec3, u: [f32; 2]) -> Option<LightSample> {
        let one_minus_cos = u[0] * self.one_minus_cos_max;
        let sin = (one_minus_cos * (2.0 - one_minus_cos)).sqrt();
        let (sin_phi, cos_phi) = (2.0 * PI * u[1]).sin_cos();
        let local = Vec3::new(sin * cos_phi, sin * sin_phi, 1.0 - one_minus_cos);
        let solid_angle = 2.0 * PI * self.one_minus_cos_max;
        Some(LightSample {
            wi: Frame::from_normal(self.direction).to_world(local),
            distance: f32::INFINITY,
            radiance_over_pdf: self.radiance * solid_angle,
            pdf: 1.0 / solid_angle,
            is_dirac: false,
        })
    }

    fn distance(&self, ray: &Ray) -> Option<f32> {
        // 1 - cos from the chord: accurate where the cosine isn't.
        let one_minus_cos = 0.5 * ray.direction.distance_squared(self.direction);
        (one_minus_cos < self.one_minus_cos_max && ray.t_max == f32::INFINITY).then_some(f32::INFINITY)
    }

    fn radiance_pdf(&self, _position: Vec3, _wi: Vec3) -> (Vec3, f32) {
        (self.radiance, 1.0 / (2.0 * PI * self.one_minus_cos_max))
    }

    fn importance(&self, _position: Vec3) -> f32 {
        strength(self.radiance) * 2.0 * PI * self.one_minus_cos_max
    }
}
