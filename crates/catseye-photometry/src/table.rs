//! Tables of photometric values: the columns of data sheets, standards and measurements.
//!
//! | column | meaning |
//! |---|---|
//! | `observation_deg` | observation angle alpha, in `[0, 180)`; needed, above 0 where there is a value |
//! | `entrance_deg` | entrance angle component `beta_1`, in `(-90, 90)`; needed |
//! | `beta_2_deg` | entrance angle component `beta_2`, in `(-90, 90)`; 0 where missing or empty |
//! | `rotation_deg` | rotation angle epsilon, in `[-360, 360]`; 0 where missing or empty |
//! | `value`, `unit` | the unit is the quantity's where it is empty, cd/lx/m2 where neither is given |
//! | `quantity` | `R_A`, `R_L`, ...; where missing or empty what the unit is of |
//! | `uncertainty` | one standard deviation, in the value's unit, or `3%` of the value |
//! | `limit` | `minimum`, `maximum` or `typical`; where empty what the standard's name says |
//! | `wavelength_nm` | of the light, in `[100, 20000]`; white where missing or empty |
//! | `source_aperture_deg`, `receiver_aperture_deg` | full angles of the apertures, both or none |
//! | `standard`, `class`, `colour`, `source` | what the value is of, and who says so |
//!
//! Other columns are kept and have no meaning. Separators are commas, semicolons, tabs or bars, decimals have
//! points or commas; names may be in any case and those of data sheets (`alpha`, `Obs. angle (°)`, `R_A
//! [cd/lx/m2]`), angles in minutes of arc where the name or the cell says so. [`Table::to_csv`] writes all of
//! it in one way: the names above, commas, points, degrees.

use std::collections::HashMap;
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use crate::columns::Columns;
use crate::hints::hints;
use crate::number::DecimalMarks;
use crate::record::Record;
use crate::sheet::{LARGEST, Sheet};
use crate::standards::plain;
use crate::{Apertures, Error, Geometry, Goniometer, Quantity, Unit};

/// Relative difference of two values for the same thing from which on they contradict each other, and the
/// same in standard deviations of the difference, where the table has them.
const CONTRADICTION: f64 = 0.05;
const CONTRADICTION_SIGMA: f64 = 4.0;

/// What a table is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd)]
pub(crate) enum Need {
    /// Geometries to measure at. Values are not looked at.
    Geometry,
    /// Values at the geometries, of which every one is checked.
    Values,
}

/// Which side of its value a material has to be on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Limit {
    /// At least the value.
    Minimum,
    /// At most the value.
    Maximum,
    /// About the value: what was measured.
    #[default]
    Typical,
}

impl Limit {
    /// `minimum`, `maximum` or `typical`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Minimum => "minimum",
            Self::Maximum => "maximum",
            Self::Typical => "typical",
        }
    }
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The line in the file, counted from 1.
    pub line: usize,
    /// Observation angle alpha, in degrees.
    pub observation_deg: f64,
    /// Entrance angle component `beta_1`, in degrees.
    pub entrance_deg: f64,
    /// Entrance angle component `beta_2`, in degrees; 0 where none is given.
    pub entrance_2_deg: f64,
    /// Rotation angle epsilon, in degrees.
    pub rotation_deg: f64,
    /// What the value is a value of.
    pub quantity: Quantity,
    /// The value in the quantity's SI unit. Present where the table was read for its values.
    pub value: Option<f64>,
    /// One standard deviation of the value in the same unit, at most the value.
    pub uncertainty: Option<f64>,
    /// The unit that the value is written in.
    pub unit: Unit,
    /// Whether the value is a lower or an upper limit.
    pub limit: Limit,
    /// The wavelength that was measured at, in nm; `None` for white light.
    pub wavelength_nm: Option<f64>,
    /// The apertures that were measured with.
    pub apertures: Option<Apertures>,
    /// The standard; empty where none is given. The same holds for the texts below.
    pub standard: String,
    /// The class within the standard, or the product.
    pub class: String,
    /// The colour.
    pub colour: String,
    /// Who says so.
    pub source: String,
    /// The row's texts, one for each column of [`Table::header`].
    pub cells: Vec<String>,
}

impl Row {
    /// The directions that the angles mean.
    #[must_use]
    pub fn geometry(&self) -> Geometry {
        let angles = Goniometer::from_degrees(
            self.observation_deg,
            self.entrance_deg,
            self.entrance_2_deg,
            self.rotation_deg,
        );
        Geometry::from(angles)
    }

    /// Standard, class and colour, empty where none is given.
    #[must_use]
    pub fn words(&self) -> [&str; 3] {
        [&self.standard, &self.class, &self.colour]
    }

    /// Whether standard, class and colour together contain a text; case, spaces and signs don't matter.
    #[must_use]
    pub fn mentions(&self, text: &str) -> bool {
        plain(&self.words().concat()).contains(&plain(text))
    }

    /// The value in the unit that it is written in.
    #[must_use]
    pub fn value_as_written(&self) -> Option<f64> {
        self.value.map(|value| self.unit.of_si(value))
    }
}

/// Photometric values or geometries, in the order of their file.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    name: String,
    header: Vec<String>,
    rows: Vec<Row>,
}

impl Table {
    /// Reads a file of values, every one of which is checked.
    ///
    /// # Errors
    /// A file that can't be read, and everything that [`Table::parse_values`] refuses.
    pub fn read_values(path: &Path) -> Result<Self, Error> {
        Self::read(path, Need::Values)
    }

    /// Reads a file of geometries to measure at; values are not looked at.
    ///
    /// # Errors
    /// A file that can't be read, and everything that [`Table::parse_geometries`] refuses.
    pub fn read_geometries(path: &Path) -> Result<Self, Error> {
        Self::read(path, Need::Geometry)
    }

    /// Reads CSV text with a header line and values; `name` is what errors call it.
    ///
    /// # Errors
    /// As [`Table::parse_geometries`], and a value that is missing, not finite, not above 0, in a unit that
    /// does not measure its quantity or beyond [`Quantity::plausible`], an observation angle of 0, and rows
    /// that contradict each other.
    pub fn parse_values(bytes: &[u8], name: &str) -> Result<Self, Error> {
        Self::parse(bytes, name, Need::Values)
    }

    /// Reads CSV text with a header line for its geometries; `name` is what errors call it.
    ///
    /// # Errors
    /// Names line and column of: text that is not UTF-8 or longer than 16 MiB, a missing or doubled column, a
    /// table without rows or with more than 250 000, an angle that is no number or out of its range, a
    /// receiver below the surface, angles of another goniometer system.
    pub fn parse_geometries(bytes: &[u8], name: &str) -> Result<Self, Error> {
        Self::parse(bytes, name, Need::Geometry)
    }

    fn read(path: &Path, need: Need) -> Result<Self, Error> {
        let io = |source| Error::Io { path: path.to_owned(), source };
        let mut bytes = Vec::new();
        File::open(path).map_err(io)?.take(LARGEST as u64 + 1).read_to_end(&mut bytes).map_err(io)?;
        Self::parse(&bytes, &path.display().to_string(), need)
    }

    fn parse(bytes: &[u8], name: &str, need: Need) -> Result<Self, Error> {
        let Sheet { header, records } = Sheet::read(bytes, name)?;
        let columns = Columns::new(&header, need)
            .map_err(|problem| Error::Table { table: name.to_owned(), problem })?;
        if records.is_empty() {
            let problem = "has a header, but no rows".to_owned();
            return Err(Error::Table { table: name.to_owned(), problem });
        }
        let mut marks = DecimalMarks::default();
        for (i, _) in columns.iter().filter(|(_, heading)| heading.column.is_number()) {
            records.iter().for_each(|(_, cells)| marks.see(&cells[i]));
        }
        let row = |(line, cells): &(usize, Vec<String>)| {
            let record =
                Record { table: name, line: *line, columns: &columns, header: &header, marks, cells };
            record.row(need)
        };
        let rows = records.iter().map(row).collect::<Result<Vec<Row>, Error>>()?;
        let table = Self { name: name.to_owned(), header: columns.canonical(&header), rows };
        if need == Need::Values {
            table.refuse_contradictions()?;
        }
        Ok(table)
    }

    /// What is legal and still odd: angles that seem to be minutes of arc, or in each other's column, and
    /// values far below the others. A sentence each, with the way out.
    #[must_use]
    pub fn hints(&self) -> Vec<String> {
        hints(&self.rows)
    }

    /// A table of rows that come from somewhere else; `header` names the rows' [`Row::cells`].
    #[must_use]
    pub fn from_rows(name: &str, header: &[String], rows: Vec<Row>) -> Self {
        Self { name: name.to_owned(), header: header.to_owned(), rows }
    }

    /// The name: that of the file, or of the standard.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The names of the columns: those with a meaning by the names of this module, others as they were read.
    #[must_use]
    pub fn header(&self) -> &[String] {
        &self.header
    }

    /// The rows; never none where the table was read.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The table as CSV: its own columns, and one more for each pair of a name and a text for every row. A
    /// column that has an added one's name is replaced.
    #[must_use]
    pub fn to_csv(&self, added: &[(&str, Vec<String>)]) -> String {
        let is_kept = |name: &str| added.iter().all(|(other, _)| !other.eq_ignore_ascii_case(name));
        let kept: Vec<usize> = (0..self.header.len()).filter(|&i| is_kept(&self.header[i])).collect();
        let names = kept.iter().map(|&i| self.header[i].as_str());
        let header: Vec<&str> = names.chain(added.iter().map(|(name, _)| *name)).collect();
        let cell = |cells: &'_ [String], i: usize| cells.get(i).cloned().unwrap_or_default();
        let rows = self.rows.iter().enumerate().map(|(i, row)| {
            let own = kept.iter().map(|&column| cell(&row.cells, column));
            own.chain(added.iter().map(|(_, cells)| cell(cells, i))).collect::<Vec<String>>()
        });
        csv_text(&header, rows)
    }

    /// Two values for the same thing at the same geometry must be about the same.
    fn refuse_contradictions(&self) -> Result<(), Error> {
        let mut known: HashMap<_, &Row> = HashMap::new();
        for row in &self.rows {
            let wavelength = row.wavelength_nm.unwrap_or_default();
            let angles =
                [row.observation_deg, row.entrance_deg, row.entrance_2_deg, row.rotation_deg, wavelength];
            let angles = angles.map(f64::to_bits);
            let key = (&row.standard, &row.class, &row.colour, row.limit, row.quantity, angles);
            let Some(first) = known.insert(key, row) else { continue };
            let (Some(a), Some(b)) = (first.value, row.value) else { continue };
            let uncertainty = first.uncertainty.unwrap_or(0.0).hypot(row.uncertainty.unwrap_or(0.0));
            if (a - b).abs() > (CONTRADICTION * a.max(b)).max(CONTRADICTION_SIGMA * uncertainty) {
                let unit = row.quantity.unit();
                return Err(Error::Row {
                    table: self.name.clone(),
                    line: row.line,
                    problem: format!(
                        "says {} = {b} {unit}, but line {} says {a} {unit} at the same angles; \
                         keep one of them, or tell them apart by class, colour or standard",
                        row.quantity, first.line
                    ),
                });
            }
        }
        Ok(())
    }
}

/// Rows as CSV, quotes only where they are needed.
pub(crate) fn csv_text(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
    // Writing to memory can't fail.
    writer.write_record(header).unwrap_or_default();
    for row in rows {
        writer.write_record(row).unwrap_or_default();
    }
    String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
}
