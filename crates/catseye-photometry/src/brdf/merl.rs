//! MERL's `.binary`: 90 x 90 x 180 values of each channel over half and difference angle.
//!
//! Matusik, Pfister, Brand and `McMillan`, "A Data-Driven Reflectance Model", SIGGRAPH 2003, and the code
//! published with it: three `int32` dimensions, then planes of `f64` for red, green and blue, all
//! little-endian, the difference's azimuth fastest. Negative values were not measured.

use std::f64::consts::{FRAC_PI_2, PI};

use super::coordinates::half_difference;
use super::{Brdf, Cosine};

/// Factors of the channels.
const SCALES: [f64; 3] = [1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0];
/// Half angles, difference angles and azimuths of a file; reciprocal data have 180 azimuths, over half a
/// turn.
const DIMENSIONS: [[u32; 3]; 2] = [[90, 90, 180], [90, 90, 360]];
/// Bytes before the values.
const HEADER: usize = 12;

/// The dimensions that a file begins with, if they are such as MERL's have: no text begins so.
pub(super) fn dimensions(bytes: &[u8]) -> Option<[u32; 3]> {
    let header = bytes.get(..HEADER)?;
    let number = |i: usize| u32::from_le_bytes([header[i], header[i + 1], header[i + 2], header[i + 3]]);
    let found = [number(0), number(4), number(8)];
    // Text has four characters in each: at least 0x09090909.
    found.iter().all(|&size| size < 0x0100_0000).then_some(found)
}

/// Reads the whole file.
pub(super) fn parse(bytes: &[u8], dimensions: [u32; 3]) -> Result<Brdf, String> {
    if !DIMENSIONS.contains(&dimensions) {
        let [a, b, c] = dimensions;
        return Err(format!("has {a} x {b} x {c} values; MERL's files have 90 x 90 x 180 or 90 x 90 x 360"));
    }
    let [halves, differences, azimuths] = dimensions.map(|size| size as usize);
    let plane = halves * differences * azimuths;
    let (found, needed) = (bytes.len(), HEADER + 3 * plane * size_of::<f64>());
    if found != needed {
        return Err(format!("has {found} bytes where its dimensions take {needed}; is it cut off?"));
    }
    let number = |i: usize| {
        let start = HEADER + i * size_of::<f64>();
        let mut eight = [0; size_of::<f64>()];
        eight.copy_from_slice(&bytes[start..start + size_of::<f64>()]);
        f64::from_le_bytes(eight)
    };
    let mut brdf = Brdf { read_as: Cosine::Excluded, ..Brdf::default() };
    for i in 0..plane {
        let value = [0, 1, 2].map(|channel| number(i + channel * plane) * SCALES[channel]);
        // The directions of most cells are those of a bin's middle; half angles are spaced as squares.
        let middle = |index: usize| index as f64 + 0.5;
        let half = FRAC_PI_2 * (middle(i / (azimuths * differences)) / halves as f64).powi(2);
        let difference = FRAC_PI_2 * middle(i / azimuths % differences) / differences as f64;
        let azimuth = PI * middle(i % azimuths) / 180.0;
        let [wi, wo] = half_difference([half, 0.0], [difference, azimuth]);
        brdf.push(wo, wi, value);
    }
    Ok(brdf)
}
