//! Pictures that patterns look up.

use std::{
    collections::HashMap,
    fmt,
    hash::{DefaultHasher, Hasher as _},
    path::{Path, PathBuf},
    sync::Arc,
};

use exr::prelude::f16;

use crate::{
    color_space::ColorSpace,
    picture::{Depth, Layout, Picture, Refusal, Room},
};

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
    picture: Arc<Picture>,
    /// What each number of a picture of bytes, words or halves stands for in colour.
    table: Box<[f32]>,
    space: &'static ColorSpace,
}

impl Texture {
    /// A picture whose colours are of this space; they are converted where they are looked up.
    pub(crate) fn new(picture: Arc<Picture>, space: &'static ColorSpace) -> Self {
        let linear = |count: u32, value: &dyn Fn(u16) -> f32| {
            (0..count).map(|i| space.transfer(value(i as u16))).collect()
        };
        let table = match picture.layout.depth {
            Depth::Byte => linear(1 << 8, &|byte| f32::from(byte) / 255.0),
            Depth::Word => linear(1 << 16, &|word| f32::from(word) / 65_535.0),
            Depth::Half => linear(1 << 16, &|half| f16::from_bits(half).to_f32()),
            Depth::Float => Box::default(),
        };
        Self { picture, table, space }
    }

    pub(crate) fn bytes(&self) -> usize {
        self.picture.samples.len() + size_of_val(&*self.table)
    }

    fn texel(&self, column: usize, row: usize) -> [f32; 4] {
        let Layout { width, channels, .. } = self.picture.layout;
        let pixel = (row * width + column) * channels;
        let color = |i| self.color(pixel + i);
        let alpha = |i| self.alpha(pixel + i);
        let ([r, g, b], a) = match channels {
            1 => ([color(0); 3], 1.0),
            2 => ([color(0); 3], alpha(1)),
            3 => ([color(0), color(1), color(2)], 1.0),
            _ => ([color(0), color(1), color(2)], alpha(3)),
        };
        let [r, g, b] = self.space.mix_primaries([r, g, b]);
        [r, g, b, a]
    }

    /// A number of the picture through the transfer function.
    fn color(&self, i: usize) -> f32 {
        let samples = &self.picture.samples;
        match self.picture.layout.depth {
            Depth::Byte => self.table[usize::from(samples[i])],
            Depth::Word | Depth::Half => {
                self.table[usize::from(u16::from_ne_bytes([samples[2 * i], samples[2 * i + 1]]))]
            }
            Depth::Float => self.space.transfer(float(samples, i)),
        }
    }

    /// A number of the picture as it is.
    fn alpha(&self, i: usize) -> f32 {
        let samples = &self.picture.samples;
        let word = || u16::from_ne_bytes([samples[2 * i], samples[2 * i + 1]]);
        match self.picture.layout.depth {
            Depth::Byte => f32::from(samples[i]) / 255.0,
            Depth::Word => f32::from(word()) / 65_535.0,
            Depth::Half => f16::from_bits(word()).to_f32(),
            Depth::Float => float(samples, i),
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
        let Layout { width, height, .. } = self.picture.layout;
        let (x, y) = (u * width as f32, (1.0 - v) * height as f32);
        let at = |column: i64, row: i64| {
            let column = wrap[0].place(column, width as i64);
            let row = wrap[1].place(row, height as i64);
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

/// The pictures of a document, each read once.
#[derive(Debug, Default)]
pub(crate) struct Textures {
    pictures: HashMap<PathBuf, Arc<Picture>>,
    textures: HashMap<(PathBuf, &'static str), Arc<Texture>>,
    bytes: usize,
}

impl Textures {
    /// A file as a texture whose colours are of this space.
    pub(crate) fn load(
        &mut self,
        path: PathBuf,
        space: &'static ColorSpace,
    ) -> Result<Arc<Texture>, Refusal> {
        let key = (path, space.name);
        if let Some(known) = self.textures.get(&key) {
            return Ok(Arc::clone(known));
        }
        let picture = self.picture(&key.0)?;
        let texture = Arc::new(Texture::new(picture, space));
        self.bytes += size_of_val(&*texture.table);
        self.textures.insert(key, Arc::clone(&texture));
        Ok(texture)
    }

    fn picture(&mut self, path: &Path) -> Result<Arc<Picture>, Refusal> {
        if let Some(known) = self.pictures.get(path) {
            return Ok(Arc::clone(known));
        }
        let picture = Arc::new(Picture::open(path, Room::beside(self.bytes))?);
        self.bytes += picture.samples.len();
        self.pictures.insert(path.to_owned(), Arc::clone(&picture));
        Ok(picture)
    }
}

impl fmt::Debug for Texture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Layout { width, height, .. } = self.picture.layout;
        // The numbers themselves would fill pages; two pictures that differ are told apart.
        let mut hash = DefaultHasher::new();
        hash.write(&self.picture.samples);
        write!(f, "Texture({width} x {height}, {:?}, {:016x})", self.space, hash.finish())
    }
}

fn float(samples: &[u8], i: usize) -> f32 {
    let at = 4 * i;
    f32::from_ne_bytes([samples[at], samples[at + 1], samples[at + 2], samples[at + 3]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color_space::COLOR_SPACES;

    fn checker() -> Texture {
        let layout = Layout { width: 2, height: 2, channels: 1, depth: Depth::Float };
        let samples = [0.0_f32, 1.0, 2.0, 3.0].iter().flat_map(|x| x.to_ne_bytes()).collect();
        Texture::new(Arc::new(Picture { layout, samples }), &COLOR_SPACES[0])
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
