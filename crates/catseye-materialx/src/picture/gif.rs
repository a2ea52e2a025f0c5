//! GIF: the first picture of it.

use std::io::BufReader;

use gif::{ColorOutput, DecodeOptions, DecodingError};

use super::{Depth, Layout, Picture, Refusal, Room, Source};

/// Bytes of a pixel: red, green, blue, alpha.
const PIXEL: usize = 4;

pub(super) fn decode(source: Source, room: &mut Room) -> Result<Picture, Refusal> {
    let mut options = DecodeOptions::new();
    options.set_color_output(ColorOutput::RGBA);
    let mut decoder = options.read_info(BufReader::into_inner(source))?;
    let (width, height) = (usize::from(decoder.width()), usize::from(decoder.height()));
    let mut picture = room.picture(Layout { width, height, channels: PIXEL, depth: Depth::Byte })?;
    let frame = decoder.next_frame_info()?.ok_or(Refusal::Ends)?;
    let [left, top, columns, rows] = [frame.left, frame.top, frame.width, frame.height].map(usize::from);
    if (columns, rows) == (width, height) {
        decoder.read_into_buffer(&mut picture.samples)?;
        return Ok(picture);
    }
    let mut part = room.buffer(columns * rows * PIXEL)?;
    decoder.read_into_buffer(&mut part)?;
    // What the frame doesn't cover is transparent.
    let columns_inside = columns.min(width.saturating_sub(left));
    let visible = part.chunks_exact(columns * PIXEL).take(height.saturating_sub(top));
    for (row, pixels) in visible.enumerate() {
        let inside = left * PIXEL..(left + columns_inside) * PIXEL;
        picture.row(top + row)[inside].copy_from_slice(&pixels[..columns_inside * PIXEL]);
    }
    Ok(picture)
}

impl From<DecodingError> for Refusal {
    fn from(cause: DecodingError) -> Self {
        match cause {
            DecodingError::Io(cause) => cause.into(),
            DecodingError::OutOfMemory => Self::Memory,
            DecodingError::MemoryLimit => Self::Room,
            DecodingError::UnexpectedEof => Self::Ends,
            _ => Self::Damaged,
        }
    }
}
