//! Lights bring the irradiance that geometry says.

use std::f32::consts::PI;

use catseye_render::light::{AreaLight, Beam, DistantLight, Environment, LatLong, PointLight, SphereLight};
use catseye_render::{Bsdf, Camera, Image, Light, Mesh, Scene, SceneBuilder, Sphere};
use glam::Vec3;

use crate::common::{SMALL, picture};

/// A white Lambert plane around the origin, a spot of it seen from above.
fn plane_lit_by(light: impl Light + 'static) -> Scene {
    let camera = Camera::orthographic(Vec3::new(-0.3, 0.3, 0.3), Vec3::ZERO, Vec3::Z, 1e-3);
    let mut builder = SceneBuilder::new(camera);
    let white = builder.material(Bsdf::matte(Vec3::ONE));
    builder.mesh(Mesh::quad(Vec3::new(-50.0, 0.0, 50.0), Vec3::X * 100.0, Vec3::NEG_Z * 100.0), white);
    builder.light(light);
    builder.build().expect("a legal scene")
}

/// Irradiance at the origin as the picture shows it.
fn irradiance(light: impl Light + 'static, spp: u32) -> f32 {
    PI * picture(&plane_lit_by(light), SMALL, spp, 1).mean()[1]
}

fn assert_near(measured: f32, expected: f32, tolerance: f32) {
    assert!((measured / expected - 1.0).abs() < tolerance, "{measured}, expected {expected}");
}

#[test]
fn point_light() {
    let position = Vec3::new(1.0, 2.0, 0.0);
    let light = PointLight { position, intensity: Vec3::splat(10.0) };
    assert_near(irradiance(light, 1), 10.0 * 2.0 / 5.0_f32.powf(1.5), 1e-4);
}

#[test]
fn sphere_light() {
    // A sphere above the horizon: radiance times pi sin^2 cos, whatever its size.
    for radius in [1e-3, 0.3, 1.2] {
        let centre = Vec3::new(1.0, 2.0, 0.0);
        let light = SphereLight::new(Sphere { centre, radius }, Vec3::ONE);
        let expected = PI * radius * radius / 5.0 * 2.0 / 5.0_f32.sqrt();
        assert_near(irradiance(light, 64), expected, 4e-3);
    }
}

#[test]
fn headlamp() {
    let sphere = Sphere { centre: Vec3::new(0.0, 20.0, 0.0), radius: 0.07 };
    let axis = Vec3::NEG_Y;
    let straight = SphereLight::headlamp(sphere, Vec3::splat(400.0), Beam::new(axis, [0.2, 0.1]));
    assert_near(irradiance(straight, 16), 1.0, 2e-3);
    let turned = Vec3::new(0.1_f32.sin(), -(0.1_f32.cos()), 0.0);
    let aside = SphereLight::headlamp(sphere, Vec3::splat(400.0), Beam::new(turned, [0.1, 0.1]));
    assert_near(irradiance(aside, 16), 0.5, 5e-3);
}

#[test]
fn rectangle_and_disk() {
    // Small and far: intensity over squared distance.
    let rectangle = AreaLight::rectangle(Vec3::Y * 10.0, Vec3::X * 0.1, Vec3::Z * 0.05, Vec3::splat(100.0));
    assert_near(irradiance(rectangle, 16), 100.0 * 0.02 / 100.0, 2e-3);
    // A disk on the axis: pi L sin^2 exactly.
    let disk = AreaLight::disk(Vec3::Y * 2.0, Vec3::NEG_Y, 1.5, Vec3::ONE);
    assert_near(irradiance(disk, 256), PI * 2.25 / 6.25, 4e-3);
}

#[test]
fn distant_light() {
    let direction = Vec3::new(0.6, 0.8, 0.0);
    assert_near(irradiance(DistantLight::new(direction, 0.0045, Vec3::splat(5.0)), 4), 4.0, 1e-3);
}

#[test]
fn environments() {
    assert_near(irradiance(Environment::Constant(Vec3::ONE), 64), PI, 1e-3);
    // The upper half white: the same irradiance, found by sampling the picture.
    let half = Image::from_fn(64, 32, |_, y| if y < 16 { [1.0; 3] } else { [0.0; 3] });
    assert_near(irradiance(Environment::Image(LatLong::new(half)), 256), PI, 0.03);
    // One pixel: a small sun that only light sampling finds.
    let mut sun = Image::new(256, 128);
    sun.set_pixel(40, 20, [1000.0; 3]);
    let theta = 20.5 / 128.0 * PI;
    let expected = 1000.0 * (PI / 128.0).powi(2) * theta.sin() * theta.cos();
    assert_near(irradiance(Environment::Image(LatLong::new(sun)), 256), expected, 0.02);
}

#[test]
fn both_strategies_together_count_light_once() {
    // A light that fills much of the hemisphere, where both sampling strategies do well.
    let light = AreaLight::disk(Vec3::Y * 0.5, Vec3::NEG_Y, 2.0, Vec3::ONE);
    assert_near(irradiance(light, 256), PI * 4.0 / 4.25, 3e-3);
}

#[test]
fn paths_of_several_scatterings_choose_lights_without_bias() {
    // Inside a sphere of albedo a with lights of intensity I the radiance of direct and all later light is
    // known: the walls of an integrating sphere are lit evenly by the light that they scatter.
    let (albedo, radius) = (0.5_f32, 2.0);
    let camera = Camera::perspective(Vec3::new(0.0, 0.0, 1.0), Vec3::NEG_Z, Vec3::Y, 0.4);
    let mut builder = SceneBuilder::new(camera);
    let wall = builder.material(Bsdf::matte(Vec3::splat(albedo)));
    builder.sphere(Sphere { centre: Vec3::ZERO, radius }, wall);
    for intensity in [1.0, 0.02, 3.0] {
        builder.light(PointLight { position: Vec3::ZERO, intensity: Vec3::splat(intensity) });
    }
    let image = picture(&builder.build().unwrap(), SMALL, 256, 40);
    let direct = 4.02 / (radius * radius) * albedo / PI;
    assert_near(image.mean()[0], direct / (1.0 - albedo), 0.01);
}

#[test]
fn a_half_opaque_screen_halves_the_light_and_the_view() {
    let camera = Camera::orthographic(Vec3::new(0.0, 3.0, 0.0), Vec3::ZERO, Vec3::Z, 1e-3);
    let mut builder = SceneBuilder::new(camera);
    let white = builder.material(Bsdf::matte(Vec3::ONE));
    let black = builder.material_with_opacity(Bsdf::matte(Vec3::ZERO), 0.5);
    builder.mesh(Mesh::quad(Vec3::new(-5.0, 0.0, 5.0), Vec3::X * 10.0, Vec3::NEG_Z * 10.0), white);
    builder.mesh(Mesh::quad(Vec3::new(-5.0, 1.0, 5.0), Vec3::X * 10.0, Vec3::NEG_Z * 10.0), black);
    builder.light(PointLight { position: Vec3::Y * 2.0, intensity: Vec3::splat(4.0 * PI) });
    let image = picture(&builder.build().expect("a legal scene"), SMALL, 1024, 1);
    assert_near(image.mean()[0], 0.25, 0.02);
}

#[test]
fn a_mesh_that_refers_beyond_its_vertices_is_an_error() {
    let mut builder = SceneBuilder::new(Camera::orthographic(Vec3::Y, Vec3::ZERO, Vec3::Z, 1.0));
    let white = builder.material(Bsdf::matte(Vec3::ONE));
    let mut mesh = Mesh::quad(Vec3::ZERO, Vec3::X, Vec3::Z);
    mesh.triangles.push([0, 1, 4]);
    builder.mesh(mesh, white);
    let error = builder.build().unwrap_err().to_string();
    assert!(error.contains("triangle 2") && error.contains("of 4"), "{error}");
}
