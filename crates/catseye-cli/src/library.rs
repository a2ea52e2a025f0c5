//! The MaterialX libraries that documents may use.

use std::path::PathBuf;
use std::sync::Arc;

use catseye_materialx::{Library, SearchPath};

/// Where MaterialX's libraries and the files of documents are.
#[derive(Debug, clap::Args)]
pub(crate) struct LibraryArgs {
    /// Folder that files may be read from, and whose `libraries` define nodes; may be given several times [default: those
    /// of `MATERIALX_SEARCH_PATH`]
    #[arg(long = "materialx-path", value_name = "DIR")]
    folders: Vec<PathBuf>,
}

impl LibraryArgs {
    pub(crate) fn load(&self) -> Result<Arc<Library>, catseye_materialx::Error> {
        let search_path = if self.folders.is_empty() {
            SearchPath::from_env()
        } else {
            SearchPath::new(self.folders.clone())
        };
        Library::load(search_path).map(Arc::new)
    }
}
