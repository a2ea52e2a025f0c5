//! The MaterialX libraries that documents may use.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catseye::Model;
use catseye_materialx::{Document, Library, Material, SearchPath};

use crate::args::ModelArg;

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

    /// The material of a document, by its name where there are several. Warnings go to standard error.
    pub(crate) fn material(&self, document: &Path, name: Option<&str>) -> anyhow::Result<Material> {
        let document = Document::load_with(document, &self.load()?)?;
        let material = document.material(name)?;
        for warning in document.warnings().iter().chain(&material.warnings) {
            eprintln!("catseye: warning: {warning}");
        }
        Ok(material)
    }
}

/// The material that a verb is about.
#[derive(Debug, clap::Args)]
pub(crate) struct MaterialArgs {
    /// MaterialX document with the material
    #[arg(value_name = "MATERIAL.mtlx")]
    document: PathBuf,
    /// Name of the surface material, where the document has several
    #[arg(long, value_name = "NAME")]
    material: Option<String>,
    #[command(flatten)]
    library: LibraryArgs,
    /// Which lobe reflects
    #[arg(long, value_enum, default_value_t)]
    model: ModelArg,
}

impl MaterialArgs {
    /// Reads the material.
    pub(crate) fn load(&self) -> anyhow::Result<Material> {
        self.library.material(&self.document, self.material.as_deref())
    }

    /// The lobe that reflects.
    pub(crate) fn model(&self) -> Model {
        self.model.0
    }

    /// The document as the user named it.
    pub(crate) fn name(&self) -> String {
        self.document.display().to_string()
    }
}
