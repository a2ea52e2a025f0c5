//! The text of a document and places in it.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use crate::error::Place;

/// A document's text under the name that messages use.
#[derive(Debug)]
pub(crate) struct Source {
    name: Arc<str>,
    text: Box<str>,
    folder: Option<PathBuf>,
}

impl Source {
    pub(crate) fn new(name: &str, text: &str) -> Self {
        Self { name: name.into(), text: text.into(), folder: None }
    }

    /// A document that lies in a folder, from which the files that it names are sought.
    pub(crate) fn in_folder(name: &str, text: &str, folder: &Path) -> Self {
        Self { folder: Some(folder.to_owned()), ..Self::new(name, text) }
    }

    pub(crate) fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    pub(crate) fn name(&self) -> &Arc<str> {
        &self.name
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// Line and column of a byte offset; offsets past the end mean the end.
    pub(crate) fn place(&self, offset: usize, element: String) -> Place {
        let before = &self.text[..self.text.floor_char_boundary(offset)];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let newlines = before.bytes().filter(|&byte| byte == b'\n').count();
        let columns = before[line_start..].chars().count();
        Place { file: Arc::clone(&self.name), line: from_one(newlines), column: from_one(columns), element }
    }
}

/// Counts as people do; documents are too short to reach the limit.
fn from_one(count: usize) -> u32 {
    u32::try_from(count).map_or(u32::MAX, |count| count.saturating_add(1))
}
