//! A point on a surface, and what there is to know of it.

use std::f32::consts::{PI, TAU};

use catseye_materialx::ShadingPoint;
use glam::{Vec2, Vec3};

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

/// Texture coordinates of a triangle's corners; zeros where there are none.
pub(crate) fn texcoords(mesh: &Mesh, triangle: [u32; 3]) -> [Vec2; 3] {
    if mesh.uvs.is_empty() { [Vec2::ZERO; 3] } else { triangle.map(|i| mesh.uvs[i as usize]) }
}

/// The point as patterns see it.
pub(crate) fn shading_point(
    hit: &Hit,
    view: Vec3,
    primitive: &Primitive,
    texcoords: [Vec2; 3],
) -> ShadingPoint {
    let (position_object, texcoord, bitangent) = match primitive {
        Primitive::Triangle(corners) => {
            let [u, v, w] = barycentric(corners, hit.position);
            let texcoord = texcoords[0] * u + texcoords[1] * v + texcoords[2] * w;
            (hit.position, texcoord, bitangent(corners, texcoords))
        }
        Primitive::Sphere(sphere) => {
            let n = (hit.position - sphere.centre) / sphere.radius;
            let longitude = n.x.atan2(n.z) / TAU + 0.5;
            let latitude = n.y.clamp(-1.0, 1.0).asin() / PI + 0.5;
            (hit.position - sphere.centre, Vec2::new(longitude, latitude), Vec3::ZERO)
        }
    };
    let [tangent, normal] = [hit.frame.x, hit.frame.z];
    // The frame's y is the bitangent of a right-handed surface seen from outside.
    let outside = if hit.inside { -hit.frame.y } else { hit.frame.y };
    let bitangent = if bitangent.dot(outside) < 0.0 { -outside } else { outside };
    ShadingPoint {
        position: hit.position.to_array(),
        position_object: position_object.to_array(),
        normal: normal.to_array(),
        tangent: tangent.to_array(),
        bitangent: bitangent.to_array(),
        texcoord: texcoord.to_array(),
        view: view.to_array(),
    }
}

/// The derivative of the position by v, up to a positive factor.
fn bitangent([p0, p1, p2]: &[Vec3; 3], [t0, t1, t2]: [Vec2; 3]) -> Vec3 {
    let (e1, e2, f1, f2) = (*p1 - *p0, *p2 - *p0, t1 - t0, t2 - t0);
    let orientation = f1.perp_dot(f2).signum();
    orientation * (e2 * f1.x - e1 * f2.x)
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
    /// The primitive's number, for what few materials ask.
    pub(crate) primitive: u32,
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
        let (material, primitive) = (attributes.material, 0);
        Self { t, position, normal: normal * side, frame, inside, color, material, primitive }
    }
}
