//! TGA.
//!
//! Format: Truevision, "TGA File Format Specification", version 2.0.

use std::io::Read;

use super::{Depth, Layout, Picture, Refusal, Room, Source, byte, bytes, unsupported};

/// What the bytes of an entry, of a pixel or of the palette, stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Entry {
    Grey,
    GreyAlpha,
    /// Five bits each, the lowest for blue; the highest is an attribute that is rarely alpha.
    Bits15,
    Bgr,
    Bgra,
}

impl Entry {
    fn of_color(bits: u8) -> Result<Self, Refusal> {
        match bits {
            15 | 16 => Ok(Self::Bits15),
            24 => Ok(Self::Bgr),
            32 => Ok(Self::Bgra),
            _ => unsupported(format!("a TGA with {bits} bits a colour"), "one with 24 or 32"),
        }
    }

    const fn channels(self) -> usize {
        match self {
            Self::Grey => 1,
            Self::GreyAlpha => 2,
            Self::Bits15 | Self::Bgr => 3,
            Self::Bgra => 4,
        }
    }

    /// The channels, at most four.
    fn read(self, source: &mut impl Read) -> Result<[u8; 4], Refusal> {
        Ok(match self {
            Self::Grey => [byte(source)?, 0, 0, 0],
            Self::GreyAlpha => {
                let [grey, alpha] = bytes(source)?;
                [grey, alpha, 0, 0]
            }
            Self::Bits15 => {
                let bits = u16::from_le_bytes(bytes(source)?);
                let five = |shift: u16| (u32::from(bits >> shift & 31) * 255 / 31) as u8;
                [five(10), five(5), five(0), 0]
            }
            Self::Bgr => {
                let [blue, green, red] = bytes(source)?;
                [red, green, blue, 0]
            }
            Self::Bgra => {
                let [blue, green, red, alpha] = bytes(source)?;
                [red, green, blue, alpha]
            }
        })
    }
}

pub(super) fn decode(mut source: Source, room: &mut Room) -> Result<Picture, Refusal> {
    let [id_length, palette_kind, kind, head @ ..] = bytes::<18>(&mut source)?;
    let word = |i: usize| usize::from(u16::from_le_bytes([head[i], head[i + 1]]));
    let (width, height, bits, flags) = (word(9), word(11), head[13], head[14]);
    std::io::copy(&mut source.by_ref().take(u64::from(id_length)), &mut std::io::sink())?;
    let mut palette = Vec::new();
    if palette_kind == 1 {
        let entry = Entry::of_color(head[4])?;
        for _ in 0..word(2) {
            palette.push(entry.read(&mut source)?);
        }
    }
    let (entry, index_bytes) = match (kind & 7, bits) {
        (1, 8 | 16) if palette_kind == 1 => (Entry::of_color(head[4])?, Some(bits / 8)),
        (2, _) => (Entry::of_color(bits)?, None),
        (3, 8) => (Entry::Grey, None),
        (3, 16) => (Entry::GreyAlpha, None),
        _ => return unsupported("this kind of TGA", "one in true colour or grey"),
    };
    if kind & !0b1011 != 0 {
        return unsupported("this kind of TGA", "one in true colour or grey");
    }
    let channels = entry.channels();
    let mut picture = room.picture(Layout { width, height, channels, depth: Depth::Byte })?;
    let pixel = |source: &mut Source| match index_bytes {
        None => entry.read(source),
        Some(size) => {
            let index = if size == 1 {
                usize::from(byte(source)?)
            } else {
                usize::from(u16::from_le_bytes(bytes(source)?))
            };
            // Entry 0 of the file is the one with this number.
            let entry = index.checked_sub(word(0)).and_then(|index| palette.get(index));
            entry.copied().ok_or(Refusal::Damaged)
        }
    };
    let (mut run, mut repeated) = (0, None);
    for i in 0..width * height {
        if kind & 8 != 0 && run == 0 {
            let code = byte(&mut source)?;
            run = usize::from(code & 127) + 1;
            repeated = if code & 128 != 0 { Some(pixel(&mut source)?) } else { None };
        }
        run = run.saturating_sub(1);
        let value = match repeated {
            Some(value) => value,
            None => pixel(&mut source)?,
        };
        let (column, row) = (i % width, i / width);
        let column = if flags & 0x10 == 0 { column } else { width - 1 - column };
        let row = if flags & 0x20 == 0 { height - 1 - row } else { row };
        let at = (row * width + column) * channels;
        picture.samples[at..at + channels].copy_from_slice(&value[..channels]);
    }
    Ok(picture)
}
