//! Files of the format LM-63 of the Illuminating Engineering Society (IES).
//!
//! Written from ANSI/IESNA LM-63-2002 as far as it can be read in public (its definitions, of which the sense
//! of the horizontal angles is one: clockwise seen from above, to the right, for Types A and B,
//! counter-clockwise for Type C) and from I. Ashdown, "Parsing the IESNA LM-63 photometric data file", 1998:
//! the edition's name or none (1986), lines of keywords, the line `TILT=`, then numbers that are separated by
//! blanks, commas and line ends in any way:
//!
//! 1. lamps, lumens of each, factor of the intensities, number of vertical and of horizontal angles, type
//!    (1 C, 2 B, 3 A), unit of length, width, length, height of the luminous opening,
//! 2. ballast factor, a number that is a second factor up to 1991 and none after, input watts,
//! 3. vertical angles, horizontal angles, intensities in cd, one run of vertical angles for each horizontal
//!    one.
//!
//! Types A and B whose horizontal angles begin at 0 are alike to the left. Type C is alike in all planes with
//! one horizontal angle, in both halves where they end at 180, in the quarters where they end at 90; what
//! ends a step before 360 is closed.

use super::Axis;
use super::net::{Kind, Net, Symmetry};
use super::text::{MOST_ANGLES, Text, shown};
use crate::Error;

/// Lines within which `TILT=` must come.
const HEADER_LINES: usize = 1000;

/// Reads a whole file.
pub(super) fn parse(bytes: &[u8], name: &str, axis: Option<Axis>) -> Result<Net, Error> {
    let text = Text::new(bytes, name)?;
    let mut numbers = Numbers::after_tilt(&text)?;
    if numbers.has_tilt {
        numbers.skip_tilt()?;
    }
    numbers.next("the number of lamps")?;
    numbers.next("the lumens of each lamp")?;
    let multiplier = numbers.next("the factor of the intensities")?;
    let vertical = numbers.count("the number of vertical angles")?;
    let horizontal = numbers.count("the number of horizontal angles")?;
    let kind = match numbers.next("the type")? {
        1.0 => Kind::C(text.axis(axis)?),
        2.0 => Kind::B,
        3.0 => Kind::A,
        other => {
            return Err(text.line(numbers.line, format!("the type is {other}, not 1 (C), 2 (B) or 3 (A)")));
        }
    };
    for what in ["the unit of length", "the opening's width", "its length", "its height"] {
        numbers.next(what)?;
    }
    let ballast = numbers.next("the ballast factor")?;
    let second = numbers.next("the second factor of the ballast")?;
    numbers.next("the input watts")?;
    let factor = multiplier * ballast * if numbers.is_early { second } else { 1.0 };
    let angles = numbers.many(vertical, "a vertical angle")?;
    let angles_line = numbers.line;
    let planes = numbers.many(horizontal, "a horizontal angle")?;
    let planes_line = numbers.line;
    let mut intensities = Vec::new();
    for _ in 0..vertical * horizontal {
        let value = numbers.next("an intensity")? * factor;
        intensities.push(text.intensity(numbers.line, value)?);
    }
    numbers.end()?;

    let is_c = matches!(kind, Kind::C(_));
    text.rising(angles_line, "the vertical angle", &angles, if is_c { [0.0, 180.0] } else { [-90.0, 90.0] })?;
    text.rising(
        planes_line,
        "the horizontal angle",
        &planes,
        if is_c { [0.0, 360.0] } else { [-180.0, 180.0] },
    )?;
    if angles.len() < 2 {
        return Err(text.line(angles_line, "one vertical angle makes no lamp".to_owned()));
    }
    let (first, last) = (planes[0], planes[planes.len() - 1]);
    // Some writers leave out 360 degrees, which is 0 again: the gap is then a step like the others.
    let step = planes.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    let is_round = is_c && last > 180.0 && last < 360.0 && 360.0 - last <= 1.001 * step;
    let symmetry = match (is_c, planes.len()) {
        (true, 1) => Symmetry::Rotation,
        (false, 1) => return Err(text.line(planes_line, "one horizontal angle makes no lamp".to_owned())),
        (false, _) if first == 0.0 => Symmetry::LeftRight,
        (false, _) => Symmetry::None,
        (true, _) if first == 0.0 && last == 90.0 => Symmetry::Both,
        (true, _) if first == 0.0 && last == 180.0 => Symmetry::C0C180,
        (true, _) if first == 0.0 && (last == 360.0 || is_round) => Symmetry::None,
        (true, _) => {
            let problem =
                format!("the horizontal angles of Type C are {first} to {last}, not 0 to 0, 90, 180 or 360");
            return Err(text.line(planes_line, problem));
        }
    };
    let net = Net { kind, symmetry, planes, angles, intensities };
    Ok(if is_round { net.closed() } else { net })
}

/// The numbers behind `TILT=`, wherever lines end.
struct Numbers<'a> {
    text: &'a Text<'a>,
    words: Box<dyn Iterator<Item = (usize, &'a str)> + 'a>,
    /// The line of the last number.
    line: usize,
    /// Whether the edition is that of 1986 or 1991.
    is_early: bool,
    has_tilt: bool,
}

impl<'a> Numbers<'a> {
    fn after_tilt(text: &'a Text<'a>) -> Result<Self, Error> {
        let is_tilt = |line: &str| line.to_ascii_uppercase().starts_with("TILT");
        let found = text.lines().take(HEADER_LINES).find(|(_, line)| is_tilt(line));
        let Some((line, tilt)) = found else {
            return Err(text.whole("has no line TILT=; is it an LM-63 file (IES)?".to_owned()));
        };
        let value = tilt.split_once('=').map_or("", |(_, value)| value.trim());
        let has_tilt = match value.to_ascii_uppercase().as_str() {
            "NONE" => false,
            "INCLUDE" => true,
            _ => {
                let problem = format!("TILT={} names another file; write TILT=NONE", shown(value));
                return Err(text.line(line, problem));
            }
        };
        let edition = text.lines().next().map_or("", |(_, line)| line).to_ascii_uppercase();
        let is_early = edition.contains("IESNA91") || !edition.starts_with("IES");
        let words = text.lines().skip(line).flat_map(|(line, content)| {
            let words = content.split(|c: char| c.is_whitespace() || c == ',');
            words.filter(|word| !word.is_empty()).map(move |word| (line, word))
        });
        Ok(Self { text, words: Box::new(words), line, is_early, has_tilt })
    }

    fn word(&mut self, what: &str) -> Result<&'a str, Error> {
        let Some((line, word)) = self.words.next() else {
            return Err(self.text.line(self.line, format!("the file ends here; {what} is expected")));
        };
        self.line = line;
        Ok(word)
    }

    fn next(&mut self, what: &str) -> Result<f64, Error> {
        let word = self.word(what)?;
        self.text.number(self.line, word, what)
    }

    fn count(&mut self, what: &str) -> Result<usize, Error> {
        let word = self.word(what)?;
        self.text.count(self.line, word, what, MOST_ANGLES)
    }

    fn many(&mut self, count: usize, what: &str) -> Result<Vec<f64>, Error> {
        (0..count).map(|_| self.next(what)).collect()
    }

    /// How a lamp's flux depends on its position: headlamps are used as they are measured.
    fn skip_tilt(&mut self) -> Result<(), Error> {
        self.next("the lamp's position")?;
        let count = self.count("the number of tilt angles")?;
        self.many(2 * count, "a tilt angle or its factor").map(|_| ())
    }

    /// Numbers that are left over mean that a count is wrong.
    fn end(&mut self) -> Result<(), Error> {
        match self.words.next() {
            Some((line, word)) if word.parse::<f64>().is_ok() => {
                let problem = format!("{word} is left over; the numbers of angles don't fit the intensities");
                Err(self.text.line(line, problem))
            }
            _ => Ok(()),
        }
    }
}
