//! From bytes to the root element of a document of a known version.

use std::{path::Path, sync::Arc};

use crate::{
    error::{Error, quoted},
    text::{
        element::Element,
        encoding::decode,
        files::{MAX_BYTES, read},
        source::Source,
        upgrade::upgrade,
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
    parse_text(&decode(bytes, name)?, name, folder)
}

pub(crate) fn parse_text(text: &str, name: &str, folder: Option<&Path>) -> Result<Element, Error> {
    refuse_large(text.as_bytes(), name)?;
    let source = match folder {
        Some(folder) => Source::in_folder(name, text, folder),
        None => Source::new(name, text),
    };
    let mut root = xml::parse(&Arc::new(source))?;
    if root.tag() != "materialx" {
        return Err(Error::NotMaterialX { at: root.place() });
    }
    match root.require("version")?.trim() {
        "1.39" => {}
        "1.38" => upgrade(&mut root),
        version => {
            let number = version.strip_prefix("1.").and_then(|minor| minor.parse::<u32>().ok());
            let instead = match number {
                Some(0..38) => "upgrade it with MaterialX's mxformat.py --upgrade",
                _ => "versions 1.38 and 1.39 are",
            };
            return Err(Error::Version { at: root.place(), version: quoted(version), instead });
        }
    }
    Ok(root)
}

fn refuse_large(bytes: &[u8], name: &str) -> Result<(), Error> {
    if bytes.len() > MAX_BYTES {
        Err(Error::TooLarge { file: name.into(), limit: MAX_BYTES })
    } else {
        Ok(())
    }
}
