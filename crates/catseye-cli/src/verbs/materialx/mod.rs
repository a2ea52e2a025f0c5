//! `catseye materialx`: the node's data library for MaterialX.

mod check;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use catseye_materialx::data_library::{FOLDER, files};
use clap::Subcommand;
use serde_json::json;

use self::check::Check;
use crate::help;
use crate::report::Stream;

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
/// Writes the folder DIR/libraries/catseye, over an earlier one of ours, and presets and a test document
/// under DIR/resources. Add DIR to MaterialX's search path, or let it be MaterialX's own root folder.
/// docs/materialx.md shows both, USD and the web.
#[derive(Debug, clap::Args)]
#[command(after_help = help::MATERIALX_EXPORT)]
struct Export {
    /// Folder to write into; made where it is missing
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
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
        let files: Vec<_> = files().collect();
        make_folder(&self.folder)?;
        // Everything is on the disk before the first file of the library itself is touched.
        let staging = tempfile::Builder::new().prefix(".catseye-").tempdir_in(&self.folder);
        let staging = staging.map_err(|error| io::Error::from(error.kind()));
        let staging = staging.with_context(|| format!("{}: can't be written", self.folder.display()))?;
        for (path, text) in &files {
            make_folder(parent(&staging.path().join(path)))?;
            fs::write(staging.path().join(path), text.as_bytes())
                .with_context(|| unwritable(&self.folder.join(path)))?;
        }
        for (path, _) in &files {
            let file = self.folder.join(path);
            make_folder(parent(&file))?;
            fs::rename(staging.path().join(path), &file).with_context(|| unwritable(&file))?;
        }
        let name = self.folder.join(FOLDER.trim_end_matches('/')).display().to_string();
        let facts = json!({ "output": name, "files": files.len() });
        Stream::Out.note(self.json, &facts, &format!("wrote {name}"))
    }
}

fn parent(path: &Path) -> &Path {
    path.parent().unwrap_or(path)
}

fn make_folder(folder: &Path) -> anyhow::Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("{}: the folder can't be made", folder.display()))
}

fn unwritable(path: &Path) -> String {
    format!("{}: can't be written", path.display())
}
