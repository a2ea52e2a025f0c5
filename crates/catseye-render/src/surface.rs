//! A point on a surface, and what there is to know of it.

use glam::Vec3;

use crate::accel::Primitive;
use crate::triangle::barycentric;
use crate::{Frame, Mesh, Ray};

/// What a primitive carries besides its shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attributes {
    material: u32,
    /// Shading normals of the corners.
    normals: Option<[Vec3; 3]>,
    /// Colours of the corners.
    colors: Option<[Vec3; 3]>,
    /// The direction of increasing u; zero where there are no texture coordinates.
    tangent: Vec3,
}

impl Attributes {
    pub(crate) fn of_triangle(mesh: &Mesh, triangle: [u32; 3], material: u32) -> Self {
        let corners = |list: &[Vec3]| (!list.is_empty()).then(|| triangle.map(|i| list[i as usize]));
        Self {
            material,
            normals: corners(&mesh.normals),
            colors: corners(&mesh.colors),
            tangent: tangent(mesh, triangle),
        }
    }

    pub(crate) fn of_sphere(material: u32) -> Self {
        Self { material, normals: None, colors: None, tangent: Vec3::ZERO }
    }
}

/// The derivative of the position by u, from the linear map between texture and space.
fn tangent(mesh: &Mesh, triangle: [u32; 3]) -> Vec3 {
    if mesh.uvs.is_empty() {
        return Vec3::ZERO;
    }
    let [p0, p1, p2] = triangle.map(|i| mesh.positions[i as usize]);
    let [t0, t1, t2] = triangle.map(|i| mesh.uvs[i as usize]);
    let (e1, e2, f1, f2) = (p1 - p0, p2 - p0, t1 - t0, t2 - t0);
    let orientation = f1.perp_dot(f2).signum();
    (orientation * (e1 * f2.y - e2 * f1.y)).normalize_or_zero()
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    /// Distance along the ray.
    pub(crate) t: f32,
    pub(crate) position: Vec3,
    /// The geometric normal on the side the ray comes from.
    pub(crate) normal: Vec3,
    /// The shading frame on the side the ray comes from.
    pub(crate) frame: Frame,
    /// Whether the ray comes from the inside.
    pub(crate) inside: bool,
    /// Factor on the BSDF.
    pub(crate) color: Vec3,
    pub(crate) material: u32,
}

impl Hit {
    pub(crate) fn new(ray: &Ray, t: f32, primitive: &Primitive, attributes: &Attributes) -> Self {
        let (position, normal, shading_normal, color, tangent) = match primitive {
            Primitive::Triangle(corners) => {
                let [u, v, w] = barycentric(corners, ray.at(t));
                let mix = |values: [Vec3; 3]| values[0] * u + values[1] * v + values[2] * w;
                let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or(Vec3::Y);
                let shading_normal =
                    attributes.normals.and_then(|n| mix(n).try_normalize()).unwrap_or(normal);
                let color = attributes.colors.map_or(Vec3::ONE, mix);
                // From the corners, not along the ray: the error doesn't grow with the distance.
                (mix(*corners), normal, shading_normal, color, attributes.tangent)
            }
            Primitive::Sphere(sphere) => {
                let normal = (ray.at(t) - sphere.centre).normalize_or(-ray.direction);
                let position = sphere.centre + normal * sphere.radius;
                (position, normal, normal, Vec3::ONE, Vec3::Y.cross(normal))
            }
        };
        let inside = normal.dot(ray.direction) > 0.0;
        let side = if inside { -1.0 } else { 1.0 };
        let mut facing = shading_normal * side;
        // A shading normal that the ray can't see.
        if facing.dot(ray.direction) >= 0.0 {
            facing = normal * side;
        }
        let frame = Frame::from_normal_tangent(facing, tangent);
        Self { t, position, normal: normal * side, frame, inside, color, material: attributes.material }
    }
}
