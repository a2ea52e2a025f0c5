//! The sums of samples that a picture is the mean of.

use std::fmt::{self, Write as _};
use std::hash::{DefaultHasher, Hasher as _};
use std::ops::Range;

use crate::{Error, Image, RenderSettings, Scene};

/// The unit of the sums, 2^-64: samples are rounded to it.
const UNIT: f64 = 1.0 / (1_u128 << 64) as f64;
/// The largest sample, 2^40: 2^22 of them have room. The sun's disk is dimmer in any unit.
const LARGEST: f32 = (1_u64 << 40) as f32;

/// The sum of some samples of a pixel.
///
/// Sums are integers, so that those of the parts of a picture are, added in any order, the sum of the whole
/// to the last bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Sum(pub(crate) [i128; 3]);

impl Sum {
    pub(crate) fn add(&mut self, sample: [f32; 3]) {
        for (sum, value) in self.0.iter_mut().zip(sample) {
            // A power of two scales without rounding; what is below the unit is cut.
            *sum += (f64::from(value.clamp(-LARGEST, LARGEST)) / UNIT) as i128;
        }
    }

    pub(crate) fn merge(&mut self, other: Self) {
        for (sum, other) in self.0.iter_mut().zip(other.0) {
            *sum += other;
        }
    }

    pub(crate) fn mean(self, count: u32) -> [f32; 3] {
        self.0.map(|sum| (sum as f64 * UNIT / f64::from(count.max(1))) as f32)
    }
}

/// A rectangle of a picture's pixels, from the top left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// The first column and the first row.
    pub start: [usize; 2],
    /// The column and the row behind the last.
    pub end: [usize; 2],
}

impl Region {
    /// Columns and rows.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [0, 1].map(|axis| self.end[axis].saturating_sub(self.start[axis]))
    }

    /// Number of pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        let [width, height] = self.size();
        width * height
    }

    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|axis| self.start[axis] < other.end[axis] && other.start[axis] < self.end[axis])
    }
}

impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([x0, y0], [x1, y1]) = (self.start, self.end);
        write!(f, "{x0},{y0},{x1},{y1}")
    }
}

/// Some of the samples of some of a picture's pixels.
///
/// Films of one scene and one seed that don't overlap can be merged; what they give together has the bits of
/// the picture that is rendered at once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Film {
    pub(crate) key: FilmKey,
    pub(crate) region: Region,
    pub(crate) samples: Range<u32>,
    /// Row by row of the region.
    pub(crate) sums: Vec<Sum>,
}

/// What films must have in common to be parts of one picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilmKey {
    /// The version of this crate.
    pub version: String,
    /// [`Scene::fingerprint`].
    pub scene: u64,
    /// Columns and rows of the whole picture.
    pub size: [usize; 2],
    /// The most scatterings of a path.
    pub max_depth: u32,
    /// Which noise.
    pub seed: u32,
}

impl FilmKey {
    /// The first thing that differs, in words.
    fn difference(&self, other: &Self) -> Option<String> {
        let of = |name: &str, [a, b]: [&dyn fmt::Display; 2]| Some(format!("{name}: {a} and {b}"));
        match (self, other) {
            (a, b) if a.version != b.version => of("versions of catseye", [&a.version, &b.version]),
            (a, b) if a.size != b.size => {
                let size = |[width, height]: [usize; 2]| format!("{width}x{height}");
                of("sizes of the picture", [&size(a.size), &size(b.size)])
            }
            (a, b) if a.seed != b.seed => of("seeds", [&a.seed, &b.seed]),
            (a, b) if a.max_depth != b.max_depth => {
                of("numbers of scatterings", [&a.max_depth, &b.max_depth])
            }
            (a, b) if a.scene != b.scene => Some("scenes, materials, lamps or exposures".to_owned()),
            _ => None,
        }
    }
}

impl Film {
    /// A film without samples; the first one will be number `first`.
    ///
    /// # Errors
    /// A setting out of its range, or a region that is not inside the picture.
    pub fn new(
        scene: &Scene,
        settings: &RenderSettings,
        region: Option<Region>,
        first: u32,
    ) -> Result<Self, Error> {
        settings.validate()?;
        let size = [settings.width, settings.height];
        let region = region.unwrap_or(Region { start: [0; 2], end: size });
        if region.pixels() == 0 || (0..2).any(|axis| region.end[axis] > size[axis]) {
            return Err(Error::Region { region, size });
        }
        let key = FilmKey {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene: scene.fingerprint(),
            size,
            max_depth: settings.max_depth,
            seed: settings.seed,
        };
        Ok(Self { key, region, samples: first..first, sums: vec![Sum::default(); region.pixels()] })
    }

    /// What it has in common with the other parts of its picture.
    #[must_use]
    pub fn key(&self) -> &FilmKey {
        &self.key
    }

    /// Which pixels it has.
    #[must_use]
    pub fn region(&self) -> Region {
        self.region
    }

    /// Which samples it has of each pixel.
    #[must_use]
    pub fn samples(&self) -> Range<u32> {
        self.samples.clone()
    }

    /// Whether it could go on with the samples of another one: the same picture and the same pixels.
    ///
    /// # Errors
    /// What differs.
    pub fn same_picture(&self, other: &Self) -> Result<(), Error> {
        match self.key.difference(&other.key) {
            Some(difference) => Err(Error::OtherPicture { difference }),
            None if self.region != other.region => {
                let difference = format!("regions: {} and {}", self.region, other.region);
                Err(Error::OtherPicture { difference })
            }
            None => Ok(()),
        }
    }

    /// The means of the samples: linear radiance of the region's pixels.
    #[must_use]
    pub fn image(&self) -> Image {
        let [width, height] = self.region.size();
        let count = self.samples.end - self.samples.start;
        Image::from_fn(width, height, |x, y| self.sums[y * width + x].mean(count))
    }

    /// The whole picture of some parts, which must give each of the samples of each of its pixels once.
    ///
    /// # Errors
    /// No part; parts of different pictures; an overlap; a gap. The error names the parts by their numbers in
    /// `parts`, from 0.
    pub fn merge(parts: &[Self], samples: Option<Range<u32>>) -> Result<Self, Error> {
        let Some(first) = parts.first() else { return Err(Error::NoParts) };
        for (number, part) in parts.iter().enumerate() {
            if let Some(difference) = first.key.difference(&part.key) {
                return Err(Error::Parts { parts: [0, number], difference });
            }
            for (earlier, other) in parts[..number].iter().enumerate() {
                let from = part.samples.start.max(other.samples.start);
                let to = part.samples.end.min(other.samples.end);
                if from < to && part.region.overlaps(&other.region) {
                    return Err(Error::Overlap { parts: [earlier, number], samples: from..to });
                }
            }
        }
        let samples = samples.unwrap_or_else(|| {
            let all = || parts.iter().map(|part| &part.samples);
            let [start, end] = [all().map(|s| s.start).min(), all().map(|s| s.end).max()];
            start.unwrap_or_default()..end.unwrap_or_default()
        });
        let [width, height] = first.key.size;
        let region = Region { start: [0; 2], end: first.key.size };
        let mut whole =
            Self { key: first.key.clone(), region, samples, sums: vec![Sum::default(); width * height] };
        let mut counts = vec![0_u32; width * height];
        for (number, part) in parts.iter().enumerate() {
            if part.samples.start < whole.samples.start || part.samples.end > whole.samples.end {
                let (samples, expected) = (part.samples.clone(), whole.samples);
                return Err(Error::Beyond { part: number, samples, expected });
            }
            for (row, sums) in part.sums.chunks(part.region.size()[0]).enumerate() {
                let at = (part.region.start[1] + row) * width + part.region.start[0];
                let count = part.samples.end - part.samples.start;
                for ((whole, total), sum) in whole.sums[at..].iter_mut().zip(&mut counts[at..]).zip(sums) {
                    whole.merge(*sum);
                    *total += count;
                }
            }
        }
        // Nothing is there twice, so that a pixel with as many samples as it should have has each of them.
        let full = whole.samples.end - whole.samples.start;
        match counts.iter().position(|count| *count != full) {
            None => Ok(whole),
            Some(at) => Err(first.gap(parts, &whole.samples, [at % width, at / width])),
        }
    }

    /// The first samples that no part has of a pixel.
    fn gap(&self, parts: &[Self], samples: &Range<u32>, pixel: [usize; 2]) -> Error {
        let here = Region { start: pixel, end: pixel.map(|p| p + 1) };
        let mut there: Vec<_> =
            parts.iter().filter(|part| part.region.overlaps(&here)).map(Self::samples).collect();
        there.sort_by_key(|samples| samples.start);
        let (mut start, mut end) = (samples.start, samples.end);
        for samples in there {
            if samples.start > start {
                end = samples.start;
                break;
            }
            start = samples.end;
        }
        Error::Gap { samples: start..end, pixel }
    }
}

impl Scene {
    /// A number that two scenes have in common only if they are the same, to the last bit of each of their
    /// numbers and in the same version of this crate.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        let mut hash = Hashed(DefaultHasher::new());
        // Numbers are printed to the last bit, and pictures as the hash of their pixels.
        write!(hash, "{self:?}").ok();
        hash.0.finish()
    }
}

/// Text whose hash is all that is kept of it.
struct Hashed(DefaultHasher);

impl fmt::Write for Hashed {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.write(text.as_bytes());
        Ok(())
    }
}
