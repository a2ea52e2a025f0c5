//! JPEG.

use std::io::{BufRead as _, Read as _, Seek as _, SeekFrom};

use zune_jpeg::{
    JpegDecoder,
    errors::DecodeErrors,
    zune_core::{bytestream::ZByteIoError, colorspace::ColorSpace, options::DecoderOptions},
};

use super::{Depth, Layout, MAX_SIDE, Picture, Refusal, Room, Source, byte, bytes};

/// What the decoder takes for rows, and for the embedded profiles and texts that it keeps.
const ROWS: usize = 4 << 20;

pub(super) fn decode(mut source: Source, room: &mut Room) -> Result<Picture, Refusal> {
    let keeps_coefficients = keeps_coefficients(&mut source)?;
    ends_with_marker(&mut source)?;
    source.rewind()?;
    let options =
        DecoderOptions::default().set_max_width(MAX_SIDE).set_max_height(MAX_SIDE).set_strict_mode(true);
    let mut decoder = JpegDecoder::new_with_options(source, options);
    decoder.decode_headers()?;
    let (info, space) = (decoder.info(), decoder.input_colorspace());
    let info = info.ok_or(Refusal::Damaged)?;
    let (space, channels) = match space {
        Some(ColorSpace::Luma) => (ColorSpace::Luma, 1),
        _ => (ColorSpace::RGB, 3),
    };
    let layout = Layout {
        width: usize::from(info.width),
        height: usize::from(info.height),
        channels,
        depth: Depth::Byte,
    };
    let mut picture = room.picture(layout)?;
    // The blocks at the borders are whole.
    let padded = layout.width.next_multiple_of(32) * layout.height.next_multiple_of(32);
    let coefficients = if keeps_coefficients { 2 * padded * usize::from(info.components) } else { 0 };
    room.scratch(ROWS + coefficients)?;
    decoder.set_options(options.jpeg_set_out_colorspace(space));
    decoder.decode_into(&mut picture.samples)?;
    Ok(picture)
}

/// Whether the picture comes in several scans, so that its coefficients must be kept until the last.
fn keeps_coefficients(source: &mut Source) -> Result<bool, Refusal> {
    source.seek(SeekFrom::Start(2))?;
    let mut components = 0;
    loop {
        // Any number of 0xff, then the marker.
        source.skip_until(0xff)?;
        let marker = loop {
            match byte(source)? {
                0xff => {}
                marker => break marker,
            }
        };
        match marker {
            0 | 0x01 | 0xd0..=0xd9 => continue,
            0xda => {
                let [_, _, scanned] = bytes(source)?;
                return Ok(scanned < components);
            }
            0xc2 => return Ok(true),
            _ => {}
        }
        let length = u16::from_be_bytes(bytes(source)?);
        let mut rest = i64::from(length) - 2;
        if rest < 0 {
            return Err(Refusal::Damaged);
        }
        if matches!(marker, 0xc0 | 0xc1) && rest >= 6 {
            let [_, _, _, _, _, count] = bytes(source)?;
            components = count;
            rest -= 6;
        }
        source.seek_relative(rest)?;
    }
}

/// Refuses a file without the marker of a picture's end, which a decoder of baseline pictures doesn't miss in
/// the last rows. Cameras append more, so it is sought in the last 64 KiB.
fn ends_with_marker(source: &mut Source) -> Result<(), Refusal> {
    const TAIL: u64 = 64 << 10;
    let length = source.seek(SeekFrom::End(0))?;
    source.seek(SeekFrom::Start(length.saturating_sub(TAIL)))?;
    let mut tail = Vec::new();
    source.take(TAIL).read_to_end(&mut tail)?;
    if tail.windows(2).any(|pair| pair == [0xff, 0xd9]) { Ok(()) } else { Err(Refusal::Ends) }
}

impl From<DecodeErrors> for Refusal {
    fn from(cause: DecodeErrors) -> Self {
        match cause {
            DecodeErrors::ExhaustedData | DecodeErrors::IoErrors(ZByteIoError::NotEnoughBytes(..)) => {
                Self::Ends
            }
            DecodeErrors::IoErrors(ZByteIoError::StdIoError(cause)) => cause.into(),
            DecodeErrors::FormatStatic("Premature end of buffer") => Self::Ends,
            DecodeErrors::Unsupported(_) => Self::Unsupported {
                what: "a JPEG with arithmetic or lossless coding".to_owned(),
                instead: "an ordinary JPEG",
            },
            _ => Self::Damaged,
        }
    }
}
