//! From a record of a table to a row: every check that concerns one row.

use crate::quantity::ROAD_COSINE;
use crate::table::Need;
use crate::{Error, Limit, Quantity, Row, Unit};

/// The columns that have a meaning.
const MEANINGFUL: [&str; 11] =
    [OBSERVATION, ENTRANCE, ROTATION, QUANTITY, VALUE, UNIT, LIMIT, "standard", "class", "colour", "source"];
const OBSERVATION: &str = "observation_deg";
const ENTRANCE: &str = "entrance_deg";
const ROTATION: &str = "rotation_deg";
const QUANTITY: &str = "quantity";
const VALUE: &str = "value";
const UNIT: &str = "unit";
const LIMIT: &str = "limit";

/// Characters of a cell that a message repeats.
const LONGEST: usize = 40;

/// Where each column stands.
#[derive(Debug)]
pub(crate) struct Columns([Option<usize>; MEANINGFUL.len()]);

impl Columns {
    /// Finds the columns; a text says what is wrong with the header.
    pub(crate) fn new(header: &[String], need: Need) -> Result<Self, String> {
        let same = |a: &str, b: &str| a.eq_ignore_ascii_case(b);
        let doubled =
            |i: usize| !header[i].is_empty() && header[..i].iter().any(|name| same(name, &header[i]));
        if let Some(i) = (0..header.len()).find(|&i| doubled(i)) {
            return Err(format!("column {} appears twice", shown(&header[i])));
        }
        let columns = Self(MEANINGFUL.map(|name| header.iter().position(|field| same(field, name))));
        let needed: &[&str] = match need {
            Need::Geometry => &[OBSERVATION, ENTRANCE],
            Need::Values => &[OBSERVATION, ENTRANCE, VALUE],
        };
        let missing: Vec<&str> = needed.iter().copied().filter(|name| columns.of(name).is_none()).collect();
        match missing.len() {
            0 => Ok(columns),
            1 => Err(format!("missing column {}", missing[0])),
            _ => Err(format!("missing columns {}", missing.join(", "))),
        }
    }

    fn of(&self, name: &str) -> Option<usize> {
        MEANINGFUL.iter().position(|known| *known == name).and_then(|i| self.0[i])
    }
}

/// A record's place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Record<'a> {
    pub(crate) table: &'a str,
    pub(crate) line: usize,
    pub(crate) columns: &'a Columns,
    pub(crate) header: &'a [String],
}

impl Record<'_> {
    /// The row's meaning.
    pub(crate) fn row(&self, cells: Vec<String>, need: Need) -> Result<Row, Error> {
        if cells.len() != self.header.len() {
            let noun = if cells.len() == 1 { "field" } else { "fields" };
            return Err(self.wrong(format!(
                "{} {noun}, but the header has {}",
                cells.len(),
                self.header.len()
            )));
        }
        let text = |name: &str| self.columns.of(name).map_or("", |i| cells[i].as_str()).to_owned();
        let observation_deg = self.angle(OBSERVATION, &cells)?;
        let entrance_deg = self.angle(ENTRANCE, &cells)?;
        let rotation_deg = if text(ROTATION).is_empty() { 0.0 } else { self.angle(ROTATION, &cells)? };
        let (unit, quantity) = self.unit_and_quantity(&text(UNIT), &text(QUANTITY))?;
        let limit = self.limit(&text(LIMIT), &text("standard"))?;
        let [standard, class, colour, source] = ["standard", "class", "colour", "source"].map(text);
        let (line, value) = (self.line, None);
        let mut row = Row {
            line,
            observation_deg,
            entrance_deg,
            rotation_deg,
            quantity,
            value,
            unit,
            limit,
            standard,
            class,
            colour,
            source,
            cells,
        };
        if !row.geometry().is_above_horizon() {
            return Err(self.wrong(format!(
                "at observation angle {observation_deg} and entrance angle {entrance_deg} the receiver is below the surface"
            )));
        }
        if need == Need::Values {
            row.value = Some(self.value(&row)?);
        }
        Ok(row)
    }

    fn angle(&self, name: &'static str, cells: &[String]) -> Result<f64, Error> {
        let text = self.columns.of(name).map_or("", |i| cells[i].as_str());
        let value = self.number(name, text)?;
        let (legal, range) = match name {
            OBSERVATION => ((0.0..180.0).contains(&value), "[0, 180)"),
            ENTRANCE => (value.abs() < 90.0, "(-90, 90)"),
            _ => (value.abs() <= 360.0, "[-360, 360]"),
        };
        if legal { Ok(value) } else { Err(self.cell(name, format!("{value} is outside {range}"))) }
    }

    fn unit_and_quantity(&self, unit: &str, quantity: &str) -> Result<(Unit, Quantity), Error> {
        let named = if quantity.is_empty() {
            None
        } else {
            Some(quantity.parse::<Quantity>().map_err(|error| self.cell(QUANTITY, error.to_string()))?)
        };
        if unit.is_empty() {
            let quantity = named.unwrap_or(Quantity::RetroReflectionCoefficient);
            return Ok((quantity.unit(), quantity));
        }
        let (unit, meant) =
            Unit::parse_with_quantity(unit).map_err(|error| self.cell(UNIT, error.to_string()))?;
        let quantity = named.unwrap_or(meant);
        if unit.measures(quantity) {
            return Ok((unit, quantity));
        }
        Err(self
            .cell(UNIT, format!("{unit} is no unit of {quantity}, which is given in {}", quantity.unit())))
    }

    fn limit(&self, limit: &str, standard: &str) -> Result<Limit, Error> {
        let said = if limit.is_empty() { standard.to_lowercase() } else { limit.to_lowercase() };
        let names = |limit: &Limit| said.contains(limit.name());
        let found = [Limit::Minimum, Limit::Maximum, Limit::Typical].into_iter().find(names);
        match found {
            Some(limit) => Ok(limit),
            None if limit.is_empty() => Ok(Limit::default()),
            None => Err(self.cell(LIMIT, format!("{} is not minimum, maximum or typical", shown(limit)))),
        }
    }

    /// The value in SI units, with everything that can be checked about it.
    fn value(&self, row: &Row) -> Result<f64, Error> {
        let text = self.columns.of(VALUE).map_or("", |i| row.cells[i].as_str());
        let written = self.number(VALUE, text)?;
        let Row { quantity, unit, .. } = *row;
        if written < 0.0 {
            return Err(self.cell(VALUE, format!("{written} is negative")));
        }
        if written == 0.0 {
            return Err(self.cell(VALUE, "is 0; leave the row out where nothing was measured".to_owned()));
        }
        if row.observation_deg == 0.0 && quantity != Quantity::DaytimeLuminance {
            let problem = "is 0, where source and receiver coincide and nothing can be measured; \
                           give the angle of the measurement, 0.2 or 0.33 for most sheeting";
            return Err(self.cell(OBSERVATION, problem.to_owned()));
        }
        let value = unit.to_si(written);
        let geometry = row.geometry();
        if unit == Unit::MillicandelaPerLuxSquareMetre && self.is_guessed(row) && geometry.wi.z > ROAD_COSINE
        {
            let problem = format!(
                "mcd/lx/m2 is the unit of road markings, whose entrance angle is near 90 degrees, not {}; \
                 is cd/lx/m2 meant? If not, say what it is in a column quantity",
                row.entrance_deg
            );
            return Err(self.cell(UNIT, problem));
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
        Err(self.cell(VALUE, problem))
    }

    /// Whether nothing but the unit said which quantity the row is of.
    fn is_guessed(&self, row: &Row) -> bool {
        let text = |name: &str| self.columns.of(name).map_or("", |i| row.cells[i].as_str());
        text(QUANTITY).is_empty() && !text(UNIT).contains(" (")
    }

    fn number(&self, name: &'static str, text: &str) -> Result<f64, Error> {
        if text.is_empty() {
            return Err(self.cell(name, "is empty".to_owned()));
        }
        let number = text.parse::<f64>().ok().filter(|x| x.is_finite());
        number.ok_or_else(|| self.cell(name, format!("{} is not a number", shown(text))))
    }

    fn cell(&self, column: &str, problem: String) -> Error {
        Error::Cell { table: self.table.to_owned(), line: self.line, column: column.to_owned(), problem }
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

/// A cell's text in quotes, cut short where it is long.
fn shown(text: &str) -> String {
    let mut start: String = text.chars().take(LONGEST).collect();
    if start.len() < text.len() {
        start.push_str("...");
    }
    format!("{start:?}")
}
