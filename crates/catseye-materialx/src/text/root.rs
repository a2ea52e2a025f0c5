//! From bytes to the root element of a document of a known version.

use std::{path::Path, sync::Arc};

use crate::{
    error::{Error, quoted},
    text::{
        element::Element,
        files::{MAX_BYTES, read},
        source::Source,
        xml,
    },
};

/// The root element of a file, its includes not yet read.
pub(crate) fn read_root(path: &Path, name: &str) -> Result<Element, Error> {
    if path.is_dir() {
        return Err(Error::Folder { file: name.into() });
    }
    let bytes = read(path).map_err(|cause| Error::Read { file: name.into(), cause })?;
    let folder =
        path.parent().map(|folder| if folder.as_os_str().is_empty() { Path::new(".") } else { folder });
    parse_bytes(&bytes, name, folder)
}

pub(crate) fn parse_bytes(bytes: &[u8], name: &str, folder: Option<&Path>) -> Result<Element, Error> {
    refuse_large(bytes, name)?;
    match str::from_utf8(bytes) {
        Ok(text) => parse_text(text, name, folder),
        Err(cause) => {
            let valid = String::from_utf8_lossy(&bytes[..cause.valid_up_to()]);
            Err(Error::NotUtf8 { at: Source::new(name, &valid).place(valid.len(), String::new()) })
        }
    }
}

pub(crate) fn parse_text(text: &str, name: &str, folder: Option<&Path>) -> Result<Element, Error> {
    refuse_large(text.as_bytes(), name)?;
    let source = match folder {
        Some(folder) => Source::in_folder(name, text, folder),
        None => Source::new(name, text),
    };
    let root = xml::parse(&Arc::new(source))?;
    if root.tag() != "materialx" {
        return Err(Error::NotMaterialX { at: root.place() });
    }
    refuse_version(&root)?;
    Ok(root)
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
