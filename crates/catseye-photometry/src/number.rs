//! Numbers as spreadsheets write them.

/// Which sign a table's numbers have before their decimals, as far as they show it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct DecimalMarks {
    /// Some number has a comma that can't be one between thousands.
    comma: bool,
    /// The same for a point.
    point: bool,
}

impl DecimalMarks {
    /// Takes note of a cell.
    pub(crate) fn see(&mut self, text: &str) {
        let text = text.trim_end_matches(|c: char| !c.is_ascii_digit());
        self.comma |= text.contains(',') && !text.contains('.') && !is_grouped(text, ',');
        self.point |= text.contains('.') && !text.contains(',') && !is_grouped(text, '.');
    }

    /// A finite number; a text says why there is none.
    pub(crate) fn number(self, text: &str) -> Result<f64, String> {
        let text = text.replace('\u{2212}', "-");
        let (commas, points) = (text.matches(',').count(), text.matches('.').count());
        let is_ambiguous = commas + points > 0
            && (commas > 0 && points > 0
                || commas > 0 && is_grouped(&text, ',') && (self.point || !self.comma || commas > 1)
                || points > 0 && is_grouped(&text, '.') && self.comma && !self.point);
        if is_ambiguous {
            return Err(
                "could have a sign between thousands or before decimals; write it without the former \
                        and with a point before the latter"
                    .to_owned(),
            );
        }
        let number = text.replace(',', ".").trim().parse::<f64>();
        number.ok().filter(|x| x.is_finite()).ok_or_else(|| "is not a number".to_owned())
    }

    /// Degrees, from degrees or minutes of arc: `0.2`, `12'`, `0.2°`, `0°12'`, `12 min`.
    pub(crate) fn degrees(self, text: &str, minutes: bool) -> Result<f64, String> {
        let text = text.trim();
        if let Some((degrees, rest)) = text.split_once(['°', 'º']) {
            let rest = rest.trim();
            let whole = self.number(degrees)?;
            let part = if rest.is_empty() { 0.0 } else { self.degrees(rest, true)? };
            return Ok(if degrees.trim_start().starts_with('-') { whole - part } else { whole + part });
        }
        let is_unit = |c: char| !c.is_ascii_digit() && !",.-+".contains(c) && c != '\u{2212}';
        let digits = text.trim_end_matches(is_unit);
        match text[digits.len()..].trim() {
            "" if minutes => Ok(self.number(digits)? / 60.0),
            "" | "deg" => self.number(digits),
            "'" | "′" | "’" | "min" | "arcmin" => Ok(self.number(digits)? / 60.0),
            _ => self.number(text),
        }
    }
}

/// Whether a text can be a whole number in groups of three digits: `1,350` and `12.000.000`, but not
/// `0.200`.
fn is_grouped(text: &str, sign: char) -> bool {
    let mut groups = text.trim_start_matches(['-', '+']).split(sign);
    let is_number = |group: &str| group.bytes().all(|b| b.is_ascii_digit());
    let first = groups.next().unwrap_or_default();
    let is_first = (1..=3).contains(&first.len()) && is_number(first) && !first.starts_with('0');
    is_first && groups.all(|group| group.len() == 3 && is_number(group))
}
