//! Renders the built-in scene: `cargo run --release -p catseye-render --example night -- night.png [WIDTH [SPP]]`.

use std::path::PathBuf;
use std::time::Instant;

use catseye_render::{RenderSettings, Scene, render, write_exr, write_png};

fn main() -> Result<(), catseye_render::Error> {
    let mut args = std::env::args().skip(1);
    let path = args.next().map_or_else(|| PathBuf::from("night.png"), PathBuf::from);
    let default = RenderSettings::default();
    let width = args.next().and_then(|a| a.parse().ok()).unwrap_or(default.width);
    let spp = args.next().and_then(|a| a.parse().ok()).unwrap_or(default.spp);
    let scene = if std::env::var_os("PREVIEW").is_some() {
        Scene::preview(
            &catseye_materialx::Material {
                name: "preview".to_owned(),
                bsdf: catseye_materialx::Closure::RetroReflective {
                    weight: 1.0,
                    params: catseye::Params::isotropic(
                        std::env::var("PREVIEW").ok().and_then(|p| p.parse().ok()).unwrap_or(0.1),
                    )
                    .with_tint([0.9, 0.8, 0.3])
                    .with_multiscatter_tint([0.2, 0.2, 0.9]),
                    tangent_u: None,
                },
                opacity: 1.0,
            },
            catseye::Model::default(),
        )?
    } else {
        Scene::builtin(None, catseye::Model::default())?
    };
    let settings = RenderSettings { width, height: width * 9 / 16, spp, ..default };
    let start = Instant::now();
    let image = render(&scene, &settings, &|_| ())?;
    println!("{:.2} s", start.elapsed().as_secs_f32());
    if path.extension().is_some_and(|e| e == "exr") {
        write_exr(&image, &path)
    } else {
        write_png(&image, scene.tone_map(), &path)
    }
}
