//! What is rendered: a built-in scene, and the materials that its parts wear.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use catseye::Model;
use catseye_materialx::{Document, Look, Material};
use catseye_render::{Lighting, Scene};
use clap::ValueEnum;

use crate::failure::Usage;
use crate::options::{LibraryArgs, ModelArg};
use crate::report;

/// The options that say what is rendered.
#[derive(Debug, clap::Args)]
pub(super) struct SubjectArgs {
    /// MaterialX document with the material to show
    #[arg(value_name = "MATERIAL.mtlx")]
    document: Option<PathBuf>,
    /// Name of the surface material, where the document has several
    #[arg(long, value_name = "NAME", requires = "document")]
    material: Option<String>,
    /// Look of the document, which assigns its materials to the scene's geometry
    #[arg(long, value_name = "NAME", requires = "document", conflicts_with = "material")]
    look: Option<String>,
    #[command(flatten)]
    library: LibraryArgs,
    /// Scene to put it in [default: preview with a material, night without]
    #[arg(long, value_enum)]
    scene: Option<SceneArg>,
    /// Which lobe reflects
    #[arg(long, value_enum, default_value_t)]
    model: ModelArg,
}

/// The scenes that a material can be shown in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum SceneArg {
    /// The road at night; the material replaces the sheeting
    Night,
    /// A sphere and a folded sheet
    Preview,
}

/// What is shown: the built-in scene with materials for its parts, or a sphere and a sheet.
pub(super) enum Subject {
    Night(Vec<Option<Material>>),
    Preview(Box<[Material; 2]>),
}

impl Subject {
    pub(super) fn scene(&self, lighting: Lighting) -> anyhow::Result<Scene> {
        Ok(match self {
            Self::Night(sheeting) => {
                let of = |i: usize| sheeting.get(i).and_then(Option::as_ref);
                Scene::builtin_of(std::array::from_fn(of), lighting)?
            }
            Self::Preview(materials) => Scene::preview_of(materials.each_ref(), lighting)?,
        })
    }
}

impl SubjectArgs {
    /// The lobe that reflects.
    pub(super) fn model(&self) -> Model {
        self.model.0
    }

    /// Reads the materials.
    pub(super) fn load(&self) -> anyhow::Result<Subject> {
        match (&self.document, self.scene) {
            (None, Some(SceneArg::Preview)) => {
                bail!(Usage("--scene preview needs a MATERIAL.mtlx to show".to_owned()))
            }
            (None, _) => Ok(Subject::Night(Vec::new())),
            (Some(path), Some(SceneArg::Night)) => {
                Ok(Subject::Night(self.materials(path, &Scene::BUILTIN_GEOMETRY)?))
            }
            (Some(path), _) => match <[_; 2]>::try_from(self.materials(path, &Scene::PREVIEW_GEOMETRY)?) {
                Ok([Some(sphere), Some(sheet)]) => Ok(Subject::Preview(Box::new([sphere, sheet]))),
                _ => {
                    let geometry = Scene::PREVIEW_GEOMETRY.join(" or ");
                    bail!("{}: the look assigns nothing to {geometry}", path.display())
                }
            },
        }
    }

    /// The material of each of a scene's parts: the look's, or the same one for all of them.
    fn materials(&self, path: &Path, geometry: &[&str]) -> anyhow::Result<Vec<Option<Material>>> {
        let Some(name) = &self.look else {
            let material = self.library.material(path, self.material.as_deref())?;
            return Ok(vec![Some(material); geometry.len()]);
        };
        let document = Document::load_with(path, &self.library.load()?)?;
        let look = look(&document, name)?;
        let material = |path: &&str| look.material(path).map(|name| document.material(Some(name)));
        let materials: Vec<Option<Material>> =
            geometry.iter().map(|path| material(path).transpose()).collect::<Result<_, _>>()?;
        if materials.iter().all(Option::is_none) {
            bail!("{}: the look assigns nothing to {}", path.display(), geometry.join(", "));
        }
        let shown = materials.iter().flatten().flat_map(|material| material.warnings.clone());
        for warning in document.warnings().into_iter().chain(shown).collect::<BTreeSet<_>>() {
            report::warn(warning);
        }
        Ok(materials)
    }
}

/// The look of this name.
fn look(document: &Document, name: &str) -> anyhow::Result<Look> {
    let looks = document.looks()?;
    let names: Vec<String> = looks.iter().map(|look| look.name.clone()).collect();
    let found = looks.into_iter().find(|look| look.name == name);
    found.with_context(|| match &names[..] {
        [] => format!("{}: no look {name:?}; it has no looks", document.name()),
        names => format!("{}: no look {name:?}; its looks: {}", document.name(), names.join(", ")),
    })
}
