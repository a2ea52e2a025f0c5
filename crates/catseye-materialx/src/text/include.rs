//! `xi:include`: other documents' elements in this one.

use std::{collections::HashSet, path::PathBuf};

use crate::{
    error::{Error, quoted},
    text::{
        element::Element,
        files::{Refusal, SearchPath},
        root::read_root,
    },
};

/// Files that one document may include, directly and through others.
const MAX_FILES: usize = 256;
/// Bytes of all included files together.
const MAX_TOTAL_BYTES: usize = 64 << 20;
/// Files that include one another in a chain.
const MAX_DEPTH: usize = 16;

/// Puts included documents' elements in the place of the includes.
#[derive(Debug)]
pub(crate) struct Includer<'a> {
    search_path: &'a SearchPath,
    /// Files that are being read, the document itself first.
    open: Vec<PathBuf>,
    /// Files whose elements are there already.
    done: HashSet<PathBuf>,
    bytes: usize,
    /// What is wrong with includes, where the caller wants to go on.
    problems: Option<Vec<Error>>,
}

impl<'a> Includer<'a> {
    pub(crate) fn new(search_path: &'a SearchPath, document: Option<PathBuf>) -> Self {
        Self {
            search_path,
            open: document.into_iter().collect(),
            done: HashSet::new(),
            bytes: 0,
            problems: None,
        }
    }

    /// Collects what is wrong instead of stopping at it.
    pub(crate) fn lenient(self) -> Self {
        Self { problems: Some(Vec::new()), ..self }
    }

    pub(crate) fn problems(self) -> Vec<Error> {
        self.problems.unwrap_or_default()
    }

    /// The root with all its includes resolved. A file that is included twice counts once.
    pub(crate) fn expand(&mut self, mut root: Element) -> Result<Element, Error> {
        if root.children_of_kind("xi:include").next().is_none() {
            return Ok(root);
        }
        let mut children = Vec::new();
        // The root stays what it is; only its children are replaced.
        let own = root.take_children();
        for child in own {
            if child.tag() != "xi:include" {
                children.push(child);
                continue;
            }
            match (self.included(&child), &mut self.problems) {
                (Ok(elements), _) => children.extend(elements),
                (Err(problem), Some(problems)) => problems.push(problem),
                (Err(problem), None) => return Err(problem),
            }
        }
        Ok(root.with_children(children))
    }

    fn included(&mut self, include: &Element) -> Result<Vec<Element>, Error> {
        let name = include.require("href")?;
        let path = self.search_path.find(include.source(), name).map_err(|refusal| match refusal {
            Refusal::Missing => Error::MissingFile { at: include.place(), name: quoted(name) },
            Refusal::Outside => Error::OutsideSearchPath { at: include.place(), name: quoted(name) },
            Refusal::Tiles => Error::Tiles { at: include.place(), name: quoted(name) },
        })?;
        if self.open.contains(&path) {
            let cycle = quoted(name);
            return Err(Error::Cycle { at: include.place(), cycle });
        }
        if !self.done.insert(path.clone()) {
            return Ok(Vec::new());
        }
        let limit = |what, limit| Err(Error::Limit { at: include.place(), what, limit });
        if self.done.len() > MAX_FILES {
            return limit("included files", MAX_FILES);
        }
        if self.open.len() > MAX_DEPTH {
            return limit("files that include one another in a chain", MAX_DEPTH);
        }
        let root = read_root(&path, &path.to_string_lossy())?;
        self.bytes += root.source().text().len();
        if self.bytes > MAX_TOTAL_BYTES {
            return limit("bytes in included files", MAX_TOTAL_BYTES);
        }
        self.open.push(path);
        let root = self.expand(root);
        self.open.pop();
        Ok(root?.into_children())
    }
}
