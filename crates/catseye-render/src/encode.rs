//! Pictures as the bytes of a file.

use std::io::Cursor;

use exr::meta::attribute::{AttributeValue, Chromaticities};
use exr::prelude::{
    Encoding, Image as ExrImage, Layer, LayerAttributes, SpecificChannels, Text, Vec2, WritableImage as _,
};

use crate::tone::encode_srgb;
use crate::{Error, Image, ToneMap};

/// The picture as an 8-bit sRGB PNG.
///
/// # Errors
/// As [`encode_png_rgb`].
pub fn encode_png(image: &Image, tone_map: &ToneMap) -> Result<Vec<u8>, Error> {
    let shown = image.toned(tone_map);
    let rgb: Vec<u8> = shown.pixels().iter().flat_map(|pixel| pixel.map(encode_srgb)).collect();
    encode_png_rgb([image.width(), image.height()], &rgb)
}

/// Rows of sRGB bytes as a PNG.
///
/// # Errors
/// A picture without pixels, or not as many bytes as pixels need.
pub fn encode_png_rgb(size: [usize; 2], rgb: &[u8]) -> Result<Vec<u8>, Error> {
    let attempt = || {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, size[0] as u32, size[1] as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(rgb)?;
        writer.finish()?;
        Ok(file)
    };
    attempt().map_err(|e: png::EncodingError| Error::Encode { format: "PNG", reason: e.to_string() })
}

/// What a file says about its picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PictureInfo {
    /// The command that made it.
    pub command: String,
    /// What the values are, such as "cd/m2".
    pub units: String,
    /// The exposure in stops that a PNG of it has; the values are as they are.
    pub exposure_ev: Option<f32>,
    /// The observation angle of the headlamp in degrees.
    pub lamp_deg: Option<f32>,
}

/// The picture as a 32-bit float EXR of linear Rec. 709 radiance. The attributes `chromaticities` and
/// `software` are always there, the others as far as they are known: command and units in `comments`, numbers
/// as `exposureEv` and `lampDeg`.
///
/// # Errors
/// A picture without pixels.
pub fn encode_exr(image: &Image, info: &PictureInfo) -> Result<Vec<u8>, Error> {
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let [r, g, b] = image.pixel(at.x(), at.y());
        (r, g, b)
    });
    let comments = [info.command.as_str(), info.units.as_str()].map(str::trim);
    let comments = comments.into_iter().filter(|line| !line.is_empty()).collect::<Vec<_>>().join("\n");
    let mut attributes = LayerAttributes {
        software_name: Some(software()),
        comments: (!comments.is_empty()).then(|| text(&comments)),
        ..LayerAttributes::default()
    };
    let number = |name: &str, value: Option<f32>| value.map(|v| (text(name), AttributeValue::F32(v)));
    attributes.other.extend(number("exposureEv", info.exposure_ev));
    let size = (image.width(), image.height());
    // Scan lines in order: the bytes are the same whichever thread compresses them first.
    let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, channels);
    let mut exr_image = ExrImage::from_layer(layer);
    exr_image.attributes.chromaticities = Some(REC_709);
    // Another map of attributes: in one map their order would differ from run to run.
    exr_image.attributes.other.extend(number("lampDeg", info.lamp_deg));
    let mut file = Cursor::new(Vec::new());
    match exr_image.write().to_buffered(&mut file) {
        Ok(()) => Ok(file.into_inner()),
        Err(e) => Err(Error::Encode { format: "EXR", reason: e.to_string() }),
    }
}

/// Primaries and white of ITU-R BT.709-6, item 1.3.
pub(crate) const REC_709: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};

/// What the attribute `software` says.
pub(crate) fn software() -> Text {
    text(concat!("catseye ", env!("CARGO_PKG_VERSION")))
}

/// The format's texts are bytes; UTF-8 is what they are read as.
pub(crate) fn text(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}
