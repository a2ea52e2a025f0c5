//! Flat shapes with an outline.

use glam::{Vec2, Vec3};

use super::Mesh;

impl Mesh {
    /// The inside of a simple polygon, counter-clockwise, in the plane z = 0 facing +z.
    ///
    /// A polygon that crosses itself gives some triangles, not necessarily sensible ones.
    #[must_use]
    pub fn polygon(outline: &[Vec2]) -> Self {
        Self {
            positions: outline.iter().map(|p| p.extend(0.0)).collect(),
            uvs: outline.to_vec(),
            triangles: cut_ears(outline),
            ..Self::default()
        }
    }

    /// The strip between two outlines with equally many points, in the plane z = 0 facing +z.
    #[must_use]
    pub fn border(outer: &[Vec2], inner: &[Vec2]) -> Self {
        let count = outer.len().min(inner.len()) as u32;
        let points: Vec<_> = outer.iter().zip(inner).flat_map(|(o, i)| [*o, *i]).collect();
        let strip = |i: u32| {
            let (a, b) = (2 * i, 2 * ((i + 1) % count));
            [[a, b, b + 1], [a, b + 1, a + 1]]
        };
        Self {
            positions: points.iter().map(|p| p.extend(0.0)).collect(),
            triangles: (0..count).flat_map(strip).collect(),
            uvs: points,
            ..Self::default()
        }
    }

    /// A plate: the polygon at z = 0, the same facing back at z = -`thickness`, and the rim.
    #[must_use]
    pub fn plate(outline: &[Vec2], thickness: f32) -> Self {
        let front = Self::polygon(outline);
        let mut back = front.clone().translated(Vec3::NEG_Z * thickness);
        for triangle in &mut back.triangles {
            triangle.swap(1, 2);
        }
        let mut plate = front.merged(&back);
        for (i, &a) in outline.iter().enumerate() {
            let b = outline[(i + 1) % outline.len()];
            let depth = Vec3::NEG_Z * thickness;
            plate = plate.merged(&Self::quad(a.extend(0.0) + depth, (b - a).extend(0.0), -depth));
        }
        plate
    }
}

/// A polygon's corners replaced by arcs of the given radius, each in `steps` pieces. For convex polygons.
pub(crate) fn rounded(corners: &[Vec2], radius: f32, steps: u32) -> Vec<Vec2> {
    let n = corners.len();
    let mut outline = Vec::new();
    for i in 0..n {
        let (before, corner, after) = (corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]);
        let (to_before, to_after) =
            ((before - corner).normalize_or_zero(), (after - corner).normalize_or_zero());
        let half_angle = 0.5 * to_before.angle_to(to_after).abs();
        let centre = corner + (to_before + to_after).normalize_or_zero() * (radius / half_angle.sin());
        let start = corner + to_before * (radius / half_angle.tan()) - centre;
        let turn = std::f32::consts::PI - 2.0 * half_angle;
        outline.extend(
            (0..=steps).map(|k| centre + Vec2::from_angle(turn * k as f32 / steps as f32).rotate(start)),
        );
    }
    outline
}

/// A regular polygon or, with many corners, a circle.
pub(crate) fn regular(corners: u32, radius: f32, first_angle: f32) -> Vec<Vec2> {
    let step = std::f32::consts::TAU / corners as f32;
    (0..corners).map(|i| radius * Vec2::from_angle(first_angle + step * i as f32)).collect()
}

/// Triangulates by cutting off one convex, empty corner after another.
fn cut_ears(outline: &[Vec2]) -> Vec<[u32; 3]> {
    let mut rest: Vec<u32> = (0..outline.len() as u32).collect();
    let mut triangles = Vec::new();
    while rest.len() > 3 {
        let n = rest.len();
        let corner = |i: usize| [rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]];
        let ear = (0..n).find(|&i| is_ear(outline, corner(i), &rest)).unwrap_or(0);
        triangles.push(corner(ear));
        rest.remove(ear);
    }
    if let [a, b, c] = rest[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

fn is_ear(outline: &[Vec2], corner: [u32; 3], rest: &[u32]) -> bool {
    let [a, b, c] = corner.map(|i| outline[i as usize]);
    let area = (b - a).perp_dot(c - b);
    area > 0.0
        && !rest.iter().any(|i| {
            let p = outline[*i as usize];
            !corner.contains(i)
                && (b - a).perp_dot(p - a) >= 0.0
                && (c - b).perp_dot(p - b) >= 0.0
                && (a - c).perp_dot(p - c) >= 0.0
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(mesh: &Mesh) -> f32 {
        let p = |i: u32| mesh.positions[i as usize];
        mesh.triangles.iter().map(|&[a, b, c]| 0.5 * (p(b) - p(a)).cross(p(c) - p(a)).z).sum()
    }

    #[test]
    fn concave_polygons_keep_their_area() {
        let star: Vec<_> = (0..10)
            .map(|i| [1.0, 0.4][i % 2] * Vec2::from_angle(std::f32::consts::PI * 0.2 * i as f32))
            .collect();
        let shoelace: f32 = (0..10).map(|i| 0.5 * star[i].perp_dot(star[(i + 1) % 10])).sum();
        let mesh = Mesh::polygon(&star);
        assert_eq!(mesh.triangles.len(), 8);
        assert!((area(&mesh) - shoelace).abs() < 1e-5);
    }

    #[test]
    fn rounding_cuts_the_corners_only() {
        let square = regular(4, 2.0_f32.sqrt(), 0.0);
        let mesh = Mesh::polygon(&rounded(&square, 0.25, 32));
        let expected = 4.0 - (4.0 - std::f32::consts::PI) * 0.25 * 0.25;
        assert!((area(&mesh) - expected).abs() < 1e-3);
    }
}
