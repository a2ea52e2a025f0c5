//! A MaterialX document.

use std::{
    fs::File,
    io::{self, Read as _},
    path::Path,
    sync::Arc,
};

use crate::{
    closure::Material,
    element::Element,
    error::{Error, listed, quoted},
    graph::{Graph, NodeRef},
    material::Builder,
    source::Source,
    xml,
};

/// Largest file that is read; MaterialX's largest is below 1 MiB.
const MAX_BYTES: usize = 16 << 20;

/// A MaterialX document, well-formed and of a known version; its nodes are checked when its materials are asked for.
#[derive(Debug)]
pub struct Document {
    name: Arc<str>,
    root: Element,
}

impl Document {
    /// Reads a file.
    ///
    /// # Errors
    /// The file can't be read, is too large, or is refused by [`Document::parse`].
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let name = path.to_string_lossy();
        if path.is_dir() {
            return Err(Error::Folder { file: name.into() });
        }
        let bytes = read(path).map_err(|cause| Error::Read { file: Arc::from(&*name), cause })?;
        Self::from_bytes(&bytes, &name)
    }

    /// Reads a document from bytes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// The text is not UTF-8, or is refused by [`Document::parse`].
    pub fn from_bytes(bytes: &[u8], name: &str) -> Result<Self, Error> {
        refuse_large(bytes, name)?;
        match str::from_utf8(bytes) {
            Ok(text) => Self::parse(text, name),
            Err(cause) => {
                let valid = String::from_utf8_lossy(&bytes[..cause.valid_up_to()]);
                Err(Error::NotUtf8 { at: Source::new(name, &valid).place(valid.len(), String::new()) })
            }
        }
    }

    /// Reads a document from its text; `name` stands for the file in messages.
    ///
    /// # Errors
    /// The text is too large, no well-formed XML, no MaterialX, or of a version other than 1.38 and 1.39.
    pub fn parse(text: &str, name: &str) -> Result<Self, Error> {
        refuse_large(text.as_bytes(), name)?;
        let source = Arc::new(Source::new(name, text));
        let root = xml::parse(&source)?;
        if root.tag() != "materialx" {
            return Err(Error::NotMaterialX { at: root.place() });
        }
        refuse_version(&root)?;
        Ok(Self { name: Arc::clone(source.name()), root })
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
        let graph = Graph::new(&self.root)?;
        if graph.materials().next().is_none() {
            return Err(Error::NoMaterial { file: Arc::clone(&self.name) });
        }
        let mut builder = Builder::new(&graph);
        graph.materials().map(|material| builder.material(material)).collect()
    }

    /// The material of this name, or the document's only one where no name is given.
    ///
    /// # Errors
    /// There is no such material, there are several to choose from, or something that it refers to is wrong.
    pub fn material(&self, name: Option<&str>) -> Result<Material, Error> {
        let graph = Graph::new(&self.root)?;
        let material = self.choose(&graph, name)?;
        Builder::new(&graph).material(material)
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

/// Reads at most one byte more than is allowed, also from what never ends.
fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn refuse_large(bytes: &[u8], name: &str) -> Result<(), Error> {
    if bytes.len() > MAX_BYTES {
        Err(Error::TooLarge { file: name.into(), limit: MAX_BYTES })
    } else {
        Ok(())
    }
}

fn refuse_version(root: &Element) -> Result<(), Error> {
    let version = root.require("version")?;
    match version.trim() {
        "1.38" | "1.39" => Ok(()),
        other => Err(Error::Version { at: root.place(), version: quoted(other) }),
    }
}
