//! Where a table of queries comes from: a file, standard input, or the command line itself.

use std::fs;
use std::io::{self, IsTerminal as _, Read as _};
use std::path::Path;

use anyhow::Context as _;
use catseye_photometry::line_of_record;

use crate::failure::Usage;

/// The text of a CSV table and what to call it in messages.
#[derive(Debug)]
pub(crate) struct Input {
    name: String,
    text: Vec<u8>,
    has_lines: bool,
}

impl Input {
    /// Reads a file, or standard input where there is none.
    pub(crate) fn read(file: Option<&Path>) -> anyhow::Result<Self> {
        let (name, mut text) = match file {
            Some(path) if path != Path::new("-") => {
                let name = path.display().to_string();
                let text = fs::read(path).with_context(|| format!("{name}: can't be read"))?;
                (name, text)
            }
            _ => ("<stdin>".to_owned(), read_stdin()?),
        };
        if text.starts_with(b"\xef\xbb\xbf") {
            text.drain(..3);
        }
        Ok(Self { name, text, has_lines: true })
    }

    /// A table of one row that was given as options.
    pub(crate) fn from_options(header: &str, row: &str) -> Self {
        Self {
            name: "command line".to_owned(),
            text: format!("{header}\n{row}\n").into_bytes(),
            has_lines: false,
        }
    }

    /// The table as CSV.
    pub(crate) fn text(&self) -> &[u8] {
        &self.text
    }

    /// The place of the record that was read from the byte offset `byte` on: `FILE:LINE`.
    pub(crate) fn place(&self, byte: u64) -> String {
        if self.has_lines {
            format!("{}:{}", self.name, line_of_record(&self.text, byte))
        } else {
            self.name.clone()
        }
    }
}

fn read_stdin() -> anyhow::Result<Vec<u8>> {
    let mut stdin = io::stdin().lock();
    if stdin.is_terminal() {
        let hint = "no input: give a CSV file, pipe one in, or use options such as --roughness and --wo (see --help)";
        return Err(Usage(hint.to_owned()).into());
    }
    let mut text = Vec::new();
    stdin.read_to_end(&mut text).context("<stdin>: can't be read")?;
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::Input;

    #[test]
    fn lines_are_counted_through_crlf_and_empty_lines() {
        let input = |text: &str| Input { name: "t".to_owned(), text: text.into(), has_lines: true };
        assert_eq!(input("a\r\n1\r\n\r\n2\r\n").place(5), "t:4", "offset of the end of line after row 1");
        assert_eq!(input("a\n1\n\n\n2\n").place(4), "t:5", "two empty lines are skipped");
        assert_eq!(input("a\n1\n").place(0), "t:1", "the header is line 1");
    }
}
