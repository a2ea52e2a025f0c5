//! Blocks of a table that are answered at once, each by one thread.

use anyhow::Context as _;
use catseye::{AnyLobe, Model, Params};
use csv::ByteRecord;
use rayon::prelude::*;

use super::Query;
use super::input::{Block, Input};
use super::layout::Layout;
use super::row::{Row, RowError, Scalar};

/// Blocks of a batch: two batches of them and their answers are what a table takes of memory, however long it
/// is.
const BLOCKS: usize = 64;

/// Some blocks, with buffers that are used again and again.
#[derive(Debug, Default)]
pub(crate) struct Batch {
    slots: Vec<Slot>,
    /// How many of the slots hold a block.
    used: usize,
}

#[derive(Debug, Default)]
struct Slot {
    block: Block,
    /// Bytes in front of the block's rows: the header.
    skipped: usize,
    answers: Vec<u8>,
    /// The byte of the first bad row.
    failure: Option<(u64, RowError)>,
}

impl Batch {
    /// Replaces everything by the next blocks of a table.
    pub(crate) fn read(&mut self, input: &mut Input) -> anyhow::Result<()> {
        self.slots.resize_with(BLOCKS, Slot::default);
        self.used = 0;
        for slot in &mut self.slots {
            slot.skipped = 0;
            input.fill(&mut slot.block)?;
            if slot.block.text.is_empty() {
                break;
            }
            self.used += 1;
        }
        Ok(())
    }

    /// Whether the table is at its end.
    pub(crate) fn is_empty(&self) -> bool {
        self.used == 0
    }

    /// The table's bytes in it.
    pub(crate) fn bytes(&self) -> u64 {
        self.slots[..self.used].iter().map(|slot| slot.block.text.len() as u64).sum()
    }

    /// Takes the first record out, and gives its place.
    pub(crate) fn take_header(&mut self, input: &Input, header: &mut ByteRecord) -> anyhow::Result<String> {
        let slot = &mut self.slots[0];
        let mut reader = reader(&slot.block.text);
        let place = input.place(&slot.block, 0);
        reader.read_byte_record(header).with_context(|| place.clone())?;
        slot.skipped = usize::try_from(reader.position().byte())?;
        Ok(place)
    }

    /// Answers all rows.
    pub(crate) fn answer<T: Scalar, Q: Query>(&mut self, query: &Q, layout: &Layout, model: Model) {
        self.slots[..self.used].par_iter_mut().for_each(|slot| {
            slot.answers.clear();
            slot.failure = slot.answer::<T, Q>(query, layout, model).err();
        });
    }

    /// The text of each block's answers, or the block, byte and fault of a bad row.
    pub(crate) fn answers(&self) -> impl Iterator<Item = Result<&[u8], (&Block, u64, &RowError)>> {
        self.slots[..self.used].iter().map(|slot| match &slot.failure {
            None => Ok(&slot.answers[..]),
            Some((byte, error)) => Err((&slot.block, *byte, error)),
        })
    }
}

impl Slot {
    fn answer<T: Scalar, Q: Query>(
        &mut self,
        query: &Q,
        layout: &Layout,
        model: Model,
    ) -> Result<(), (u64, RowError)> {
        let mut reader = reader(&self.block.text[self.skipped..]);
        let (mut record, mut cells, mut known) = (ByteRecord::new(), Vec::new(), None);
        loop {
            let byte = self.skipped as u64 + reader.position().byte();
            match reader.read_byte_record(&mut record) {
                Ok(true) => {}
                Ok(false) => return Ok(()),
                Err(error) => return Err((byte, RowError::row(error.to_string()))),
            }
            cells.clear();
            layout
                .row(&record)
                .and_then(|row| query.answer(&lobe::<T>(&mut known, model, row)?, row, &mut cells))
                .map_err(|error| (byte, error))?;
            layout.write(&mut self.answers, &record, &cells);
        }
    }
}

/// The row's lobe; the one of the row before where the parameters are the same.
fn lobe<T: Scalar>(
    known: &mut Option<(Params<T>, AnyLobe<T>)>,
    model: Model,
    row: Row<'_>,
) -> Result<AnyLobe<T>, RowError> {
    let params = row.params()?;
    if let Some((_, lobe)) = known.filter(|(before, _)| *before == params) {
        return Ok(lobe);
    }
    let lobe = AnyLobe::new(model, &params).map_err(|error| Row::out_of_range(&error))?;
    *known = Some((params, lobe));
    Ok(lobe)
}

fn reader(text: &[u8]) -> csv::Reader<&[u8]> {
    csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text)
}
