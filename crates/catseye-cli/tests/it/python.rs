//! Tests in Python, of what other programs make of our files.
//!
//! They get a virtual environment under the target folder, made at the first run. Where Python or the
//! packages can't be had they are skipped, and say so; with `CATSEYE_REQUIRE=all` that is a failure.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// The folder that holds the binary under test, `target/debug` usually.
pub(crate) fn target() -> PathBuf {
    Path::new(env!("CARGO_BIN_EXE_catseye")).parent().unwrap().to_path_buf()
}

pub(crate) fn succeeds(command: &mut Command) -> bool {
    command.output().is_ok_and(|output| output.status.success())
}

/// The Python of the virtual environment for a folder with `requirements.txt`, made where it is missing or
/// its packages have changed.
pub(crate) fn interpreter(tests: &Path, name: &str) -> Option<PathBuf> {
    let requirements = tests.join("requirements.txt");
    let wanted = std::fs::read_to_string(&requirements).unwrap();
    let folder = target().join(format!("{name}-venv"));
    let (python, stamp) = (folder.join("bin/python"), folder.join("requirements.txt"));
    // The tests run at once, in processes of their own: the first one makes it, the others wait.
    let lock = std::fs::File::create(target().join(format!("{name}-venv.lock"))).unwrap();
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

/// The Python of the virtual environment; where there can be none says that `what` is skipped, and fails
/// where everything is required.
pub(crate) fn required(tests: &Path, name: &str, what: &str) -> Option<PathBuf> {
    let python = interpreter(tests, name);
    if python.is_none() {
        let all = std::env::var("CATSEYE_REQUIRE").is_ok_and(|value| value == "all");
        assert!(!all, "no virtual environment with {name} could be made");
        skipped(&format!("{what}: no virtual environment with {name} could be made"));
    }
    python
}

/// Runs the command, shows what it says, and expects success.
pub(crate) fn passes(command: &mut Command, what: &str) {
    let output = command.output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    eprintln!("{text}");
    text.lines().filter(|line| line.contains("skipped '")).for_each(skipped);
    assert!(output.status.success(), "{what}");
}

/// Says so past the test harness, which would keep the output of a test that passes to itself.
#[expect(clippy::explicit_write, reason = "eprintln! is what the harness keeps")]
pub(crate) fn skipped(what: &str) {
    writeln!(std::io::stderr(), "skipped: {what}").unwrap();
}
