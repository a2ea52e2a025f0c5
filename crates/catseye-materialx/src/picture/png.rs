//! PNG.

use png::{BitDepth, Decoder, DecodingError, Limits, Transformations};

use super::{Depth, Layout, Picture, Refusal, Room, Source};

/// What the decoder may take for its rows and tables: a row of 16,384 pixels has 131,072 bytes.
const MAX_SCRATCH: usize = 4 << 20;

pub(super) fn decode(source: Source, room: &mut Room) -> Result<Picture, Refusal> {
    room.scratch(MAX_SCRATCH)?;
    let mut decoder = Decoder::new_with_limits(source, Limits { bytes: MAX_SCRATCH });
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    decoder.set_transformations(Transformations::EXPAND);
    let (width, height) = decoder.read_header_info()?.size();
    super::check_size(width as usize, height as usize)?;
    let mut reader = decoder.read_info()?;
    let (color, bits) = reader.output_color_type();
    let depth = if bits == BitDepth::Sixteen { Depth::Word } else { Depth::Byte };
    let layout = Layout { width: width as usize, height: height as usize, channels: color.samples(), depth };
    let mut picture = room.picture(layout)?;
    reader.next_frame(&mut picture.samples)?;
    reader.finish()?;
    if depth == Depth::Word {
        for word in picture.samples.chunks_exact_mut(2) {
            word.copy_from_slice(&u16::from_be_bytes([word[0], word[1]]).to_ne_bytes());
        }
    }
    Ok(picture)
}

impl From<DecodingError> for Refusal {
    fn from(cause: DecodingError) -> Self {
        match cause {
            DecodingError::IoError(cause) => cause.into(),
            DecodingError::Format(_) | DecodingError::Parameter(_) => Self::Damaged,
            DecodingError::LimitsExceeded => Self::Room,
        }
    }
}
