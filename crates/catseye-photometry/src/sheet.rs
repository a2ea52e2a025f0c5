//! From the bytes of a table to its records: encoding, lines before the header, separator.

use std::borrow::Cow;

use crate::Error;
use crate::columns::{is_known, shown};
use crate::lines::{LineCounter, line_of_record};

/// Bytes of the largest table that is read: photometric tables have hundreds of rows, not millions.
pub(crate) const LARGEST: usize = 16 << 20;
/// Rows of the longest one: each takes half a kilobyte.
const MOST_ROWS: usize = 250_000;
/// Columns of the widest one.
const MOST_COLUMNS: usize = 200;
/// Characters of the longest cell: more are an open quote.
const LONGEST_CELL: usize = 4096;
/// What columns are separated by, and how a message names it. Of equals the first is taken.
const SEPARATORS: [(u8, &str); 4] = [(b',', "`,`"), (b';', "`;`"), (b'\t', "tab"), (b'|', "`|`")];

/// A table's texts, without rows that hold nothing.
#[derive(Debug)]
pub(crate) struct Sheet {
    pub(crate) header: Vec<String>,
    /// The line of each record, counted from 1, and its cells: as many as the header's.
    pub(crate) records: Vec<(usize, Vec<String>)>,
}

impl Sheet {
    /// Reads CSV text whose columns are separated by commas, semicolons, tabs or bars.
    pub(crate) fn read(bytes: &[u8], name: &str) -> Result<Self, Error> {
        let fail = |problem: String| Error::Table { table: name.to_owned(), problem };
        if bytes.len() > LARGEST {
            return Err(fail(format!("is larger than {} MiB; is it a table?", LARGEST >> 20)));
        }
        let text = decoded(bytes).map_err(|(byte, problem)| Error::Row {
            table: name.to_owned(),
            line: line_of_record(bytes, byte as u64),
            problem: format!("{problem}; save the table as CSV in UTF-8"),
        })?;
        let (start, said) = preamble(&text);
        if start == text.len() {
            return Err(fail("is empty; a header line and rows are needed".to_owned()));
        }
        let separator = said.map_or_else(|| separator(&text[start..]), Ok).map_err(fail)?;
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(separator)
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(&text.as_bytes()[start..]);
        let broken = |error: csv::Error| fail(format!("can't be read as CSV: {error}"));
        let mut header: Vec<String> = reader.headers().map_err(broken)?.iter().map(str::to_owned).collect();
        if header.len() > MOST_COLUMNS {
            return Err(fail(format!("has {} columns; at most {MOST_COLUMNS} are read", header.len())));
        }
        if let Some(long) = header.iter().find(|name| name.len() > LONGEST_CELL) {
            return Err(fail(format!("the header's {} does not end; is a quote left open?", shown(long))));
        }
        while header.last().is_some_and(String::is_empty) {
            header.pop();
        }
        let (mut records, mut lines) = (Vec::new(), LineCounter::new(text.as_bytes()));
        for record in reader.records() {
            let record = record.map_err(broken)?;
            if record.iter().all(str::is_empty) {
                continue;
            }
            let line = lines.of_record(start as u64 + record.position().map_or(0, csv::Position::byte));
            let wrong = |problem| Error::Row { table: name.to_owned(), line, problem };
            records.push((line, cells(&record, header.len(), separator).map_err(wrong)?));
            if records.len() > MOST_ROWS {
                return Err(fail(format!("has more than {MOST_ROWS} rows; split it, or thin it out")));
            }
        }
        Ok(Self { header, records })
    }
}

/// UTF-8, or what spreadsheets of western Europe write instead, where nothing in it is unlike text. What is
/// no text is told with the byte where it begins.
fn decoded(bytes: &[u8]) -> Result<Cow<'_, str>, (usize, &'static str)> {
    let is_control = |b: &u8| *b < b' ' && !matches!(b, b'\t' | b'\n' | b'\r');
    if let Some(byte) = bytes.iter().position(is_control) {
        return Err((byte, "is no text, or not in UTF-8"));
    }
    let mark = b"\xef\xbb\xbf";
    match str::from_utf8(bytes) {
        // A mark that is kept keeps the bytes' places; it is white space to nobody.
        Ok(text) if bytes.starts_with(mark) => Ok(Cow::Owned(text.replacen('\u{feff}', "   ", 1))),
        Ok(text) => Ok(Cow::Borrowed(text)),
        // Windows-1252 and ISO 8859-1 agree on these; 0xFE and 0xFF begin UTF-16.
        Err(_) if bytes.iter().all(|b| !matches!(b, 0x7f..0xa0 | 0xfe..)) => {
            Ok(Cow::Owned(bytes.iter().copied().map(char::from).collect()))
        }
        Err(error) => Err((error.valid_up_to(), "is not UTF-8 text")),
    }
}

/// Where the header begins, behind lines of nothing, remarks (`#`) and a spreadsheet's `sep=;`, which names
/// the separator.
fn preamble(text: &str) -> (usize, Option<u8>) {
    let (mut start, mut said) = (0, None);
    for line in text.split_inclusive('\n') {
        let plain = line.trim_matches([' ', '\r', '\n']);
        let named = plain.to_lowercase().strip_prefix("sep=").and_then(|rest| rest.bytes().next());
        let is_nothing = plain.chars().all(|c| c.is_whitespace() || ",;|".contains(c));
        if let Some(separator) = named.filter(|named| SEPARATORS.iter().any(|(known, _)| known == named)) {
            said = Some(separator);
        } else if !is_nothing && !plain.starts_with('#') {
            break;
        }
        start += line.len();
    }
    (start, said)
}

/// The separator that finds most columns with a meaning in the header; a text says that two find as many.
fn separator(text: &str) -> Result<u8, String> {
    let line = text.lines().next().unwrap_or_default();
    let fields = |separator: u8| {
        let mut reader = csv::ReaderBuilder::new();
        let mut reader = reader.delimiter(separator).has_headers(false).from_reader(line.as_bytes());
        reader.records().next().and_then(Result::ok).unwrap_or_default()
    };
    let known = SEPARATORS.map(|(separator, name)| {
        let fields = fields(separator);
        (fields.iter().filter(|field| is_known(field)).count(), fields.len(), separator, name)
    });
    // The first of the greatest.
    let best = known.into_iter().reduce(|a, b| if (b.0, b.1) > (a.0, a.1) { b } else { a });
    let Some((found, _, separator, name)) = best else { return Ok(b',') };
    let rival = known.iter().find(|other| other.2 != separator && other.0 == found && found > 1);
    match rival {
        Some((.., other)) => {
            Err(format!("the header can be read with {name} and with {other} between columns; use one"))
        }
        None => Ok(separator),
    }
}

/// A record's cells, as many as the header has; more of them may be empty ones.
fn cells(record: &csv::StringRecord, columns: usize, separator: u8) -> Result<Vec<String>, String> {
    if let Some(long) = record.iter().find(|cell| cell.len() > LONGEST_CELL) {
        return Err(format!("a cell that begins with {} does not end; is a quote left open?", shown(long)));
    }
    let mut cells: Vec<String> = record.iter().map(str::to_owned).collect();
    while cells.len() > columns && cells.last().is_some_and(String::is_empty) {
        cells.pop();
    }
    if cells.len() == columns {
        return Ok(cells);
    }
    let noun = if cells.len() == 1 { "field" } else { "fields" };
    let cure = match cells.len() > columns && separator == b',' {
        true => "; if decimals have commas, separate the columns with `;`, or quote the numbers",
        false => "; is a cell or a quote missing?",
    };
    Err(format!("{} {noun}, but the header has {columns}{cure}", cells.len()))
}
