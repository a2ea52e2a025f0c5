//! `catseye materialx`: the node's data library for MaterialX.

mod check;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use catseye_materialx::data_library::{FILES, NAME};
use clap::Subcommand;

use self::check::Check;
use crate::help;

/// Work with MaterialX: write the node's data library, check documents
#[derive(Debug, clap::Args)]
#[command(after_help = help::MATERIALX)]
pub(crate) struct Args {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    Export(Export),
    Check(Check),
}

/// Write the data library that adds `retro_reflective_bsdf` to MaterialX 1.39
///
/// Writes the folder DIR/catseye, over an earlier one of ours. Add DIR to MaterialX's search path and load the library `catseye`, or
/// let DIR be MaterialX's own folder `libraries`, where it is found by itself. docs/materialx.md shows both.
#[derive(Debug, clap::Args)]
#[command(after_help = help::MATERIALX_EXPORT)]
struct Export {
    /// Folder to write the library's folder into; made where it is missing
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        match &self.verb {
            Verb::Export(export) => export.run(),
            Verb::Check(check) => check.run(),
        }
    }
}

impl Export {
    fn run(&self) -> anyhow::Result<()> {
        let library = self.folder.join(NAME);
        for (path, text) in FILES {
            write(&library.join(path), text)?;
        }
        println!("wrote {} ({} files)", library.display(), FILES.len());
        Ok(())
    }
}

fn write(path: &Path, text: &str) -> anyhow::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).with_context(|| format!("can't make the folder {}", folder.display()))?;
    }
    fs::write(path, text).with_context(|| format!("can't write {}", path.display()))
}
