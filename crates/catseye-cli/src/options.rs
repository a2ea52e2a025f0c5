//! The options that several verbs share: lobe models, precision, and the material with its libraries.

use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;

use catseye::Model;
use catseye_materialx::{Document, Library, Material, SearchPath};
use catseye_photometry::openmaterial::Band;
use clap::ValueEnum;

use crate::report;

/// The lobe's model, by the names of [`Model::name`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct ModelArg(pub(crate) Model);

impl ValueEnum for ModelArg {
    fn value_variants<'a>() -> &'a [Self] {
        const { &[Self(Model::ALL[0]), Self(Model::ALL[1]), Self(Model::ALL[2])] }
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        let help = match self.0 {
            Model::Reciprocal => "The proposal's lobe, with multiple-scattering compensation",
            Model::Edwards => "The paper's own lobe: albedo 1, not reciprocal",
            Model::BackVector => {
                "The microfacet lobe of MaterialX 1.39.5 with retroreflective = true, of the same peak"
            }
        };
        Some(clap::builder::PossibleValue::new(self.0.name()).help(help))
    }
}

/// A value of `--roughness`: along the tangent and across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Roughness(pub(crate) [f64; 2]);

impl FromStr for Roughness {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (u, v) = text.split_once(',').unwrap_or((text, text));
        let number = |text: &str| text.trim().parse().map_err(|_| "write it like 0.3, or 0.3,0.1".to_owned());
        Ok(Self([number(u)?, number(v)?]))
    }
}

/// A value of `--tint`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tint(pub(crate) Band);

impl FromStr for Tint {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let parts = text
            .split_once('=')
            .and_then(|(nm, factor)| Some(Band { wavelength_nm: number(nm)?, tint: number(factor)? }));
        let band = parts.ok_or("a wavelength in nanometres and a factor are needed: 905=0.3")?;
        let legal = (100.0..=20_000.0).contains(&band.wavelength_nm) && (0.0..=1.0).contains(&band.tint);
        if !legal {
            return Err("the wavelength must be from 100 to 20000 nm, the factor from 0 to 1".to_owned());
        }
        Ok(Self(band))
    }
}

/// The type that a query is answered in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Precision {
    /// Double precision.
    #[default]
    F64,
    /// Single precision, as shaders and renderers use it.
    F32,
}

/// What computes the answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Backend {
    /// The Rust code.
    #[default]
    Cpu,
    /// The shader twin: part of the command line's contract, not of this version.
    #[value(hide = true)]
    Gpu,
}

/// Where MaterialX's libraries and the files of documents are.
#[derive(Debug, clap::Args)]
pub(crate) struct LibraryArgs {
    /// Folder that files may be read from, and whose `libraries` define nodes; may be given several times
    /// [default: those of `MATERIALX_SEARCH_PATH`]
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
            report::warn(warning);
        }
        Ok(material)
    }
}

/// How the material of a document is read.
#[derive(Debug, clap::Args)]
pub(crate) struct ReadingArgs {
    /// Name of the surface material, where the document has several
    #[arg(long, value_name = "NAME")]
    material: Option<String>,
    #[command(flatten)]
    library: LibraryArgs,
    /// Which lobe reflects
    #[arg(long, value_enum, default_value_t)]
    model: ModelArg,
}

impl ReadingArgs {
    /// Reads the material of a document.
    pub(crate) fn material(&self, document: &Path) -> anyhow::Result<Material> {
        self.library.material(document, self.material.as_deref())
    }

    /// The lobe that reflects.
    pub(crate) fn model(&self) -> Model {
        self.model.0
    }
}

/// The material that a verb is about.
#[derive(Debug, clap::Args)]
pub(crate) struct MaterialArgs {
    /// MaterialX document with the material
    #[arg(value_name = "MATERIAL.mtlx")]
    document: PathBuf,
    #[command(flatten)]
    reading: ReadingArgs,
}

impl MaterialArgs {
    /// Reads the material.
    pub(crate) fn load(&self) -> anyhow::Result<Material> {
        self.reading.material(&self.document)
    }

    /// The lobe that reflects.
    pub(crate) fn model(&self) -> Model {
        self.reading.model()
    }

    /// The document as the user named it.
    pub(crate) fn name(&self) -> String {
        self.document.display().to_string()
    }
}
