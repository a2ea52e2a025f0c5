//! Where a table of queries comes from: a file, standard input, or the command line itself.

use std::fs::File;
use std::io::{self, Cursor, IsTerminal as _, Read};
use std::path::Path;

use anyhow::{Context as _, bail};
use catseye_photometry::line_of_record;

use crate::failure::Usage;

/// Bytes that are read at a time, some hundred records.
const BLOCK: usize = 1 << 15;
/// Bytes of the longest record: more are no row of numbers, but an open quote or no text at all.
const LONGEST: usize = 1 << 24;

/// A CSV table that is read block by block, and what to call it in messages.
pub(crate) struct Input {
    name: String,
    reader: Box<dyn Read + Send>,
    has_lines: bool,
    /// Bytes of the whole table, where they are known.
    pub(crate) length: Option<u64>,
    /// What was read behind the last whole record, and where such records end in it.
    rest: Vec<u8>,
    ends: RecordEnds,
    /// Ends of lines before `rest`.
    lines: usize,
}

/// Whole records of a table.
#[derive(Debug, Default)]
pub(crate) struct Block {
    pub(crate) text: Vec<u8>,
    /// Ends of lines before them.
    lines: usize,
}

impl Input {
    /// A file, or standard input where there is none or its name is `-`.
    pub(crate) fn open(file: Option<&Path>) -> anyhow::Result<Self> {
        let Some(path) = file.filter(|path| *path != Path::new("-")) else {
            if io::stdin().is_terminal() {
                let hint = "no input: give a CSV file, pipe one in, or use options such as --roughness and \
                            --wo (see --help)";
                bail!(Usage(hint.to_owned()));
            }
            return Ok(Self::new("<stdin>".to_owned(), Box::new(io::stdin()), None));
        };
        let name = path.display().to_string();
        let file = File::open(path).with_context(|| format!("{name}: can't be read"))?;
        let length = file.metadata().ok().filter(std::fs::Metadata::is_file).map(|meta| meta.len());
        Ok(Self::new(name, Box::new(file), length))
    }

    /// A table of one row that was given as options.
    pub(crate) fn from_options(header: &str, row: &str) -> Self {
        let text = format!("{header}\n{row}\n").into_bytes();
        Self { has_lines: false, ..Self::new("command line".to_owned(), Box::new(Cursor::new(text)), None) }
    }

    fn new(name: String, reader: Box<dyn Read + Send>, length: Option<u64>) -> Self {
        let (rest, ends) = (Vec::new(), RecordEnds::default());
        Self { name, reader, has_lines: true, length, rest, ends, lines: 0 }
    }

    /// Reads the next whole records; none are left where the block stays empty.
    pub(crate) fn fill(&mut self, block: &mut Block) -> anyhow::Result<()> {
        let Block { text, lines } = block;
        text.clear();
        text.append(&mut self.rest);
        *lines = self.lines;
        while self.ends.last == 0 {
            let read = self.reader.by_ref().take(BLOCK as u64).read_to_end(text);
            if read.with_context(|| format!("{}: can't be read", self.name))? == 0 {
                self.ends.last = text.len();
                break;
            }
            if text.len() > LONGEST {
                bail!("{}: a record is longer than 16 MiB: is a quote left open?", self.place(block, 0));
            }
            self.ends.see(text);
        }
        self.rest.extend_from_slice(&text[self.ends.last..]);
        text.truncate(self.ends.last);
        self.ends = RecordEnds::default();
        self.ends.see(&self.rest);
        self.lines += text.iter().filter(|b| **b == b'\n').count();
        Ok(())
    }

    /// The place of the record that was read from a byte of a block on: `FILE:LINE`.
    pub(crate) fn place(&self, block: &Block, byte: u64) -> String {
        if self.has_lines {
            format!("{}:{}", self.name, block.lines + line_of_record(&block.text, byte))
        } else {
            self.name.clone()
        }
    }
}

/// Finds the end of the last whole record in a text that comes piece by piece.
#[derive(Debug, Default)]
struct RecordEnds {
    field: Field,
    /// How far the text was seen.
    seen: usize,
    /// Behind the last whole record; 0 where there is none.
    last: usize,
}

/// Where in a field a byte is.
#[derive(Clone, Copy, Debug, Default)]
enum Field {
    #[default]
    Start,
    Plain,
    Quoted,
    /// Behind a quote that ends the field, or is the first of a doubled one.
    Closed,
}

impl RecordEnds {
    fn see(&mut self, text: &[u8]) {
        let new = &text[self.seen..];
        if !matches!(self.field, Field::Quoted | Field::Closed) && !new.contains(&b'"') {
            // Without quotes every line is a record, and only the last one's last field may go on.
            self.last = new.iter().rposition(|b| *b == b'\n').map_or(self.last, |i| self.seen + i + 1);
            let begins = text.last().is_none_or(|b| matches!(b, b',' | b'\n'));
            self.field = if begins { Field::Start } else { Field::Plain };
            self.seen = text.len();
            return;
        }
        for (i, &byte) in text.iter().enumerate().skip(self.seen) {
            self.field = match (self.field, byte) {
                (Field::Start | Field::Closed, b'"') => Field::Quoted,
                (Field::Quoted, b'"') => Field::Closed,
                (Field::Quoted, _) => Field::Quoted,
                (_, b'\n') => {
                    self.last = i + 1;
                    Field::Start
                }
                (_, b',') => Field::Start,
                _ => Field::Plain,
            };
        }
        self.seen = text.len();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The blocks of a table, and their first lines.
    fn blocks(text: &[u8]) -> Vec<(Vec<u8>, String)> {
        let mut input = Input::new("t".to_owned(), Box::new(Cursor::new(text.to_vec())), None);
        let mut all = Vec::new();
        loop {
            let mut block = Block::default();
            input.fill(&mut block).unwrap();
            if block.text.is_empty() {
                return all;
            }
            let place = input.place(&block, 0);
            all.push((block.text, place));
        }
    }

    #[test]
    fn blocks_are_whole_records_and_together_the_table() {
        let quoted = "1,\"a \"\"quoted\"\",\nfield\",2\r\n";
        for (row, lines) in [(quoted, 2), ("1,5\" inches,2\n", 1), ("1,a field,2\n", 1)] {
            let text = row.repeat(10_000);
            let blocks = blocks(text.as_bytes());
            assert!(blocks.len() > 3, "{}", blocks.len());
            let mut line = 1;
            for (block, place) in &blocks {
                assert!(block.len().is_multiple_of(row.len()), "a record is cut: {row}");
                assert_eq!(*place, format!("t:{line}"));
                line += lines * block.len() / row.len();
            }
            assert_eq!(blocks.into_iter().flat_map(|(block, _)| block).collect::<Vec<u8>>(), text.as_bytes());
        }
    }

    #[test]
    fn an_open_quote_ends_at_the_limit() {
        let mut text = b"a,b\n\"".to_vec();
        text.resize(LONGEST + 2 * BLOCK, b'x');
        let mut input = Input::new("t".to_owned(), Box::new(Cursor::new(text)), None);
        let mut block = Block::default();
        input.fill(&mut block).unwrap();
        let error = input.fill(&mut block).unwrap_err();
        assert_eq!(error.to_string(), "t:2: a record is longer than 16 MiB: is a quote left open?");
    }
}
