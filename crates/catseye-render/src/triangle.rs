//! Where rays meet triangles.

use glam::Vec3;

use crate::Ray;

/// A ray prepared for many triangles: the map that makes it the z axis.
///
/// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013: no ray slips through an edge that
/// two triangles share.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShearedRay {
    origin: Vec3,
    axes: [usize; 3],
    shear: Vec3,
}

impl ShearedRay {
    pub(crate) fn new(ray: &Ray) -> Self {
        let d = ray.direction;
        let z = d.abs().max_position();
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        // Keep the winding where the axis is reversed.
        if d[z] < 0.0 {
            (x, y) = (y, x);
        }
        Self { origin: ray.origin, axes: [x, y, z], shear: Vec3::new(d[x], d[y], 1.0) / d[z] }
    }

    #[inline]
    fn shear(&self, point: Vec3) -> [f32; 3] {
        let p = point - self.origin;
        let [x, y, z] = self.axes;
        [p[x] - self.shear.x * p[z], p[y] - self.shear.y * p[z], self.shear.z * p[z]]
    }
}

/// The distance in `(0, t_max)` at which the ray meets the triangle, from either side.
#[inline]
pub(crate) fn intersect_triangle(ray: &ShearedRay, corners: &[Vec3; 3], t_max: f32) -> Option<f32> {
    let [a, b, c] = corners.map(|p| ray.shear(p));
    let mut edges = [c[0] * b[1] - c[1] * b[0], a[0] * c[1] - a[1] * c[0], b[0] * a[1] - b[1] * a[0]];
    if edges.contains(&0.0) {
        edges = [cross_f64(c, b), cross_f64(a, c), cross_f64(b, a)];
    }
    let [u, v, w] = edges;
    if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
        return None;
    }
    let determinant = u + v + w;
    if determinant == 0.0 {
        return None;
    }
    let t = (u * a[2] + v * b[2] + w * c[2]) / determinant;
    (t > 0.0 && t < t_max).then_some(t)
}

/// The edge function again, where single precision can't tell the side.
#[cold]
fn cross_f64(p: [f32; 3], q: [f32; 3]) -> f32 {
    (f64::from(p[0]) * f64::from(q[1]) - f64::from(p[1]) * f64::from(q[0])) as f32
}

/// The weights of the corners at a point of the triangle's plane.
#[inline]
pub(crate) fn barycentric(corners: &[Vec3; 3], point: Vec3) -> [f32; 3] {
    let [a, b, c] = *corners;
    let normal = (b - a).cross(c - a);
    let scale = 1.0 / normal.length_squared();
    let v = (a - c).cross(point - c).dot(normal) * scale;
    let w = (b - a).cross(point - a).dot(normal) * scale;
    let (v, w) = (v.clamp(0.0, 1.0), w.clamp(0.0, 1.0));
    [(1.0 - v - w).max(0.0), v, w]
}
