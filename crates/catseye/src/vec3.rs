//! The three-component vector that directions are given in.

use core::ops::{Add, Mul, Neg, Sub};

use crate::Real;

/// A vector in the local shading frame: `z` along the shading normal, `x` along `tangent_u`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Vec3<T> {
    /// Component along `tangent_u`.
    pub x: T,
    /// Component along `normal x tangent_u`.
    pub y: T,
    /// Component along the shading normal; for a unit vector the cosine of its polar angle.
    pub z: T,
}

impl<T: Real> Vec3<T> {
    /// The vector `(x, y, z)`.
    #[inline]
    #[must_use]
    pub const fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }

    /// The unit vector at polar angle `theta` from the normal and azimuth `phi` from `tangent_u`, both in
    /// radians.
    #[inline]
    #[must_use]
    pub fn from_angles(theta: T, phi: T) -> Self {
        let (sin_theta, cos_theta) = theta.sin_cos();
        let (sin_phi, cos_phi) = phi.sin_cos();
        Self::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
    }

    /// The scalar product.
    #[inline]
    #[must_use]
    pub fn dot(self, other: Self) -> T {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The vector product.
    #[inline]
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// The vector scaled to length 1. A zero vector gives NaN.
    #[inline]
    #[must_use]
    pub fn normalized(self) -> Self {
        self * (T::ONE / self.dot(self).sqrt())
    }
}

impl<T: Real> Add for Vec3<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<T: Real> Sub for Vec3<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<T: Real> Mul<T> for Vec3<T> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: T) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<T: Real> Neg for Vec3<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<T> From<[T; 3]> for Vec3<T> {
    #[inline]
    fn from([x, y, z]: [T; 3]) -> Self {
        Self { x, y, z }
    }
}

impl<T> From<Vec3<T>> for [T; 3] {
    #[inline]
    fn from(v: Vec3<T>) -> Self {
        [v.x, v.y, v.z]
    }
}
