//! The CSV verbs: a table of queries in, the same table with the answers' columns out.

mod batch;
mod input;
mod layout;
pub(crate) mod point;
pub(crate) mod row;

use std::path::PathBuf;

use anyhow::{anyhow, bail};
use catseye::{AnyLobe, Model};
use csv::ByteRecord;

use self::batch::Batch;
use self::input::Input;
use self::layout::Layout;
use self::row::{Cell, Row, RowError, Scalar};
use crate::failure::Usage;
use crate::options::{Backend, ModelArg, Precision};
use crate::output::{Draft, Output};
use crate::progress::Progress;
use crate::report;

/// The options that the CSV verbs share.
#[derive(Debug, clap::Args)]
pub(crate) struct TableArgs {
    /// CSV file with a header line [default: standard input]
    file: Option<PathBuf>,
    /// File to write, which appears whole or not at all; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
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

    /// Appends the values of the added columns.
    fn answer<T: Scalar>(
        &self,
        lobe: &AnyLobe<T>,
        row: Row<'_>,
        cells: &mut Vec<Cell>,
    ) -> Result<(), RowError>;
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
            bail!(Usage(hint.to_owned()));
        }
        let mut input = table.map_or_else(|| Input::open(self.file.as_deref()), Ok)?;
        let output = Output::new(&self.output)?;
        // A bad row in the end must leave nothing behind.
        let mut draft = output.draft()?;
        match self.precision {
            Precision::F64 => self.answer_all::<f64, _>(query, &mut input, &mut draft),
            Precision::F32 => self.answer_all::<f32, _>(query, &mut input, &mut draft),
        }?;
        draft.finish()
    }

    fn answer_all<T: Scalar, Q: Query>(
        &self,
        query: &Q,
        input: &mut Input,
        out: &mut Draft<'_>,
    ) -> anyhow::Result<()> {
        let (mut now, mut next) = (Batch::default(), Batch::default());
        now.read(input)?;
        let layout = self.layout::<Q>(input, &mut now)?;
        let progress =
            input.length.map_or_else(|| Progress::unknown("rows"), |all| Progress::new("rows", all));
        out.put(&layout.opening())?;
        let (mut bytes, mut is_first) = (0, true);
        while !now.is_empty() {
            // The next blocks are read while these are answered.
            let ((), read) =
                rayon::join(|| now.answer::<T, Q>(query, &layout, self.model.0), || next.read(input));
            for answered in now.answers() {
                let text = answered
                    .map_err(|(block, byte, error)| anyhow!("{}: {error}", input.place(block, byte)))?;
                // The objects of an array are parted by commas, which each begins with.
                let skipped = usize::from(self.json && is_first && !text.is_empty());
                out.put(&text[skipped..])?;
                is_first &= text.is_empty();
            }
            read?;
            bytes += now.bytes();
            progress.set(bytes);
            std::mem::swap(&mut now, &mut next);
        }
        out.put(layout.closing())
    }

    /// The columns, by the first record, which is taken out of the first block.
    fn layout<Q: Query>(&self, input: &Input, batch: &mut Batch) -> anyhow::Result<Layout> {
        let mut header = ByteRecord::new();
        let place = batch.take_header(input, &mut header)?;
        if header.is_empty() {
            bail!("{place}: no header line");
        }
        let layout = Layout::new(header, Q::ARGUMENT, Q::ADDED, self.json)
            .map_err(|error| error.context(place.clone()))?;
        for warning in layout.warnings(self.model.0) {
            report::warn(format!("{place}: {warning}"));
        }
        Ok(layout)
    }
}
