//! Spheres, and where rays meet them.

use std::f32::consts::PI;

use glam::Vec3;

use crate::Ray;

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Its centre, world space.
    pub centre: Vec3,
    /// Its radius, above 0.
    pub radius: f32,
}

impl Sphere {
    /// The nearest distance in `(0, ray.t_max)` at which the ray meets the sphere.
    ///
    /// Haines, Günther and Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing
    /// Gems, 2019: the discriminant from the distance of the ray to the centre, the roots without
    /// cancellation.
    #[inline]
    #[must_use]
    pub fn intersect(&self, ray: &Ray) -> Option<f32> {
        let f = ray.origin - self.centre;
        let b = -f.dot(ray.direction);
        let nearest = f + ray.direction * b;
        let discriminant = self.radius * self.radius - nearest.length_squared();
        if discriminant < 0.0 {
            return None;
        }
        let q = b + discriminant.sqrt().copysign(b);
        let c = f.length_squared() - self.radius * self.radius;
        let (t0, t1) = if b > 0.0 { (c / q, q) } else { (q, c / q) };
        [t0, t1].into_iter().find(|&t| t > 0.0 && t < ray.t_max)
    }

    /// Solid angle the sphere covers seen from `position`, in steradian; 4 pi from inside.
    #[must_use]
    pub fn solid_angle(&self, position: Vec3) -> f32 {
        2.0 * PI * self.one_minus_cos(position)
    }

    /// 1 - cos of the half angle of the cone around the sphere; 2 from inside.
    pub(crate) fn one_minus_cos(&self, position: Vec3) -> f32 {
        let sin2 = self.radius * self.radius / position.distance_squared(self.centre);
        // Written without the difference of two numbers near 1: lamps are small.
        if sin2 < 1.0 { sin2 / (1.0 + (1.0 - sin2).sqrt()) } else { 2.0 }
    }
}
