//! What can be wrong with a document, each with its place and the way out.

use core::{borrow::Borrow, fmt};
use std::{io, sync::Arc};

/// Where in a document something is wrong.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The file, as named by the caller.
    pub file: Arc<str>,
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
    /// The element and its name, as in `mix "body", input "fg"`; empty where the text is no XML yet.
    pub element: String,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, line, column, element } = self;
        write!(f, "{file}:{line}:{column}")?;
        if element.is_empty() { Ok(()) } else { write!(f, ": {element}") }
    }
}

/// What of a document is ignored or approximated.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Warning {
    /// Where.
    pub at: Place,
    /// What, and the way out where there is one.
    pub message: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.at, self.message)
    }
}

/// Why a document could not be read: one line that names file, place, element, value and the way out.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file is missing, or the system refuses to give it.
    #[error("{file}: can't be read: {cause}")]
    Read {
        /// The file.
        file: Arc<str>,
        /// What the system says.
        cause: io::Error,
    },
    /// A folder where a file is expected.
    #[error("{file}: is a folder; name one .mtlx file")]
    Folder {
        /// The folder.
        file: Arc<str>,
    },
    /// The file is too large to be a material.
    #[error("{file}: is larger than {limit} bytes; split the document")]
    TooLarge {
        /// The file.
        file: Arc<str>,
        /// Most bytes that are read.
        limit: usize,
    },
    /// The bytes are not text in the encoding that they seem to be in.
    #[error("{at}: is not {encoding} from here on; save the file as UTF-8")]
    Encoding {
        /// The first byte that is wrong.
        at: Place,
        /// UTF-8 or UTF-16.
        encoding: &'static str,
    },
    /// The text is not well-formed XML.
    #[error("{at}: malformed XML: {message}")]
    Xml {
        /// Where the parser stopped.
        at: Place,
        /// What it says.
        message: String,
    },
    /// A document type declaration: the door to entity bombs and foreign files, and MaterialX has no use for
    /// it.
    #[error("{at}: document type declarations are refused; remove <!DOCTYPE ...>")]
    DocumentType {
        /// The declaration.
        at: Place,
    },
    /// More of something than any sane document has: reading it would take unbounded time or memory.
    #[error("{at}: more than {limit} {what}; simplify or split the document")]
    Limit {
        /// Where the limit was passed.
        at: Place,
        /// What there is too much of.
        what: &'static str,
        /// How much is allowed.
        limit: usize,
    },
    /// XML, but of another kind.
    #[error("{at}: the root element is not <materialx>; this is no MaterialX document")]
    NotMaterialX {
        /// The root element.
        at: Place,
    },
    /// A document of a version whose rules are not known here.
    #[error("{at}: version {version} is not supported; {instead}")]
    Version {
        /// The root element.
        at: Place,
        /// The version, quoted.
        version: String,
        /// The way out.
        instead: &'static str,
    },
    /// MaterialX, but a part of it that is not read here.
    #[error("{at}: {what} is not supported; {instead}")]
    Unsupported {
        /// The element.
        at: Place,
        /// What is not supported.
        what: String,
        /// The way out.
        instead: String,
    },
    /// An attribute that MaterialX demands is missing.
    #[error("{at}: has no {attribute}=\"...\"; add it")]
    MissingAttribute {
        /// The element.
        at: Place,
        /// The attribute.
        attribute: &'static str,
    },
    /// Two elements of one scope have the same name, so a connection to it would be ambiguous.
    #[error("{at}: the name is already taken in line {first_line}; rename one of them")]
    DuplicateName {
        /// The second element.
        at: Place,
        /// Line of the first.
        first_line: u32,
    },
    /// A node of a category that is not known here.
    #[error(
        "{at}: unknown node category; `--materialx-path` or MATERIALX_SEARCH_PATH adds libraries that define nodes"
    )]
    UnknownCategory {
        /// The node.
        at: Place,
    },
    /// A node that is declared but that nothing here knows how to compute.
    #[error(
        "{at}: the node is declared, but its implementation is code for another renderer; it is not supported"
    )]
    NoGraph {
        /// The node.
        at: Place,
    },
    /// An input that the node's category does not have.
    #[error("{at}: no such input; {category} has {known}")]
    UnknownInput {
        /// The input.
        at: Place,
        /// The node's category.
        category: String,
        /// The inputs it has.
        known: String,
    },
    /// A type other than the node's definition says.
    #[error("{at}: is of type {found}; {expected} is expected")]
    WrongType {
        /// The node or input.
        at: Place,
        /// The type it is given, quoted.
        found: String,
        /// The type, or the types, it may have.
        expected: String,
    },
    /// A value that can't be read as its type.
    #[error("{at}: value {value} is not {expected}")]
    BadValue {
        /// The input.
        at: Place,
        /// The value, quoted.
        value: String,
        /// What is expected, with an example.
        expected: &'static str,
    },
    /// A value outside its range.
    #[error("{at}: {message}")]
    OutOfRange {
        /// The input.
        at: Place,
        /// Name, value and range.
        message: String,
    },
    /// A colour space that is not known here.
    #[error("{at}: colour space {colorspace} is not supported; {supported} are")]
    ColorSpace {
        /// The input.
        at: Place,
        /// The colour space, quoted.
        colorspace: String,
        /// Those that are known.
        supported: String,
    },
    /// A connection that leads nowhere.
    #[error("{at}: is connected to {target}, which doesn't exist; add it or correct the name")]
    Dangling {
        /// The input.
        at: Place,
        /// What it names.
        target: String,
    },
    /// A node that feeds itself.
    #[error("{at}: feeds itself through {cycle}; break the cycle")]
    Cycle {
        /// The node.
        at: Place,
        /// The nodes of the cycle, from it on.
        cycle: String,
    },
    /// A file that a document names and that isn't there.
    #[error("{at}: there is no file {name}; correct the name, or add its folder with `--materialx-path`")]
    MissingFile {
        /// The element that names it.
        at: Place,
        /// The file's name, quoted.
        name: String,
    },
    /// A file outside the folders that may be read.
    #[error(
        "{at}: the file {name} is outside the document's folder; `--materialx-path` or MATERIALX_SEARCH_PATH with a folder \
         above it allows it"
    )]
    OutsideSearchPath {
        /// The element that names it.
        at: Place,
        /// The file's name, quoted.
        name: String,
    },
    /// A name that stands for the tiles of a picture.
    #[error(
        "{at}: {name} names the tiles of a picture, which is not supported; name one of them, as in name.1001.png"
    )]
    Tiles {
        /// The element that names them.
        at: Place,
        /// The name, quoted.
        name: String,
    },
    /// A picture that can't be read.
    #[error("{at}: the picture {name} can't be read: {message}")]
    Picture {
        /// The element that names it.
        at: Place,
        /// The file's name, quoted.
        name: String,
        /// What is wrong with it.
        message: String,
    },
    /// A document without a material.
    #[error("{file}: has no <surfacematerial>; add one and connect its surfaceshader")]
    NoMaterial {
        /// The file.
        file: Arc<str>,
    },
    /// A material without a surface.
    #[error("{at}: has no surfaceshader; connect a surface node")]
    NoSurface {
        /// The material.
        at: Place,
    },
    /// One material was asked for by name, and there is none of that name.
    #[error("{file}: has no material {name}; it has {names}")]
    NoSuchMaterial {
        /// The file.
        file: Arc<str>,
        /// The name asked for, quoted.
        name: String,
        /// The names there are.
        names: String,
    },
    /// One material was expected, and there are several.
    #[error("{file}: has several materials; choose one of {names}")]
    SeveralMaterials {
        /// The file.
        file: Arc<str>,
        /// Their names.
        names: String,
    },
}

impl Error {
    /// Where the document is wrong; `None` where the file as a whole is.
    #[must_use]
    pub fn place(&self) -> Option<&Place> {
        match self {
            Self::Read { .. }
            | Self::Folder { .. }
            | Self::TooLarge { .. }
            | Self::NoMaterial { .. }
            | Self::NoSuchMaterial { .. }
            | Self::SeveralMaterials { .. } => None,
            Self::Encoding { at, .. }
            | Self::Xml { at, .. }
            | Self::DocumentType { at }
            | Self::Limit { at, .. }
            | Self::NotMaterialX { at }
            | Self::Version { at, .. }
            | Self::Unsupported { at, .. }
            | Self::MissingAttribute { at, .. }
            | Self::DuplicateName { at, .. }
            | Self::UnknownCategory { at }
            | Self::NoGraph { at }
            | Self::UnknownInput { at, .. }
            | Self::WrongType { at, .. }
            | Self::BadValue { at, .. }
            | Self::OutOfRange { at, .. }
            | Self::ColorSpace { at, .. }
            | Self::Dangling { at, .. }
            | Self::Cycle { at, .. }
            | Self::MissingFile { at, .. }
            | Self::OutsideSearchPath { at, .. }
            | Self::Tiles { at, .. }
            | Self::Picture { at, .. }
            | Self::NoSurface { at } => Some(at),
        }
    }
}

/// Characters of the document's text that a message repeats at a time.
const LONGEST: usize = 60;

/// The text in quotes, on one line and short enough for a message, whatever it contains.
pub(crate) fn quoted(text: &str) -> String {
    let (start, rest) = cut(text, LONGEST);
    format!("{start:?}{rest}")
}

/// A document's name without the quotes, likewise.
pub(crate) fn plain(name: &str) -> String {
    let (start, rest) = cut(name, LONGEST);
    format!("{}{rest}", start.escape_debug())
}

/// The XML parser's words on one line, the long names of a hostile document cut short.
pub(crate) fn one_line(text: &str) -> String {
    let printable = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.to_string() };
    let (start, rest) = cut(text, 3 * LONGEST);
    start.chars().map(printable).collect::<String>() + rest
}

/// The start of a text that takes at most so many characters once it is escaped, and what stands for the
/// rest.
fn cut(text: &str, longest: usize) -> (&str, &'static str) {
    let mut length = 0;
    for (end, c) in text.char_indices() {
        length += c.escape_debug().count();
        if length > longest {
            return (&text[..end], "...");
        }
    }
    (text, "")
}

/// Names for a message, in the given order: at most 20, then how many more there are.
pub(crate) fn listed<S: Borrow<str>>(names: impl IntoIterator<Item = S>) -> String {
    const MOST: usize = 20;
    let mut names = names.into_iter();
    let mut text = names.by_ref().take(MOST).collect::<Vec<S>>().join(", ");
    let rest = names.count();
    if rest > 0 {
        text += &format!(" and {rest} more");
    }
    text
}
