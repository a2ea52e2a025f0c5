//! Where a verb may write. Files appear whole or not at all: see [`catseye_render::write_whole`].

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use anyhow::Context as _;

/// An output file that can be written, as far as can be known before the work is done.
#[derive(Clone, Debug)]
pub(crate) struct Output {
    given: PathBuf,
    target: PathBuf,
}

impl Output {
    /// Refuses at once what could only fail after the work.
    pub(crate) fn new(path: &Path) -> anyhow::Result<Self> {
        // Behind a link the target is replaced, not the link.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        refuse_unwritable(&target).with_context(|| format!("{}: can't be written", path.display()))?;
        Ok(Self { given: path.to_owned(), target })
    }

    /// The file to write.
    pub(crate) fn path(&self) -> &Path {
        &self.target
    }

    /// The file as the user named it.
    pub(crate) fn name(&self) -> String {
        self.given.display().to_string()
    }

    /// Writes the whole file.
    pub(crate) fn write(&self, bytes: &[u8]) -> anyhow::Result<()> {
        Ok(catseye_render::write_whole(&self.target, |file| file.write_all(bytes))?)
    }
}

fn refuse_unwritable(path: &Path) -> io::Result<()> {
    if let Ok(meta) = fs::metadata(path) {
        if meta.is_dir() {
            return Err(io::Error::other("it is a folder"));
        }
        if !meta.is_file() {
            // Renaming a file to its name would take a device out of the system.
            return Err(io::Error::other("it is not a regular file"));
        }
        if meta.permissions().readonly() {
            return Err(io::Error::other("it is read-only"));
        }
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(io::Error::other(format!("there is no folder {}", folder.display())));
    }
    // The error's own text names the temporary file, which would puzzle everyone.
    tempfile::tempfile_in(folder).map_err(|error| io::Error::from(error.kind()))?;
    Ok(())
}
