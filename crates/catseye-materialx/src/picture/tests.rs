//! Every format to known pixels, and no damaged file as a picture.

use std::{fs, path::PathBuf, sync::LazyLock};

use exr::prelude::f16;

use super::{Depth, Layout, Picture, Refusal, Room};

/// File, channels, depth, and how far a number may be off, in 1/255. The pixels are those of `make.py` beside
/// the files.
const FILES: &[(&str, usize, Depth, f32)] = &[
    ("rgb8.png", 3, Depth::Byte, 0.0),
    ("palette.png", 3, Depth::Byte, 0.0),
    ("grey16.png", 1, Depth::Word, 0.0),
    ("rgba16.png", 4, Depth::Word, 0.0),
    // What the quantisation of JPEG leaves at quality 100, and with subsampled colours.
    ("rgb.jpg", 3, Depth::Byte, 3.0),
    ("grey.jpg", 1, Depth::Byte, 2.0),
    ("progressive.jpg", 3, Depth::Byte, 12.0),
    ("grey.gif", 4, Depth::Byte, 0.0),
    ("rgb.bmp", 3, Depth::Byte, 0.0),
    ("palette.bmp", 3, Depth::Byte, 0.0),
    ("runs.bmp", 3, Depth::Byte, 0.0),
    // Five and six bits a channel.
    ("565.bmp", 3, Depth::Byte, 8.0),
    ("rgb.tga", 3, Depth::Byte, 0.0),
    ("rgba_runs.tga", 4, Depth::Byte, 0.0),
    ("grey.tga", 1, Depth::Byte, 0.0),
    ("palette_runs.tga", 3, Depth::Byte, 0.0),
    // Eight bits with the exponent of the largest channel.
    ("rgb.hdr", 3, Depth::Float, 1.0),
    ("rgb_half.exr", 3, Depth::Half, 0.1),
    ("layers.exr", 3, Depth::Half, 0.1),
    ("rgba_float.exr", 4, Depth::Float, 1e-4),
    ("height.exr", 1, Depth::Float, 1e-4),
    ("rgb8_lzw.tif", 3, Depth::Byte, 0.0),
    ("grey16_zip.tif", 1, Depth::Word, 0.0),
    ("rgba_half_planes.tif", 4, Depth::Half, 0.1),
    ("rgb_float_tiles.tif", 3, Depth::Float, 1e-4),
];

/// Files whose channels are all the same, or whose alpha is 1.
const GREYS: &[&str] = &["palette.png", "grey.gif", "palette.bmp", "runs.bmp", "palette_runs.tga"];

fn path(name: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/pictures")).join(name)
}

fn open(name: &str) -> Picture {
    Picture::open(&path(name), Room::beside(0)).unwrap_or_else(|refusal| panic!("{name}: {refusal}"))
}

/// A number of the picture, of 255.
fn number(picture: &Picture, i: usize) -> f32 {
    let depth = picture.layout.depth;
    match &picture.samples[i * depth.bytes()..][..depth.bytes()] {
        [byte] => f32::from(*byte),
        &[a, b] if depth == Depth::Word => f32::from(u16::from_ne_bytes([a, b])) / 257.0,
        &[a, b] => f16::from_ne_bytes([a, b]).to_f32() * 255.0,
        &[a, b, c, d] => f32::from_ne_bytes([a, b, c, d]) * 255.0,
        _ => unreachable!(),
    }
}

#[test]
fn every_format_has_its_pixels() {
    for &(name, channels, depth, tolerance) in FILES {
        let picture = open(name);
        assert_eq!(picture.layout, Layout { width: 9, height: 3, channels, depth }, "{name}");
        for i in 0..27 * channels {
            let (pixel, channel) = (i / channels, i % channels);
            let (x, y) = ((pixel % 9) as f32, (pixel / 9) as f32);
            let expected = match channel {
                3 if GREYS.contains(&name) => 255.0,
                _ if GREYS.contains(&name) => 20.0 * x + 9.0 * y,
                _ => 20.0 * x + 9.0 * y + 20.0 * channel as f32,
            };
            let found = number(&picture, i);
            assert!((found - expected).abs() <= tolerance, "{name} ({x}, {y}): {found}, not {expected}");
        }
    }
}

#[test]
fn bits_and_unused_alpha_of_a_bmp() {
    let bits = open("bits.bmp");
    assert!((0..27).all(|pixel| {
        let grey = 20 * (pixel % 9) + 9 * (pixel / 9);
        number(&bits, 3 * pixel) == if grey > 100 { 255.0 } else { 0.0 }
    }));
    assert_eq!(open("rgba.bmp").layout.channels, 3);
}

/// Every file, changed by `damage`, must be refused or decoded: no panic.
fn decode_damaged(name: &str, bytes: &[u8]) -> Result<Picture, Refusal> {
    // Room for what the decoders need, not for what a damaged header claims.
    let room = match name.rsplit_once('.') {
        Some((_, "tif")) => 82 << 20,
        Some((_, "exr")) => 18 << 20,
        _ => 5 << 20,
    };
    static FOLDER: LazyLock<tempfile::TempDir> = LazyLock::new(|| tempfile::tempdir().unwrap());
    let file = FOLDER.path().join(format!("{:?}{name}", std::thread::current().id()));
    fs::write(&file, bytes).unwrap();
    Picture::open(&file, Room::beside(super::MAX_BYTES - room))
}

#[test]
fn a_file_that_ends_early_is_no_picture() {
    for (name, ..) in FILES {
        let bytes = fs::read(path(name)).unwrap();
        for length in (0..bytes.len()).step_by(2) {
            let refusal = decode_damaged(name, &bytes[..length]).err();
            // What comes behind the pixels: the footer of a TGA, tags of a TIFF, the end of a GIF.
            let needed = match name.rsplit_once('.') {
                Some((_, "tga")) => bytes.len() - 26,
                Some((_, "tif")) => bytes.len() / 4,
                Some((_, "gif")) => bytes.len() - 4,
                _ => bytes.len(),
            };
            assert!(refusal.is_some() || length >= needed, "{name} of {length} bytes, not {}", bytes.len());
        }
        let start = decode_damaged(name, &bytes[..bytes.len() / 4]).err().map(|refusal| refusal.to_string());
        let plain = ["the file ends before the picture does", "its data is damaged"];
        assert!(
            start.as_ref().is_some_and(|text| plain.iter().any(|words| text.starts_with(words))),
            "{name}: {start:?}"
        );
    }
}

#[test]
fn damaged_bytes_do_not_panic() {
    for (name, ..) in FILES {
        let bytes = fs::read(path(name)).unwrap();
        for at in (0..bytes.len()).step_by(3) {
            for byte in [0xff, bytes[at] ^ 1] {
                let mut damaged = bytes.clone();
                damaged[at] = byte;
                let _ = decode_damaged(name, &damaged);
            }
        }
    }
}

#[test]
fn pictures_share_the_room() {
    let beside = |used| Picture::open(&path("rgb8.png"), Room::beside(used));
    assert!(matches!(beside(super::MAX_BYTES - 80), Err(Refusal::Room)));
    assert!(matches!(beside(usize::MAX), Err(Refusal::Room)));
}
