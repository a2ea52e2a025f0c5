//! The retro-reflective peak as a picture shows it: radiance is the BSDF in closed form.

use catseye::{AnyLobe, Lobe as _, Model, Params};
use catseye_render::light::{PointLight, SphereLight};
use catseye_render::{Bsdf, Camera, Frame, Light, Mesh, SceneBuilder, Sphere};
use glam::Vec3;

use crate::common::picture;

const DISTANCE: f32 = 15.0;
/// A panel turned 20 degrees away, and a lamp of 1000 units of intensity.
const ENTRANCE_ANGLE: f32 = 0.35;
const INTENSITY: f32 = 1000.0;

/// Radiance of a panel seen from the camera, and in closed form for a point-like lamp.
fn seen_and_expected(roughness: f32, observation_angle: f32, lamp_radius: f32) -> [f32; 2] {
    let params = Params::isotropic(roughness).with_tint([0.1, 0.5, 1.0]);
    let lobe = AnyLobe::<f32>::new(Model::Reciprocal, &params).expect("legal parameters");
    // Before the lamp, so that it isn't in the way.
    let eye = Vec3::Z * (0.5 * DISTANCE);
    let lamp = DISTANCE * Vec3::new(observation_angle.sin(), 0.0, observation_angle.cos());
    let mut builder = SceneBuilder::new(Camera::perspective(eye, Vec3::ZERO, Vec3::Y, 1e-5));
    let sheeting = builder.material(Bsdf::from_lobe(lobe));
    let panel = Mesh::quad(Vec3::new(-0.5, -0.5, 0.0), Vec3::X, Vec3::Y).rotated(Vec3::Y, ENTRANCE_ANGLE);
    builder.mesh(panel, sheeting);
    let light: Box<dyn Light> = if lamp_radius == 0.0 {
        Box::new(PointLight { position: lamp, intensity: Vec3::splat(INTENSITY) })
    } else {
        let area = std::f32::consts::PI * lamp_radius * lamp_radius;
        let sphere = Sphere { centre: lamp, radius: lamp_radius };
        Box::new(SphereLight::new(sphere, Vec3::splat(INTENSITY / area)))
    };
    builder.boxed_light(light);
    let seen = picture(&builder.build().expect("a legal scene"), [2, 2], 256, 1).mean()[1];

    let frame = Frame::from_normal(Vec3::new(ENTRANCE_ANGLE.sin(), 0.0, ENTRANCE_ANGLE.cos()));
    let local = |w: Vec3| catseye::Vec3::from(frame.to_local(w).to_array());
    let (wo, wi) = (local(Vec3::Z), local(lamp / DISTANCE));
    [seen, lobe.eval(wo, wi)[1] * wi.z * INTENSITY / (DISTANCE * DISTANCE)]
}

#[test]
fn point_lamp_beside_the_camera() {
    for roughness in [0.003, 0.006, 0.02, 0.3] {
        for angle_deg in [0.0_f32, 0.2, 0.5] {
            let [seen, expected] = seen_and_expected(roughness, angle_deg.to_radians(), 0.0);
            // Rounding of f32 directions moves the flank of the narrowest lobe.
            let tolerance = 5e-3 * expected + 1e-3;
            assert!(
                (seen - expected).abs() <= tolerance,
                "r {roughness}, {angle_deg} deg: {seen}, {expected}"
            );
        }
    }
}

#[test]
fn lamp_with_an_extent() {
    // Small against the lobe: the mean over the lamp is the value at its centre.
    for roughness in [0.02, 0.3] {
        let [seen, expected] = seen_and_expected(roughness, 0.2_f32.to_radians(), 0.01);
        assert!((seen / expected - 1.0).abs() < 5e-3, "r {roughness}: {seen}, {expected}");
    }
}

#[test]
fn a_narrow_lobe_sees_the_whole_of_a_wide_lamp() {
    // The lobe fits into the lamp: radiance times albedo, found by scattered rays.
    let [seen, _] = seen_and_expected(0.003, 0.0, 1.0);
    let radiance = INTENSITY / std::f32::consts::PI;
    assert!((seen / (0.5 * radiance) - 1.0).abs() < 5e-3, "{seen} {radiance}");
}
