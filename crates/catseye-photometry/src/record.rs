//! From a record of a table to a row: every check that concerns one row.

use crate::columns::{Column, Columns, shown};
use crate::number::DecimalMarks;
use crate::quantity::ROAD_COSINE;
use crate::table::Need;
use crate::{Apertures, Error, Limit, Quantity, Row, Unit};

/// Wavelengths of light and of lidars, in nm.
const WAVELENGTHS_NM: [f64; 2] = [100.0, 20_000.0];

/// A record, and what its table's header and other records say.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Record<'a> {
    pub(crate) table: &'a str,
    pub(crate) line: usize,
    pub(crate) columns: &'a Columns,
    pub(crate) header: &'a [String],
    pub(crate) marks: DecimalMarks,
    pub(crate) cells: &'a [String],
}

impl Record<'_> {
    /// The row's meaning.
    pub(crate) fn row(&self, need: Need) -> Result<Row, Error> {
        let text = |column| self.text(column).to_owned();
        let (unit, quantity) = self.unit_and_quantity()?;
        let mut row = Row {
            line: self.line,
            observation_deg: self.angle(Column::Observation)?.unwrap_or(f64::NAN),
            entrance_deg: self.angle(Column::Entrance)?.unwrap_or(f64::NAN),
            entrance_2_deg: self.angle(Column::Entrance2)?.unwrap_or(0.0),
            rotation_deg: self.angle(Column::Rotation)?.unwrap_or(0.0),
            quantity,
            value: None,
            uncertainty: None,
            unit,
            limit: self.limit()?,
            wavelength_nm: self.wavelength()?,
            apertures: self.apertures()?,
            standard: text(Column::Standard),
            class: text(Column::Class),
            colour: text(Column::Colour),
            source: text(Column::Source),
            cells: Vec::new(),
        };
        if !row.geometry().is_above_horizon() {
            let Row { observation_deg, entrance_deg, .. } = row;
            return Err(self.wrong(format!(
                "at observation angle {observation_deg} and entrance angle {entrance_deg} the receiver is \
                 below the surface"
            )));
        }
        if need == Need::Values {
            let value = self.value(&row)?;
            row.value = Some(value);
            row.uncertainty = self.uncertainty(&row, value)?;
        }
        row.cells = self.canonical_cells(&row);
        Ok(row)
    }

    fn text(&self, column: Column) -> &str {
        self.columns.of(column).map_or("", |(i, _)| &self.cells[i])
    }

    /// An angle in degrees; `None` where there is none and none is needed.
    fn angle(&self, column: Column) -> Result<Option<f64>, Error> {
        let Some((i, heading)) = self.columns.of(column) else { return Ok(None) };
        let text = &self.cells[i];
        let is_needed = matches!(column, Column::Observation | Column::Entrance);
        if text.is_empty() {
            return if is_needed { Err(self.cell(column, "is empty".to_owned())) } else { Ok(None) };
        }
        let value = self.marks.degrees(text, heading.minutes);
        let value = value.map_err(|problem| self.cell(column, format!("{} {problem}", shown(text))))?;
        let (legal, range) = match column {
            Column::Observation => ((0.0..180.0).contains(&value), "[0, 180)"),
            Column::Entrance => (value.abs() < 90.0, "(-90, 90)"),
            Column::Entrance2 => (value.abs() < 90.0, "(-90, 90)"),
            Column::Rotation => (value.abs() <= 360.0, "[-360, 360]"),
            _ => ((0.0..=20.0).contains(&value), "[0, 20]"),
        };
        if legal { Ok(Some(value)) } else { Err(self.cell(column, format!("{value} is outside {range}"))) }
    }

    fn apertures(&self) -> Result<Option<Apertures>, Error> {
        let [source, receiver] = [self.angle(Column::SourceAperture)?, self.angle(Column::ReceiverAperture)?];
        match (source, receiver) {
            (Some(source), Some(receiver)) => {
                Ok(Some(Apertures { source: source.to_radians(), receiver: receiver.to_radians() }))
            }
            (None, None) => Ok(None),
            (None, _) => {
                Err(self.cell(Column::SourceAperture, "is missing; both apertures are needed".to_owned()))
            }
            (_, None) => {
                Err(self.cell(Column::ReceiverAperture, "is missing; both apertures are needed".to_owned()))
            }
        }
    }

    fn wavelength(&self) -> Result<Option<f64>, Error> {
        let column = Column::Wavelength;
        let text = self.text(column);
        if text.is_empty() {
            return Ok(None);
        }
        let value = self.number(column, text)?;
        let [least, most] = WAVELENGTHS_NM;
        if (least..=most).contains(&value) {
            return Ok(Some(value));
        }
        Err(self.cell(column, format!("{value} is outside [{least}, {most}] nm")))
    }

    fn unit_and_quantity(&self) -> Result<(Unit, Quantity), Error> {
        let heading = self.columns.of(Column::Value).map(|(_, heading)| heading);
        let (unit, quantity) = (self.text(Column::Unit), self.text(Column::Quantity));
        let named = match quantity {
            "" => None,
            name => {
                let named = name.parse::<Quantity>();
                Some(named.map_err(|error| self.cell(Column::Quantity, error.to_string()))?)
            }
        };
        let (of_header, unit_of_header) = heading.map_or((None, None), |h| (h.quantity, h.unit));
        if let (Some(named), Some(of_header)) = (named, of_header)
            && named != of_header
        {
            return Err(
                self.cell(Column::Quantity, format!("{named} is not {of_header}, as the header says"))
            );
        }
        let named = named.or(of_header);
        let (unit, meant) = match (unit, unit_of_header) {
            ("", None) => {
                let quantity = named.unwrap_or(Quantity::RetroReflectionCoefficient);
                return Ok((quantity.unit(), quantity));
            }
            ("", Some(unit)) => (unit, unit.usual_quantity()),
            (text, of_header) => {
                let found = Unit::parse_with_quantity(text);
                let found = found.map_err(|error| self.cell(Column::Unit, error.to_string()))?;
                if let Some(of_header) = of_header.filter(|unit| *unit != found.0) {
                    let problem = format!("{} is not {of_header}, as the header says", found.0);
                    return Err(self.cell(Column::Unit, problem));
                }
                found
            }
        };
        let quantity = named.unwrap_or(meant);
        if unit.measures(quantity) {
            return Ok((unit, quantity));
        }
        let problem = format!("{unit} is no unit of {quantity}, which is given in {}", quantity.unit());
        Err(self.cell(Column::Unit, problem))
    }

    fn limit(&self) -> Result<Limit, Error> {
        let (limit, standard) = (self.text(Column::Limit), self.text(Column::Standard));
        let said = if limit.is_empty() { standard.to_lowercase() } else { limit.to_lowercase() };
        let names = |limit: &Limit| said.contains(limit.name());
        let found = [Limit::Minimum, Limit::Maximum, Limit::Typical].into_iter().find(names);
        match found {
            Some(limit) => Ok(limit),
            None if limit.is_empty() => Ok(Limit::default()),
            None => {
                Err(self.cell(Column::Limit, format!("{} is not minimum, maximum or typical", shown(limit))))
            }
        }
    }

    /// The value in SI units, with everything that can be checked about it.
    fn value(&self, row: &Row) -> Result<f64, Error> {
        let written = self.number(Column::Value, self.text(Column::Value))?;
        let Row { quantity, unit, .. } = *row;
        if written < 0.0 {
            return Err(self.cell(Column::Value, format!("{written} is negative; leave the row out")));
        }
        if written == 0.0 {
            let problem = "is 0; leave the row out where nothing was measured, or write what could have been \
                           seen, with maximum in a column limit";
            return Err(self.cell(Column::Value, problem.to_owned()));
        }
        if row.observation_deg == 0.0 && quantity != Quantity::DaytimeLuminance {
            let problem = "is 0, where source and receiver coincide and nothing can be measured; \
                           give the angle of the measurement, 0.2 or 0.33 for most sheeting";
            return Err(self.cell(Column::Observation, problem.to_owned()));
        }
        let value = unit.to_si(written);
        let geometry = row.geometry();
        if unit == Unit::MillicandelaPerLuxSquareMetre && self.is_guessed() && geometry.wi.z > ROAD_COSINE {
            let problem = format!(
                "mcd/lx/m2 is the unit of road markings, whose entrance angle is near 90 degrees, not {}; \
                 is cd/lx/m2 meant? If not, say what it is in a column quantity",
                row.entrance_deg
            );
            return Err(self.cell(Column::Unit, problem));
        }
        let [least, most] = quantity.plausible(&geometry);
        if (least..=most).contains(&value) {
            return Ok(value);
        }
        let si = quantity.unit();
        let problem = format!(
            "{quantity} = {} is not plausible: {least} to {} are; {}",
            with_unit(written, unit),
            with_unit(most, si),
            way_out(quantity, unit, value, [least, most])
        );
        Err(self.cell(Column::Value, problem))
    }

    /// One standard deviation of the value in SI units, where the table has it.
    fn uncertainty(&self, row: &Row, value: f64) -> Result<Option<f64>, Error> {
        let Some((i, heading)) = self.columns.of(Column::Uncertainty) else { return Ok(None) };
        let text = &self.cells[i];
        if text.is_empty() {
            return Ok(None);
        }
        let column = Column::Uncertainty;
        let (digits, is_percent) = match text.strip_suffix('%') {
            Some(digits) => (digits.trim_end(), true),
            None => (text.as_str(), heading.percent),
        };
        let written = self.number(column, digits)?;
        let unit = heading.unit.unwrap_or(row.unit);
        if unit != row.unit {
            return Err(
                self.cell(column, format!("is in {unit}, but the value in {}; use one unit", row.unit))
            );
        }
        let uncertainty = if is_percent { 0.01 * written * value } else { unit.to_si(written) };
        if uncertainty > 0.0 && uncertainty <= value {
            return Ok(Some(uncertainty));
        }
        Err(self.cell(
            column,
            format!(
                "{} is not above 0 and at most the value; it is one standard deviation in {}, or in percent \
                 (3%)",
                shown(text),
                row.unit
            ),
        ))
    }

    /// Whether nothing but the unit said which quantity the row is of.
    fn is_guessed(&self) -> bool {
        let of_header = self.columns.of(Column::Value).and_then(|(_, heading)| heading.quantity);
        of_header.is_none()
            && self.text(Column::Quantity).is_empty()
            && !self.text(Column::Unit).contains(" (")
    }

    fn number(&self, column: Column, text: &str) -> Result<f64, Error> {
        if text.is_empty() {
            return Err(self.cell(column, "is empty".to_owned()));
        }
        self.marks.number(text).map_err(|problem| {
            let cure = match text.chars().next() {
                Some('<' | '>' | '≤' | '≥') => {
                    "; write the number, and minimum or maximum in a column limit"
                }
                _ if text.ends_with('%') => "; write the number, and % in the column unit",
                _ if text.contains(char::is_whitespace) => "; write it without spaces and without its unit",
                _ => "",
            };
            self.cell(column, format!("{} {problem}{cure}", shown(text)))
        })
    }

    /// The cells as this crate writes them: numbers with a point, angles in degrees, what the header said
    /// about unit and quantity in columns of their own. What is written so already stays as it is.
    fn canonical_cells(&self, row: &Row) -> Vec<String> {
        let mut cells = self.cells.to_vec();
        for (i, heading) in self.columns.iter() {
            let value = match heading.column {
                Column::Observation => Some(row.observation_deg),
                Column::Entrance => Some(row.entrance_deg),
                Column::Entrance2 => Some(row.entrance_2_deg),
                Column::Rotation => Some(row.rotation_deg),
                Column::SourceAperture => row.apertures.map(|a| a.source.to_degrees()),
                Column::ReceiverAperture => row.apertures.map(|a| a.receiver.to_degrees()),
                Column::Value | Column::Wavelength => self.marks.number(&cells[i]).ok(),
                Column::Uncertainty if heading.percent && !cells[i].ends_with('%') => {
                    cells[i] = self.marks.number(&cells[i]).map_or(String::new(), |x| format!("{x}%"));
                    None
                }
                Column::Uncertainty => {
                    cells[i] = cells[i].replace(',', ".");
                    None
                }
                _ => None,
            };
            let is_plain = !heading.minutes && cells[i].parse::<f64>().is_ok();
            if let Some(value) = value.filter(|_| !is_plain && !cells[i].is_empty()) {
                cells[i] = value.to_string();
            }
        }
        for column in self.columns.added() {
            let text = if column == Column::Unit { row.unit.symbol() } else { row.quantity.symbol() };
            match self.columns.of(column) {
                Some((i, _)) => text.clone_into(&mut cells[i]),
                None => cells.push(text.to_owned()),
            }
        }
        cells
    }

    fn cell(&self, column: Column, problem: String) -> Error {
        let name = self.columns.of(column).map_or(column.name(), |(i, _)| &self.header[i]);
        Error::Cell { table: self.table.to_owned(), line: self.line, column: name.to_owned(), problem }
    }

    fn wrong(&self, problem: String) -> Error {
        Error::Row { table: self.table.to_owned(), line: self.line, problem }
    }
}

/// The unit that would make a value plausible, if one would.
fn way_out(quantity: Quantity, unit: Unit, value: f64, [least, most]: [f64; 2]) -> String {
    let written = unit.of_si(value);
    let fits = |other: &Unit| {
        *other != unit && other.measures(quantity) && (least..=most).contains(&other.to_si(written))
    };
    match Unit::ALL.into_iter().find(fits) {
        Some(other) => format!("is {other} meant?"),
        None => "check the value and its unit".to_owned(),
    }
}

/// A number and its unit, if it has one.
fn with_unit(number: f64, unit: Unit) -> String {
    if unit == Unit::One { number.to_string() } else { format!("{number} {unit}") }
}
