//! `catseye render`: a path-traced picture.

mod long;
mod shot;
mod subject;

use std::path::PathBuf;
use std::time::Instant;

use anyhow::bail;
use catseye_render::{Image, Lighting, PictureInfo, RenderSettings, Scene, render};
use serde_json::json;

use crate::failure::Usage;
use crate::help;
use crate::output::{self, Output};
use crate::progress::{Progress, ProgressStyle};
use crate::report::Stream;
use long::LongArgs;
pub(crate) use long::{OVERSAMPLING, QUARTERS, Samples, read_part};
pub(crate) use shot::{Exposure, Format, Shot, encode};
use subject::{Subject, SubjectArgs};

/// Columns and rows of the largest picture that is rendered.
const LARGEST: usize = 16384;
/// Pictures side by side.
const MAX_LAMPS: usize = 4;

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
    #[command(flatten)]
    subject: SubjectArgs,
    /// Picture to write: .png, or .exr with linear radiance; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "catseye.png")]
    output: PathBuf,
    /// Format of the picture [default: by the file's ending; PNG on standard output]
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Columns and rows of the picture
    #[arg(long, value_name = "WxH", default_value = "960x540", value_parser = parse_size, allow_hyphen_values = true)]
    size: (usize, usize),
    /// Samples per pixel: four times as many halve the noise (4 and more are rounded up to a multiple of 4)
    #[arg(long, value_name = "N", default_value_t = RenderSettings::default().spp, value_parser = clap::value_parser!(u32).range(1..))]
    spp: u32,
    /// Stops to add to the scene's exposure, or auto: the exposure that suits this picture
    #[arg(long, value_name = "EV|auto", default_value = "0", allow_negative_numbers = true, value_parser = Exposure::parse)]
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
    #[command(flatten)]
    long: LongArgs,
    /// How progress is shown
    #[arg(long, value_enum, default_value_t)]
    progress: ProgressStyle,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let started = Instant::now();
        let format = output::format(&self.output, self.format)?;
        let output = Output::new(&self.output)?;
        let lamps = self.lamps(format)?;
        self.check_long(&output, format, &lamps)?;
        let oversampling = if self.spp >= QUARTERS || self.long.is_asked_for() { OVERSAMPLING } else { 1 };
        let settings = self.settings(oversampling)?;
        let subject = self.subject.load()?;
        if self.long.is_part() {
            return self.part(&output, &subject, &settings, started);
        }
        let shots = lamps.iter().map(|lamp| self.shot(&subject, *lamp, &settings, oversampling));
        let shots = shots.collect::<anyhow::Result<Vec<_>>>()?;
        output.write(&encode(&shots, format, self.labels)?)?;
        self.report(&output, &shots, started.elapsed().as_secs_f64())
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

    /// Refuses what can't be asked for together.
    fn check_long(&self, output: &Output, format: Format, lamps: &[Option<f32>]) -> anyhow::Result<()> {
        if self.progress == ProgressStyle::Openjd && output.messages() == Stream::Err {
            bail!(Usage(
                "--progress openjd and `-o -` both need standard output: write the picture to a file"
                    .to_owned()
            ));
        }
        if !self.long.is_asked_for() {
            return Ok(());
        }
        if lamps.len() > 1 {
            bail!(Usage("give one --lamp-deg for parts, checkpoints and renders of limited time".to_owned()));
        }
        if self.long.is_part() && (format != Format::Exr || self.exposure == Exposure::Auto) {
            bail!(Usage(
                "a part of a picture (--samples, --region) is an EXR and has no --exposure auto: name it part.exr, and \
                 give catseye merge the PNG's name and exposure"
                    .to_owned()
            ));
        }
        Ok(())
    }

    fn scene(&self, subject: &Subject, lamp_deg: Option<f32>) -> anyhow::Result<Scene> {
        subject.scene(Lighting { model: self.subject.model(), lamp_deg })
    }

    fn shot(
        &self,
        subject: &Subject,
        lamp_deg: Option<f32>,
        settings: &RenderSettings,
        oversampling: usize,
    ) -> anyhow::Result<Shot> {
        let scene = self.scene(subject, lamp_deg)?;
        let progress = Progress::shares("rendering", self.progress);
        let (image, spp) = if self.long.is_asked_for() {
            let film = self.long.render(&scene, settings, *scene.tone_map(), &progress)?.film;
            (film.image(), film.samples().end)
        } else {
            (render(&scene, settings, &|share| progress.share(share))?, settings.spp)
        };
        let tone_map = self.exposure.tone_map(*scene.tone_map(), &image);
        let exposure_ev = Some(tone_map.exposure_ev);
        let info = PictureInfo { command: command(), exposure_ev, ..scene.info().clone() };
        let signs = matches!(subject, Subject::Night(_)).then(|| Shot::signs_of(&image));
        let spp = spp * (oversampling * oversampling) as u32;
        Ok(Shot { image, oversampling, spp, tone_map, info, signs })
    }

    /// Writes a part of the picture.
    fn part(
        &self,
        output: &Output,
        subject: &Subject,
        settings: &RenderSettings,
        started: Instant,
    ) -> anyhow::Result<()> {
        let scene = self.scene(subject, self.lamp_deg.first().copied())?;
        let progress = Progress::shares("rendering", self.progress);
        let tone_map = self.exposure.tone_map(*scene.tone_map(), &Image::new(0, 0));
        let part = self.long.render(&scene, settings, tone_map, &progress)?;
        drop(progress);
        output.write(&part.encode()?)?;
        let (samples, region) = (part.film.samples(), part.film.region());
        let [start, end] = [samples.start, samples.end].map(|n| n * QUARTERS);
        let [[x0, y0], [x1, y1]] = [region.start, region.end].map(|at| at.map(|n| n / OVERSAMPLING));
        let (name, seconds) = (output.name(), started.elapsed().as_secs_f64());
        let facts = json!({
            "output": name, "samples": [start, end], "region": [x0, y0, x1, y1], "seconds": seconds,
        });
        let text = format!(
            "wrote {name} (samples {start}..{end} of the pixels {x0},{y0},{x1},{y1}, {seconds:.1} s)"
        );
        output.messages().note(self.json, &facts, &text)
    }

    fn settings(&self, oversampling: usize) -> anyhow::Result<RenderSettings> {
        let (width, height) = self.size;
        let most = LARGEST / oversampling;
        if width > most || height > most {
            bail!(Usage(format!(
                "--size {width}x{height}: a picture of 4 samples per pixel or more, which is made from one of twice the size, \
                 has at most {most} columns and rows: take --spp 1 to 3"
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

    /// Says what was written.
    fn report(&self, output: &Output, shots: &[Shot], seconds: f64) -> anyhow::Result<()> {
        let (width, height) = self.size;
        let name = output.name();
        let (info, spp) = (&shots[0].info, shots[0].spp);
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

/// The command line, for the picture's file.
fn command() -> String {
    let words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    std::iter::once("catseye".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
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
