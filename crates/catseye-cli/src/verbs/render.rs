//! `catseye render`: a path-traced picture.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context as _, bail};
use catseye_materialx::{Document, Look, Material};
use catseye_photometry::{luminance, significant};
use catseye_render::{
    Image, Lighting, PictureInfo, RenderSettings, Scene, ToneMap, encode_exr, encode_png, encode_srgb, render,
};
use clap::ValueEnum;
use serde_json::json;

use crate::failure::Usage;
use crate::options::{LibraryArgs, ModelArg};
use crate::output::{self, Output};
use crate::plot::sheet::{Sheet, Tile};
use crate::progress::Progress;
use crate::{help, report};

/// Columns and rows of the largest picture that is rendered.
const LARGEST: usize = 16384;
/// Pictures side by side.
const MAX_LAMPS: usize = 4;
/// Steps of the progress bar.
const STEPS: f32 = 1000.0;

/// Render a picture of the built-in scene or of a MaterialX material
///
/// Without a material: a road at night in the light of two headlamps beside the camera; the signs, cones'
/// bands, posts' reflectors and studs on the left wear retro-reflective sheeting, those on the right matte
/// paint of the same colours. With a material: a sphere and a folded sheet of it, lit by a headlamp 0.2
/// degrees beside the camera. Lamp and exposure are the same for every material, so that pictures compare.
///
/// Pictures that a material looks up may be PNG, JPEG, EXR, TIFF, HDR, TGA, BMP or GIF.
///
/// A look assigns materials to the paths /preview/sphere and /preview/sheet, or, with --scene night, to
/// /night/signs, /night/cones, /night/studs and /night/posts.
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
    /// Samples per pixel: four times as many halve the noise (a PNG takes 1 to 3, or rounds up to a multiple
    /// of 4)
    #[arg(long, value_name = "N", default_value_t = RenderSettings::default().spp, value_parser = clap::value_parser!(u32).range(1..))]
    spp: u32,
    /// Stops to add to the scene's exposure, or auto: the exposure that suits this picture
    #[arg(long, value_name = "EV|auto", default_value = "0", allow_negative_numbers = true, value_parser = parse_exposure)]
    exposure: Exposure,
    /// Angle between camera and headlamp, seen from the material: the observation angle [default: the
    /// scene's]; for several, 4 at most, a PNG shows the pictures side by side
    #[arg(long, value_name = "DEG,...", value_delimiter = ',', value_parser = parse_lamp)]
    lamp_deg: Vec<f32>,
    /// Write below a PNG what it shows: the lamp's angle, or the luminances of the built-in scene's signs
    #[arg(long)]
    labels: bool,
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

/// What `--exposure` asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Exposure {
    /// Stops to add to the scene's.
    Stops(f32),
    /// What suits the picture.
    Auto,
}

impl Exposure {
    fn tone_map(self, scene: &Scene, image: &Image) -> ToneMap {
        let tone_map = *scene.tone_map();
        match self {
            Self::Stops(stops) => ToneMap { exposure_ev: tone_map.exposure_ev + stops, ..tone_map },
            Self::Auto => tone_map.fitted(image),
        }
    }
}

/// The picture's file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// 8 bits per channel, as shown on a screen
    Png,
    /// Linear radiance
    Exr,
}

/// What is shown: the built-in scene with materials for its parts, or a sphere and a sheet.
enum Subject {
    Night(Vec<Option<Material>>),
    Preview(Box<[Material; 2]>),
}

impl Subject {
    fn scene(&self, lighting: Lighting) -> anyhow::Result<Scene> {
        Ok(match self {
            Self::Night(sheeting) => {
                let of = |i: usize| sheeting.get(i).and_then(Option::as_ref);
                Scene::builtin_of(std::array::from_fn(of), lighting)?
            }
            Self::Preview(materials) => Scene::preview_of(materials.each_ref(), lighting)?,
        })
    }
}

/// A picture and what it shows.
struct Shot {
    image: Image,
    tone_map: ToneMap,
    info: PictureInfo,
    /// Luminances of the left and of the right sign's white in the built-in scene.
    signs: Option<[f64; 2]>,
}

impl Shot {
    fn label(&self) -> String {
        match self.signs {
            Some([left, right]) => format!(
                "Luminance of the signs' white: left {}, right {} cd/m\u{b2}, a ratio of {:.0}",
                significant(left, 2),
                significant(right, 2),
                left / right
            ),
            None => format!("headlamp {}\u{b0} beside the camera", self.info.lamp_deg.unwrap_or_default()),
        }
    }

    /// As a screen shows it, each pixel the mean of some that were rendered.
    fn shown(&self, oversampling: usize) -> Image {
        self.image.toned(&self.tone_map).reduced(oversampling)
    }
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let started = Instant::now();
        let format = output::format(&self.output, self.format)?;
        let output = Output::new(&self.output)?;
        let lamps = self.lamps(format)?;
        let oversampling = self.oversampling(format);
        let settings = self.settings(oversampling)?;
        let subject = self.subject()?;
        let shots = lamps.iter().map(|lamp| self.shot(&subject, *lamp, &settings));
        let shots = shots.collect::<anyhow::Result<Vec<_>>>()?;
        output.write(&self.encode(&shots, format, oversampling)?)?;
        let spp = settings.spp * (oversampling * oversampling) as u32;
        self.report(&output, &shots, spp, started.elapsed().as_secs_f64())
    }

    /// The lamp's angle in each picture; `None` is the scene's own.
    fn lamps(&self, format: Format) -> anyhow::Result<Vec<Option<f32>>> {
        let angles = &self.lamp_deg;
        if angles.len() > MAX_LAMPS || format == Format::Exr && (angles.len() > 1 || self.labels) {
            bail!(Usage(format!(
                "--lamp-deg takes 1 to {MAX_LAMPS} angles, an EXR one picture without --labels"
            )));
        }
        Ok(if angles.is_empty() { vec![None] } else { angles.iter().copied().map(Some).collect() })
    }

    fn shot(
        &self,
        subject: &Subject,
        lamp_deg: Option<f32>,
        settings: &RenderSettings,
    ) -> anyhow::Result<Shot> {
        let scene = subject.scene(Lighting { model: self.model.0, lamp_deg })?;
        let progress = Progress::new("rendering", STEPS as u64);
        let image = render(&scene, settings, &|share| progress.set((share * STEPS) as u64))?;
        let tone_map = self.exposure.tone_map(&scene, &image);
        let exposure_ev = Some(tone_map.exposure_ev);
        let info = PictureInfo { command: command(), exposure_ev, ..scene.info().clone() };
        let is_night = matches!(subject, Subject::Night(_));
        let signs = is_night.then(|| Scene::BUILTIN_SIGN_WHITES.map(|at| luminance_at(&image, at)));
        Ok(Shot { image, tone_map, info, signs })
    }

    fn encode(&self, shots: &[Shot], format: Format, oversampling: usize) -> anyhow::Result<Vec<u8>> {
        Ok(match (format, shots) {
            (Format::Exr, [first, ..]) => encode_exr(&first.image, &first.info)?,
            (Format::Png, [only]) if !self.labels => encode_png(&only.shown(oversampling), &ToneMap::LINEAR)?,
            _ => self.sheet(shots, oversampling).png()?,
        })
    }

    fn sheet(&self, shots: &[Shot], oversampling: usize) -> Sheet {
        let tile = |shot: &Shot| {
            let shown = shot.shown(oversampling);
            let rgb = shown.pixels().iter().flat_map(|pixel| pixel.map(encode_srgb)).collect();
            Tile { rgb, lines: vec![shot.label()] }
        };
        Sheet {
            title: String::new(),
            notes: Vec::new(),
            pixels: [self.size.0, self.size.1],
            columns: shots.len().min(2),
            tiles: shots.iter().map(tile).collect(),
        }
    }

    fn subject(&self) -> anyhow::Result<Subject> {
        match (&self.document, self.scene) {
            (None, Some(SceneArg::Preview)) => {
                bail!(Usage("--scene preview needs a MATERIAL.mtlx to show".to_owned()))
            }
            (None, _) => Ok(Subject::Night(Vec::new())),
            (Some(path), Some(SceneArg::Night)) => {
                Ok(Subject::Night(self.materials(path, &Scene::BUILTIN_GEOMETRY)?))
            }
            (Some(path), _) => match <[_; 2]>::try_from(self.materials(path, &Scene::PREVIEW_GEOMETRY)?) {
                Ok([Some(sphere), Some(sheet)]) => Ok(Subject::Preview(Box::new([sphere, sheet]))),
                _ => {
                    let geometry = Scene::PREVIEW_GEOMETRY.join(" or ");
                    bail!("{}: the look assigns nothing to {geometry}", path.display())
                }
            },
        }
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

    /// Columns and rows that are rendered for one of a PNG and averaged behind the tone curve: an edge
    /// between sheeting and the night, a hundred times darker, is only smooth on the screen where it is
    /// smoothed there.
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
    fn report(&self, output: &Output, shots: &[Shot], spp: u32, seconds: f64) -> anyhow::Result<()> {
        let (width, height) = self.size;
        let name = output.name();
        let info = &shots[0].info;
        let lamps: Vec<f32> = shots.iter().filter_map(|shot| shot.info.lamp_deg).collect();
        let exposures: Vec<f32> = shots.iter().map(|shot| shot.tone_map.exposure_ev).collect();
        let facts = json!({
            "output": name, "width": width, "height": height, "spp": spp, "seconds": seconds,
            "lamp_deg": lamps, "exposure_ev": exposures, "units": info.units, "signs_cd_m2": shots[0].signs,
        });
        let listed = |values: Vec<String>| values.join(", ");
        let text = format!(
            "wrote {name} ({width} x {height}, {spp} samples per pixel, headlamp at {} deg, exposure {} EV, \
             {seconds:.1} s)",
            listed(lamps.iter().map(f32::to_string).collect()),
            listed(exposures.iter().map(|ev| format!("{ev:+}")).collect()),
        );
        output.messages().note(self.json, &facts, &text)
    }
}

/// The mean luminance around a point of a picture, given right and down from its centre in units of its
/// height.
fn luminance_at(image: &Image, [x, y]: [f32; 2]) -> f64 {
    let (width, height) = (image.width() as f32, image.height() as f32);
    let side = (height / 50.0).max(1.0);
    let range = |centre: f32, length: usize| {
        let start = (centre - 0.5 * side).max(0.0) as usize;
        start.min(length - 1)..(start + side as usize).min(length)
    };
    let (columns, rows) =
        (range(0.5 * width + x * height, image.width()), range((0.5 + y) * height, image.height()));
    let count = (columns.len() * rows.len()) as f64;
    let pixels = rows.flat_map(|row| columns.clone().map(move |column| image.pixel(column, row)));
    pixels.map(|pixel| luminance(pixel.map(f64::from))).sum::<f64>() / count
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

/// The command line, for the picture's file.
fn command() -> String {
    let words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    std::iter::once("catseye".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}

fn parse_exposure(text: &str) -> Result<Exposure, String> {
    match text.parse::<f32>() {
        _ if text == "auto" => Ok(Exposure::Auto),
        Ok(stops) if stops.abs() <= 100.0 => Ok(Exposure::Stops(stops)),
        _ => Err("give stops from -100 to 100, or auto".to_owned()),
    }
}

fn parse_lamp(text: &str) -> Result<f32, String> {
    let angle = text.parse().ok().filter(|angle| (0.0..=45.0).contains(angle));
    angle.ok_or_else(|| "give degrees from 0 to 45".to_owned())
}

/// `WxH` as width and height.
fn parse_size(text: &str) -> Result<(usize, usize), String> {
    let parse = |number: &str| number.parse().ok().filter(|n| (1..=LARGEST).contains(n));
    let size = text.split_once('x').and_then(|(width, height)| parse(width).zip(parse(height)));
    size.ok_or_else(|| format!("write it like 960x540, each number from 1 to {LARGEST}"))
}
