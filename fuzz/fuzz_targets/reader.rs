//! Any bytes either read as materials that can be evaluated, or give an error of one line.
//!
//! CONTRIBUTING.md has the command.

#![no_main]

use catseye_materialx::{Document, ShadingPoint};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let document = match Document::from_bytes(bytes, "fuzz.mtlx") {
        Ok(document) => document,
        Err(error) => return assert_one_line(&error.to_string()),
    };
    let _ = (document.looks(), document.warnings());
    match document.outputs() {
        Err(error) => assert_one_line(&error.to_string()),
        Ok(outputs) => {
            for output in &outputs {
                let _ = output.at(&ShadingPoint::default());
            }
        }
    }
    match document.materials() {
        Err(error) => assert_one_line(&error.to_string()),
        Ok(materials) => {
            for material in materials {
                let Some(patterns) = material.patterns else { continue };
                let point = ShadingPoint { texcoord: [0.3, -7.5], ..ShadingPoint::default() };
                let surface = patterns.at(&point);
                assert!((0.0..=1.0).contains(&surface.opacity), "opacity {}", surface.opacity);
                assert!(surface.emission.iter().all(|x| x.is_finite() && *x >= 0.0), "{:?}", surface.emission);
            }
        }
    }
});

fn assert_one_line(message: &str) {
    assert!(!message.contains(char::is_control) && message.len() < 4096, "{message:?}");
}
