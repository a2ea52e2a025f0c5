//! The line of a record, as an editor counts it.

/// The line of the first record at or after a byte offset of a CSV text, counted from 1.
///
/// The reader's own line numbers are off by the empty lines before a record, and by one after a CRLF. It
/// counts from the start of the text: for the one place that a message names.
#[must_use]
pub fn line_of_record(text: &[u8], byte: u64) -> usize {
    LineCounter::new(text).of_record(byte)
}

/// Counts lines once for all records of a text, in the order of the text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineCounter<'a> {
    text: &'a [u8],
    /// How far the line ends are counted, and how many there were.
    reached: usize,
    ends: usize,
}

impl<'a> LineCounter<'a> {
    pub(crate) fn new(text: &'a [u8]) -> Self {
        Self { text, reached: 0, ends: 0 }
    }

    /// As [`line_of_record`]; offsets must not fall from one call to the next.
    pub(crate) fn of_record(&mut self, byte: u64) -> usize {
        let byte = usize::try_from(byte).unwrap_or(usize::MAX).clamp(self.reached, self.text.len());
        let is_end = |b: &u8| matches!(b, b'\n' | b'\r');
        let record = byte + self.text[byte..].iter().take_while(|b| is_end(b)).count();
        let is_second_of_crlf = |i: usize| i > 0 && self.text[i - 1..=i] == *b"\r\n";
        let ends = |i: &usize| is_end(&self.text[*i]) && !is_second_of_crlf(*i);
        self.ends += (self.reached..record).filter(ends).count();
        self.reached = record;
        self.ends + 1
    }
}
