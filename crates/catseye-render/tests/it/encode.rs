//! Files keep what a picture holds: an EXR every bit and how it was made, a PNG the sRGB of the tone map.

use std::io::Cursor;

use catseye_render::{Error, Image, PictureInfo, ToneMap, encode_exr, encode_png, encode_png_rgb};
use exr::meta::attribute::AttributeValue;
use exr::prelude::{ReadChannels as _, ReadLayers as _};

fn picture() -> Image {
    Image::from_fn(5, 3, |x, y| [x as f32 * 0.25, y as f32 * 100.0, 0.5])
}

fn info() -> PictureInfo {
    PictureInfo {
        command: "catseye render Straße.mtlx".to_owned(),
        units: "radiance in cd/m2".to_owned(),
        exposure_ev: Some(-7.5),
        lamp_deg: Some(0.2),
    }
}

#[test]
fn exr_keeps_every_bit() {
    let read = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| Image::new(size.width(), size.height()),
            |image, at, (r, g, b): (f32, f32, f32)| image.set_pixel(at.x(), at.y(), [r, g, b]),
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(encode_exr(&picture(), &info()).unwrap()))
        .unwrap();
    assert_eq!(read.layer_data.channel_data.pixels, picture());
}

#[test]
fn exr_says_how_it_was_made() {
    let bytes = encode_exr(&picture(), &info()).unwrap();
    let meta = exr::meta::MetaData::read_from_buffered(bytes.as_slice(), true).unwrap();
    let header = &meta.headers[0];
    let (own, shared) = (&header.own_attributes, &header.shared_attributes);
    let comments = own.comments.as_ref().unwrap().as_slice();
    assert_eq!(str::from_utf8(comments), Ok("catseye render Straße.mtlx\nradiance in cd/m2"));
    assert!(own.software_name.as_ref().unwrap().to_string().starts_with("catseye "));
    assert_eq!(own.other[b"exposureEv".as_slice()], AttributeValue::F32(-7.5));
    assert_eq!(own.other[b"lampDeg".as_slice()], AttributeValue::F32(0.2));
    assert_eq!(shared.chromaticities.unwrap().white.x(), 0.3127);
}

#[test]
fn the_same_picture_is_the_same_bytes() {
    let large = Image::from_fn(300, 200, |x, y| [x as f32, y as f32, (x * y) as f32]);
    let first = encode_exr(&large, &info()).unwrap();
    for _ in 0..8 {
        assert!(encode_exr(&large, &info()).unwrap() == first);
    }
}

#[test]
fn png_is_srgb_of_the_tone_map() {
    let png = encode_png(&picture(), &ToneMap::LINEAR).unwrap();
    let mut reader = png::Decoder::new(Cursor::new(png)).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    assert_eq!(&bytes[..6], &[0, 0, 188, 137, 0, 188]);
    assert_eq!(bytes[5 * 3 + 1], 255);
}

#[test]
fn what_is_no_picture_is_an_error() {
    let error = encode_png_rgb([2, 2], &[0; 11]).unwrap_err();
    assert!(matches!(error, Error::Encode { format: "PNG", .. }), "{error}");
    let error = encode_png(&Image::new(0, 3), &ToneMap::LINEAR).unwrap_err().to_string();
    assert!(error.starts_with("the picture can't be made a PNG file"), "{error}");
}
