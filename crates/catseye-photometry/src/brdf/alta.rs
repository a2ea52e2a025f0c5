//! ALTA's text format: a header of `#KEY value` lines, then a row of numbers for each sample.
//!
//! The format is described by the ALTA library (`github.com/belcour/alta`, `documents/data-formats.dox`):
//! `#DIM N P` says how many numbers a row has for the directions and for the values, `#PARAM_IN` and
//! `#PARAM_OUT` what they are. Numbers beyond them, confidence intervals where `#VS` is above 0, are not
//! read.

use super::coordinates::Coordinates;
use super::{Brdf, Cosine};
use crate::Error;

/// What the header says.
#[derive(Clone, Debug)]
struct Header {
    coordinates: Option<Coordinates>,
    /// `#DIM`: numbers for the directions, numbers for the values.
    dimensions: Option<[usize; 2]>,
    cosine: Option<Cosine>,
}

/// Reads the text of a file.
pub(super) fn parse(bytes: &[u8], name: &str, cosine: Cosine) -> Result<Brdf, Error> {
    let in_file = |problem: String| Error::Table { table: name.to_owned(), problem };
    let in_line =
        |line: usize| move |problem: String| Error::Row { table: name.to_owned(), line: line + 1, problem };
    let text = str::from_utf8(bytes).map_err(|_| {
        in_file("is neither MERL's .binary (90 x 90 x 180 values) nor text in ALTA's format".to_owned())
    })?;
    let mut header = Header { coordinates: None, dimensions: None, cosine: None };
    let mut rows = None;
    let mut brdf = Brdf::default();
    for (number, line) in text.lines().enumerate() {
        let line = line.trim();
        if let Some(entry) = line.strip_prefix('#') {
            if rows.is_none() {
                header.read(entry).map_err(in_line(number))?;
            }
        } else if !line.is_empty() {
            let rows = match rows {
                Some(rows) => rows,
                None => *rows.insert(Rows::new(&header, cosine, &mut brdf).map_err(in_file)?),
            };
            rows.read(line, &mut brdf).map_err(in_line(number))?;
        }
    }
    if !text.ends_with('\n') {
        brdf.remarks.push("the file ends within a line: its last number may be cut off".to_owned());
    }
    Ok(brdf)
}

impl Header {
    /// Reads a line without its `#`; what is no known entry is a comment.
    fn read(&mut self, entry: &str) -> Result<(), String> {
        let mut words = entry.split_whitespace();
        let key = words.next().unwrap_or_default();
        let value = words.next().unwrap_or_default();
        match key {
            "DIM" => {
                let number = |word: Option<&str>| word.and_then(|word| word.parse::<usize>().ok());
                let dimensions = (number(Some(value)), number(words.next()));
                let (Some(n), Some(p)) = dimensions else {
                    return Err("#DIM needs two numbers: of the directions and of the values".to_owned());
                };
                if p != 1 && p != 3 {
                    return Err(format!(
                        "#DIM says {p} values for each sample; 1 and 3 (red, green, blue) are known"
                    ));
                }
                self.dimensions = Some([n, p]);
            }
            "PARAM_IN" => {
                let coordinates = Coordinates::named(value)
                    .map_err(|known| format!("#PARAM_IN {value} is not known; known are {known}"))?;
                self.coordinates = Some(coordinates);
            }
            "PARAM_OUT" => {
                self.cosine = match value {
                    "INV_STERADIAN" | "RGB_COLOR" => Some(Cosine::Excluded),
                    "INV_STERADIAN_COSINE_FACTOR" => Some(Cosine::Included),
                    "UNKNOWN" | "UNKNOWN_OUTPUT" => None,
                    _ => {
                        let known = "INV_STERADIAN, INV_STERADIAN_COSINE_FACTOR, RGB_COLOR";
                        return Err(format!("#PARAM_OUT {value} is not known; known are {known}"));
                    }
                };
            }
            "FORMAT" if value != "text" => {
                return Err(format!("#FORMAT {value} is not read; convert it to text with ALTA's data2data"));
            }
            _ => {}
        }
        Ok(())
    }
}

/// How rows are read.
#[derive(Clone, Copy, Debug)]
struct Rows {
    coordinates: Coordinates,
    /// Values for each sample: 1 or 3.
    values: usize,
    cosine: Cosine,
}

impl Rows {
    /// What the header and the caller say; remarks of the file tell what neither does.
    fn new(header: &Header, cosine: Cosine, brdf: &mut Brdf) -> Result<Self, String> {
        let Some(coordinates) = header.coordinates else {
            return Err(
                "has no #PARAM_IN line before its first row: the parametrisation is needed".to_owned()
            );
        };
        let Some([n, values]) = header.dimensions else {
            return Err("has no #DIM line before its first row: the numbers of a row are needed".to_owned());
        };
        let needed = coordinates.dimension();
        if n != needed {
            return Err(format!("#DIM says {n} numbers for the directions, its #PARAM_IN takes {needed}"));
        }
        let cosine = match (cosine, header.cosine) {
            (Cosine::AsStated, Some(stated)) => stated,
            (Cosine::AsStated, None) => {
                brdf.remarks.push(
                    "#PARAM_OUT is missing: values are taken as f in 1/sr, without a cosine".to_owned(),
                );
                Cosine::Excluded
            }
            (given, _) => given,
        };
        brdf.read_as = cosine;
        Ok(Self { coordinates, values, cosine })
    }

    fn read(&self, line: &str, brdf: &mut Brdf) -> Result<(), String> {
        let n = self.coordinates.dimension();
        let needed = n + self.values;
        let mut numbers = [0.0; 9];
        let mut words = line.split_whitespace();
        for (i, number) in numbers[..needed].iter_mut().enumerate() {
            let Some(word) = words.next() else {
                return Err(format!("has {i} numbers where #DIM says {needed}; is the file cut off?"));
            };
            *number = word.parse().map_err(|_| format!("number {}: {word:?} is not a number", i + 1))?;
        }
        let [wo, wi] = self.coordinates.directions(&numbers[..n]);
        let scale = if self.cosine == Cosine::Included { 1.0 / wo.z } else { 1.0 };
        let value = |channel: usize| numbers[n + channel % self.values] * scale;
        // Below the horizon the cosine is negative; what counts then is where, not the value's sign.
        let value = if wo.z > 0.0 { [0, 1, 2].map(value) } else { [0.0; 3] };
        brdf.push(wo, wi, value);
        Ok(())
    }
}
