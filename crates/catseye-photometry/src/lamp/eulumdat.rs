//! EULUMDAT files (A. W. Stockmar, 1990).
//!
//! Written from the public descriptions of the format at helios32.com/Eulumdat.htm and in the R package
//! `lighting`: one item a line. Of the 26 lines at the beginning these count: 3 symmetry `Isym`, 4 number of
//! C planes `Mc`, 6 number of gamma angles `Ng`, 24 factor of the intensities, 25 tilt during the
//! measurement, 26 number of sets of lamps. Six lines follow for each set, the third of them its flux in lm,
//! then ten direct ratios, `Mc` C planes, `Ng` gamma angles, and the intensities in cd per 1000 lm, one run
//! of gamma for each plane that the symmetry leaves: all for 0, the first for 1, C0 to C180 for 2, C270 over
//! C0 to C90 for 3, C0 to C90 for 4. Decimal commas are read.

use super::Axis;
use super::net::{Kind, Net, Symmetry};
use super::text::{MOST_ANGLES, Text};
use crate::Error;

/// Reads a whole file.
pub(super) fn parse(bytes: &[u8], name: &str, axis: Option<Axis>) -> Result<Net, Error> {
    let text = Text::new(bytes, name)?;
    let mut items = Items { text: &text, lines: Box::new(text.lines()), line: 0 };
    items.skip(2)?;
    let symmetry = match items.next("the symmetry (line 3)")? {
        0.0 => Symmetry::None,
        1.0 => Symmetry::Rotation,
        2.0 => Symmetry::C0C180,
        3.0 => Symmetry::C90C270,
        4.0 => Symmetry::Both,
        other => return Err(text.line(items.line, format!("the symmetry is {other}, not 0 to 4"))),
    };
    let planes = items.count("the number of C planes (line 4)", MOST_ANGLES)?;
    let planes_line = items.line;
    items.skip(1)?;
    let angles = items.count("the number of gamma angles (line 6)", MOST_ANGLES)?;
    items.skip(17)?;
    let factor = items.next("the factor of the intensities (line 24)")?;
    if items.next("the tilt (line 25)")? != 0.0 {
        return Err(
            text.line(items.line, "the lamp was measured tilted; give a file without tilt".to_owned())
        );
    }
    if items.next("the number of sets of lamps (line 26)")? != 1.0 {
        return Err(text.line(items.line, "several sets of lamps; keep the one that is used".to_owned()));
    }
    items.skip(2)?;
    let flux = items.next("the flux of the lamps")?;
    items.skip(3 + 10)?;
    let all_planes = items.many(planes, "a C plane")?;
    text.rising(items.line, "the C plane", &all_planes, [0.0, 360.0])?;
    let gammas = items.many(angles, "a gamma angle")?;
    text.rising(items.line, "the gamma angle", &gammas, [0.0, 180.0])?;
    if gammas.len() < 2 {
        return Err(text.line(items.line, "one gamma angle makes no lamp".to_owned()));
    }

    let kind = Kind::C(text.axis(axis)?);
    let planes = kept(symmetry, &all_planes)
        .ok_or_else(|| text.line(planes_line, "the C planes don't fit the symmetry (line 3)".to_owned()))?;
    let factor = factor * flux / 1000.0;
    let mut intensities = Vec::new();
    for _ in 0..planes.len() * gammas.len() {
        let value = items.next("an intensity")? * factor;
        intensities.push(text.intensity(items.line, value)?);
    }
    let net = Net { kind, symmetry, planes, angles: gammas, intensities };
    Ok(if symmetry == Symmetry::None { net.closed() } else { net })
}

/// The planes that have intensities; they must be where the symmetry has its mirrors.
fn kept(symmetry: Symmetry, planes: &[f64]) -> Option<Vec<f64>> {
    let between = |from: f64, to: f64| {
        let kept: Vec<f64> = planes.iter().copied().filter(|plane| (from..=to).contains(plane)).collect();
        (kept.len() > 1 && kept.first() == Some(&from) && kept.last() == Some(&to)).then_some(kept)
    };
    match symmetry {
        Symmetry::None => (planes.len() > 1 && planes.last()? - planes[0] < 360.0).then(|| planes.to_vec()),
        Symmetry::Rotation => Some(planes[..1].to_vec()),
        Symmetry::C0C180 | Symmetry::LeftRight => between(0.0, 180.0),
        Symmetry::Both => between(0.0, 90.0),
        Symmetry::C90C270 => {
            // C270 to C360 and C0 to C90, counted through 0.
            let left = planes.iter().filter(|plane| **plane >= 270.0).map(|plane| plane - 360.0);
            let right = planes.iter().copied().filter(|plane| *plane <= 90.0);
            let kept: Vec<f64> = left.chain(right).collect();
            let rises = kept.windows(2).all(|pair| pair[0] < pair[1]);
            (rises && kept.first() == Some(&-90.0) && kept.last() == Some(&90.0)).then_some(kept)
        }
    }
}

/// The items of a file.
struct Items<'a> {
    text: &'a Text<'a>,
    lines: Box<dyn Iterator<Item = (usize, &'a str)> + 'a>,
    /// The line of the last item.
    line: usize,
}

impl Items<'_> {
    fn word(&mut self, what: &str) -> Result<String, Error> {
        let Some((line, word)) = self.lines.next() else {
            return Err(self.text.line(self.line, format!("the file ends here; {what} is expected")));
        };
        self.line = line;
        Ok(word.replace(',', "."))
    }

    fn skip(&mut self, count: usize) -> Result<(), Error> {
        (0..count).try_for_each(|_| self.word("another line").map(|_| ()))
    }

    fn next(&mut self, what: &str) -> Result<f64, Error> {
        let word = self.word(what)?;
        self.text.number(self.line, &word, what)
    }

    fn count(&mut self, what: &str, most: usize) -> Result<usize, Error> {
        let word = self.word(what)?;
        self.text.count(self.line, &word, what, most)
    }

    fn many(&mut self, count: usize, what: &str) -> Result<Vec<f64>, Error> {
        (0..count).map(|_| self.next(what)).collect()
    }
}
