//! Radiance's RGBE pictures.
//!
//! Format: Greg Ward, "Real Pixels", Graphics Gems II, and Radiance's `color.c`.

use std::io::{BufRead as _, Read};

use super::{Depth, Layout, Picture, Refusal, Room, Source, byte, bytes, unsupported};

/// Bytes of a line of the header.
const MAX_LINE: u64 = 1024;
/// Lines of the header.
const MAX_LINES: usize = 256;

pub(super) fn decode(mut source: Source, room: &mut Room) -> Result<Picture, Refusal> {
    let (width, height) = header(&mut source)?;
    let mut picture = room.picture(Layout { width, height, channels: 3, depth: Depth::Float })?;
    let mut line = vec![[0; 4]; width];
    for row in 0..height {
        scanline(&mut source, &mut line)?;
        for (pixel, rgbe) in picture.row(row).chunks_exact_mut(12).zip(&line) {
            let scale = f32::from(i16::from(rgbe[3]) - 136).exp2();
            for (number, mantissa) in pixel.chunks_exact_mut(4).zip(rgbe) {
                let value = if rgbe[3] == 0 { 0.0 } else { f32::from(*mantissa) * scale };
                number.copy_from_slice(&value.to_ne_bytes());
            }
        }
    }
    Ok(picture)
}

/// Width and height.
fn header(source: &mut Source) -> Result<(usize, usize), Refusal> {
    for _ in 0..MAX_LINES {
        let line = text_line(source)?;
        if line == "FORMAT=32-bit_rle_xyze" {
            return unsupported("a picture in XYZ", "one in RGB");
        }
        if !line.is_empty() {
            continue;
        }
        let resolution = text_line(source)?;
        let words: Vec<&str> = resolution.split_whitespace().collect();
        let ["-Y", height, "+X", width] = words[..] else {
            return unsupported(
                "a picture that is turned or mirrored",
                "one whose rows run from the top left",
            );
        };
        let number = |word: &str| word.parse().map_err(|_| Refusal::Damaged);
        return Ok((number(width)?, number(height)?));
    }
    Err(Refusal::Damaged)
}

fn text_line(source: &mut Source) -> Result<String, Refusal> {
    let mut line = Vec::new();
    source.take(MAX_LINE).read_until(b'\n', &mut line)?;
    match line.pop() {
        Some(b'\n') => Ok(String::from_utf8_lossy(&line).trim_end().to_owned()),
        Some(_) if line.len() as u64 + 1 == MAX_LINE => Err(Refusal::Damaged),
        _ => Err(Refusal::Ends),
    }
}

fn scanline(source: &mut impl Read, line: &mut [[u8; 4]]) -> Result<(), Refusal> {
    let first = bytes(source)?;
    let is_new = first[0] == 2 && first[1] == 2 && first[2] < 128 && (8..0x8000).contains(&line.len());
    if !is_new {
        return old_scanline(source, first, line);
    }
    if usize::from(u16::from_be_bytes([first[2], first[3]])) != line.len() {
        return Err(Refusal::Damaged);
    }
    // One component after the other, each in runs.
    for component in 0..4 {
        let mut column = 0;
        while column < line.len() {
            let code = byte(source)?;
            let (run, value) = if code > 128 { (code - 128, Some(byte(source)?)) } else { (code, None) };
            let pixels = line.get_mut(column..column + usize::from(run)).filter(|run| !run.is_empty());
            for pixel in pixels.ok_or(Refusal::Damaged)? {
                pixel[component] = match value {
                    Some(value) => value,
                    None => byte(source)?,
                };
            }
            column += usize::from(run);
        }
    }
    Ok(())
}

/// Pixels of four bytes; 1, 1, 1, n repeats the last one n times, and such runs in sequence are the digits of
/// one number, the lowest first.
fn old_scanline(source: &mut impl Read, first: [u8; 4], line: &mut [[u8; 4]]) -> Result<(), Refusal> {
    let (mut column, mut shift, mut next) = (0, 0, Some(first));
    while column < line.len() {
        let pixel = match next.take() {
            Some(pixel) => pixel,
            None => bytes(source)?,
        };
        if let [1, 1, 1, digit] = pixel {
            let run = usize::from(digit).checked_shl(shift).ok_or(Refusal::Damaged)?;
            let last = *column.checked_sub(1).and_then(|last| line.get(last)).ok_or(Refusal::Damaged)?;
            let end = column.checked_add(run).ok_or(Refusal::Damaged)?;
            line.get_mut(column..end).ok_or(Refusal::Damaged)?.fill(last);
            column = end;
            shift += 8;
        } else {
            line[column] = pixel;
            column += 1;
            shift = 0;
        }
    }
    Ok(())
}
