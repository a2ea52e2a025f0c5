//! Node definitions: our own, and those of MaterialX libraries on disk.

use std::{
    collections::HashMap,
    path::{Path, PathBuf},
    sync::LazyLock,
};

use crate::{
    data_library::definitions,
    error::Error,
    text::{
        element::Element,
        files::SearchPath,
        root::{parse_bytes, read_root},
    },
};

/// Files of all libraries together; MaterialX 1.39.5 has 30 that are read here.
const MAX_FILES: usize = 4096;
/// Folders inside folders.
const MAX_DEPTH: usize = 6;

/// The definitions of our own data library that are graphs: `retro_sheeting_surface`. Test `read` reads a
/// document with it.
static OWN: LazyLock<Vec<Element>> = LazyLock::new(|| {
    definitions().flat_map(|(name, text)| parse_bytes(text.as_bytes(), name, None)).collect()
});

/// The folders that may be read, and the node definitions in the MaterialX libraries among them.
///
/// The nodes of our own data library are always known. A folder of the search path that has a folder
/// `libraries` (as MaterialX and its Python package have), or is one, gives its definitions; nodes that are
/// defined as nodegraphs, such as `standard_surface`, are then known.
#[derive(Debug, Default)]
pub struct Library {
    search_path: SearchPath,
    roots: Vec<Element>,
}

impl Library {
    /// Reads the libraries of a search path; without any there are only our own library and the nodes that
    /// are built in.
    ///
    /// # Errors
    /// A folder or a file of a library can't be read.
    pub fn load(search_path: SearchPath) -> Result<Self, Error> {
        let mut files = Vec::new();
        for folder in search_path.folders() {
            let read = |cause| Error::Read { file: folder.to_string_lossy().into(), cause };
            folder.read_dir().map_err(read)?;
            let inside = folder.join("libraries");
            if inside.is_dir() {
                collect(&inside, 0, &mut files)?;
            } else if folder.file_name().is_some_and(|name| name == "libraries") {
                collect(folder, 0, &mut files)?;
            }
        }
        let roots = files.iter().map(|path| read_root(path, &path.to_string_lossy()));
        Ok(Self { roots: roots.collect::<Result<_, _>>()?, search_path })
    }

    /// The folders.
    #[must_use]
    pub fn search_path(&self) -> &SearchPath {
        &self.search_path
    }

    /// How many node definitions there are.
    #[must_use]
    pub fn definitions(&self) -> usize {
        self.roots().map(|root| root.children_of_kind("nodedef").count()).sum()
    }

    /// The documents with definitions, our own first.
    pub(crate) fn roots(&self) -> impl Iterator<Item = &Element> + Clone {
        OWN.iter().chain(&self.roots)
    }
}

/// The documents under a folder in the order of their names. Folders of one target's code (`genglsl`, ...)
/// have no graphs.
fn collect(folder: &Path, depth: usize, files: &mut Vec<PathBuf>) -> Result<(), Error> {
    let read = |cause| Error::Read { file: folder.to_string_lossy().into(), cause };
    let mut entries = folder
        .read_dir()
        .and_then(|entries| {
            entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<Vec<_>, _>>()
        })
        .map_err(read)?;
    entries.sort();
    for path in entries {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            if depth < MAX_DEPTH && !name.starts_with("gen") && name != "targets" {
                collect(&path, depth + 1, files)?;
            }
        } else if name.ends_with(".mtlx") && files.len() < MAX_FILES {
            files.push(path);
        }
    }
    Ok(())
}

/// A node definition of a document or library.
#[derive(Debug)]
pub(crate) struct Definition<'a> {
    /// The definition, then those that it inherits from.
    nodedefs: Vec<&'a Element>,
    /// The graph that says what the node does.
    pub(crate) graph: Option<&'a Element>,
}

impl<'a> Definition<'a> {
    pub(crate) fn nodedef(&self) -> &'a Element {
        self.nodedefs[0]
    }

    pub(crate) fn input(&self, name: &str) -> Option<&'a Element> {
        self.nodedefs.iter().find_map(|nodedef| nodedef.child("input", name))
    }

    pub(crate) fn inputs(&self) -> impl Iterator<Item = &'a Element> {
        self.nodedefs.iter().flat_map(|nodedef| nodedef.children_of_kind("input"))
    }

    pub(crate) fn outputs(&self) -> impl Iterator<Item = &'a Element> {
        let own = self.nodedefs.iter().find(|nodedef| nodedef.children_of_kind("output").next().is_some());
        own.into_iter().flat_map(|nodedef| nodedef.children_of_kind("output"))
    }

    /// The type of its nodes, by name.
    pub(crate) fn output_type(&self) -> Option<&'a str> {
        let mut outputs = self.outputs();
        let first = outputs.next()?;
        if outputs.next().is_some() { Some("multioutput") } else { first.attribute("type") }
    }

    /// Whether every input of the node exists with its type.
    fn fits(&self, node: &Element) -> bool {
        /// Inputs of a node; more than any has, and few enough to be looked up one by one.
        const MOST: usize = 512;
        self.output_type() == node.attribute("type")
            && node.children().len() <= MOST
            && self.nodedefs.iter().all(|nodedef| nodedef.children().len() <= MOST)
            && node.children_of_kind("input").all(|input| {
                let defined = input.name().and_then(|name| self.input(name));
                defined.is_some_and(|defined| defined.attribute("type") == input.attribute("type"))
            })
    }
}

/// All definitions that a document sees.
#[derive(Debug)]
pub(crate) struct Definitions<'a> {
    by_category: HashMap<&'a str, Vec<Definition<'a>>>,
}

impl<'a> Definitions<'a> {
    pub(crate) fn new(roots: impl Iterator<Item = &'a Element> + Clone) -> Self {
        /// Definitions that inherit from one another; a cycle ends here too.
        const MAX_INHERITANCE: usize = 8;
        /// Definitions of one category; MaterialX's `convert` has 45.
        const MAX_SAME_CATEGORY: usize = 256;
        let elements = || roots.clone().flat_map(Element::children);
        let by_name: HashMap<&str, &Element> = elements()
            .filter(|element| element.tag() == "nodedef")
            .filter_map(|element| Some((element.name()?, element)))
            .collect();
        let graphs = graphs(elements());
        let mut by_category: HashMap<&str, Vec<Definition<'_>>> = HashMap::new();
        for nodedef in elements().filter(|element| element.tag() == "nodedef") {
            let Some(category) = nodedef.attribute("node") else { continue };
            let parent = |nodedef: &&'a Element| {
                nodedef.attribute("inherit").and_then(|name| by_name.get(name).copied())
            };
            let nodedefs: Vec<&Element> =
                core::iter::successors(Some(nodedef), parent).take(MAX_INHERITANCE).collect();
            let graph = nodedefs.iter().find_map(|nodedef| graphs.get(nodedef.name()?).copied());
            let same = by_category.entry(category).or_default();
            if same.len() < MAX_SAME_CATEGORY {
                same.push(Definition { nodedefs, graph });
            }
        }
        Self { by_category }
    }

    /// Every definition of a category.
    pub(crate) fn of(&self, category: &str) -> &[Definition<'a>] {
        self.by_category.get(category).map_or(&[], Vec::as_slice)
    }

    /// The definition that fits a node: of the version that it names, else the default one.
    pub(crate) fn find(&self, node: &Element) -> Option<&Definition<'a>> {
        let of_version = |definition: &&Definition<'_>| {
            let nodedef = definition.nodedef();
            match node.attribute("version") {
                Some(version) => nodedef.attribute("version") == Some(version),
                None => nodedef.attribute("isdefaultversion") == Some("true"),
            }
        };
        let fitting = || self.of(node.tag()).iter().filter(|definition| definition.fits(node));
        fitting().find(of_version).or_else(|| fitting().next())
    }
}

/// The graphs that implement definitions, by the definitions' names.
fn graphs<'a>(elements: impl Iterator<Item = &'a Element> + Clone) -> HashMap<&'a str, &'a Element> {
    let graphs = || elements.clone().filter(|element| element.tag() == "nodegraph");
    let direct = graphs().filter_map(|graph| Some((graph.attribute("nodedef")?, graph)));
    let by_name: HashMap<&str, &Element> =
        graphs().filter_map(|graph| Some((graph.name()?, graph))).collect();
    let implementations =
        elements.clone().filter(|element| element.tag() == "implementation").filter_map(|element| {
            Some((element.attribute("nodedef")?, *by_name.get(element.attribute("nodegraph")?)?))
        });
    implementations.chain(direct).collect()
}
