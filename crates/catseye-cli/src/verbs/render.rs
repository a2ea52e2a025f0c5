//! `catseye render`: a path-traced picture.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context as _, bail};
use catseye_materialx::{Document, Look, Material};
use catseye_render::{PictureInfo, RenderSettings, Scene, ToneMap, encode_exr, encode_png, render};
use clap::ValueEnum;
use serde_json::json;

use crate::failure::Usage;
use crate::options::{LibraryArgs, ModelArg};
use crate::output::{self, Output};
use crate::progress::Progress;
use crate::{help, report};

/// Columns and rows of the largest picture that is rendered.
const LARGEST: usize = 16384;
/// Steps of the progress bar.
const STEPS: f32 = 1000.0;

/// Render a picture of the built-in scene or of a MaterialX material
///
/// Without a material: a road at night in the light of two headlamps beside the camera; on the left everything wears
/// retro-reflective sheeting, on the right the same colours as matte paint. With a material: a sphere and a folded sheet
/// of it, lit by a headlamp 0.2 degrees beside the camera.
///
/// Pictures that a material looks up may be PNG, JPEG, EXR, TIFF, HDR, TGA, BMP or GIF.
///
/// A look assigns materials to the paths /preview/sphere and /preview/sheet, or, with --scene night, to /night/signs,
/// /night/cones, /night/studs and /night/posts.
#[derive(Debug, clap::Args)]
#[command(after_help = help::RENDER)]
pub(crate) struct Args {
    /// MaterialX document with the material to show
    #[arg(value_name = "MATERIAL.mtlx")]
    document: Option<PathBuf>,
    /// Picture to write: .png, or .exr with linear radiance; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "catseye.png")]
    output: PathBuf,
    /// Format of the picture [default: by the file's ending; PNG on standard output]
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Name of the surface material, where the document has several
    #[arg(long, value_name = "NAME", requires = "document")]
    material: Option<String>,
    /// Look of the document, which assigns its materials to the scene's geometry
    #[arg(long, value_name = "NAME", requires = "document", conflicts_with = "material")]
    look: Option<String>,
    #[command(flatten)]
    library: LibraryArgs,
    /// Scene to put it in [default: preview with a material, night without]
    #[arg(long, value_enum)]
    scene: Option<SceneArg>,
    /// Columns and rows of the picture
    #[arg(long, value_name = "WxH", default_value = "960x540", value_parser = parse_size, allow_hyphen_values = true)]
    size: (usize, usize),
    /// Samples per pixel: four times as many halve the noise (a PNG takes 1 to 3, or rounds up to a multiple of 4)
    #[arg(long, value_name = "N", default_value_t = RenderSettings::default().spp, value_parser = clap::value_parser!(u32).range(1..))]
    spp: u32,
    /// Another number gives other noise
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// Threads, 1 to 256 [default: one per core]; the picture does not depend on their number
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
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

/// The picture's file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// 8 bits per channel, as shown on a screen
    Png,
    /// Linear radiance
    Exr,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let started = Instant::now();
        let format = output::format(&self.output, self.format)?;
        let output = Output::new(&self.output)?;
        let scene = self.load_scene()?;
        let oversampling = self.oversampling(format);
        let settings = self.settings(oversampling)?;
        let progress = Progress::new("rendering", STEPS as u64);
        let image = render(&scene, &settings, &|share| progress.set((share * STEPS) as u64))?;
        drop(progress);
        let bytes = match format {
            Format::Png => encode_png(&image.toned(scene.tone_map()).reduced(oversampling), &ToneMap::LINEAR),
            Format::Exr => encode_exr(&image, &PictureInfo::default()),
        };
        output.write(&bytes?)?;
        let spp = settings.spp * (oversampling * oversampling) as u32;
        self.report(&output, spp, started.elapsed().as_secs_f64())
    }

    fn load_scene(&self) -> anyhow::Result<Scene> {
        let model = self.model.0;
        let scene = match (&self.document, self.scene) {
            (None, Some(SceneArg::Preview)) => {
                bail!(Usage("--scene preview needs a MATERIAL.mtlx to show".to_owned()))
            }
            (None, _) => Scene::builtin(None, model),
            (Some(path), Some(SceneArg::Night)) => {
                let sheeting = self.materials(path, &Scene::BUILTIN_GEOMETRY)?;
                Scene::builtin_of(std::array::from_fn(|i| sheeting[i].as_ref()), model)
            }
            (Some(path), _) => {
                let materials = self.materials(path, &Scene::PREVIEW_GEOMETRY)?;
                let [Some(sphere), Some(sheet)] = &materials[..] else {
                    let geometry = Scene::PREVIEW_GEOMETRY.join(" or ");
                    bail!("{}: the look assigns nothing to {geometry}", path.display())
                };
                Scene::preview_of([sphere, sheet], model)
            }
        };
        Ok(scene?)
    }

    /// The material of each of a scene's parts: the look's, or the same one for all of them.
    fn materials(&self, path: &Path, geometry: &[&str]) -> anyhow::Result<Vec<Option<Material>>> {
        let Some(name) = &self.look else {
            let material = self.library.material(path, self.material.as_deref())?;
            return Ok(vec![Some(material); geometry.len()]);
        };
        let document = Document::load_with(path, &self.library.load()?)?;
        let look = look(&document, name)?;
        let material = |path: &&str| look.material(path).map(|name| document.material(Some(name)));
        let materials: Vec<Option<Material>> =
            geometry.iter().map(|path| material(path).transpose()).collect::<Result<_, _>>()?;
        if materials.iter().all(Option::is_none) {
            bail!("{}: the look assigns nothing to {}", path.display(), geometry.join(", "));
        }
        let shown = materials.iter().flatten().flat_map(|material| material.warnings.clone());
        for warning in document.warnings().into_iter().chain(shown).collect::<BTreeSet<_>>() {
            report::warn(warning);
        }
        Ok(materials)
    }

    /// Columns and rows that are rendered for one of a PNG and averaged behind the tone curve: an edge between sheeting
    /// and the night, a hundred times darker, is only smooth on the screen where it is smoothed there.
    fn oversampling(&self, format: Format) -> usize {
        if format == Format::Png && self.spp >= 4 { 2 } else { 1 }
    }

    fn settings(&self, oversampling: usize) -> anyhow::Result<RenderSettings> {
        let (width, height) = self.size;
        let most = LARGEST / oversampling;
        if width > most || height > most {
            bail!(Usage(format!(
                "--size {width}x{height}: a PNG of 4 samples per pixel or more, which is made from a picture of twice the \
                 size, has at most {most} columns and rows; write an EXR, or take --spp 1 to 3"
            )));
        }
        Ok(RenderSettings {
            width: width * oversampling,
            height: height * oversampling,
            spp: self.spp.div_ceil((oversampling * oversampling) as u32),
            seed: self.seed,
            threads: self.threads.map(usize::from),
            ..RenderSettings::default()
        })
    }

    /// Says what was written; `spp` are the samples that a pixel got.
    fn report(&self, output: &Output, spp: u32, seconds: f64) -> anyhow::Result<()> {
        let (width, height) = self.size;
        let name = output.name();
        let facts =
            json!({ "output": name, "width": width, "height": height, "spp": spp, "seconds": seconds });
        let text = format!("wrote {name} ({width} x {height}, {spp} samples per pixel, {seconds:.1} s)");
        output.messages().note(self.json, &facts, &text)
    }
}

/// The look of this name.
fn look(document: &Document, name: &str) -> anyhow::Result<Look> {
    let looks = document.looks()?;
    let names: Vec<String> = looks.iter().map(|look| look.name.clone()).collect();
    let found = looks.into_iter().find(|look| look.name == name);
    found.with_context(|| match &names[..] {
        [] => format!("{}: no look {name:?}; it has no looks", document.name()),
        names => format!("{}: no look {name:?}; its looks: {}", document.name(), names.join(", ")),
    })
}

/// `WxH` as width and height.
fn parse_size(text: &str) -> Result<(usize, usize), String> {
    let parse = |number: &str| number.parse().ok().filter(|n| (1..=LARGEST).contains(n));
    let size = text.split_once('x').and_then(|(width, height)| parse(width).zip(parse(height)));
    size.ok_or_else(|| format!("write it like 960x540, each number from 1 to {LARGEST}"))
}
