//! Any bytes can be checked; a document without problems can be read.
//!
//! CONTRIBUTING.md has the command.

#![no_main]

use catseye_materialx::{Document, Error, Library, check_bytes};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let problems = check_bytes(bytes, "fuzz.mtlx", &Library::default());
    for problem in &problems {
        let message = problem.to_string();
        assert!(!message.contains(char::is_control) && message.len() < 4096, "{message:?}");
    }
    if !problems.is_empty() {
        return;
    }
    let materials = Document::from_bytes(bytes, "fuzz.mtlx").and_then(|document| document.materials());
    match materials {
        // What only building finds: materials without a surface, limits, and settings that must be constant.
        Ok(_)
        | Err(Error::NoMaterial { .. } | Error::NoSurface { .. } | Error::Limit { .. } | Error::Unsupported { .. })
        | Err(Error::OutOfRange { .. } | Error::NoGraph { .. } | Error::MissingAttribute { .. }) => {}
        Err(error) => panic!("check found nothing, but: {error}"),
    }
});
