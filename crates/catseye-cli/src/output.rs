//! Files that appear whole or not at all.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use tempfile::NamedTempFile;

/// A file under construction: nothing is seen under its name before [`OutputFile::commit`].
#[derive(Debug)]
pub(crate) struct OutputFile {
    path: PathBuf,
    sink: Sink,
}

#[derive(Debug)]
enum Sink {
    /// A file beside the target, renamed in the end.
    Temporary(BufWriter<NamedTempFile>),
    /// A device or a pipe, which must not be replaced.
    Special(BufWriter<fs::File>),
}

impl OutputFile {
    /// Opens the output before the work starts, so that an unwritable one fails at once.
    pub(crate) fn create(path: &Path) -> anyhow::Result<Self> {
        // Behind a link the target is replaced, not the link.
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let sink = open(&path).with_context(|| format!("{}: can't be written", path.display()))?;
        Ok(Self { path, sink })
    }

    /// Puts the file in its place.
    pub(crate) fn commit(self) -> anyhow::Result<()> {
        let path = self.path;
        finish(self.sink, &path).with_context(|| format!("{}: can't be written", path.display()))
    }
}

impl Write for OutputFile {
    fn write(&mut self, buf: &[u8]) -> io::Result<usize> {
        match &mut self.sink {
            Sink::Temporary(file) => file.write(buf),
            Sink::Special(file) => file.write(buf),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.sink {
            Sink::Temporary(file) => file.flush(),
            Sink::Special(file) => file.flush(),
        }
    }
}

fn open(path: &Path) -> io::Result<Sink> {
    match fs::metadata(path) {
        Ok(meta) if meta.is_dir() => return Err(io::Error::from(io::ErrorKind::IsADirectory)),
        Ok(meta) if !meta.is_file() => {
            return Ok(Sink::Special(BufWriter::new(fs::OpenOptions::new().write(true).open(path)?)));
        }
        Ok(meta) if meta.permissions().readonly() => {
            return Err(io::Error::from(io::ErrorKind::PermissionDenied));
        }
        _ => {}
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".catseye-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // What any other new file gets; the process's umask takes its bits away.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let file = builder.tempfile_in(folder).map_err(|error| io::Error::from(error.kind()))?;
    Ok(Sink::Temporary(BufWriter::new(file)))
}

fn finish(sink: Sink, path: &Path) -> io::Result<()> {
    match sink {
        Sink::Temporary(file) => {
            let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
            file.persist(path).map_err(|error| error.error)?;
            Ok(())
        }
        Sink::Special(mut file) => file.flush(),
    }
}
