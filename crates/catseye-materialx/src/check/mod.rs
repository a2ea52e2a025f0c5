//! Everything that is wrong with a document, in one go, and whether it can be rendered.

mod walk;

use core::fmt;
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use crate::{
    compile::surface::Builder,
    error::{Error, Place, Warning},
    graph::{
        Graph, NodeRef,
        library::Library,
        look::{looks, warnings},
    },
    program::Assembler,
    text::{
        element::Element,
        include::Includer,
        root::{parse_bytes, read_root},
    },
};

/// Most problems that are reported for a document.
const MAX_PROBLEMS: usize = 200;
/// Materials that are refused, each by a builder without a past; the rest is not built.
const MAX_REFUSED: usize = 16;
/// Builders that reach a limit with several materials together: each has done as much as reading may take.
const MAX_EXHAUSTED: usize = 2;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// A material can't be read.
    Error,
    /// Something is ignored, approximated, or wrong where no material uses it.
    Warning,
}

/// What is wrong at a place of a document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// How bad it is.
    pub severity: Severity,
    /// The file, as named by the caller.
    pub file: Arc<str>,
    /// Where in the file; `None` where it is about the file as a whole.
    pub place: Option<Place>,
    /// What it is, and the way out.
    pub message: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            None => write!(f, "{}: ", self.file)?,
            Some(Place { line, column, .. }) => write!(f, "{}:{line}:{column}: ", self.file)?,
        }
        if self.severity == Severity::Warning {
            f.write_str("warning: ")?;
        }
        if let Some(Place { element, .. }) = &self.place
            && !element.is_empty()
        {
            write!(f, "{element}: ")?;
        }
        f.write_str(&self.message)
    }
}

impl Finding {
    fn of_error(severity: Severity, error: &Error, own_file: &Arc<str>) -> Self {
        let place = error.place().cloned();
        let file = place.as_ref().map_or(own_file, |place| &place.file);
        let line = error.to_string();
        let front = place.as_ref().map_or_else(|| format!("{file}: "), |place| format!("{place}: "));
        let message = line.strip_prefix(&front).unwrap_or(&line).to_owned();
        Self { severity, file: Arc::clone(file), place, message }
    }

    fn of_warning(warning: Warning) -> Self {
        let file = Arc::clone(&warning.at.file);
        Self { severity: Severity::Warning, file, place: Some(warning.at), message: warning.message }
    }

    /// The document's own first, by line; then those of the files that it includes.
    fn order(&self, own_file: &Arc<str>) -> (bool, Arc<str>, u32, u32) {
        let (line, column) = self.place.as_ref().map_or((0, 0), |place| (place.line, place.column));
        (self.file != *own_file, Arc::clone(&self.file), line, column)
    }
}

/// What [`check`] found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// In the order of the document's lines, at most 200.
    pub findings: Vec<Finding>,
    /// How many more there are at least.
    pub more: usize,
}

impl Report {
    /// Whether reading one of the document's materials or looks is refused.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.findings.iter().any(|finding| finding.severity == Severity::Error)
    }
}

/// What is wrong with a file: errors exactly where [`Document`](crate::Document) refuses it or one of its
/// materials or looks.
///
/// Unlike [`Document::material`](crate::Document::material) this goes on after the first problem, and looks
/// at nodes too that no material uses; what is wrong with them alone is a warning. A document without a
/// material, such as a library of nodes, is told so by a warning; what is wrong with its nodes are errors.
#[must_use]
pub fn check(path: impl AsRef<Path>, library: &Library) -> Report {
    let path = path.as_ref();
    let name = path.to_string_lossy();
    check_root(read_root(path, &name), &name, path.canonicalize().ok(), library)
}

/// As [`check`], for a document's bytes; `name` stands for the file in messages.
#[must_use]
pub fn check_bytes(bytes: &[u8], name: &str, library: &Library) -> Report {
    check_root(parse_bytes(bytes, name, None), name, None, library)
}

fn check_root(root: Result<Element, Error>, name: &str, path: Option<PathBuf>, library: &Library) -> Report {
    let own_file: Arc<str> = name.into();
    let mut includer = Includer::new(library.search_path(), path).lenient();
    match root.and_then(|root| includer.expand(root)) {
        Err(error) => {
            Report { findings: vec![Finding::of_error(Severity::Error, &error, &own_file)], more: 0 }
        }
        Ok(root) => check_elements(&root, &own_file, includer.problems(), library),
    }
}

fn check_elements(root: &Element, own_file: &Arc<str>, mut errors: Vec<Error>, library: &Library) -> Report {
    let programs: Vec<Assembler> = (0..=MAX_REFUSED).map(|_| Assembler::default()).collect();
    let (graph, duplicates, mut more) = Graph::with_problems(root, library);
    errors.extend(duplicates);
    let walk = walk::walk(&graph, root, library);
    more += walk.more;
    let mut notes = warnings(root);
    notes.extend(walk.warnings);
    refused(&graph, library, &programs, &mut errors, &mut notes);
    errors.extend(looks(root).err());
    // A cycle is the same one wherever it is entered.
    let is_cycle = |error: &Error| matches!(error, Error::Cycle { .. });
    // A document without a material is a library of nodes: it is judged by them.
    let no_material = graph.materials().next().is_none();
    let refuses = !errors.is_empty() || no_material;
    if walk.problems.iter().any(is_cycle) {
        errors.retain(|error| !is_cycle(error));
    }
    let severity = if refuses { Severity::Error } else { Severity::Warning };
    let errors = errors.iter().map(|error| Finding::of_error(Severity::Error, error, own_file));
    let suspects = walk.problems.iter().map(|error| Finding::of_error(severity, error, own_file));
    let mut findings: Vec<Finding> = errors.chain(suspects).collect();
    if no_material {
        let missing = Error::NoMaterial { file: Arc::clone(own_file) };
        findings.push(Finding::of_error(Severity::Warning, &missing, own_file));
    }
    findings.extend(notes.into_iter().map(Finding::of_warning));
    findings.sort_by_cached_key(|finding| finding.order(own_file));
    findings.dedup();
    more += findings.len().saturating_sub(MAX_PROBLEMS);
    // What refuses the document stays.
    if findings.iter().take(MAX_PROBLEMS).all(|finding| finding.severity == Severity::Warning) {
        findings.sort_by_key(|finding| finding.severity);
    }
    findings.truncate(MAX_PROBLEMS);
    Report { findings, more }
}

/// Builds every material as [`Document::material`](crate::Document::material) does, and tells what is
/// refused.
///
/// One builder does for all as long as it refuses nothing; where it does, a new one decides, since limits are
/// those of one material.
fn refused<'a>(
    graph: &'a Graph<'a>,
    library: &'a Library,
    programs: &'a [Assembler],
    errors: &mut Vec<Error>,
    notes: &mut Vec<Warning>,
) {
    // Then no material is read at all.
    let refuses_all = !errors.is_empty();
    let materials: Vec<NodeRef<'a>> = graph.materials().collect();
    if refuses_all {
        return;
    }
    let (mut next, mut exhausted) = (0, 0);
    for program in programs {
        if exhausted >= MAX_EXHAUSTED {
            break;
        }
        let mut builder = Builder::new(graph, library, program);
        let mut is_new = true;
        while let Some(material) = materials.get(next) {
            match builder.material(*material) {
                Ok(material) => notes.extend(material.warnings),
                Err(error) if is_new => {
                    errors.push(error);
                    next += 1;
                    break;
                }
                Err(error) => {
                    exhausted += usize::from(matches!(error, Error::Limit { .. }));
                    break;
                }
            }
            next += 1;
            is_new = false;
        }
    }
}
