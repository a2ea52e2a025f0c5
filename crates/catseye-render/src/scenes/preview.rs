//! A stage for one material.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use catseye::Model;
use catseye_materialx::Material;
use glam::Vec3;

use crate::light::{AreaLight, Environment, SphereLight};
use crate::{Bsdf, Camera, Error, Frame, Mesh, Scene, SceneBuilder, Shading, Sphere, ToneMap};

/// Where the camera stands.
const EYE: Vec3 = Vec3::new(0.0, 2.1, 11.0);
/// What it looks at.
const TARGET: Vec3 = Vec3::new(0.0, 0.78, 0.0);
/// Angle between camera and headlamp, seen from the target: the first observation angle of ASTM D4956's tables.
const OBSERVATION_ANGLE: f32 = 0.2 * PI / 180.0;
/// Irradiance at the target by the headlamp for a material that doesn't send much of it back.
const LAMP_IRRADIANCE: f32 = 0.8;
/// Radiance that the lamp is dimmed to where more would come back.
const LAMP_RETURN: f32 = 0.7;

/// Radiance that a path may bring of indirect light, about that of the white ball: the lamp is tiny and would make
/// specks.
const INDIRECT_LIMIT: f32 = 0.6;

pub(crate) fn scene(materials: [&Material; 2], model: Model) -> Result<Scene, Error> {
    let mut builder = SceneBuilder::new(Camera::perspective(EYE, TARGET, Vec3::Y, 0.235));
    let bsdfs = materials.map(|material| Bsdf::with_model(&material.surface.bsdf, model));
    let headlamp = headlamp(&bsdfs.into_iter().collect::<Result<Vec<_>, _>>()?);
    let [sphere, sheet] = materials.map(|material| builder.materialx(material, model));
    let ground = builder.material(Bsdf::matte(Vec3::splat(0.16)));
    let white = builder.material(Bsdf::matte(Vec3::splat(0.8)));

    builder.sphere(Sphere { centre: Vec3::new(-1.0, 0.9, 0.0), radius: 0.9 }, sphere?);
    builder.mesh(folded_sheet(), sheet?);
    builder.sphere(Sphere { centre: Vec3::new(0.12, 0.2, 1.0), radius: 0.2 }, white);
    builder.mesh(studio(), ground);
    builder.light(headlamp);
    add_panels(&mut builder);
    builder.light(Environment::Constant(Vec3::new(0.03, 0.035, 0.045)));
    builder.indirect_limit(INDIRECT_LIMIT);
    builder.tone_map(ToneMap { exposure_ev: 0.4, white: 4.0, glare: 0.01 });
    builder.build()
}

/// The lamp beside the camera, or behind it for a perfect retro-reflector, which shows nothing but the camera itself:
/// then it shines through the pinhole, as a beam splitter would let it.
fn headlamp(bsdfs: &[Bsdf]) -> SphereLight {
    let wo = (EYE - TARGET).normalize();
    // A surface 30 degrees from the line of sight.
    let normal = Frame::from_normal(wo).to_world(Vec3::new(0.5, 0.0, 0.75_f32.sqrt()));
    let shadings = || bsdfs.iter().map(|bsdf| bsdf.at(Frame::from_normal(normal), wo, false));
    let perfect = |shading: Shading<'_>| {
        (0..64).any(|i| {
            let u = std::array::from_fn(|k| sobol_burley::sample(i, k as u32, 0));
            shading.sample(u).is_some_and(|s| s.is_dirac && s.wi.dot(wo) > 0.999)
        })
    };
    if shadings().any(perfect) {
        return SphereLight::new(Sphere { centre: EYE + wo * 0.1, radius: 0.05 }, Vec3::splat(LAMP_RETURN));
    }
    let centre = EYE + Vec3::X * (EYE.distance(TARGET) * OBSERVATION_ANGLE.tan());
    let wi = (centre - TARGET).normalize();
    let most = shadings().map(|shading| shading.eval_pdf(wi).0.max_element()).fold(1e-6, f32::max);
    let irradiance = LAMP_IRRADIANCE.min(LAMP_RETURN / most);
    let intensity = irradiance * centre.distance_squared(TARGET);
    let sphere = Sphere { centre, radius: 0.006 };
    SphereLight::new(sphere, Vec3::splat(intensity / (PI * sphere.radius * sphere.radius)))
}

/// Soft lights: a warm one from the left, a cool one from behind on the right.
fn add_panels(builder: &mut SceneBuilder) {
    let mut panel = |centre: Vec3, half_size: f32, radiance: Vec3| {
        let frame = Frame::from_normal((Vec3::Y * 0.8 - centre).normalize());
        builder.light(AreaLight::rectangle(centre, frame.x * half_size, frame.y * half_size, radiance));
    };
    panel(Vec3::new(-6.0, 6.0, 3.5), 1.4, Vec3::new(1.0, 0.93, 0.84) * 7.0);
    panel(Vec3::new(5.5, 5.0, -2.5), 1.0, Vec3::new(0.6, 0.78, 1.0) * 12.0);
}

/// A sheet that waves like a flag: many angles between surface and camera in one piece.
fn folded_sheet() -> Mesh {
    let mut mesh = Mesh::grid([160, 40], |s, t| {
        let wave = 0.32 * (s * TAU * 1.5 + 0.4).sin();
        Vec3::new(0.42 + 1.55 * s, 0.0005 + 1.62 * t, wave - 0.2)
    });
    mesh.normals = smooth_normals(&mesh);
    mesh
}

/// A ground that bends up into a wall behind: no horizon.
fn studio() -> Mesh {
    const DEPTH: f32 = -3.5;
    const BEND: f32 = 3.0;
    let profile = |t: f32| match t {
        t if t < 0.4 => [12.0 + (DEPTH - 12.0) * t / 0.4, 0.0],
        t if t < 0.8 => {
            let angle = FRAC_PI_2 * (t - 0.4) / 0.4;
            [DEPTH - BEND * angle.sin(), BEND * (1.0 - angle.cos())]
        }
        t => [DEPTH - BEND, BEND + 40.0 * (t - 0.8)],
    };
    let mut mesh = Mesh::grid([1, 80], |s, t| {
        let [z, y] = profile(t);
        Vec3::new(60.0 * (s - 0.5), y, z)
    });
    mesh.normals = smooth_normals(&mesh);
    mesh
}

/// Normals averaged over the triangles around each vertex, by area.
fn smooth_normals(mesh: &Mesh) -> Vec<Vec3> {
    let mut normals = vec![Vec3::ZERO; mesh.positions.len()];
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
        for &i in triangle {
            normals[i as usize] += (b - a).cross(c - a);
        }
    }
    normals
}
