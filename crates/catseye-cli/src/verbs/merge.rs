//! `catseye merge`: the parts of a picture put together.

use std::path::PathBuf;

use anyhow::bail;
use catseye_render::{Error, Film, PictureInfo};
use serde_json::json;

use super::render::{Exposure, Format, OVERSAMPLING, QUARTERS, Samples, Shot, encode, read_part};
use crate::help;
use crate::output::{self, Output};

/// Put the parts of a picture together
///
/// The parts are those that `catseye render` writes with --samples or --region, in any order. Together they
/// must have each sample of each pixel once; the picture then has the bytes of one that is rendered at once.
/// Gaps, overlaps, and parts of other scenes, seeds or versions are refused.
#[derive(Debug, clap::Args)]
#[command(after_help = help::MERGE)]
pub(crate) struct Args {
    /// The parts
    #[arg(value_name = "PART.exr", required = true)]
    parts: Vec<PathBuf>,
    /// Picture to write: .png, or .exr with linear radiance; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Format of the picture [default: by the file's ending; PNG on standard output]
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// The samples that the picture must have [default: from the first to the last that a part has]
    #[arg(long, value_name = "A..B")]
    expect: Option<Samples>,
    /// Stops to add to the exposure that the parts were rendered for, or auto: the exposure that suits this
    /// picture
    #[arg(long, value_name = "EV|auto", default_value = "0", allow_negative_numbers = true, value_parser = Exposure::parse)]
    exposure: Exposure,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let format = output::format(&self.output, self.format)?;
        let output = Output::new(&self.output)?;
        let parts = self.parts.iter().map(|path| read_part(path)).collect::<anyhow::Result<Vec<_>>>()?;
        let Some(first) = parts.first() else { bail!("there are no parts to merge") };
        let (tone_map, info) = (first.tone_map, first.info.clone());
        let films: Vec<Film> = parts.into_iter().map(|part| part.film).collect();
        let expect = self.expect.map(|samples| samples.start..samples.end);
        let film = Film::merge(&films, expect).map_err(|error| self.named(error))?;
        drop(films);
        let image = film.image();
        let samples = [film.samples().start, film.samples().end].map(|n| n * QUARTERS);
        let tone_map = self.exposure.tone_map(tone_map, &image);
        let info = PictureInfo { exposure_ev: Some(tone_map.exposure_ev), ..info };
        let spp = samples[1] - samples[0];
        let shot = Shot { image, oversampling: OVERSAMPLING, spp, tone_map, info, signs: None };
        output.write(&encode(&[shot], format, false)?)?;
        let (name, [start, end]) = (output.name(), samples);
        let facts = json!({ "output": name, "parts": self.parts.len(), "samples": samples });
        let text = format!("wrote {name} (samples {start}..{end} from {} parts)", self.parts.len());
        output.messages().note(self.json, &facts, &text)
    }

    /// The error in terms of files, and of the picture's pixels and samples.
    fn named(&self, error: Error) -> anyhow::Error {
        let name = |part: usize| self.parts[part].display().to_string();
        let range = |start: u32, end: u32| format!("{}..{}", start * QUARTERS, end * QUARTERS);
        anyhow::Error::msg(match error {
            Error::Parts { parts: [a, b], difference } => {
                format!("{} and {} are parts of different pictures: {difference}", name(a), name(b))
            }
            Error::Overlap { parts: [a, b], samples } => {
                let samples = range(samples.start, samples.end);
                format!(
                    "{} and {} both have the samples {samples} of some pixels: leave one out",
                    name(a),
                    name(b)
                )
            }
            Error::Beyond { part, samples, expected } => {
                let [samples, expected] = [samples, expected].map(|s| range(s.start, s.end));
                format!(
                    "{}: it has the samples {samples}, beyond the {expected} that are expected",
                    name(part)
                )
            }
            Error::Gap { samples, pixel } => {
                let [x, y] = pixel.map(|at| at / OVERSAMPLING);
                let samples = range(samples.start, samples.end);
                format!(
                    "no part has the samples {samples} of the pixel in column {x} and row {y}: render them, and merge again"
                )
            }
            other => other.to_string(),
        })
    }
}
