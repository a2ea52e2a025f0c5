//! The CSV verbs: a table of queries in, the same table with the answers' columns out.

mod input;
mod layout;
pub(crate) mod point;
pub(crate) mod row;

use std::io::{self, Write as _};
use std::path::PathBuf;

use anyhow::anyhow;
use catseye::{AnyLobe, Model, Params};
use csv::ByteRecord;
use rayon::prelude::*;

use self::input::Input;
use self::layout::Layout;
use self::row::{Cell, Row, RowError, Scalar};
use crate::failure::Usage;
use crate::options::{Backend, ModelArg, Precision};
use crate::output::Output;
use crate::progress::Progress;

/// Rows read before they are answered in parallel.
const BATCH: usize = 1 << 14;
/// Rows that one thread answers at a time.
const CHUNK: usize = 256;

/// The options that the CSV verbs share.
#[derive(Debug, clap::Args)]
pub(crate) struct TableArgs {
    /// CSV file with a header line [default: standard input]
    file: Option<PathBuf>,
    /// Write to this file instead of standard output; it appears whole or not at all
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Which lobe answers
    #[arg(long, value_enum, default_value_t)]
    model: ModelArg,
    /// Floating-point type to compute in
    #[arg(long, value_enum, default_value_t)]
    precision: Precision,
    /// What computes
    #[arg(long, value_enum, default_value_t, hide_possible_values = true)]
    backend: Backend,
    /// Print a JSON array with one object per row instead of CSV
    #[arg(long)]
    json: bool,
}

/// What a verb adds to a row.
pub(crate) trait Query: Sync {
    /// The names of the added columns.
    const ADDED: &'static [&'static str];
    /// The query's argument beside the parameters and `wo`.
    const ARGUMENT: Option<[&'static str; 3]>;

    /// The values of the added columns.
    fn answer<T: Scalar>(&self, lobe: &AnyLobe<T>, row: Row<'_>) -> Result<Vec<Cell>, RowError>;
}

impl TableArgs {
    /// Whether a file was named.
    pub(crate) fn has_file(&self) -> bool {
        self.file.is_some()
    }

    /// The lobe's model and the type to compute in.
    pub(crate) fn model_and_precision(&self) -> (Model, Precision) {
        (self.model.0, self.precision)
    }

    /// Answers the queries of a table, or of the file or standard input where there is none.
    pub(crate) fn run(&self, query: &impl Query, table: Option<Input>) -> anyhow::Result<()> {
        if self.backend == Backend::Gpu {
            let hint =
                "the gpu backend is not part of this version; leave --backend out to compute on the CPU";
            return Err(Usage(hint.to_owned()).into());
        }
        let input = table.map_or_else(|| Input::read(self.file.as_deref()), Ok)?;
        let output = self.output.as_deref().map(Output::new).transpose()?;
        let text = match self.precision {
            Precision::F64 => self.answer_all::<f64, _>(query, &input),
            Precision::F32 => self.answer_all::<f32, _>(query, &input),
        }?;
        match output {
            None => io::stdout().lock().write_all(&text)?,
            Some(file) => file.write(&text)?,
        }
        Ok(())
    }

    /// The whole output: a bad row in the end must leave nothing behind.
    fn answer_all<T: Scalar, Q: Query>(&self, query: &Q, input: &Input) -> anyhow::Result<Vec<u8>> {
        let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(input.text());
        let header = reader.byte_headers()?.clone();
        if header.is_empty() {
            return Err(anyhow!("{}: no header line", input.place(0)));
        }
        let layout = Layout::new(header, Q::ARGUMENT, Q::ADDED, self.json)
            .map_err(|error| error.context(input.place(0)))?;
        let progress = Progress::new("rows", input.text().len() as u64);
        let mut out = layout.opening();
        loop {
            let batch = read_batch(&mut reader)?;
            if batch.is_empty() {
                break;
            }
            let done: Vec<_> =
                batch.par_chunks(CHUNK).map(|rows| self.answer_chunk::<T, Q>(query, &layout, rows)).collect();
            for chunk in done {
                let text = chunk.map_err(|(byte, error)| anyhow!("{}: {error}", input.place(byte)))?;
                out.extend_from_slice(&text);
            }
            progress.set(reader.position().byte());
        }
        layout.close(&mut out);
        Ok(out)
    }

    /// The output's lines for some rows, or the byte offset of the first bad row.
    fn answer_chunk<T: Scalar, Q: Query>(
        &self,
        query: &Q,
        layout: &Layout,
        rows: &[ByteRecord],
    ) -> Result<Vec<u8>, (u64, RowError)> {
        let mut lines = Vec::with_capacity(rows.len() * 256);
        let mut known = None;
        for record in rows {
            let cells = layout
                .row(record)
                .and_then(|row| query.answer::<T>(&self.lobe(&mut known, row)?, row))
                .map_err(|error| (record.position().map_or(0, csv::Position::byte), error))?;
            layout.write(&mut lines, record, &cells);
        }
        Ok(lines)
    }

    /// The row's lobe; the one of the row before where the parameters are the same.
    fn lobe<T: Scalar>(
        &self,
        known: &mut Option<(Params<T>, AnyLobe<T>)>,
        row: Row<'_>,
    ) -> Result<AnyLobe<T>, RowError> {
        let params = row.params()?;
        if let Some((_, lobe)) = known.filter(|(before, _)| *before == params) {
            return Ok(lobe);
        }
        let lobe = AnyLobe::new(self.model.0, &params).map_err(|error| Row::out_of_range(&error))?;
        *known = Some((params, lobe));
        Ok(lobe)
    }
}

fn read_batch(reader: &mut csv::Reader<&[u8]>) -> anyhow::Result<Vec<ByteRecord>> {
    Ok(reader.byte_records().take(BATCH).collect::<Result<_, _>>()?)
}
