//! `catseye materialx check`: everything that is wrong with documents.

use std::io::{self, Write as _};
use std::path::PathBuf;

use anyhow::bail;
use catseye_materialx::check;

use crate::help;
use crate::options::LibraryArgs;

/// Check documents: every problem with its place
///
/// Looks for unknown nodes and inputs, wrong types, connections that lead nowhere or in circles, missing
/// files and values out of range, also in nodes that no material uses. One line for each problem,
/// `file:line:column: ...`; exit code 1 if there is any.
#[derive(Debug, clap::Args)]
#[command(after_help = help::MATERIALX_CHECK)]
pub(crate) struct Check {
    /// Documents to check
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    library: LibraryArgs,
}

impl Check {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let library = self.library.load()?;
        let mut out = io::stdout().lock();
        let mut count = 0;
        for file in &self.files {
            let problems = check(file, &library);
            for problem in &problems {
                writeln!(out, "{problem}")?;
            }
            if problems.is_empty() {
                writeln!(out, "{}: no problems", file.display())?;
            }
            count += problems.len();
        }
        match (count, self.files.len()) {
            (0, _) => Ok(()),
            (1, _) => bail!("1 problem"),
            (count, 1) => bail!("{count} problems"),
            (count, files) => bail!("{count} problems in {files} files"),
        }
    }
}
