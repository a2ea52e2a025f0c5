//! Developer tasks. People and continuous integration run the same commands, so they can't differ.

mod fit_albedo;
mod generated;
mod golden;
mod lint;
mod package;
mod pictures;
mod shader_albedo;
mod test;
mod tool;

use clap::{Parser, Subcommand};

use generated::Mode;

/// The examples of README.md, compiled and run as tests of the documentation.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;

/// Chores of the Catseye workspace
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Debug, Subcommand)]
enum Chore {
    /// Check formatting, clippy, the documentation, the build without std and the packages
    Lint,
    /// Lint, then run every test
    Test,
    /// Fit the albedo: regenerate crates/catseye/src/albedo/tables.rs
    FitAlbedo(Mode),
    /// Regenerate the project's own vectors in conformance/
    Golden(Mode),
    /// Write the compact albedo fit's table into the shading languages
    Shaders(Mode),
    /// Render the pictures of README.md and docs/
    Readme,
}

/// Runs the chore that the command line names, in the workspace's root.
///
/// # Errors
/// The check that failed, or the command that could not be run.
pub fn run() -> anyhow::Result<()> {
    let cli = Cli::parse();
    std::env::set_current_dir(tool::root())?;
    match cli.chore {
        Chore::Lint => lint::run(),
        Chore::Test => test::run(),
        Chore::FitAlbedo(mode) => generated::TABLES.run(mode),
        Chore::Golden(mode) => generated::VECTORS.run(mode),
        Chore::Shaders(mode) => generated::SHADERS.run(mode),
        Chore::Readme => pictures::run(),
    }
}
