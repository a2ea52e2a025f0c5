//! Where rays meet triangles.

use glam::{Mat3A, Vec3, Vec3A};

use crate::Ray;

/// A ray prepared for many triangles: the shear that makes it the z axis.
///
/// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013: no ray slips through an
/// edge that two triangles share, because its end points are mapped alike for both.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShearedRay {
    origin: Vec3A,
    shear: Mat3A,
}

impl ShearedRay {
    pub(crate) fn new(ray: &Ray) -> Self {
        let d = ray.direction;
        let z = d.abs().max_position();
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        // x' = x - z d_x / d_z, y' alike, z' = z / d_z; the axes turned so that d_z is the largest component.
        let mut columns = [Vec3A::ZERO; 3];
        columns[x].x = 1.0;
        columns[y].y = 1.0;
        columns[z] = Vec3A::new(-d[x], -d[y], 1.0) / d[z];
        let [c0, c1, c2] = columns;
        Self { origin: ray.origin.into(), shear: Mat3A::from_cols(c0, c1, c2) }
    }

    #[inline]
    fn shear(&self, point: Vec3) -> Vec3A {
        self.shear * (Vec3A::from(point) - self.origin)
    }
}

/// The distance in `(0, t_max)` at which the ray meets the triangle, from either side.
#[inline]
pub(crate) fn intersect_triangle(ray: &ShearedRay, corners: &[Vec3; 3], t_max: f32) -> Option<f32> {
    let [a, b, c] = corners.map(|p| ray.shear(p));
    let cross = |p: Vec3A, q: Vec3A| p.x * q.y - p.y * q.x;
    let mut edges = [cross(c, b), cross(a, c), cross(b, a)];
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
    let t = (u * a.z + v * b.z + w * c.z) / determinant;
    (t > 0.0 && t < t_max).then_some(t)
}

/// The edge function again, where single precision can't tell the side.
#[cold]
fn cross_f64(p: Vec3A, q: Vec3A) -> f32 {
    (f64::from(p.x) * f64::from(q.y) - f64::from(p.y) * f64::from(q.x)) as f32
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_ray_slips_through_a_shared_edge() {
        let corners = [
            Vec3::new(0.1, 0.2, 0.3),
            Vec3::new(1.3, 0.15, -0.2),
            Vec3::new(0.9, 1.7, 0.4),
            Vec3::new(-0.4, 1.1, 0.05),
        ];
        let triangles = [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]];
        for i in 1..2000 {
            let target = corners[0].lerp(corners[2], i as f32 / 2000.0);
            let direction = (target - Vec3::new(0.3, -0.7, 5.0)).normalize();
            let ray = ShearedRay::new(&Ray::new(Vec3::new(0.3, -0.7, 5.0), direction));
            let hits = triangles.iter().filter_map(|t| intersect_triangle(&ray, t, f32::INFINITY)).count();
            assert!(hits >= 1, "ray {i}");
        }
    }

    #[test]
    fn distance_and_barycentric_coordinates_name_the_point() {
        let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y * 2.0];
        let ray = Ray::new(Vec3::new(0.25, 0.5, -3.0), Vec3::Z);
        let t = intersect_triangle(&ShearedRay::new(&ray), &triangle, f32::INFINITY).unwrap();
        assert!((t - 3.0).abs() < 1e-6);
        let weights = barycentric(&triangle, ray.at(t));
        assert!(weights.iter().zip([0.5, 0.25, 0.25]).all(|(w, e)| (w - e).abs() < 1e-6), "{weights:?}");
        assert!(intersect_triangle(&ShearedRay::new(&ray), &triangle, 2.9).is_none());
    }
}
