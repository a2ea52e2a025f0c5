//! `catseye render`: a path-traced picture.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::bail;
use catseye_materialx::Material;
use catseye_render::{RenderSettings, Scene, ToneMap, render, write_exr, write_png};
use clap::ValueEnum;
use serde_json::json;

use crate::args::ModelArg;
use crate::failure::Usage;
use crate::library::LibraryArgs;
use crate::output::Output;
use crate::progress::Progress;
use crate::{help, report};

/// Steps of the progress bar.
const STEPS: f32 = 1000.0;

/// Render a picture of the built-in scene or of a MaterialX material
///
/// Without a material: a road at night in the light of two headlamps beside the camera; on the left everything wears
/// retro-reflective sheeting, on the right the same colours as matte paint. With a material: a sphere and a folded sheet
/// of it, lit by a headlamp 0.2 degrees beside the camera.
#[derive(Debug, clap::Args)]
#[command(after_help = help::RENDER)]
pub(crate) struct Args {
    /// MaterialX document with the material to show
    #[arg(value_name = "MATERIAL.mtlx")]
    document: Option<PathBuf>,
    /// Picture to write: .png, or .exr with linear radiance
    #[arg(short, long, value_name = "FILE", default_value = "catseye.png")]
    output: PathBuf,
    /// Name of the surface material, where the document has several
    #[arg(long, value_name = "NAME", requires = "document")]
    material: Option<String>,
    #[command(flatten)]
    library: LibraryArgs,
    /// Scene to put it in [default: preview with a material, night without]
    #[arg(long, value_enum)]
    scene: Option<SceneArg>,
    /// Columns and rows of the picture
    #[arg(long, value_name = "WxH", default_value = "960x540", value_parser = parse_size)]
    size: (usize, usize),
    /// Samples per pixel: four times as many halve the noise (a PNG takes multiples of four)
    #[arg(long, value_name = "N", default_value_t = RenderSettings::default().spp, value_parser = clap::value_parser!(u32).range(1..))]
    spp: u32,
    /// Another number gives other noise
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// Threads [default: one per core]; the picture does not depend on their number
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Which lobe reflects
    #[arg(long, value_enum, default_value_t)]
    model: ModelArg,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
}

/// The scenes that a material can be shown in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum SceneArg {
    /// The road at night; the material replaces the sheeting
    Night,
    /// A sphere and a folded sheet
    Preview,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let started = Instant::now();
        let format = self.format()?;
        let output = Output::new(&self.output)?;
        let scene = self.load_scene()?;
        let oversampling = self.oversampling(format);
        let settings = self.settings(oversampling);
        let progress = Progress::new("rendering", STEPS as u64);
        let image = render(&scene, &settings, &|share| progress.set((share * STEPS) as u64))?;
        drop(progress);
        match format {
            Format::Png => {
                let shown = image.toned(scene.tone_map()).reduced(oversampling);
                write_png(&shown, &ToneMap::LINEAR, output.path())
            }
            Format::Exr => write_exr(&image, output.path()),
        }?;
        self.report(&output.name(), started.elapsed().as_secs_f64())
    }

    fn format(&self) -> anyhow::Result<Format> {
        let ending = self.output.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match ending.as_str() {
            "png" => Ok(Format::Png),
            "exr" => Ok(Format::Exr),
            _ => bail!(Usage(format!("{}: the name must end in .png or .exr", self.output.display()))),
        }
    }

    fn load_scene(&self) -> anyhow::Result<Scene> {
        let material = self.load_material()?;
        let model = self.model.0;
        let scene = match (self.scene, &material) {
            (Some(SceneArg::Preview), None) => {
                bail!(Usage("--scene preview needs a MATERIAL.mtlx to show".to_owned()))
            }
            (Some(SceneArg::Night), _) | (None, None) => Scene::builtin(material.as_ref(), model),
            (_, Some(material)) => Scene::preview(material, model),
        };
        Ok(scene?)
    }

    fn load_material(&self) -> anyhow::Result<Option<Material>> {
        let Some(path) = &self.document else { return Ok(None) };
        self.library.material(path, self.material.as_deref()).map(Some)
    }

    /// Columns and rows that are rendered for one of a PNG and averaged behind the tone curve: an edge between sheeting
    /// and the night, a hundred times darker, is only smooth on the screen where it is smoothed there.
    fn oversampling(&self, format: Format) -> usize {
        if format == Format::Png && self.spp >= 4 { 2 } else { 1 }
    }

    fn settings(&self, oversampling: usize) -> RenderSettings {
        let (width, height) = self.size;
        RenderSettings {
            width: width * oversampling,
            height: height * oversampling,
            spp: self.spp.div_ceil((oversampling * oversampling) as u32),
            seed: self.seed,
            threads: self.threads.map(usize::from),
            ..RenderSettings::default()
        }
    }

    fn report(&self, name: &str, seconds: f64) -> anyhow::Result<()> {
        let (width, height) = self.size;
        let spp = self.spp;
        let facts =
            json!({ "output": name, "width": width, "height": height, "spp": spp, "seconds": seconds });
        let text = format!("wrote {name} ({width} x {height}, {spp} samples per pixel, {seconds:.1} s)");
        report::print(self.json, &facts, &text)
    }
}

/// `WxH` as width and height.
fn parse_size(text: &str) -> Result<(usize, usize), String> {
    let parse = |number: &str| number.parse().ok().filter(|n| (1..=16384).contains(n));
    let size = text.split_once('x').and_then(|(width, height)| parse(width).zip(parse(height)));
    size.ok_or_else(|| "write it like 960x540, each number from 1 to 16384".to_owned())
}
