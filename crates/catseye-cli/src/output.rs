//! Where a verb may write. Files appear whole or not at all.

use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use anyhow::Context as _;

/// An output file that can be written, as far as can be known before the work is done.
#[derive(Clone, Debug)]
pub(crate) struct Output {
    given: PathBuf,
    target: PathBuf,
}

impl Output {
    /// Refuses at once what could only fail after the work.
    pub(crate) fn new(path: &Path) -> anyhow::Result<Self> {
        // Behind a link the target is replaced, not the link.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        refuse_unwritable(&target).with_context(|| format!("{}: can't be written", path.display()))?;
        Ok(Self { given: path.to_owned(), target })
    }

    /// The file as the user named it.
    pub(crate) fn name(&self) -> String {
        self.given.display().to_string()
    }

    /// Writes the whole file.
    pub(crate) fn write(&self, bytes: &[u8]) -> anyhow::Result<()> {
        write_whole(&self.target, |file| file.write_all(bytes))
            .with_context(|| format!("cannot write {}", self.name()))
    }
}

/// Writes a file under a temporary name beside its own, and renames it when it is complete.
fn write_whole(path: &Path, write: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut temporary = temporary_file(folder)?;
    write(temporary.as_file_mut())?;
    temporary.persist(path).map_err(|e| e.error)?;
    Ok(())
}

/// A file with the permissions that any new file gets, deleted unless it is renamed.
fn temporary_file(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".catseye-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

fn refuse_unwritable(path: &Path) -> io::Result<()> {
    if let Ok(meta) = fs::metadata(path) {
        if meta.is_dir() {
            return Err(io::Error::other("it is a folder"));
        }
        if !meta.is_file() {
            // Renaming a file to its name would take a device out of the system.
            return Err(io::Error::other("it is not a regular file"));
        }
        if meta.permissions().readonly() {
            return Err(io::Error::other("it is read-only"));
        }
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(io::Error::other(format!("there is no folder {}", folder.display())));
    }
    // The error's own text names the temporary file, which would puzzle everyone.
    tempfile::tempfile_in(folder).map_err(|error| io::Error::from(error.kind()))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_half_way_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.png");
        fs::write(&path, "old").unwrap();
        let result = write_whole(&path, |file| {
            file.write_all(b"half of the new")?;
            Err(io::Error::other("the disk is full"))
        });
        assert_eq!(result.unwrap_err().to_string(), "the disk is full");
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
