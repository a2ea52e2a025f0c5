//! Rays, and where they start so that they don't meet the surface they leave.

use glam::Vec3;

/// A half line with an end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts, world space.
    pub origin: Vec3,
    /// Where it goes, unit length.
    pub direction: Vec3,
    /// Where it ends, in units of `direction`; may be infinite.
    pub t_max: f32,
}

/// Distance that a ray's origin is lifted off a surface, relative to the largest coordinate: about a hundred
/// times the rounding of a point computed from three vertices.
const RELATIVE_OFFSET: f32 = 1.2e-5;

impl Ray {
    /// The ray without end.
    #[inline]
    #[must_use]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, t_max: f32::INFINITY }
    }

    /// The ray that leaves a surface point, lifted off the surface on the side it goes to.
    ///
    /// `normal` is the geometric normal, either orientation.
    #[inline]
    #[must_use]
    pub fn leaving(position: Vec3, normal: Vec3, direction: Vec3) -> Self {
        let magnitude = position.abs().max_element().max(1e-2);
        let lift = (magnitude * RELATIVE_OFFSET).copysign(normal.dot(direction));
        Self::new(position + normal * lift, direction)
    }

    /// The point at the distance `t`.
    #[inline]
    #[must_use]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }
}
