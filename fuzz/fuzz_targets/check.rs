//! Any bytes can be checked; a document without errors can be read.
//!
//! CONTRIBUTING.md has the command.

#![no_main]

use catseye_materialx::{Document, Library, check_bytes};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let report = check_bytes(bytes, "fuzz.mtlx", &Library::default());
    for finding in &report.findings {
        let message = finding.to_string();
        assert!(!message.contains(char::is_control) && message.len() < 4096, "{message:?}");
    }
    if report.has_errors() {
        return;
    }
    let document = Document::from_bytes(bytes, "fuzz.mtlx").unwrap();
    for name in document.material_names() {
        document.material(Some(&name)).unwrap();
    }
});
