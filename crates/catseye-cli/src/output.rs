//! Where a verb writes. Files appear whole or not at all; `-` is standard output.

use std::fs;
use std::io::{self, Seek as _, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::ValueEnum;
use tempfile::{NamedTempFile, SpooledTempFile};

use crate::failure::Usage;
use crate::interrupt;
use crate::report::{self, Stream};

/// Bytes for standard output that are kept in memory until all of them are there.
const SPOOL: usize = 1 << 20;

/// An output that can be written, as far as can be known before the work is done.
#[derive(Clone, Debug)]
pub(crate) struct Output {
    given: PathBuf,
    /// The file behind the name; `None` is standard output.
    target: Option<PathBuf>,
}

impl Output {
    /// Refuses at once what could only fail after the work.
    pub(crate) fn new(path: &Path) -> anyhow::Result<Self> {
        if path == Path::new("-") {
            return Ok(Self { given: path.to_owned(), target: None });
        }
        // Behind a link the target is replaced, not the link.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        refuse_unwritable(&target).with_context(|| format!("{}: can't be written", path.display()))?;
        interrupt::expect(&target);
        Ok(Self { given: path.to_owned(), target: Some(target) })
    }

    /// The file as the user named it.
    pub(crate) fn name(&self) -> String {
        if self.target.is_none() { "<stdout>".to_owned() } else { self.given.display().to_string() }
    }

    /// Where text about the file goes.
    pub(crate) fn messages(&self) -> Stream {
        if self.target.is_none() { Stream::Err } else { Stream::Out }
    }

    /// Writes the whole file.
    pub(crate) fn write(&self, bytes: &[u8]) -> anyhow::Result<()> {
        if self.target.is_none() {
            return report::to_stdout(bytes);
        }
        let mut draft = self.draft()?;
        draft.put(bytes)?;
        draft.finish()
    }

    /// Begins to write the file, which nobody sees before [`Draft::finish`].
    pub(crate) fn draft(&self) -> anyhow::Result<Draft<'_>> {
        let sink = match &self.target {
            None => Sink::Spool(tempfile::spooled_tempfile(SPOOL)),
            Some(target) => Sink::File(temporary_file(target).with_context(|| self.failure())?, target),
        };
        Ok(Draft { output: self, sink })
    }

    /// What is said where writing fails.
    fn failure(&self) -> String {
        format!("{}: can't be written", self.name())
    }
}

/// The format of a file, of those that are named as their files end: the one that was asked for, or else the
/// one that the name ends in, or else, on standard output, the first.
pub(crate) fn format<F: ValueEnum + PartialEq>(path: &Path, asked: Option<F>) -> anyhow::Result<F> {
    let name =
        |format: &F| format.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default();
    let ending = path.extension().unwrap_or_default();
    let named = F::value_variants().iter().find(|format| ending.eq_ignore_ascii_case(name(format)));
    match (asked, named, F::value_variants().first()) {
        (Some(asked), Some(named), _) if asked != *named => {
            bail!(Usage(format!(
                "{}: the name is not that of a file in the format {}",
                path.display(),
                name(&asked)
            )))
        }
        (Some(asked), ..) => Ok(asked),
        (None, Some(named), _) => Ok(named.clone()),
        (None, None, Some(first)) if path == Path::new("-") => Ok(first.clone()),
        _ => {
            let endings: Vec<String> =
                F::value_variants().iter().map(|format| format!(".{}", name(format))).collect();
            bail!(Usage(format!("{}: the name must end in {}", path.display(), endings.join(" or "))))
        }
    }
}

/// Refuses a file whose name doesn't end in what the file is; standard output has no ending.
pub(crate) fn must_end_in(path: &Path, ending: &str) -> anyhow::Result<()> {
    if path == Path::new("-") || path.extension().is_some_and(|other| other.eq_ignore_ascii_case(ending)) {
        return Ok(());
    }
    bail!(Usage(format!("{}: the name must end in .{ending}", path.display())))
}

/// A file in the making, deleted unless it is finished.
#[derive(Debug)]
pub(crate) struct Draft<'a> {
    output: &'a Output,
    sink: Sink<'a>,
}

#[derive(Debug)]
enum Sink<'a> {
    Spool(SpooledTempFile),
    File(NamedTempFile, &'a Path),
}

impl Write for Draft<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.sink {
            Sink::Spool(spool) => spool.write(bytes),
            // The temporary file itself would put its own name into the error.
            Sink::File(file, _) => file.as_file_mut().write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.sink {
            Sink::Spool(spool) => spool.flush(),
            Sink::File(file, _) => file.as_file_mut().flush(),
        }
    }
}

impl Draft<'_> {
    /// Writes some more.
    pub(crate) fn put(&mut self, bytes: &[u8]) -> anyhow::Result<()> {
        self.write_all(bytes).with_context(|| self.output.failure())
    }

    /// Shows the whole file at once.
    pub(crate) fn finish(self) -> anyhow::Result<()> {
        let done = match self.sink {
            Sink::File(file, target) => {
                interrupt::complete(target, || file.persist(target).map(|_| ()).map_err(|error| error.error))
            }
            Sink::Spool(mut spool) => {
                let mut out = io::stdout().lock();
                spool.rewind().and_then(|()| io::copy(&mut spool, &mut out)).and_then(|_| out.flush())
            }
        };
        done.with_context(|| self.output.failure())
    }
}

/// A file beside its target with the permissions of the file that it replaces, or of any new file.
fn temporary_file(target: &Path) -> io::Result<NamedTempFile> {
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".catseye-").suffix(".tmp");
    let replaced = fs::metadata(target).ok().map(|meta| meta.permissions());
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(replaced.clone().unwrap_or_else(|| fs::Permissions::from_mode(0o666)));
    }
    let file = builder.tempfile_in(folder).map_err(nameless)?;
    interrupt::stand_in(target, file.path());
    if let Some(permissions) = replaced {
        // The system's mask does not apply to what was chosen for the file before.
        fs::set_permissions(file.path(), permissions)?;
    }
    Ok(file)
}

fn refuse_unwritable(path: &Path) -> io::Result<()> {
    if let Ok(meta) = fs::metadata(path) {
        if meta.is_dir() {
            return Err(io::Error::other("it is a folder"));
        }
        if !meta.is_file() {
            // Renaming a file to its name would take a device out of the system.
            return Err(io::Error::other("it is not a regular file; `-` is standard output"));
        }
        if meta.permissions().readonly() {
            return Err(io::Error::other("it is read-only"));
        }
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(io::Error::other(format!("there is no folder {}", folder.display())));
    }
    tempfile::tempfile_in(folder).map_err(nameless)?;
    Ok(())
}

/// The error without the name of the temporary file, which would puzzle everyone.
fn nameless(error: io::Error) -> io::Error {
    io::Error::from(error.kind())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_half_way_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.png");
        fs::write(&path, "old").unwrap();
        let output = Output::new(&path).unwrap();
        let mut draft = output.draft().unwrap();
        draft.write_all(b"half of the new").unwrap();
        drop(draft);
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
