//! Renders that take long: parts of a picture, checkpoints, a limit of time.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::{Duration, Instant};

use anyhow::{Context as _, bail};
use catseye_render::{Film, Part, PictureInfo, Region, RenderSettings, Scene, ToneMap, expose};

use super::command;
use crate::failure::{Interrupted, Usage};
use crate::output::Output;
use crate::progress::Progress;
use crate::{interrupt, report};

/// Columns and rows of a film for each of the picture: a part is good for a picture of any format.
pub(crate) const OVERSAMPLING: usize = 2;
/// Samples of a picture's pixel for each of a film's.
pub(crate) const QUARTERS: u32 = (OVERSAMPLING * OVERSAMPLING) as u32;
/// About how long an interrupted render can lose.
const PASS: Duration = Duration::from_secs(4);

/// The options of renders that take long.
#[derive(Debug, clap::Args)]
pub(super) struct LongArgs {
    /// Only the samples from A up to but not including B of each pixel, multiples of 4: a part of the
    /// picture, written as an EXR for `catseye merge`
    #[arg(long, value_name = "A..B", conflicts_with = "spp")]
    samples: Option<Samples>,
    /// Only the pixels from column X0 and row Y0 up to but not including X1 and Y1: a part of the picture
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = parse_region)]
    region: Option<Region>,
    /// Take as many samples as there is time for, instead of --spp
    #[arg(long, value_name = "SECONDS", conflicts_with_all = ["spp", "samples"], value_parser = parse_seconds)]
    time: Option<Duration>,
    /// Write the samples so far to this EXR now and then, and where the render is interrupted
    #[arg(long, value_name = "FILE.exr", conflicts_with = "resume")]
    checkpoint: Option<PathBuf>,
    /// Go on from the samples of a checkpoint, and keep it up to date
    #[arg(long, value_name = "FILE.exr")]
    resume: Option<PathBuf>,
    /// Seconds between checkpoints
    #[arg(long, value_name = "SECONDS", default_value = "30", value_parser = parse_seconds)]
    checkpoint_every: Duration,
}

/// A range of samples of a picture's pixel, both ends multiples of [`QUARTERS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Samples {
    /// In samples of a film's pixel.
    pub(crate) start: u32,
    pub(crate) end: u32,
}

impl FromStr for Samples {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number =
            |text: &str| text.parse::<u32>().ok().filter(|n| n % QUARTERS == 0).map(|n| n / QUARTERS);
        let range = text.split_once("..").and_then(|(start, end)| number(start).zip(number(end)));
        let range = range.filter(|(start, end)| start < end);
        let range = range.ok_or_else(|| format!("write it like 0..16, both multiples of {QUARTERS}"))?;
        Ok(Self { start: range.0, end: range.1 })
    }
}

impl LongArgs {
    /// Whether anything is asked for that needs a film.
    pub(super) fn is_asked_for(&self) -> bool {
        self.is_part() || self.time.is_some() || self.checkpoint().is_some()
    }

    /// Whether a part is to be written instead of a picture.
    pub(super) fn is_part(&self) -> bool {
        self.samples.is_some() || self.region.is_some()
    }

    fn checkpoint(&self) -> Option<&Path> {
        self.checkpoint.as_deref().or(self.resume.as_deref())
    }

    /// The picture of a scene, or the part of it that is asked for.
    pub(super) fn render(
        &self,
        scene: &Scene,
        settings: &RenderSettings,
        tone_map: ToneMap,
        progress: &Progress,
    ) -> anyhow::Result<Part> {
        let samples = self.samples.unwrap_or(Samples { start: 0, end: settings.spp });
        let region = self.region.map(|region| Region {
            start: region.start.map(|at| at * OVERSAMPLING),
            end: region.end.map(|at| at * OVERSAMPLING),
        });
        let film = Film::new(scene, settings, region, samples.start).map_err(|error| match error {
            catseye_render::Error::Region { .. } => {
                let [width, height] = [settings.width, settings.height].map(|length| length / OVERSAMPLING);
                Usage(format!("--region: it is empty or not inside the picture of {width}x{height} pixels"))
                    .into()
            }
            error => anyhow::Error::from(error),
        })?;
        let _lock = self.checkpoint().map(Lock::new).transpose()?;
        let film = self.begun(film, samples)?;
        let checkpoint = self.checkpoint().map(Checkpoint::new).transpose()?;
        let info = PictureInfo { command: command(), ..scene.info().clone() };
        let part = Part { film, oversampling: OVERSAMPLING, tone_map, info };
        self.go_on(scene, settings, part, samples.end, checkpoint, progress)
    }

    /// The film that is gone on with.
    fn begun(&self, film: Film, samples: Samples) -> anyhow::Result<Film> {
        let Some(path) = &self.resume else {
            if let Some(path) = self.checkpoint.as_ref().filter(|path| path.exists()) {
                bail!(
                    "{0}: it is there already; go on from it with --resume {0}, or delete it",
                    path.display()
                );
            }
            return Ok(film);
        };
        let part = read_part(path)?;
        part.film.same_picture(&film).with_context(|| path.display().to_string())?;
        let found = part.film.samples();
        if found.start != samples.start || self.time.is_none() && found.end > samples.end {
            bail!(
                "{}: it has the samples {}..{}, which are not the beginning of {}..{}",
                path.display(),
                found.start * QUARTERS,
                found.end * QUARTERS,
                samples.start * QUARTERS,
                samples.end * QUARTERS
            );
        }
        Ok(part.film)
    }

    fn go_on(
        &self,
        scene: &Scene,
        settings: &RenderSettings,
        mut part: Part,
        end: u32,
        mut checkpoint: Option<Checkpoint>,
        progress: &Progress,
    ) -> anyhow::Result<Part> {
        let started = Instant::now();
        let first = part.film.samples().end;
        let mut each = Duration::ZERO;
        if checkpoint.is_some() {
            interrupt::stop_gently();
        }
        loop {
            let done = part.film.samples().end;
            let left = match self.time {
                // The first pass shows how long one takes.
                Some(_) if done == first => 1,
                Some(time) => passes(time.saturating_sub(started.elapsed()), each),
                None => end - done,
            };
            if left == 0 {
                return Ok(part);
            }
            let count = if done == first { 1 } else { left.min(passes(PASS, each).max(1)) };
            let begun = Instant::now();
            let share = |of_pass: f32| match self.time {
                Some(time) => started.elapsed().as_secs_f32() / time.as_secs_f32(),
                None => (done as f32 - first as f32 + of_pass * count as f32) / (end - first) as f32,
            };
            let whole = expose(scene, settings, &mut part.film, count, interrupt::stop(), &|of_pass| {
                progress.share(share(of_pass));
            })?;
            if !whole {
                let Some(checkpoint) = &mut checkpoint else { bail!(Interrupted(String::new())) };
                checkpoint.write(&part)?;
                bail!(Interrupted(checkpoint.hint(&part.film)));
            }
            each = begun.elapsed() / count;
            if let Some(checkpoint) = &mut checkpoint
                && checkpoint.written.elapsed() >= self.checkpoint_every
                && let Err(error) = checkpoint.write(&part)
            {
                // What was written before is still there, and the picture may yet be finished.
                report::warn(format!("{error:#}; the render goes on"));
                checkpoint.written = Instant::now();
            }
        }
    }
}

/// How many passes of one sample fit into a time.
fn passes(time: Duration, each: Duration) -> u32 {
    (time.as_secs_f64() / each.as_secs_f64().max(1e-6)) as u32
}

/// A file of samples.
pub(crate) fn read_part(path: &Path) -> anyhow::Result<Part> {
    let bytes = fs::read(path).with_context(|| format!("{}: can't be read", path.display()))?;
    let part = Part::decode(&bytes).with_context(|| path.display().to_string())?;
    if part.oversampling != OVERSAMPLING {
        bail!("{}: it was not written by this command", path.display());
    }
    Ok(part)
}

/// The file that samples are kept in.
struct Checkpoint {
    output: Output,
    written: Instant,
}

impl Checkpoint {
    fn new(path: &Path) -> anyhow::Result<Self> {
        Ok(Self { output: Output::new(path)?, written: Instant::now() })
    }

    fn write(&mut self, part: &Part) -> anyhow::Result<()> {
        self.output.write(&part.encode()?)?;
        self.written = Instant::now();
        Ok(())
    }

    fn hint(&self, film: &Film) -> String {
        let (name, samples) = (self.output.name(), film.samples());
        let [start, end] = [samples.start, samples.end].map(|n| n * QUARTERS);
        format!("; {name} has the samples {start}..{end}: go on with --resume {name}")
    }
}

/// Keeps other runs from a checkpoint.
struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    fn new(checkpoint: &Path) -> anyhow::Result<Self> {
        let mut path = checkpoint.as_os_str().to_owned();
        path.push(".lock");
        let path = PathBuf::from(path);
        let file = File::create(&path).with_context(|| format!("{}: can't be written", path.display()))?;
        match file.try_lock() {
            Ok(()) => Ok(Self { path, _file: file }),
            Err(TryLockError::WouldBlock) => {
                bail!(
                    "{}: another run is writing it; wait for it, or take another file",
                    checkpoint.display()
                )
            }
            Err(TryLockError::Error(error)) => {
                Err(error).with_context(|| format!("{}: can't be locked", path.display()))
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        fs::remove_file(&self.path).ok();
    }
}

fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds| (0.0..=1e7).contains(seconds));
    seconds.map(Duration::from_secs_f64).ok_or_else(|| "give seconds from 0 to 10000000".to_owned())
}

fn parse_region(text: &str) -> Result<Region, String> {
    let numbers = text.split(',').map(str::parse).collect::<Result<Vec<usize>, _>>();
    match numbers.as_deref() {
        Ok(&[x0, y0, x1, y1]) if x0 < x1 && y0 < y1 && x1.max(y1) <= super::LARGEST => {
            Ok(Region { start: [x0, y0], end: [x1, y1] })
        }
        _ => Err(
            "write it like 0,0,480,270: column and row of the first pixel, and of the one behind the last"
                .to_owned(),
        ),
    }
}
