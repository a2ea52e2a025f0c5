//! What the compiler and its companions can say without running anything.

use std::process::Command;

use anyhow::Result;

use crate::package;
use crate::tool::{self, cargo, has_cargo, output, run_cargo};

/// Formatting, clippy, documentation, the BSDF without std, and the packages.
pub(crate) fn run() -> Result<()> {
    if has_cargo("fmt", "run `rustup component add rustfmt`")? {
        run_cargo("fmt --all --check")?;
    }
    if has_cargo("clippy", "run `rustup component add clippy`")? {
        run_cargo("clippy --release --workspace --all-targets -- -D warnings")?;
    }
    document()?;
    without_std()?;
    package::run()
}

/// Builds the documentation, private items too; a warning is an error.
fn document() -> Result<()> {
    let args = "doc --release --workspace --no-deps --document-private-items";
    tool::run(cargo(args).env("RUSTDOCFLAGS", "-D warnings"), &format!("cargo {args}"))
}

/// Checks the BSDF without std: for a target that has none where one is installed, else for this machine.
fn without_std() -> Result<()> {
    let mut args = "check --release -p catseye --no-default-features --features libm".to_owned();
    let installed = output(Command::new("rustup").args(["target", "list", "--installed"]));
    if let Some(target) = installed.iter().flat_map(|list| list.lines()).find(|line| is_bare(line)) {
        args += &format!(" --target {target}");
    }
    run_cargo(&args)
}

/// Whether a target has no operating system, and so no std.
fn is_bare(target: &str) -> bool {
    target.contains("-none")
}
