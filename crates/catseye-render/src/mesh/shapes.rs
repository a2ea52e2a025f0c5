//! Simple shapes as meshes. The y axis points up.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use super::Mesh;

impl Mesh {
    /// A parallelogram: `origin`, `origin + u`, `origin + u + v`, `origin + v`. It faces `u` cross `v`.
    #[must_use]
    pub fn quad(origin: Vec3, u: Vec3, v: Vec3) -> Self {
        Self::grid([1, 1], |s, t| origin + u * s + v * t)
    }

    /// A surface `position(s, t)` over the unit square in `columns` by `rows` cells, flat shaded.
    #[must_use]
    pub fn grid([columns, rows]: [u32; 2], position: impl Fn(f32, f32) -> Vec3) -> Self {
        let mut mesh = Self::default();
        for row in 0..=rows {
            for column in 0..=columns {
                let uv = Vec2::new(column as f32 / columns as f32, row as f32 / rows as f32);
                mesh.positions.push(position(uv.x, uv.y));
                mesh.uvs.push(uv);
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let a = row * (columns + 1) + column;
                let (b, c, d) = (a + 1, a + columns + 2, a + columns + 1);
                mesh.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        mesh
    }

    /// A box with the given centre and size.
    #[must_use]
    pub fn cuboid(centre: Vec3, size: Vec3) -> Self {
        let mut mesh = Self::default();
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                let normal = Vec3::AXES[axis] * side;
                let u = Vec3::AXES[(axis + 1) % 3] * side;
                let v = normal.cross(u);
                let corner = centre + 0.5 * size * (normal - u - v);
                let quad = Self::quad(corner, u * size, v * size);
                mesh = if mesh.positions.is_empty() { quad } else { mesh.merged(&quad) };
            }
        }
        mesh
    }

    /// The surface that `profile`, points (radius, height), sweeps out around the y axis; outside is to the
    /// right of the profile's direction of travel when it runs upwards. Normals are smooth around the axis
    /// and flat along each piece of the profile.
    #[must_use]
    pub fn lathe(profile: &[[f32; 2]], segments: u32) -> Self {
        let mut mesh = Self::default();
        for piece in profile.windows(2) {
            let ([r0, y0], [r1, y1]) = (piece[0], piece[1]);
            let normal = Vec2::new(y1 - y0, r0 - r1);
            mesh.ring([r0, y0], [r1, y1], [normal, normal], segments);
        }
        mesh
    }

    /// As [`Mesh::lathe`], smooth along the profile too; it is a curve.
    #[must_use]
    pub fn smooth_lathe(profile: &[[f32; 2]], segments: u32) -> Self {
        let direction = |i: usize| {
            let (a, b) = (profile[i.saturating_sub(1)], profile[(i + 1).min(profile.len() - 1)]);
            Vec2::new(b[1] - a[1], a[0] - b[0])
        };
        let mut mesh = Self::default();
        for i in 1..profile.len() {
            mesh.ring(profile[i - 1], profile[i], [direction(i - 1), direction(i)], segments);
        }
        mesh
    }

    /// A sphere of triangles, for where a mesh is needed instead of [`Sphere`](crate::Sphere).
    #[must_use]
    pub fn uv_sphere(radius: f32, segments: u32) -> Self {
        let rings = segments / 2;
        let profile: Vec<_> = (0..=rings)
            .map(|i| {
                let (sin, cos) = (PI * i as f32 / rings as f32).sin_cos();
                [radius * sin.max(0.0), -radius * cos]
            })
            .collect();
        Self::smooth_lathe(&profile, segments)
    }

    /// Adds the band between two circles around the y axis; normals are given as (radial, up).
    fn ring(&mut self, low: [f32; 2], high: [f32; 2], normals: [Vec2; 2], segments: u32) {
        let first = self.positions.len() as u32;
        for i in 0..=segments {
            let u = i as f32 / segments as f32;
            // The seam closes exactly: its two sides are the same numbers.
            let (sin, cos) = (TAU * (i % segments) as f32 / segments as f32).sin_cos();
            for ([radius, y], normal, v) in [(low, normals[0], 0.0), (high, normals[1], 1.0)] {
                self.positions.push(Vec3::new(radius * sin, y, radius * cos));
                self.normals.push(Vec3::new(normal.x * sin, normal.y, normal.x * cos));
                self.uvs.push(Vec2::new(u, v));
            }
        }
        for i in 0..segments {
            let a = first + 2 * i;
            self.triangles.extend([[a, a + 2, a + 3], [a, a + 3, a + 1]]);
        }
    }
}
