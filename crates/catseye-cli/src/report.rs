//! What a verb says: results as text for people or as JSON for programs, and warnings.

use std::fmt;
use std::io::{self, Write as _};
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::Context as _;
use serde_json::{Map, Value};

/// Whether `--quiet` was given.
static QUIET: AtomicBool = AtomicBool::new(false);

/// Leaves out warnings, progress bars and what was written from now on.
pub(crate) fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Whether only results and errors are wanted.
pub(crate) fn is_quiet() -> bool {
    QUIET.load(Ordering::Relaxed)
}

/// Where text goes: to standard error where a file goes to standard output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stream {
    Out,
    Err,
}

impl Stream {
    /// Prints one of the two forms of a result.
    pub(crate) fn print(self, json: bool, facts: &Value, text: &str) -> anyhow::Result<()> {
        let text = if json { self::json(facts)? } else { format!("{text}\n") };
        match self {
            Self::Out => to_stdout(text.as_bytes()),
            Self::Err => Ok(io::stderr().write_all(text.as_bytes())?),
        }
    }

    /// Says what was written, unless nobody wants to hear it.
    pub(crate) fn note(self, json: bool, facts: &Value, text: &str) -> anyhow::Result<()> {
        if is_quiet() && !json { Ok(()) } else { self.print(json, facts, text) }
    }
}

/// Prints one of the two forms of a result on standard output.
pub(crate) fn print(json: bool, facts: &Value, text: &str) -> anyhow::Result<()> {
    Stream::Out.print(json, facts, text)
}

/// Writes all of it to standard output, now.
pub(crate) fn to_stdout(bytes: &[u8]) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes).and_then(|()| out.flush()).context("<stdout>: can't be written")
}

/// Warns on standard error.
pub(crate) fn warn(warning: impl fmt::Display) {
    if !is_quiet() {
        eprintln!("catseye: warning: {warning}");
    }
}

/// JSON as it is printed.
pub(crate) fn json(facts: &Value) -> anyhow::Result<String> {
    Ok(serde_json::to_string_pretty(facts)? + "\n")
}

/// The objects as CSV, numbers with the digits that give them back.
pub(crate) fn csv(objects: &[Map<String, Value>]) -> anyhow::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let Some(first) = objects.first() else { return Ok(String::new()) };
    writer.write_record(first.keys())?;
    for object in objects {
        // What some subjects have and others have not is the last column.
        let cells = first.keys().map(|name| match object.get(name) {
            Some(Value::String(text)) => text.clone(),
            None | Some(Value::Null) => String::new(),
            Some(number) => number.to_string(),
        });
        writer.write_record(cells)?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}
