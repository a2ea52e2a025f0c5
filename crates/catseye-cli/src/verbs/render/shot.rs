//! A finished picture, and how it becomes a file.

use catseye_photometry::{luminance, significant};
use catseye_render::{Image, PictureInfo, Scene, ToneMap, encode_exr, encode_png, encode_srgb};
use clap::ValueEnum;

use crate::plot::sheet::{Sheet, Tile};

/// What `--exposure` asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Exposure {
    /// Stops to add to the scene's.
    Stops(f32),
    /// What suits the picture.
    Auto,
}

impl Exposure {
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        match text.parse::<f32>() {
            _ if text == "auto" => Ok(Self::Auto),
            Ok(stops) if stops.abs() <= 100.0 => Ok(Self::Stops(stops)),
            _ => Err("give stops from -100 to 100, or auto".to_owned()),
        }
    }

    pub(crate) fn tone_map(self, tone_map: ToneMap, image: &Image) -> ToneMap {
        match self {
            Self::Stops(stops) => ToneMap { exposure_ev: tone_map.exposure_ev + stops, ..tone_map },
            Self::Auto => tone_map.fitted(image),
        }
    }
}

/// The picture's file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// 8 bits per channel, as shown on a screen
    Png,
    /// Linear radiance
    Exr,
}

/// A picture and what it shows.
pub(crate) struct Shot {
    /// `oversampling` times as many columns and rows as the picture.
    pub(crate) image: Image,
    pub(crate) oversampling: usize,
    /// Samples of each of the picture's pixels.
    pub(crate) spp: u32,
    pub(crate) tone_map: ToneMap,
    pub(crate) info: PictureInfo,
    /// Luminances of the left and of the right sign's white in the built-in scene.
    pub(crate) signs: Option<[f64; 2]>,
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

    /// As a screen shows it, each pixel the mean of some that were rendered: an edge between sheeting and the
    /// night, a hundred times darker, is only smooth on the screen where it is smoothed there.
    fn shown(&self) -> Image {
        self.image.toned(&self.tone_map).reduced(self.oversampling)
    }

    /// The luminances of the built-in scene's signs.
    pub(crate) fn signs_of(image: &Image) -> [f64; 2] {
        Scene::BUILTIN_SIGN_WHITES.map(|at| luminance_at(image, at))
    }
}

/// The bytes of a file that shows the pictures, of which only a PNG can have several, and labels.
pub(crate) fn encode(shots: &[Shot], format: Format, labels: bool) -> anyhow::Result<Vec<u8>> {
    Ok(match (format, shots) {
        (Format::Exr, [first, ..]) => encode_exr(&first.image.reduced(first.oversampling), &first.info)?,
        (Format::Png, [only]) if !labels => encode_png(&only.shown(), &ToneMap::LINEAR)?,
        _ => sheet(shots).png()?,
    })
}

fn sheet(shots: &[Shot]) -> Sheet {
    let shown: Vec<Image> = shots.iter().map(Shot::shown).collect();
    let tile = |(shot, shown): (&Shot, &Image)| {
        let rgb = shown.pixels().iter().flat_map(|pixel| pixel.map(encode_srgb)).collect();
        Tile { rgb, lines: vec![shot.label()] }
    };
    Sheet {
        title: String::new(),
        notes: Vec::new(),
        pixels: shown.first().map_or([0; 2], |image| [image.width(), image.height()]),
        columns: shots.len().min(2),
        tiles: shots.iter().zip(&shown).map(tile).collect(),
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
