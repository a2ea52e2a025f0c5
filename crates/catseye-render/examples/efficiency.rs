//! How noisy a picture is for the time that it takes: what a change of the integrator is judged by.
//!
//! `cargo run --release -p catseye-render --example efficiency`
//!
//! For three scenes, at 240 x 135 pixels and 16 samples: the root of the mean squared error against 1024
//! samples of another seed, of the picture as a screen shows it (a few specks would rule the error of the
//! radiance itself); the seconds of processor time that it takes, the shortest of three runs; and one over
//! squared error and seconds, which more samples don't change. Linux only: the time is read from /proc.

use std::fs;

use catseye::Model;
use catseye_materialx::{Closure, Material};
use catseye_render::glam::Vec3;
use catseye_render::light::{Environment, SphereLight};
use catseye_render::{Bsdf, Camera, Error, Image, Mesh, RenderSettings, Scene, SceneBuilder, Sphere, render};

fn main() -> Result<(), Error> {
    let matte = Material::of(Closure::OrenNayarDiffuse {
        weight: 1.0,
        color: [0.6, 0.5, 0.4],
        roughness: 0.2,
        energy_compensation: true,
    });
    println!("scene         RMSE      seconds   efficiency");
    for (name, scene) in [
        ("night", Scene::builtin(None, Model::Reciprocal)?),
        ("preview", Scene::preview(&matte, Model::Reciprocal)?),
        ("environment", under_a_sky()?),
    ] {
        let settings =
            RenderSettings { width: 240, height: 135, threads: Some(1), ..RenderSettings::default() };
        let reference = RenderSettings { spp: 1024, seed: 1, threads: None, ..settings.clone() };
        let reference = render(&scene, &reference, &|_| ())?.toned(scene.tone_map());
        let mut seconds = f64::INFINITY;
        let mut error = 0.0;
        for _ in 0..3 {
            let started = processor_seconds();
            let image = render(&scene, &settings, &|_| ())?;
            seconds = seconds.min(processor_seconds() - started);
            error = rmse(&image.toned(scene.tone_map()), &reference);
        }
        println!("{name:12}  {error:.6}  {seconds:7.3}   {:10.0}", 1.0 / (error * error * seconds));
    }
    Ok(())
}

/// A sphere on the ground under an even sky, and a lamp.
fn under_a_sky() -> Result<Scene, Error> {
    let camera = Camera::perspective(Vec3::new(0.0, 2.0, 7.0), Vec3::Y * 0.7, Vec3::Y, 0.6);
    let mut builder = SceneBuilder::new(camera);
    let ground = builder.material(Bsdf::matte(Vec3::splat(0.5)));
    let ball = builder.material(Bsdf::matte(Vec3::new(0.7, 0.4, 0.3)));
    builder.mesh(Mesh::quad(Vec3::new(-10.0, 0.0, 10.0), Vec3::X * 20.0, Vec3::NEG_Z * 20.0), ground);
    builder.sphere(Sphere { centre: Vec3::Y, radius: 1.0 }, ball);
    let lamp = Sphere { centre: Vec3::new(3.0, 4.0, 2.0), radius: 0.5 };
    builder.light(SphereLight::new(lamp, Vec3::splat(8.0)));
    builder.light(Environment::Constant(Vec3::splat(0.3)));
    builder.build()
}

/// Processor time that this process has taken.
fn processor_seconds() -> f64 {
    /// `USER_HZ`, the unit of /proc: `proc_pid_stat(5)`.
    const TICKS: f64 = 100.0;
    let stat = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // User and system time are the fields 14 and 15; the 2nd, in brackets, may have spaces.
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    fields.filter_map(|field| field.parse::<f64>().ok()).sum::<f64>() / TICKS
}

fn rmse(image: &Image, reference: &Image) -> f64 {
    let both = image.pixels().iter().flatten().zip(reference.pixels().iter().flatten());
    let squares: f64 = both.map(|(a, b)| f64::from(a - b).powi(2)).sum();
    (squares / (3 * image.pixels().len()) as f64).sqrt()
}
