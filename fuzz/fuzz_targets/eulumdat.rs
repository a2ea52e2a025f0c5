//! Any bytes are a lamp in EULUMDAT whose intensities are numbers, or give an error of one line.
//!
//! CONTRIBUTING.md has the command.

#![no_main]

use catseye_photometry::lamp::{Axis, Lamp};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    for axis in [None, Some(Axis::Ahead), Some(Axis::Down)] {
        match Lamp::parse_eulumdat(bytes, "fuzz", axis) {
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
});
