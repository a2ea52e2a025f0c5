//! rtrace finds in an exported material what it was exported from.

use std::process::Command;

use crate::python;

#[test]
fn rtrace_finds_what_was_exported() {
    let tests = python::root().join("crates/catseye-photometry/tests/radiance");
    let Some(python) = python::required(&tests, "radiance", "test_radiance.py") else { return };
    let mut command = Command::new(python);
    command
        .args(["-B", "test_radiance.py", "-v"])
        .current_dir(tests)
        .env("CATSEYE", env!("CARGO_BIN_EXE_catseye"));
    python::passes(&mut command, "test_radiance.py");
}
