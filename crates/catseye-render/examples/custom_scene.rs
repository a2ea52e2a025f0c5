//! A scene of one's own: two spheres on a table, one of them retro-reflective, seen from beside the lamp.
//!
//! `cargo run --release -p catseye-render --example custom_scene -- spheres.png`

use std::path::PathBuf;

use catseye::{AnyLobe, Model, Params};
use catseye_render::light::{Environment, SphereLight};
use catseye_render::{
    Bsdf, Camera, Mesh, RenderSettings, SceneBuilder, Sphere, ToneMap, encode_png, glam::Vec3, render,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).map_or_else(|| PathBuf::from("spheres.png"), PathBuf::from);
    let eye = Vec3::new(0.0, 1.0, 6.0);
    let mut scene = SceneBuilder::new(Camera::perspective(eye, Vec3::Y * 0.4, Vec3::Y, 0.4));

    let lobe = AnyLobe::new(Model::Reciprocal, &Params::isotropic(0.3).with_tint([0.9, 0.6, 0.1]))?;
    let [retro, matte, table] =
        [Bsdf::from_lobe(lobe), Bsdf::matte(Vec3::new(0.9, 0.6, 0.1)), Bsdf::matte(Vec3::splat(0.2))]
            .map(|bsdf| scene.material(bsdf));
    scene.sphere(Sphere { centre: Vec3::new(-0.6, 0.5, 0.0), radius: 0.5 }, retro);
    scene.sphere(Sphere { centre: Vec3::new(0.6, 0.5, 0.0), radius: 0.5 }, matte);
    scene.mesh(Mesh::quad(Vec3::new(-9.0, 0.0, 6.0), Vec3::X * 18.0, Vec3::NEG_Z * 18.0), table);

    let lamp = Sphere { centre: eye + Vec3::X * 0.1, radius: 0.05 };
    scene.light(SphereLight::new(lamp, Vec3::splat(1500.0)));
    scene.light(Environment::Constant(Vec3::splat(0.02)));
    let settings = RenderSettings { width: 640, height: 360, ..RenderSettings::default() };
    let image = render(&scene.build()?, &settings, &|_| ())?;
    std::fs::write(path, encode_png(&image, &ToneMap::default())?)?;
    Ok(())
}
