//! What a verb prints about its work: text for people, JSON for programs.

use std::io::{self, Write as _};

use serde_json::Value;

/// Prints one of the two forms on standard output.
pub(crate) fn print(json: bool, facts: &Value, text: &str) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    if json {
        out.write_all(self::json(facts)?.as_bytes())?;
    } else {
        writeln!(out, "{text}")?;
    }
    Ok(())
}

/// JSON as it is printed.
pub(crate) fn json(facts: &Value) -> anyhow::Result<String> {
    Ok(serde_json::to_string_pretty(facts)? + "\n")
}
