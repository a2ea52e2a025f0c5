//! TIFF: the first picture of it, strip by strip or tile by tile.

use tiff::{
    ColorType, TiffError, TiffUnsupportedError,
    decoder::{Decoder, DecodingSampleType, Limits, TiffCodingUnit},
};

use super::{Depth, Layout, Picture, Refusal, Room, Source, check_size, unsupported};

/// What the decoder takes for a strip as it is stored, and for its table of strips.
const MAX_STORED: usize = 64 << 20;
const MAX_TABLE: usize = 8 << 20;

pub(super) fn decode(source: Source, room: &mut Room) -> Result<Picture, Refusal> {
    let mut limits = Limits::default();
    limits.intermediate_buffer_size = MAX_STORED;
    limits.ifd_value_size = MAX_TABLE;
    room.scratch(MAX_STORED + 2 * MAX_TABLE)?;
    let mut decoder = Decoder::new(source)?.with_limits(limits);
    let (width, height) = decoder.dimensions()?;
    let (width, height) = (width as usize, height as usize);
    check_size(width, height)?;
    let channels = channels(decoder.colortype()?)?;
    let first = decoder.image_coding_unit_layout(TiffCodingUnit(0))?;
    let (sample, planes) = (first.sample_type, first.planes);
    let depth = match sample {
        Some(DecodingSampleType::U8) => Depth::Byte,
        Some(DecodingSampleType::U16) => Depth::Word,
        Some(DecodingSampleType::F16) => Depth::Half,
        Some(DecodingSampleType::F32) => Depth::Float,
        _ => return unsupported("a TIFF with such numbers", "one with 8 or 16 bits, half or float"),
    };
    if planes != 1 && planes != channels {
        return unsupported("a TIFF with such planes", "one with interleaved channels");
    }
    let mut picture = room.picture(Layout { width, height, channels, depth })?;
    let (columns, rows) = decoder.chunk_dimensions();
    let (columns, rows) = (columns as usize, rows as usize);
    if columns == 0 || rows == 0 {
        return Err(Refusal::Damaged);
    }
    let across = width.div_ceil(columns);
    let direct = planes == 1 && across == 1;
    // The planes of a strip, one after the other.
    let mut strip = if direct { Vec::new() } else { room.buffer(first.complete_len)? };
    for unit in 0..across * height.div_ceil(rows) {
        let (left, top) = (unit % across * columns, unit / across * rows);
        let unit = TiffCodingUnit(unit as u32);
        if direct {
            let stride = picture.layout.stride();
            let end = (top + rows).min(height) * stride;
            decoder.read_coding_unit_bytes(unit, &mut picture.samples[top * stride..end])?;
            continue;
        }
        let (columns, rows) = (columns.min(width - left), rows.min(height - top));
        decoder.read_coding_unit_bytes(unit, &mut strip)?;
        place(&strip, planes, [left, top, columns, rows], &mut picture);
    }
    Ok(picture)
}

fn channels(color: ColorType) -> Result<usize, Refusal> {
    Ok(match color {
        ColorType::Gray(8 | 16 | 32) => 1,
        ColorType::GrayA(8 | 16 | 32) => 2,
        ColorType::RGB(8 | 16 | 32) => 3,
        ColorType::RGBA(8 | 16 | 32) => 4,
        ColorType::Multiband { bit_depth: 8 | 16 | 32, num_samples: samples @ 1..=4 } => usize::from(samples),
        _ => {
            return unsupported(
                "a TIFF with a palette, few bits or other than RGB colours",
                "one in RGB or grey",
            );
        }
    })
}

/// Copies a strip's or tile's planes to their place.
fn place(strip: &[u8], planes: usize, [left, top, columns, rows]: [usize; 4], picture: &mut Picture) {
    let Layout { channels, depth, .. } = picture.layout;
    // What a plane has of a pixel.
    let part = channels / planes * depth.bytes();
    let whole = channels * depth.bytes();
    for (plane, numbers) in strip.chunks_exact(columns * rows * part).take(planes).enumerate() {
        for (row, line) in numbers.chunks_exact(columns * part).enumerate() {
            let pixels = picture.row(top + row)[left * whole..].chunks_exact_mut(whole);
            for (pixel, number) in pixels.zip(line.chunks_exact(part)) {
                pixel[plane * part..][..part].copy_from_slice(number);
            }
        }
    }
}

impl From<TiffError> for Refusal {
    fn from(cause: TiffError) -> Self {
        match cause {
            TiffError::IoError(cause) => cause.into(),
            TiffError::LimitsExceeded | TiffError::IntSizeError => Self::Room,
            TiffError::UnsupportedError(TiffUnsupportedError::UnsupportedCompressionMethod(method)) => {
                Self::Unsupported {
                    what: format!("a TIFF with the compression {method:?}"),
                    instead: "one with LZW, ZIP or without compression",
                }
            }
            TiffError::UnsupportedError(_) => {
                Self::Unsupported { what: "this kind of TIFF".to_owned(), instead: "one in RGB or grey" }
            }
            _ => Self::Damaged,
        }
    }
}
