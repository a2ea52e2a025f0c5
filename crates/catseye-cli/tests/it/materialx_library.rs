//! The data library loads, generates, compiles, evaluates and renders in MaterialX itself, as our own code
//! does.
//!
//! Runs the Python tests of `crates/catseye-materialx/tests/materialx`. They get a virtual environment under
//! the target folder, made at the first run. Where Python, the packages or a display can't be had they are
//! skipped, and say so; with `CATSEYE_REQUIRE=all` that is a failure.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

fn tests() -> PathBuf {
    root().join("crates/catseye-materialx/tests/materialx")
}

/// The folder that holds the binary under test, `target/debug` usually.
fn target() -> PathBuf {
    Path::new(env!("CARGO_BIN_EXE_catseye")).parent().unwrap().to_path_buf()
}

fn succeeds(command: &mut Command) -> bool {
    command.output().is_ok_and(|output| output.status.success())
}

/// The Python of the virtual environment, made where it is missing or its packages have changed.
fn python() -> Option<PathBuf> {
    let requirements = tests().join("requirements.txt");
    let wanted = std::fs::read_to_string(&requirements).unwrap();
    let folder = target().join("materialx-venv");
    let (python, stamp) = (folder.join("bin/python"), folder.join("requirements.txt"));
    // The tests run at once, in processes of their own: the first one makes it, the others wait.
    let lock = std::fs::File::create(target().join("materialx-venv.lock")).unwrap();
    lock.lock().unwrap();
    if std::fs::read_to_string(&stamp).is_ok_and(|installed| installed == wanted) {
        return Some(python);
    }
    let made = succeeds(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&folder))
        && succeeds(Command::new(&python).args(["-m", "pip", "install", "-q", "-r"]).arg(&requirements));
    made.then(|| {
        std::fs::write(stamp, wanted).unwrap();
        python
    })
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

/// Says so past the test harness, which would keep the output of a test that passes to itself.
#[expect(clippy::explicit_write, reason = "eprintln! is what the harness keeps")]
fn skipped(what: &str) {
    writeln!(std::io::stderr(), "skipped: {what}").unwrap();
}

fn run(file: &str) {
    let required = std::env::var("CATSEYE_REQUIRE").is_ok_and(|value| value == "all");
    let Some(python) = python() else {
        assert!(!required, "no virtual environment with MaterialX could be made");
        skipped(&format!("{file}: no virtual environment with MaterialX could be made"));
        return;
    };
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
    let output = command.output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    eprintln!("{text}");
    text.lines().filter(|line| line.contains("skipped '")).for_each(skipped);
    assert!(output.status.success(), "{file}");
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
fn the_environment_is_integrated() {
    run("test_environment.py");
}

#[test]
fn pictures_match_ours() {
    run("test_pictures.py");
}

#[test]
fn what_is_missing_fails_where_everything_is_required() {
    let Some(python) = python() else {
        return skipped("no virtual environment with MaterialX could be made");
    };
    let files = [
        ("test_generate.py", "Generate.test_glsl_compiles"),
        ("test_fallback.py", "Fallback.test_the_surface_is_translated"),
        ("test_hosts.py", "Web.test_the_module_brings_the_nodes"),
        ("test_nodes.py", "Nodes"),
        ("test_values.py", "Values"),
        ("test_environment.py", "Environment"),
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
