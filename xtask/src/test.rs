//! The test command of README.md.

use anyhow::Result;

use crate::lint;
use crate::tool::{cargo, output, run_cargo};

/// Everything that must hold, cheap checks first. The tests come last, so that their summary is what ends the
/// output.
///
/// The generated files are among the tests: see [`crate::generated`].
pub(crate) fn run() -> Result<()> {
    lint::run()?;
    run_cargo("test --release --workspace --doc")?;
    // nextest runs the tests of all crates at once and sums them up in one line; without it nothing else is
    // lost.
    if output(&mut cargo("nextest --version")).is_some() {
        run_cargo("nextest run --release --workspace --no-fail-fast")
    } else {
        run_cargo("test --release --workspace --tests --no-fail-fast")
    }
}
