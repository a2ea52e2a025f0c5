//! What a verb prints about its work: text for people, JSON for programs.

use std::io::{self, Write as _};

use serde_json::Value;

/// Prints one of the two forms on standard output.
pub(crate) fn print(json: bool, facts: &Value, text: &str) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    if json {
        serde_json::to_writer_pretty(&mut out, facts).map_err(io::Error::from)?;
        writeln!(out)?;
    } else {
        writeln!(out, "{text}")?;
    }
    Ok(())
}
