//! Which files a document may read: those under its own folder and under the search path.

use std::{
    fs::File,
    io::{self, Read as _},
    path::{Path, PathBuf},
};

use crate::text::source::Source;

/// Largest document that is read; MaterialX's largest is below 1 MiB.
pub(crate) const MAX_BYTES: usize = 16 << 20;

/// The folders that files may be read from.
///
/// A document may name files under its own folder; what it names outside, with `..`, an absolute path or a
/// symbolic link, must lie under one of these folders.
#[derive(Clone, Debug, Default)]
pub struct SearchPath {
    folders: Vec<PathBuf>,
}

/// Why a file that a document names is not read.
#[derive(Debug)]
pub(crate) enum Refusal {
    Missing,
    Outside,
    /// The name stands for many files.
    Tiles,
}

impl SearchPath {
    /// The folders, the first one first.
    #[must_use]
    pub fn new(folders: impl IntoIterator<Item = PathBuf>) -> Self {
        Self { folders: folders.into_iter().collect() }
    }

    /// The folders of the environment variable `MATERIALX_SEARCH_PATH`; none where it is not set.
    #[must_use]
    pub fn from_env() -> Self {
        let variable = std::env::var_os("MATERIALX_SEARCH_PATH").unwrap_or_default();
        Self::new(std::env::split_paths(&variable).filter(|folder| !folder.as_os_str().is_empty()))
    }

    /// The folders.
    #[must_use]
    pub fn folders(&self) -> &[PathBuf] {
        &self.folders
    }

    /// The file that an element of `source` names.
    pub(crate) fn find(&self, source: &Source, name: &str) -> Result<PathBuf, Refusal> {
        if ["<UDIM>", "<UVTILE>"].iter().any(|token| name.contains(token)) {
            return Err(Refusal::Tiles);
        }
        let bases = source.folder().into_iter().chain(self.folders.iter().map(PathBuf::as_path));
        let mut refusal = Refusal::Missing;
        for base in bases {
            // Symbolic links and `..` are resolved before the comparison: nothing is compared by its
            // spelling.
            let Ok(path) = base.join(name).canonicalize() else { continue };
            if self.allows(source, &path) {
                return Ok(path);
            }
            refusal = Refusal::Outside;
        }
        Err(refusal)
    }

    fn allows(&self, source: &Source, path: &Path) -> bool {
        let mut roots = source.folder().into_iter().chain(self.folders.iter().map(PathBuf::as_path));
        roots.any(|root| root.canonicalize().is_ok_and(|root| path.starts_with(root)))
    }
}

/// Reads at most one byte more than is allowed, also from what never ends.
pub(crate) fn read(path: &Path) -> io::Result<Vec<u8>> {
    // Opening a pipe would wait for a writer.
    if !path.metadata()?.is_file() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no regular file"));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}
