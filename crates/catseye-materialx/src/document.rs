//! A MaterialX document.

use std::{path::Path, sync::Arc};

use crate::{
    compile::{pattern::PatternCompiler, surface::Builder},
    error::{Error, Warning, listed, quoted},
    graph::{
        Graph, NodeRef,
        library::Library,
        look::{self, Look},
    },
    output::Output,
    program::Assembler,
    surface::Material,
    text::{
        element::Element,
        files::SearchPath,
        include::Includer,
        root::{parse_bytes, parse_text, read_root},
    },
};

/// A MaterialX document, well-formed and of a known version; its nodes are checked when its materials are
/// asked for.
#[derive(Debug)]
pub struct Document {
    name: Arc<str>,
    root: Element,
    library: Arc<Library>,
}

impl Document {
    /// Reads a file and what it includes from its own folder.
    ///
    /// # Errors
    /// The file can't be read, is too large, or is refused by [`Document::parse`].
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::load_with(path, &Arc::default())
    }

    /// Reads a file and what it includes from its own folder and the search path of a library, whose
    /// definitions its nodes may have.
    ///
    /// # Errors
    /// As [`Document::load`].
    pub fn load_with(path: impl AsRef<Path>, library: &Arc<Library>) -> Result<Self, Error> {
        let path = path.as_ref();
        let name = path.to_string_lossy();
        let root = read_root(path, &name)?;
        let root = Includer::new(library.search_path(), path.canonicalize().ok()).expand(root)?;
        Ok(Self { name: Arc::from(&*name), root, library: Arc::clone(library) })
    }

    /// Reads a document from bytes; `name` stands for the file in messages. It has no folder: it can't name
    /// files.
    ///
    /// # Errors
    /// The bytes are no text in UTF-8, UTF-16 or a declared ISO-8859-1, or it is refused by
    /// [`Document::parse`].
    pub fn from_bytes(bytes: &[u8], name: &str) -> Result<Self, Error> {
        Self::of_root(parse_bytes(bytes, name, None)?)
    }

    /// Reads a document from its text; `name` stands for the file in messages. It has no folder: it can't
    /// name files.
    ///
    /// # Errors
    /// The text is too large, no well-formed XML, no MaterialX, or of a version other than 1.38 and 1.39.
    pub fn parse(text: &str, name: &str) -> Result<Self, Error> {
        Self::of_root(parse_text(text, name, None)?)
    }

    /// As [`Document::parse`], with a library's definitions and search path.
    ///
    /// # Errors
    /// As [`Document::parse`].
    pub fn parse_with(text: &str, name: &str, library: &Arc<Library>) -> Result<Self, Error> {
        let root = Includer::new(library.search_path(), None).expand(parse_text(text, name, None)?)?;
        Ok(Self { name: Arc::clone(root.source().name()), root, library: Arc::clone(library) })
    }

    fn of_root(root: Element) -> Result<Self, Error> {
        let root = Includer::new(&SearchPath::default(), None).expand(root)?;
        Ok(Self { name: Arc::clone(root.source().name()), root, library: Arc::default() })
    }

    /// The file's name, as given by the caller.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// All surface materials, in the document's order; at least one.
    ///
    /// # Errors
    /// There is none, or something that one of them refers to is wrong.
    pub fn materials(&self) -> Result<Vec<Material>, Error> {
        let graph = Graph::new(&self.root, &self.library)?;
        if graph.materials().next().is_none() {
            return Err(Error::NoMaterial { file: Arc::clone(&self.name) });
        }
        let program = Assembler::default();
        let mut builder = Builder::new(&graph, &self.library, &program);
        graph.materials().map(|material| builder.material(material)).collect()
    }

    /// The document's own outputs, those of its nodegraphs left out, in its order.
    ///
    /// # Errors
    /// An output is connected to nothing, to what has no numbers, or to something that is wrong.
    pub fn outputs(&self) -> Result<Vec<Output>, Error> {
        let program = Assembler::default();
        let graph = Graph::new(&self.root, &self.library)?;
        let mut patterns = PatternCompiler::new(&graph, &self.library, &program);
        self.root.children_of_kind("output").map(|output| patterns.output(output)).collect()
    }

    /// The names of all surface materials, in the document's order.
    #[must_use]
    pub fn material_names(&self) -> Vec<String> {
        let materials = self.root.children_of_kind("surfacematerial");
        materials.filter_map(|material| material.name().map(str::to_owned)).collect()
    }

    /// All looks, in the document's order.
    ///
    /// # Errors
    /// An assignment names no material, or one that doesn't exist.
    pub fn looks(&self) -> Result<Vec<Look>, Error> {
        look::looks(&self.root)
    }

    /// What of the document has no meaning here: units of lengths and angles, for instance.
    #[must_use]
    pub fn warnings(&self) -> Vec<Warning> {
        look::warnings(&self.root)
    }

    /// The material of this name, or the document's only one where no name is given.
    ///
    /// # Errors
    /// There is no such material, there are several to choose from, or something that it refers to is wrong.
    pub fn material(&self, name: Option<&str>) -> Result<Material, Error> {
        let program = Assembler::default();
        let graph = Graph::new(&self.root, &self.library)?;
        let material = self.choose(&graph, name)?;
        Builder::new(&graph, &self.library, &program).material(material)
    }

    fn choose<'a>(&self, graph: &Graph<'a>, name: Option<&str>) -> Result<NodeRef<'a>, Error> {
        let file = || Arc::clone(&self.name);
        let mut materials = graph.materials();
        let Some(first) = materials.next() else { return Err(Error::NoMaterial { file: file() }) };
        let names = || listed(graph.materials().map(|material| material.element.quoted_name()));
        match name {
            Some(name) => graph
                .materials()
                .find(|material| material.element.name() == Some(name))
                .ok_or_else(|| Error::NoSuchMaterial { file: file(), name: quoted(name), names: names() }),
            None if materials.next().is_some() => {
                Err(Error::SeveralMaterials { file: file(), names: names() })
            }
            None => Ok(first),
        }
    }
}
