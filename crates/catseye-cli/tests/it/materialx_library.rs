//! The data library loads, generates, compiles, evaluates and renders in MaterialX itself, as our own code
//! does.
//!
//! Runs the Python tests of `crates/catseye-materialx/tests/materialx`. Where a display can't be had, those
//! that need one are skipped, and say so; with `CATSEYE_REQUIRE=all` that is a failure.

use std::path::PathBuf;
use std::process::Command;

use crate::python::{self, root, skipped, succeeds, target};

fn tests() -> PathBuf {
    root().join("crates/catseye-materialx/tests/materialx")
}

/// An example that some of the tests run: it renders our half of pictures, or evaluates nodes.
fn example(package: &str, name: &str) -> Option<PathBuf> {
    let build = ["build", "--release", "--package", package, "--example", name];
    // Beside the tests' own folder, whatever their profile: in most runs it is built already.
    let folder = target().join("..");
    let mut cargo = Command::new(env!("CARGO"));
    let built = succeeds(cargo.args(build).arg("--target-dir").arg(&folder).current_dir(root()));
    built.then(|| folder.join("release/examples").join(name))
}

fn run(file: &str) {
    let Some(python) = python::required(&tests(), "materialx", file) else { return };
    let pictures = file == "test_pictures.py";
    let has_xvfb = succeeds(Command::new("sh").args(["-c", "command -v xvfb-run"]));
    let mut command = if pictures && has_xvfb {
        let mut xvfb = Command::new("xvfb-run");
        xvfb.args(["-a", "-s", "-screen 0 1280x1024x24"]).arg(python);
        xvfb
    } else {
        Command::new(python)
    };
    command
        .args(["-B", file, "-v"])
        .current_dir(tests())
        .env("CATSEYE", env!("CARGO_BIN_EXE_catseye"))
        .env("CATSEYE_EVIDENCE", target().join("../evidence/materialx"));
    let needed = match file {
        "test_pictures.py" => Some(("DIRECT_SPHERE", example("catseye-render", "direct_sphere"))),
        "test_nodes.py" => Some(("OUTPUTS", example("catseye-materialx", "outputs"))),
        _ => None,
    };
    if let Some((name, Some(path))) = needed {
        command.env(name, path);
    }
    python::passes(&mut command, file);
}

#[test]
fn the_library_loads_and_is_complete() {
    run("test_library.py");
}

#[test]
fn old_documents_are_upgraded_as_the_reader_is_told() {
    run("test_upgrade.py");
}

#[test]
fn every_document_generates_and_compiles() {
    run("test_generate.py");
}

#[test]
fn without_the_library_the_look_by_day_is_kept() {
    run("test_fallback.py");
}

#[test]
fn nodes_are_those_of_materialx() {
    run("test_nodes.py");
}

#[test]
fn other_hosts_read_it() {
    run("test_hosts.py");
}

#[test]
fn values_match_the_oracle() {
    run("test_values.py");
}

#[test]
fn what_is_exported_to_engines_is_as_stated() {
    run("test_export.py");
}

#[test]
fn the_environment_is_integrated() {
    run("test_environment.py");
}

#[test]
fn pictures_match_ours() {
    run("test_pictures.py");
}

#[test]
fn what_is_missing_fails_where_everything_is_required() {
    let Some(python) = python::interpreter(&tests(), "materialx") else {
        return skipped("no virtual environment with MaterialX could be made");
    };
    let files = [
        ("test_generate.py", "Generate.test_glsl_compiles"),
        ("test_fallback.py", "Fallback.test_the_surface_is_translated"),
        ("test_hosts.py", "Web.test_the_module_brings_the_nodes"),
        ("test_nodes.py", "Nodes"),
        ("test_values.py", "Values"),
        ("test_environment.py", "Environment"),
        ("test_export.py", "Gltf"),
        ("test_export.py", "Three"),
        ("test_pictures.py", "Pictures"),
    ];
    for (file, case) in files {
        for (required, good) in [("all", false), ("", true)] {
            // No programs, no display, no command under test.
            let mut command = Command::new(&python);
            command.args(["-B", file, case]).current_dir(tests()).env_clear();
            command.env("PATH", "").env("CATSEYE_REQUIRE", required);
            let output = command.output().unwrap();
            let text = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.success(), good, "{file}, CATSEYE_REQUIRE={required}: {text}");
            assert!(text.contains(if good { "skipped=" } else { "AssertionError" }), "{file}: {text}");
        }
    }
}
