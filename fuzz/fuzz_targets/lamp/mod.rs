//! What the readers of lamps' files promise of any bytes: intensities that are numbers, or an error of one
//! line.

use catseye_photometry::Error;
use catseye_photometry::lamp::{Axis, Lamp};

/// Reads bytes along each axis.
pub(crate) fn check(bytes: &[u8], parse: fn(&[u8], &str, Option<Axis>) -> Result<Lamp, Error>) {
    for axis in [None, Some(Axis::Ahead), Some(Axis::Down)] {
        match parse(bytes, "fuzz", axis) {
            Err(error) => {
                let message = error.to_string();
                assert!(!message.contains(char::is_control) && message.len() < 4096, "{message:?}");
            }
            Ok(lamp) => {
                for i in 0..200_u16 {
                    let (right, up) = (f64::from(i) * 7.3 % 360.0 - 180.0, f64::from(i) * 1.7 % 180.0 - 90.0);
                    let known = lamp.intensity_cd(right, up).unwrap_or_default();
                    assert!(known.is_finite() && known >= 0.0, "{right} {up} {known}");
                }
            }
        }
    }
}
