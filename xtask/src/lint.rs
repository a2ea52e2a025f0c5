//! What the compiler and its companions can say without running anything.

use std::fs;
use std::process::Command;

use anyhow::{Context as _, Result, ensure};

use crate::package;
use crate::tool::{self, cargo, has_cargo, output, run_cargo};

/// Formatting, the width of lines, clippy, documentation, the BSDF without std, and the packages.
pub(crate) fn run() -> Result<()> {
    if has_cargo("fmt", "run `rustup component add rustfmt`")? {
        run_cargo("fmt --all --check")?;
    }
    if has_cargo("clippy", "run `rustup component add clippy`")? {
        run_cargo("clippy --release --workspace --all-targets -- -D warnings")?;
    }
    widths()?;
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

/// Lines within the columns that people read in: 110 in Rust, 120 in Markdown. Exempt are what can't be
/// broken, which is text in quotes, tables, listings and links, and generated files.
fn widths() -> Result<()> {
    let files = output(Command::new("git").args(["ls-files", "*.rs", "*.md"]).current_dir(tool::root()));
    let Some(files) = files else {
        eprintln!("xtask: SKIPPED: the width of lines, since git doesn't list the files");
        return Ok(());
    };
    let mut wide = Vec::new();
    for file in files.lines() {
        let text =
            fs::read_to_string(tool::root().join(file)).with_context(|| format!("{file}: can't be read"))?;
        if !text.starts_with("// Generated") {
            wide.extend(wide_lines(&text, file.ends_with(".md")).map(|n| format!("{file}:{n}")));
        }
    }
    ensure!(wide.is_empty(), "wider than 110 columns in Rust or 120 in Markdown: {}", wide.join(", "));
    Ok(())
}

/// The numbers of lines that are too wide.
fn wide_lines(text: &str, is_markdown: bool) -> impl Iterator<Item = usize> {
    let most = if is_markdown { 120 } else { 110 };
    let mut listing = false;
    text.lines().enumerate().filter_map(move |(i, line)| {
        listing ^= is_markdown && line.starts_with("```");
        let indivisible = if is_markdown {
            listing || line.starts_with(['|', ' ']) || line.contains("](")
        } else {
            let is_table = line.trim_start().trim_start_matches(['/', '!']).starts_with(" |");
            is_table || line.contains('"') || line.ends_with('\\') || line.contains("](")
        };
        (!indivisible && line.chars().count() > most).then_some(i + 1)
    })
}
