//! Films as files: EXR pictures that also carry the sums which their pixels are means of.

use std::collections::HashMap;
use std::io::Cursor;

use exr::meta::MetaData;
use exr::meta::attribute::{AttributeValue, IntegerBounds, SampleType};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image as ExrImage, Layer, LayerAttributes,
    ReadChannels as _, ReadLayers as _, Vec2, WritableImage as _, read,
};

use crate::encode::{REC_709, software, text};
use crate::film::Sum;
use crate::render::MAX_SIZE;
use crate::{Error, Film, FilmKey, PictureInfo, Region, ToneMap};

/// The attribute of the file that says what part of which picture it is: lines of a name and a value.
const ATTRIBUTE: &str = "catseyePart";
/// The channels with the 32-bit words of the sums, the lowest first, of red, green and blue.
const WORDS: [[&str; 4]; 3] = [
    ["sum.R.0", "sum.R.1", "sum.R.2", "sum.R.3"],
    ["sum.G.0", "sum.G.1", "sum.G.2", "sum.G.3"],
    ["sum.B.0", "sum.B.1", "sum.B.2", "sum.B.3"],
];
/// The most that the compression makes of a byte: that of deflate.
const MAX_RATIO: usize = 1032;

/// Samples of a picture on their way to be merged or gone on with, and how the picture is to be shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The samples.
    pub film: Film,
    /// Each pixel of the finished picture is the mean of as many columns and rows of the film.
    pub oversampling: usize,
    /// The tone map that suits the picture.
    pub tone_map: ToneMap,
    /// What the picture's file is to say of it.
    pub info: PictureInfo,
}

impl Part {
    /// The part as an EXR file, which shows the picture so far and has the exact sums in channels of their
    /// own.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn encode(&self) -> Result<Vec<u8>, Error> {
        let film = &self.film;
        let image = film.image();
        let size = film.region.size();
        let channel = |name: &str, data: FlatSamples| AnyChannel::new(name, data);
        let mut channels: Vec<_> = ["R", "G", "B"]
            .iter()
            .enumerate()
            .map(|(i, name)| channel(name, FlatSamples::F32(image.pixels().iter().map(|p| p[i]).collect())))
            .collect();
        for (i, names) in WORDS.iter().enumerate() {
            for (word, name) in names.iter().enumerate() {
                let words = film.sums.iter().map(|sum| (sum.0[i] >> (32 * word)) as u32).collect();
                channels.push(channel(name, FlatSamples::U32(words)));
            }
        }
        let [x, y] = film.region.start.map(|at| at as i32);
        let comments = (!self.info.command.is_empty()).then(|| text(&self.info.command));
        let mut attributes = LayerAttributes {
            software_name: Some(software()),
            layer_position: Vec2(x, y),
            comments,
            ..LayerAttributes::default()
        };
        attributes.other.insert(text(ATTRIBUTE), AttributeValue::Text(text(&self.lines())));
        let layer = Layer::new(
            (size[0], size[1]),
            attributes,
            Encoding::SMALL_LOSSLESS,
            AnyChannels::sort(channels.into_iter().collect()),
        );
        let mut exr_image = ExrImage::from_layer(layer);
        let [width, height] = film.key.size;
        exr_image.attributes.display_window = IntegerBounds::new((0, 0), (width, height));
        exr_image.attributes.chromaticities = Some(REC_709);
        let mut file = Cursor::new(Vec::new());
        match exr_image.write().to_buffered(&mut file) {
            Ok(()) => Ok(file.into_inner()),
            Err(e) => Err(Error::Encode { format: "EXR", reason: e.to_string() }),
        }
    }

    fn lines(&self) -> String {
        let (film, tone_map) = (&self.film, &self.tone_map);
        let optional = |value: Option<f32>| value.map_or("none".to_owned(), |value| value.to_string());
        [
            ("version", film.key.version.clone()),
            ("scene", format!("{:016x}", film.key.scene)),
            ("width", film.key.size[0].to_string()),
            ("height", film.key.size[1].to_string()),
            ("max_depth", film.key.max_depth.to_string()),
            ("seed", film.key.seed.to_string()),
            ("samples_start", film.samples.start.to_string()),
            ("samples_end", film.samples.end.to_string()),
            ("oversampling", self.oversampling.to_string()),
            ("exposure_ev", tone_map.exposure_ev.to_string()),
            ("white", tone_map.white.to_string()),
            ("glare", tone_map.glare.to_string()),
            ("lamp_deg", optional(self.info.lamp_deg)),
            ("units", self.info.units.clone()),
        ]
        .map(|(name, value)| format!("{name} {}\n", value.replace('\n', " ")))
        .concat()
    }

    /// Reads what [`Part::encode`] wrote.
    ///
    /// # Errors
    /// A file that is no EXR, is damaged or cut off, is no part of a picture, or contradicts itself.
    pub fn decode(file: &[u8]) -> Result<Self, Error> {
        let damaged = |reason: String| Error::Part { reason };
        let meta = MetaData::read_from_buffered(Cursor::new(file), false);
        let meta = meta.map_err(|e| damaged(format!("it can't be read as an EXR: {e}")))?;
        let [header] = &meta.headers[..] else { return Err(damaged("it has several layers".to_owned())) };
        let attribute = header.own_attributes.other.get(&text(ATTRIBUTE));
        let Some(AttributeValue::Text(lines)) = attribute else {
            return Err(damaged(
                "it is a finished picture, without the sums that parts are merged by".to_owned(),
            ));
        };
        let lines = Lines::new(&lines.to_string());
        let size: [usize; 2] = [lines.number("width")?, lines.number("height")?];
        let start = header.own_attributes.layer_position;
        let inside = |axis: usize, at: i32, length: usize| {
            let start = usize::try_from(at).ok()?;
            let end = start.checked_add(length)?;
            (length > 0 && end <= size[axis] && size[axis] <= MAX_SIZE).then_some([start, end])
        };
        let area = header.layer_size;
        let columns = inside(0, start.x(), area.width());
        let rows = inside(1, start.y(), area.height());
        let (Some([x0, x1]), Some([y0, y1])) = (columns, rows) else {
            return Err(damaged("its pixels are not inside its picture".to_owned()));
        };
        let words: usize = header.channels.list.iter().filter(|c| c.sample_type == SampleType::U32).count();
        if words != 12
            || header.channels.list.len() != 15
            || area.area() > file.len().saturating_mul(MAX_RATIO)
        {
            return Err(damaged("its channels are not those of a part of a picture".to_owned()));
        }
        let region = Region { start: [x0, y0], end: [x1, y1] };
        let samples = lines.number("samples_start")?..lines.number("samples_end")?;
        if samples.start > samples.end {
            return Err(damaged("its samples end before they start".to_owned()));
        }
        let key = FilmKey {
            version: lines.word("version")?.to_owned(),
            scene: u64::from_str_radix(lines.word("scene")?, 16)
                .map_err(|_| damaged("its line \"scene\" is no number".to_owned()))?,
            size,
            max_depth: lines.number("max_depth")?,
            seed: lines.number("seed")?,
        };
        let lamp_deg = match lines.word("lamp_deg")? {
            "none" => None,
            _ => Some(lines.number("lamp_deg")?),
        };
        Ok(Self {
            film: Film { key, region, samples, sums: read_sums(file)? },
            oversampling: lines.number("oversampling")?,
            tone_map: ToneMap {
                exposure_ev: lines.number("exposure_ev")?,
                white: lines.number("white")?,
                glare: lines.number("glare")?,
            },
            info: PictureInfo { units: lines.word("units")?.to_owned(), lamp_deg, ..PictureInfo::default() },
        })
    }
}

fn read_sums(file: &[u8]) -> Result<Vec<Sum>, Error> {
    let damaged = |reason: String| Error::Part { reason };
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(file))
        .map_err(|e| damaged(format!("it is damaged or cut off: {e}")))?;
    let mut sums = vec![Sum::default(); image.layer_data.size.area()];
    for (i, names) in WORDS.iter().enumerate() {
        for (word, name) in names.iter().enumerate() {
            let found = image.layer_data.channel_data.list.iter().find(|channel| channel.name == **name);
            let Some(FlatSamples::U32(words)) = found.map(|channel| &channel.sample_data) else {
                return Err(damaged(format!("its channel {name} is missing")));
            };
            for (sum, value) in sums.iter_mut().zip(words) {
                sum.0[i] |= (u128::from(*value) << (32 * word)) as i128;
            }
        }
    }
    Ok(sums)
}

/// The attribute's lines.
struct Lines(HashMap<String, String>);

impl Lines {
    fn new(lines: &str) -> Self {
        let pairs = lines.lines().filter_map(|line| line.split_once(' '));
        Self(pairs.map(|(name, value)| (name.to_owned(), value.to_owned())).collect())
    }

    fn word(&self, name: &str) -> Result<&str, Error> {
        let missing = || Error::Part { reason: format!("its line {name:?} is missing") };
        self.0.get(name).map(String::as_str).ok_or_else(missing)
    }

    fn number<T: std::str::FromStr>(&self, name: &str) -> Result<T, Error> {
        let word = self.word(name)?;
        word.parse().map_err(|_| Error::Part { reason: format!("its line {name:?} is no number: {word:?}") })
    }
}
