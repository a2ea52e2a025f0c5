//! The columns of a CSV verb's output, as CSV and as JSON.

use std::fmt::Write as _;

use csv::ByteRecord;

use super::row::{Cell, Columns, Row, RowError};

/// The columns of the output.
#[derive(Debug)]
pub(crate) struct Layout {
    header: ByteRecord,
    columns: Columns,
    added: &'static [&'static str],
    /// The input's columns that are carried through: all but those that an added one replaces.
    carried: Vec<usize>,
    json: bool,
}

impl Layout {
    /// Finds the query's columns in the header.
    pub(crate) fn new(
        header: ByteRecord,
        argument: Option<[&'static str; 3]>,
        added: &'static [&'static str],
        json: bool,
    ) -> anyhow::Result<Self> {
        let columns = Columns::new(&header, argument)?;
        let replaced =
            |field: &usize| added.iter().any(|name| name.as_bytes() == header[*field].trim_ascii());
        let carried = (0..header.len()).filter(|field| !replaced(field)).collect();
        Ok(Self { columns, added, carried, json, header })
    }

    /// A record with the meaning of its fields.
    pub(crate) fn row<'a>(&'a self, record: &'a ByteRecord) -> Result<Row<'a>, RowError> {
        let (fields, columns) = (record.len(), self.header.len());
        if fields != columns {
            let noun = if fields == 1 { "field" } else { "fields" };
            return Err(RowError::row(format!("{fields} {noun}, but the header has {columns}")));
        }
        Ok(Row { record, columns: &self.columns })
    }

    /// What comes before the first row.
    pub(crate) fn opening(&self) -> Vec<u8> {
        if self.json {
            return b"[".to_vec();
        }
        let mut line = Vec::new();
        self.write_csv(&mut line, &self.header, self.added.iter().map(|&name| Cell::Word(name)));
        line
    }

    /// Writes what comes after the last row.
    pub(crate) fn close(&self, out: &mut Vec<u8>) {
        if self.json {
            // The last object's comma.
            if out.last() == Some(&b',') {
                out.pop();
            }
            out.extend_from_slice(b"\n]\n");
        }
    }

    /// Writes a row and its answers.
    pub(crate) fn write(&self, out: &mut Vec<u8>, record: &ByteRecord, cells: &[Cell]) {
        if self.json {
            self.write_json(out, record, cells);
        } else {
            self.write_csv(out, record, cells.iter().copied());
        }
    }

    fn write_csv(&self, out: &mut Vec<u8>, record: &ByteRecord, cells: impl Iterator<Item = Cell>) {
        for &field in &self.carried {
            push_field(out, &record[field]);
            out.push(b',');
        }
        let mut text = String::new();
        for cell in cells {
            push_cell(&mut text, cell);
            text.push(',');
        }
        text.pop();
        out.extend_from_slice(text.as_bytes());
        out.push(b'\n');
    }

    /// Inputs and answers as numbers, everything else as text; what JSON has no number for as text, too.
    fn write_json(&self, out: &mut Vec<u8>, record: &ByteRecord, cells: &[Cell]) {
        let mut text = String::from("\n{");
        for &field in &self.carried {
            let value = String::from_utf8_lossy(&record[field]);
            let number = value.trim().parse::<f64>().ok().filter(|_| self.columns.is_input(field));
            push_key(&mut text, &String::from_utf8_lossy(&self.header[field]));
            match number {
                Some(number) => push_json(&mut text, Cell::F64(number)),
                None => text.push_str(&json_text(&value)),
            }
            text.push(',');
        }
        for (name, &cell) in self.added.iter().zip(cells) {
            push_key(&mut text, name);
            push_json(&mut text, cell);
            text.push(',');
        }
        text.pop();
        text.push_str("},");
        out.extend_from_slice(text.as_bytes());
    }
}

/// A CSV field, in quotes only where it needs them.
fn push_field(out: &mut Vec<u8>, field: &[u8]) {
    if !field.iter().any(|b| matches!(b, b',' | b'"' | b'\n' | b'\r')) {
        out.extend_from_slice(field);
        return;
    }
    out.push(b'"');
    for &b in field {
        if b == b'"' {
            out.push(b'"');
        }
        out.push(b);
    }
    out.push(b'"');
}

/// The shortest digits that give the same value back.
fn push_cell(text: &mut String, cell: Cell) {
    // Writing to a string can't fail.
    match cell {
        Cell::F64(x) => write!(text, "{x:?}").ok(),
        Cell::F32(x) => write!(text, "{x:?}").ok(),
        Cell::Word(word) => write!(text, "{word}").ok(),
    };
}

fn push_json(text: &mut String, cell: Cell) {
    let finite = match cell {
        Cell::F64(x) => x.is_finite(),
        Cell::F32(x) => x.is_finite(),
        Cell::Word(_) => false,
    };
    if finite {
        return push_cell(text, cell);
    }
    text.push('"');
    push_cell(text, cell);
    text.push('"');
}

fn push_key(text: &mut String, name: &str) {
    text.push_str(&json_text(name));
    text.push(':');
}

fn json_text(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
