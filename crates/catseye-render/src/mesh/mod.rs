//! Triangle meshes.

pub(crate) mod polygon;
mod shapes;

use glam::{Affine3A, Vec2, Vec3};

/// Triangles that share vertices. Attributes are given per vertex; an empty list means that there are none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Where the vertices are.
    pub positions: Vec<Vec3>,
    /// Shading normals, any length; without them the triangles are flat.
    pub normals: Vec<Vec3>,
    /// Texture coordinates; the tangent points along increasing u.
    pub uvs: Vec<Vec2>,
    /// Factors on the material's BSDF, in `[0, 1]`.
    pub colors: Vec<Vec3>,
    /// Three vertices each, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The mesh moved by an affine map; normals stay perpendicular to the surface.
    #[must_use]
    pub fn transformed(mut self, transform: Affine3A) -> Self {
        let for_normals = transform.matrix3.inverse().transpose();
        for position in &mut self.positions {
            *position = transform.transform_point3(*position);
        }
        for normal in &mut self.normals {
            *normal = for_normals * *normal;
        }
        self
    }

    /// The mesh moved by a vector.
    #[must_use]
    pub fn translated(self, by: Vec3) -> Self {
        self.transformed(Affine3A::from_translation(by))
    }

    /// The mesh turned about an axis (unit length) through the origin, by an angle in radians.
    #[must_use]
    pub fn rotated(self, axis: Vec3, angle: f32) -> Self {
        self.transformed(Affine3A::from_axis_angle(axis, angle))
    }

    /// Both meshes in one. An attribute that only one of them has is dropped.
    #[must_use]
    pub fn merged(mut self, other: &Self) -> Self {
        let offset = self.positions.len() as u32;
        append(&mut self.normals, &other.normals);
        append(&mut self.uvs, &other.uvs);
        append(&mut self.colors, &other.colors);
        self.positions.extend(&other.positions);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + offset)));
        self
    }

    /// What does not fit in the mesh, if anything.
    pub(crate) fn problem(&self) -> Option<String> {
        let count = self.positions.len();
        for (name, len) in
            [("normals", self.normals.len()), ("uvs", self.uvs.len()), ("colors", self.colors.len())]
        {
            if len != 0 && len != count {
                return Some(format!("{len} {name} for {count} vertices"));
            }
        }
        if let Some(i) = self.positions.iter().position(|p| !p.is_finite()) {
            return Some(format!("vertex {i} is not finite"));
        }
        let bad = self.triangles.iter().position(|t| t.iter().any(|&i| i as usize >= count));
        bad.map(|i| format!("triangle {i} refers to a vertex beyond the last of {count}"))
    }
}

fn append<T: Clone>(list: &mut Vec<T>, other: &[T]) {
    if list.is_empty() || other.is_empty() {
        list.clear();
    } else {
        list.extend_from_slice(other);
    }
}
