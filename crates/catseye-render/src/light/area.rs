//! Flat lights.

use std::f32::consts::PI;

use glam::Vec3;

use super::{Light, LightSample, direction_and_distance, strength};
use crate::{Frame, Ray};

/// A flat light that shines from one side, alike in all directions (Lambert's law).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaLight {
    shape: Shape,
    centre: Vec3,
    /// Unit length, on the shining side.
    normal: Vec3,
    radiance: Vec3,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    /// Half the sides.
    Rectangle {
        u: Vec3,
        v: Vec3,
    },
    Disk {
        radius: f32,
    },
}

impl AreaLight {
    /// A rectangle around `centre`, given by the vectors from the centre to the middles of two sides, at
    /// right angles. It shines to the side of `u` cross `v`.
    #[must_use]
    pub fn rectangle(centre: Vec3, u: Vec3, v: Vec3, radiance: Vec3) -> Self {
        let normal = u.cross(v).normalize_or(Vec3::Y);
        Self { shape: Shape::Rectangle { u, v }, centre, normal, radiance }
    }

    /// A disk around `centre` that shines to the side of `normal` (unit length).
    #[must_use]
    pub fn disk(centre: Vec3, normal: Vec3, radius: f32, radiance: Vec3) -> Self {
        Self { shape: Shape::Disk { radius }, centre, normal, radiance }
    }

    fn area(&self) -> f32 {
        match self.shape {
            Shape::Rectangle { u, v } => 4.0 * u.cross(v).length(),
            Shape::Disk { radius } => PI * radius * radius,
        }
    }

    fn point(&self, [s, t]: [f32; 2]) -> Vec3 {
        match self.shape {
            Shape::Rectangle { u, v } => self.centre + u * (2.0 * s - 1.0) + v * (2.0 * t - 1.0),
            Shape::Disk { radius } => {
                let (sin, cos) = (2.0 * PI * t).sin_cos();
                let local = Vec3::new(cos, sin, 0.0) * (radius * s.sqrt());
                self.centre + Frame::from_normal(self.normal).to_world(local)
            }
        }
    }

    fn contains(&self, point: Vec3) -> bool {
        let offset = point - self.centre;
        match self.shape {
            Shape::Rectangle { u, v } => {
                offset.dot(u).abs() <= u.length_squared() && offset.dot(v).abs() <= v.length_squared()
            }
            Shape::Disk { radius } => offset.length_squared() <= radius * radius,
        }
    }

    /// Density per steradian of a uniform point of the light.
    fn density(&self, wi: Vec3, distance: f32) -> f32 {
        distance * distance / (self.area() * -wi.dot(self.normal)).max(f32::MIN_POSITIVE)
    }
}

impl Light for AreaLight {
    fn sample(&self, position: Vec3, u: [f32; 2]) -> Option<LightSample> {
        let (wi, distance) = direction_and_distance(position, self.point(u))?;
        if wi.dot(self.normal) >= 0.0 {
            return None;
        }
        let pdf = self.density(wi, distance);
        Some(LightSample { wi, distance, radiance_over_pdf: self.radiance / pdf, pdf, is_dirac: false })
    }

    fn distance(&self, ray: &Ray) -> Option<f32> {
        let approach = ray.direction.dot(self.normal);
        let t = (self.centre - ray.origin).dot(self.normal) / approach;
        (approach < 0.0 && t > 0.0 && t < ray.t_max && self.contains(ray.at(t))).then_some(t)
    }

    fn radiance_pdf(&self, position: Vec3, wi: Vec3) -> (Vec3, f32) {
        let distance = (self.centre - position).dot(self.normal) / wi.dot(self.normal);
        (self.radiance, self.density(wi, distance))
    }

    fn importance(&self, position: Vec3) -> f32 {
        let to_light = self.centre - position;
        if to_light.dot(self.normal) >= 0.0 {
            return 0.0;
        }
        let area = self.area();
        // Near a large light the distance to its centre says little.
        strength(self.radiance) * PI.min(area / to_light.length_squared())
    }
}
