//! Pictures that patterns look up.

use std::{fmt, fs::File, io::BufReader, path::Path};

use image::{DynamicImage, ImageReader};

use crate::color_space::ColorSpace;

/// Columns or rows of a picture.
const MAX_SIDE: u32 = 16_384;
/// Columns times rows of a picture.
const MAX_PIXELS: u64 = 1 << 26;
/// Bytes of a picture's file.
const MAX_FILE_BYTES: u64 = 256 << 20;

/// What lies outside the unit square of texture coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Wrap {
    /// The default value.
    Constant,
    Clamp,
    Periodic,
    Mirror,
}

impl Wrap {
    pub(crate) fn parse(word: &str) -> Option<Self> {
        Some(match word {
            "constant" => Self::Constant,
            "clamp" => Self::Clamp,
            "periodic" | "" => Self::Periodic,
            "mirror" => Self::Mirror,
            _ => return None,
        })
    }

    /// The column of a position, which may be outside.
    fn place(self, i: i64, count: i64) -> Option<usize> {
        let inside = match self {
            Self::Constant => return (0..count).contains(&i).then_some(i as usize),
            Self::Clamp => i.clamp(0, count - 1),
            Self::Periodic => i.rem_euclid(count),
            Self::Mirror => {
                let i = i.rem_euclid(2 * count);
                if i < count { i } else { 2 * count - 1 - i }
            }
        };
        Some(inside as usize)
    }
}

/// How values between pixels are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Filter {
    Closest,
    Linear,
}

/// A picture in linear light.
pub(crate) struct Texture {
    width: usize,
    height: usize,
    texels: Texels,
}

enum Texels {
    /// Four bytes each, with the numbers that they stand for in colour and in alpha.
    Bytes {
        pixels: Vec<[u8; 4]>,
        linear: Box<[f32; 256]>,
        primaries: Option<&'static ColorSpace>,
    },
    Floats(Vec<[f32; 4]>),
}

impl Texture {
    /// Reads a file; colours are converted from their space.
    pub(crate) fn load(path: &Path, space: &'static ColorSpace) -> Result<Self, String> {
        let picture = open(path)?;
        let (width, height) = (picture.width() as usize, picture.height() as usize);
        let texels = match picture {
            DynamicImage::ImageRgb32F(_)
            | DynamicImage::ImageRgba32F(_)
            | DynamicImage::ImageLuma16(_)
            | DynamicImage::ImageRgb16(_)
            | DynamicImage::ImageRgba16(_)
            | DynamicImage::ImageLumaA16(_) => {
                let pixels = picture.into_rgba32f().into_vec();
                let linear = |p: &[f32]| {
                    let [r, g, b] = space.to_linear([p[0], p[1], p[2]]);
                    [r, g, b, p[3]]
                };
                Texels::Floats(pixels.chunks_exact(4).map(linear).collect())
            }
            _ => {
                let pixels = picture.into_rgba8().into_vec();
                let pixels = pixels.chunks_exact(4).map(|p| [p[0], p[1], p[2], p[3]]).collect();
                let linear = Box::new(core::array::from_fn(|i| space.transfer(i as f32 / 255.0)));
                Texels::Bytes { pixels, linear, primaries: space.has_primaries().then_some(space) }
            }
        };
        Ok(Self { width, height, texels })
    }

    pub(crate) fn bytes(&self) -> usize {
        match &self.texels {
            Texels::Bytes { pixels, .. } => pixels.len() * 4,
            Texels::Floats(pixels) => pixels.len() * 16,
        }
    }

    fn texel(&self, column: usize, row: usize) -> [f32; 4] {
        let i = row * self.width + column;
        match &self.texels {
            Texels::Floats(pixels) => pixels[i],
            Texels::Bytes { pixels, linear, primaries } => {
                let [r, g, b, a] = pixels[i];
                let rgb = [r, g, b].map(|x| linear[usize::from(x)]);
                let [r, g, b] = primaries.map_or(rgb, |space| space.mix_primaries(rgb));
                [r, g, b, f32::from(a) / 255.0]
            }
        }
    }

    /// The value at texture coordinates; v points up, the picture's first row is on top.
    pub(crate) fn look_up(
        &self,
        uv: [f32; 2],
        wrap: [Wrap; 2],
        filter: Filter,
        default: [f32; 4],
    ) -> [f32; 4] {
        // Far outside, and where there is no number, nothing can be told apart anyway.
        let [u, v] = uv.map(|x| if x.abs() < 1e6 { x } else { 0.0 });
        let (x, y) = (u * self.width as f32, (1.0 - v) * self.height as f32);
        let at = |column: i64, row: i64| {
            let column = wrap[0].place(column, self.width as i64);
            let row = wrap[1].place(row, self.height as i64);
            column.zip(row).map_or(default, |(column, row)| self.texel(column, row))
        };
        if filter == Filter::Closest {
            return at(x.floor() as i64, y.floor() as i64);
        }
        let (x, y) = (x - 0.5, y - 0.5);
        let (column, row) = (x.floor(), y.floor());
        let (s, t) = (x - column, y - row);
        let (column, row) = (column as i64, row as i64);
        let lerp = |a: [f32; 4], b: [f32; 4], t: f32| core::array::from_fn(|i| a[i] + (b[i] - a[i]) * t);
        lerp(
            lerp(at(column, row), at(column + 1, row), s),
            lerp(at(column, row + 1), at(column + 1, row + 1), s),
            t,
        )
    }
}

impl fmt::Debug for Texture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Texture({} x {})", self.width, self.height)
    }
}

/// Opens a picture whose size in the file and in memory is bearable, whatever it claims.
fn open(path: &Path) -> Result<DynamicImage, String> {
    let mut reader = reader(path)?;
    let mut limits = image::Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(1 << 30);
    reader.limits(limits);
    reader.decode().map_err(|cause| cause.to_string())
}

/// The size of a picture, from its head alone; an error where it is more than [`Texture::load`] reads.
pub(crate) fn check_size(path: &Path) -> Result<(), String> {
    reader(path).map(|_| ())
}

fn reader(path: &Path) -> Result<ImageReader<BufReader<File>>, String> {
    let text = |cause: std::io::Error| cause.to_string();
    let metadata = path.metadata().map_err(text)?;
    if !metadata.is_file() || metadata.len() > MAX_FILE_BYTES {
        return Err(format!("it is no file of at most {MAX_FILE_BYTES} bytes"));
    }
    let open = || ImageReader::open(path).and_then(ImageReader::with_guessed_format).map_err(text);
    let (width, height) = open()?.into_dimensions().map_err(|cause| cause.to_string())?;
    if width > MAX_SIDE || height > MAX_SIDE || u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(format!(
            "it has {width} x {height} pixels; at most {MAX_SIDE} a side and {MAX_PIXELS} together are read"
        ));
    }
    if width == 0 || height == 0 {
        return Err("it has no pixels".to_owned());
    }
    open()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checker() -> Texture {
        let pixels = vec![[0.0; 4], [1.0; 4], [2.0; 4], [3.0; 4]];
        Texture { width: 2, height: 2, texels: Texels::Floats(pixels) }
    }

    #[test]
    fn v_points_up_and_addresses_wrap() {
        let look_up = |u, v, wrap| checker().look_up([u, v], [wrap; 2], Filter::Closest, [9.0; 4])[0];
        assert_eq!(look_up(0.25, 0.75, Wrap::Periodic), 0.0);
        assert_eq!(look_up(0.75, 0.25, Wrap::Periodic), 3.0);
        assert_eq!(look_up(1.25, 0.75, Wrap::Periodic), 0.0);
        assert_eq!(look_up(1.25, 0.75, Wrap::Mirror), 1.0);
        assert_eq!(look_up(7.25, 0.75, Wrap::Clamp), 1.0);
        assert_eq!(look_up(1.25, 0.75, Wrap::Constant), 9.0);
        assert_eq!(look_up(f32::NAN, 0.75, Wrap::Periodic), 0.0);
    }

    #[test]
    fn linear_filter_interpolates_between_centres() {
        let value = checker().look_up([0.5, 0.5], [Wrap::Clamp; 2], Filter::Linear, [0.0; 4])[0];
        assert_eq!(value, 1.5);
    }
}
