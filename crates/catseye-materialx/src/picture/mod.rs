//! Pictures as their files have them: decoded within a given room, in the format that they need.

mod bmp;
mod exr;
mod gif;
mod hdr;
mod jpeg;
mod png;
mod tga;
mod tiff;

use std::{
    fs::File,
    io::{self, BufReader, Read, Seek as _},
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
};

/// Columns or rows of a picture.
const MAX_SIDE: usize = 16_384;
/// Columns times rows of a picture.
const MAX_PIXELS: usize = 1 << 26;
/// Bytes of a picture's file.
const MAX_FILE_BYTES: u64 = 256 << 20;
/// Bytes that all pictures of a document and what decoding them takes may have at a time: with the largest
/// document (some 0.3 GB) a process stays below 1 GB.
pub(crate) const MAX_BYTES: usize = 640 << 20;

/// How a picture's numbers are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Depth {
    /// 0 to 255 for 0 to 1.
    Byte,
    /// 0 to 65535 for 0 to 1.
    Word,
    /// IEEE 754 binary16.
    Half,
    /// IEEE 754 binary32.
    Float,
}

impl Depth {
    pub(crate) const fn bytes(self) -> usize {
        match self {
            Self::Byte => 1,
            Self::Word | Self::Half => 2,
            Self::Float => 4,
        }
    }
}

/// Size and format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// 1: grey, 2: grey and alpha, 3: red, green, blue, 4: the same and alpha.
    pub(crate) channels: usize,
    pub(crate) depth: Depth,
}

impl Layout {
    /// Bytes of one row.
    fn stride(&self) -> usize {
        self.width * self.channels * self.depth.bytes()
    }

    fn bytes(&self) -> usize {
        self.height * self.stride()
    }
}

/// A decoded picture: rows from the top, pixels from the left, numbers in the machine's byte order.
#[derive(Debug)]
pub(crate) struct Picture {
    pub(crate) layout: Layout,
    pub(crate) samples: Vec<u8>,
}

/// Why a picture is not read, in words that follow "the picture x can't be read: ".
#[derive(Debug, thiserror::Error)]
pub(crate) enum Refusal {
    #[error("{0}")]
    System(io::Error),
    #[error("its format is not known; save it as PNG, JPEG, EXR, TIFF, HDR, TGA, BMP or GIF")]
    Format,
    #[error("the file ends before the picture does; copy or save it again")]
    Ends,
    #[error("its data is damaged; copy or save it again")]
    Damaged,
    #[error("{what} is not supported; save it as {instead}")]
    Unsupported { what: String, instead: &'static str },
    #[error("it is no file of at most {MAX_FILE_BYTES} bytes")]
    File,
    #[error("it has {0} x {1} pixels; at most {MAX_SIDE} a side and {MAX_PIXELS} together are read")]
    Size(usize, usize),
    #[error("it has no pixels")]
    Empty,
    #[error(
        "with the other pictures it takes more than {} MiB of memory; make them smaller",
        MAX_BYTES >> 20
    )]
    Room,
    #[error("there is not enough memory for it")]
    Memory,
}

impl From<io::Error> for Refusal {
    fn from(cause: io::Error) -> Self {
        match cause.kind() {
            io::ErrorKind::UnexpectedEof => Self::Ends,
            io::ErrorKind::InvalidData | io::ErrorKind::InvalidInput | io::ErrorKind::Other => Self::Damaged,
            io::ErrorKind::OutOfMemory => Self::Memory,
            _ => Self::System(cause),
        }
    }
}

fn unsupported<T>(what: impl Into<String>, instead: &'static str) -> Result<T, Refusal> {
    Err(Refusal::Unsupported { what: what.into(), instead })
}

/// What a picture may still take of memory.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Room(usize);

impl Room {
    pub(crate) fn beside(used: usize) -> Self {
        Self(MAX_BYTES.saturating_sub(used))
    }

    /// The buffer for a picture, zeros all over.
    fn picture(&mut self, layout: Layout) -> Result<Picture, Refusal> {
        check_size(layout.width, layout.height)?;
        Ok(Picture { layout, samples: self.buffer(layout.bytes())? })
    }

    fn buffer(&mut self, bytes: usize) -> Result<Vec<u8>, Refusal> {
        self.take(bytes)?;
        let mut buffer = Vec::new();
        buffer.try_reserve_exact(bytes).map_err(|_| Refusal::Memory)?;
        buffer.resize(bytes, 0);
        Ok(buffer)
    }

    /// Counts what a decoder is about to allocate itself, and sees whether the system has it.
    fn scratch(&mut self, bytes: usize) -> Result<(), Refusal> {
        self.take(bytes)?;
        Vec::<u8>::new().try_reserve_exact(bytes).map_err(|_| Refusal::Memory)
    }

    fn take(&mut self, bytes: usize) -> Result<(), Refusal> {
        self.0 = self.0.checked_sub(bytes).ok_or(Refusal::Room)?;
        Ok(())
    }
}

fn check_size(width: usize, height: usize) -> Result<(), Refusal> {
    if width == 0 || height == 0 {
        return Err(Refusal::Empty);
    }
    if width > MAX_SIDE || height > MAX_SIDE || width * height > MAX_PIXELS {
        return Err(Refusal::Size(width, height));
    }
    Ok(())
}

type Source = BufReader<File>;

impl Picture {
    /// Decodes a file; its format is told by its first bytes, that of a TGA by its name.
    pub(crate) fn open(path: &Path, mut room: Room) -> Result<Self, Refusal> {
        let file = File::open(path)?;
        let metadata = file.metadata()?;
        if !metadata.is_file() || metadata.len() > MAX_FILE_BYTES {
            return Err(Refusal::File);
        }
        let mut source = BufReader::new(file);
        let mut head = Vec::new();
        source.by_ref().take(12).read_to_end(&mut head)?;
        source.rewind()?;
        let decode = || Self::decode(&head, path, source, &mut room);
        // The decoders are other people's: what one stumbles over is refused like any other damage.
        catch_unwind(AssertUnwindSafe(decode)).unwrap_or(Err(Refusal::Damaged))
    }

    fn decode(head: &[u8], path: &Path, source: Source, room: &mut Room) -> Result<Self, Refusal> {
        match head {
            [0x89, b'P', b'N', b'G', ..] => png::decode(source, room),
            [0xff, 0xd8, ..] => jpeg::decode(source, room),
            [0x76, 0x2f, 0x31, 0x01, ..] => exr::decode(source, room),
            [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => tiff::decode(source, room),
            [b'#', b'?', ..] => hdr::decode(source, room),
            [b'B', b'M', ..] => bmp::decode(source, room),
            [b'G', b'I', b'F', b'8', ..] => gif::decode(source, room),
            _ if has_extension(path, "tga") => tga::decode(source, room),
            [] => Err(Refusal::Ends),
            _ => Err(Refusal::Format),
        }
    }

    fn row(&mut self, row: usize) -> &mut [u8] {
        let stride = self.layout.stride();
        &mut self.samples[row * stride..][..stride]
    }
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension))
}

fn bytes<const N: usize>(source: &mut impl Read) -> Result<[u8; N], Refusal> {
    let mut bytes = [0; N];
    source.read_exact(&mut bytes)?;
    Ok(bytes)
}

fn byte(source: &mut impl Read) -> Result<u8, Refusal> {
    bytes::<1>(source).map(|[byte]| byte)
}

#[cfg(test)]
mod tests;
