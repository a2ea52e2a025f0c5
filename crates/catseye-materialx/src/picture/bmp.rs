//! BMP.
//!
//! Format: Microsoft, "Bitmap Storage", the headers `BITMAPCOREHEADER` to `BITMAPV5HEADER`.

use std::io::{Read, Seek as _, SeekFrom};

use super::{Depth, Layout, Picture, Refusal, Room, Source, byte, bytes, unsupported};

/// How the pixels are packed.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Packing {
    Palette {
        bits: u32,
    },
    /// Runs of palette entries, of eight or of four bits.
    Runs {
        bits: u32,
    },
    Bgr,
    /// Red, green, blue and alpha in these bits of two or four bytes.
    Masks {
        bytes: usize,
        masks: [u32; 4],
    },
}

struct Header {
    layout: Layout,
    from_top: bool,
    packing: Packing,
    palette: Vec<[u8; 3]>,
}

pub(super) fn decode(mut source: Source, room: &mut Room) -> Result<Picture, Refusal> {
    let header = header(&mut source)?;
    let mut picture = room.picture(header.layout)?;
    match header.packing {
        Packing::Runs { bits } => runs(&mut source, &mut picture, &header.palette, bits)?,
        packing => rows(&mut source, &mut picture, &header, packing)?,
    }
    Ok(picture)
}

/// Reads the headers and goes to the pixels.
fn header(source: &mut Source) -> Result<Header, Refusal> {
    let file: [u8; 14] = bytes(source)?;
    let pixels = u32::from_le_bytes([file[10], file[11], file[12], file[13]]);
    let size = u32::from_le_bytes(bytes(source)?);
    if !matches!(size, 12 | 40..=124) {
        return Err(Refusal::Damaged);
    }
    let mut info = vec![0; size as usize - 4];
    source.read_exact(&mut info)?;
    // The masks follow a header of 40 bytes and lie inside a longer one.
    let word = |i: usize| u32::from(u16::from_le_bytes([info[i], info[i + 1]]));
    let long = |i: usize| u32::from_le_bytes([info[i], info[i + 1], info[i + 2], info[i + 3]]);
    let (width, height, bits, compression, colors) = if size == 12 {
        (word(0), word(2) as i32, word(6), 0, 0)
    } else {
        (long(0), long(4) as i32, word(10), long(12), long(28))
    };
    let mut masks = [0; 4];
    if matches!(compression, 3 | 6) {
        let count = if compression == 6 || size >= 56 { 4 } else { 3 };
        for (i, mask) in masks.iter_mut().enumerate().take(count) {
            *mask = if size >= 52 { long(36 + 4 * i) } else { u32::from_le_bytes(bytes(source)?) };
        }
    }
    let packing = match (compression, bits) {
        (0, 1 | 4 | 8) => Packing::Palette { bits },
        (1, 8) | (2, 4) => Packing::Runs { bits },
        (0, 24) => Packing::Bgr,
        (0, 16) => Packing::Masks { bytes: 2, masks: [31 << 10, 31 << 5, 31, 0] },
        (0, 32) => Packing::Masks { bytes: 4, masks: [0xff << 16, 0xff << 8, 0xff, 0] },
        (3 | 6, 16 | 32) => Packing::Masks { bytes: bits as usize / 8, masks },
        _ => return unsupported("this kind of BMP", "one with 24 or 32 bits a pixel"),
    };
    let palette = match packing {
        Packing::Palette { bits } | Packing::Runs { bits } => palette(source, size, bits, colors)?,
        _ => Vec::new(),
    };
    source.seek(SeekFrom::Start(u64::from(pixels)))?;
    let channels =
        if matches!(packing, Packing::Masks { masks: [.., alpha], .. } if alpha > 0) { 4 } else { 3 };
    let (width, rows) = (width as usize, height.unsigned_abs() as usize);
    let layout = Layout { width, height: rows, channels, depth: Depth::Byte };
    Ok(Header { layout, from_top: height < 0, packing, palette })
}

fn palette(source: &mut Source, size: u32, bits: u32, colors: u32) -> Result<Vec<[u8; 3]>, Refusal> {
    let most = 1 << bits;
    let count = if colors == 0 { most } else { colors.min(most) };
    let mut palette = Vec::new();
    for _ in 0..count {
        let [blue, green, red] = bytes(source)?;
        if size != 12 {
            byte(source)?;
        }
        palette.push([red, green, blue]);
    }
    Ok(palette)
}

/// Rows of whole four bytes, from the bottom unless the height is negative.
fn rows(
    source: &mut Source,
    picture: &mut Picture,
    header: &Header,
    packing: Packing,
) -> Result<(), Refusal> {
    let Layout { width, height, channels, .. } = header.layout;
    let bits = match packing {
        Packing::Palette { bits } | Packing::Runs { bits } => bits as usize,
        Packing::Bgr => 24,
        Packing::Masks { bytes, .. } => 8 * bytes,
    };
    let mut line = vec![0; (width * bits).div_ceil(32) * 4];
    for row in 0..height {
        source.read_exact(&mut line)?;
        let row = if header.from_top { row } else { height - 1 - row };
        for (column, pixel) in picture.row(row).chunks_exact_mut(channels).enumerate() {
            let start = column * bits / 8;
            match packing {
                Packing::Bgr => pixel.copy_from_slice(&[line[start + 2], line[start + 1], line[start]]),
                Packing::Masks { bytes, masks } => {
                    let packed =
                        (0..bytes).fold(0, |packed, i| packed | u32::from(line[start + i]) << (8 * i));
                    pixel.iter_mut().zip(masks).for_each(|(channel, mask)| *channel = masked(packed, mask));
                }
                Packing::Palette { .. } | Packing::Runs { .. } => {
                    let index = line[start] >> (8 - bits - column * bits % 8) & ((1_u16 << bits) - 1) as u8;
                    pixel.copy_from_slice(entry(&header.palette, index)?);
                }
            }
        }
    }
    Ok(())
}

/// The bits of a mask, its range brought to 0 to 255.
fn masked(packed: u32, mask: u32) -> u8 {
    if mask == 0 {
        return 0;
    }
    let shift = mask.trailing_zeros();
    (u64::from((packed & mask) >> shift) * 255 / u64::from(mask >> shift)) as u8
}

fn entry(palette: &[[u8; 3]], index: u8) -> Result<&[u8; 3], Refusal> {
    palette.get(usize::from(index)).ok_or(Refusal::Damaged)
}

/// Runs from the bottom; what they leave out has the palette's first colour.
fn runs(source: &mut Source, picture: &mut Picture, palette: &[[u8; 3]], bits: u32) -> Result<(), Refusal> {
    let Layout { width, height, .. } = picture.layout;
    for pixel in picture.samples.chunks_exact_mut(3) {
        pixel.copy_from_slice(entry(palette, 0)?);
    }
    let (mut column, mut row) = (0, 0);
    let mut put = |column: &mut usize, row: usize, index: u8| -> Result<(), Refusal> {
        if *column >= width || row >= height {
            return Err(Refusal::Damaged);
        }
        let at = ((height - 1 - row) * width + *column) * 3;
        picture.samples[at..at + 3].copy_from_slice(entry(palette, index)?);
        *column += 1;
        Ok(())
    };
    let nibble = |packed: u8, i: usize| match bits {
        8 => packed,
        _ => packed >> (4 * (1 - i % 2)) & 15,
    };
    loop {
        match bytes(source)? {
            [0, 0] => (column, row) = (0, row + 1),
            [0, 1] => return Ok(()),
            [0, 2] => {
                let [right, up] = bytes(source)?;
                (column, row) = (column + usize::from(right), row + usize::from(up));
            }
            [0, count] => {
                let stored = (usize::from(count) * bits as usize).div_ceil(8).next_multiple_of(2);
                let mut packed = vec![0; stored];
                source.read_exact(&mut packed)?;
                for i in 0..usize::from(count) {
                    put(&mut column, row, nibble(packed[i * bits as usize / 8], i))?;
                }
            }
            [count, packed] => {
                for i in 0..usize::from(count) {
                    put(&mut column, row, nibble(packed, i))?;
                }
            }
        }
    }
}
