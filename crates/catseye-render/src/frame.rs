//! The local frame that directions are shaded in.

use glam::Vec3;

/// An orthonormal, right-handed frame: `z` along the normal, `x` along the tangent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The tangent, unit length, world space.
    pub x: Vec3,
    /// `z` cross `x`.
    pub y: Vec3,
    /// The normal, unit length, world space.
    pub z: Vec3,
}

impl Frame {
    /// A frame around a unit normal, its tangent arbitrary but continuous almost everywhere.
    ///
    /// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
    #[must_use]
    pub fn from_normal(normal: Vec3) -> Self {
        let sign = 1.0_f32.copysign(normal.z);
        let a = -1.0 / (sign + normal.z);
        let b = normal.x * normal.y * a;
        let x = Vec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
        Self { x, y: normal.cross(x), z: normal }
    }

    /// A frame around a unit normal whose `x` is `tangent` made orthogonal to it.
    ///
    /// A tangent that is zero, not finite or along the normal gives [`Frame::from_normal`].
    #[must_use]
    pub fn from_normal_tangent(normal: Vec3, tangent: Vec3) -> Self {
        let projected = tangent - normal * normal.dot(tangent);
        match projected.try_normalize() {
            Some(x) => Self { x, y: normal.cross(x), z: normal },
            None => Self::from_normal(normal),
        }
    }

    /// The components of a world-space vector in this frame.
    #[inline]
    #[must_use]
    pub fn to_local(&self, v_world: Vec3) -> Vec3 {
        Vec3::new(self.x.dot(v_world), self.y.dot(v_world), self.z.dot(v_world))
    }

    /// The world-space vector with these components.
    #[inline]
    #[must_use]
    pub fn to_world(&self, v_local: Vec3) -> Vec3 {
        self.x * v_local.x + self.y * v_local.y + self.z * v_local.z
    }
}
