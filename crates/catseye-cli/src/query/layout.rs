//! The columns of a CSV verb's output, as CSV and as JSON.

use std::io::Write as _;

use catseye::Model;
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
        let replaced = |field: &usize| {
            added.iter().any(|name| header[*field].trim_ascii().eq_ignore_ascii_case(name.as_bytes()))
        };
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

    /// What is ignored, and might not be meant to be.
    pub(crate) fn warnings(&self, model: Model) -> Vec<String> {
        let others = self.carried.iter().filter(|field| !self.columns.is_input(**field));
        let typos = others.filter_map(|&field| {
            let name = String::from_utf8_lossy(self.header[field].trim_ascii());
            let meant = self.columns.like(&name)?;
            Some(format!("column {name:?} has no meaning; did you mean {meant}?"))
        });
        let unused = (model != Model::Reciprocal && self.columns.has_multiscatter_tint())
            .then(|| format!("the model {} has no compensation: multiscatter_tint is ignored", model.name()));
        typos.chain(unused).collect()
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

    /// What comes after the last row.
    pub(crate) fn closing(&self) -> &'static [u8] {
        if self.json { b"\n]\n" } else { b"" }
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
        for cell in cells {
            push_cell(out, cell);
            out.push(b',');
        }
        out.pop();
        out.push(b'\n');
    }

    /// A comma and an object: inputs and answers as numbers, everything else as text; what JSON has no number
    /// for as text, too.
    fn write_json(&self, out: &mut Vec<u8>, record: &ByteRecord, cells: &[Cell]) {
        out.extend_from_slice(b",\n{");
        for &field in &self.carried {
            let value = String::from_utf8_lossy(&record[field]);
            let number = value.trim().parse::<f64>().ok().filter(|_| self.columns.is_input(field));
            push_text(out, &String::from_utf8_lossy(&self.header[field]));
            out.push(b':');
            match number {
                Some(number) => push_json(out, Cell::F64(number)),
                None => push_text(out, &value),
            }
            out.push(b',');
        }
        for (name, &cell) in self.added.iter().zip(cells) {
            push_text(out, name);
            out.push(b':');
            push_json(out, cell);
            out.push(b',');
        }
        out.pop();
        out.push(b'}');
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
fn push_cell(out: &mut Vec<u8>, cell: Cell) {
    // Writing to a vector can't fail.
    match cell {
        Cell::F64(x) => write!(out, "{x:?}").ok(),
        Cell::F32(x) => write!(out, "{x:?}").ok(),
        Cell::Word(word) => write!(out, "{word}").ok(),
    };
}

fn push_json(out: &mut Vec<u8>, cell: Cell) {
    let finite = match cell {
        Cell::F64(x) => x.is_finite(),
        Cell::F32(x) => x.is_finite(),
        Cell::Word(_) => false,
    };
    if finite {
        return push_cell(out, cell);
    }
    out.push(b'"');
    push_cell(out, cell);
    out.push(b'"');
}

fn push_text(out: &mut Vec<u8>, text: &str) {
    out.extend_from_slice(serde_json::Value::from(text).to_string().as_bytes());
}
