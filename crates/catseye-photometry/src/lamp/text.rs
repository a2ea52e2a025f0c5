//! The text of a lamp's file, line by line, and what is said of its faults.

use super::{Axis, LARGEST};
use crate::Error;

/// Characters of a word that a message repeats.
const LONGEST: usize = 30;
/// Angles along one axis that are read at most.
pub(super) const MOST_ANGLES: usize = 2000;

/// A file's text.
#[derive(Debug)]
pub(super) struct Text<'a> {
    name: &'a str,
    text: String,
}

impl<'a> Text<'a> {
    /// Bytes that are not UTF-8 stand in names and remarks only; numbers don't have them.
    pub(super) fn new(bytes: &[u8], name: &'a str) -> Result<Self, Error> {
        let text =
            Self { name, text: String::from_utf8_lossy(bytes).replace("\r\n", "\n").replace('\r', "\n") };
        if bytes.len() > LARGEST {
            return Err(text.whole(format!("is larger than {} MiB; is it a lamp's file?", LARGEST >> 20)));
        }
        if text.text.trim().is_empty() {
            return Err(text.whole("is empty".to_owned()));
        }
        Ok(text)
    }

    /// The lines with their numbers from 1.
    pub(super) fn lines(&self) -> impl Iterator<Item = (usize, &str)> {
        self.text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()))
    }

    /// What is wrong with the file as a whole.
    pub(super) fn whole(&self, problem: String) -> Error {
        Error::Table { table: self.name.to_owned(), problem }
    }

    /// What is wrong with a line.
    pub(super) fn line(&self, line: usize, problem: String) -> Error {
        Error::Row { table: self.name.to_owned(), line, problem }
    }

    /// A number where `what` is expected.
    pub(super) fn number(&self, line: usize, word: &str, what: &str) -> Result<f64, Error> {
        let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| self.line(line, format!("{} is no number; {what} is expected", shown(word))))
    }

    /// A count between 1 and the most.
    pub(super) fn count(&self, line: usize, word: &str, what: &str, most: usize) -> Result<usize, Error> {
        let number = self.number(line, word, what)?;
        let legal = number.fract() == 0.0 && (1.0..=most as f64).contains(&number);
        if legal {
            Ok(number as usize)
        } else {
            Err(self.line(line, format!("{what} is {number}, not 1 to {most}")))
        }
    }

    /// Refuses an intensity that is negative.
    pub(super) fn intensity(&self, line: usize, value: f64) -> Result<f64, Error> {
        if value >= 0.0 && value.is_finite() {
            return Ok(value);
        }
        Err(self.line(line, format!("an intensity is {value}; it must be 0 or above")))
    }

    /// Refuses angles that don't rise, or lie outside a range.
    pub(super) fn rising(
        &self,
        line: usize,
        what: &str,
        angles: &[f64],
        range: [f64; 2],
    ) -> Result<(), Error> {
        let [least, most] = range;
        if let Some(angle) = angles.iter().find(|angle| !(least..=most).contains(*angle)) {
            return Err(self.line(line, format!("{what} {angle} is outside [{least}, {most}] degrees")));
        }
        match angles.windows(2).find(|pair| pair[0] >= pair[1]) {
            Some(pair) => {
                Err(self.line(line, format!("{what} {} follows {}; they must rise", pair[1], pair[0])))
            }
            None => Ok(()),
        }
    }

    /// The axis, which a file of C-gamma angles doesn't say.
    pub(super) fn axis(&self, axis: Option<Axis>) -> Result<Axis, Error> {
        axis.ok_or_else(|| Error::LampAxis { file: self.name.to_owned() })
    }
}

/// A word in quotes, cut short where it is long.
pub(super) fn shown(word: &str) -> String {
    let mut start: String = word.chars().take(LONGEST).collect();
    if start.len() < word.len() {
        start.push_str("...");
    }
    format!("{start:?}")
}
