//! One row of a CSV table as the parameters and directions of a query.

use std::str::FromStr;

use anyhow::bail;
use catseye::{Params, Real, Vec3};
use csv::ByteRecord;

/// How far a direction's length may be from 1; it is made 1.
const UNIT_TOLERANCE: f64 = 1e-3;
/// How far it may be for the direction to be taken as it is: what single precision leaves of a unit vector.
const ROUNDING: f64 = 1e-6;

/// The parameters' columns. Only `roughness_u` must be there.
pub(crate) const PARAMS: [&str; 8] = [
    "roughness_u",
    "roughness_v",
    "tint_r",
    "tint_g",
    "tint_b",
    "multiscatter_tint_r",
    "multiscatter_tint_g",
    "multiscatter_tint_b",
];
/// The direction towards the viewer.
pub(crate) const WO: [&str; 3] = ["wo_x", "wo_y", "wo_z"];
/// The direction towards the light.
pub(crate) const WI: [&str; 3] = ["wi_x", "wi_y", "wi_z"];
/// The uniform numbers that a sample is made of.
pub(crate) const U: [&str; 3] = ["u1", "u2", "u3"];

/// `f32` or `f64`, with what a table needs of them.
pub(crate) trait Scalar: Real + FromStr {
    /// The greatest value below 1.
    const BELOW_ONE: Self;
    /// The value as a cell of the table.
    fn cell(self) -> Cell;
}

impl Scalar for f64 {
    const BELOW_ONE: Self = 1.0_f64.next_down();
    fn cell(self) -> Cell {
        Cell::F64(self)
    }
}

impl Scalar for f32 {
    const BELOW_ONE: Self = 1.0_f32.next_down();
    fn cell(self) -> Cell {
        Cell::F32(self)
    }
}

/// A computed value.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Cell {
    /// Printed with the digits that identify an `f64`.
    F64(f64),
    /// Printed with the digits that identify an `f32`.
    F32(f32),
    /// Printed as it is.
    Word(&'static str),
}

/// What is wrong with a row.
#[derive(Debug)]
pub(crate) struct RowError {
    column: Option<String>,
    message: String,
}

impl RowError {
    /// Something wrong with the row as a whole.
    pub(crate) fn row(message: String) -> Self {
        Self { column: None, message }
    }

    fn cell(column: &str, message: String) -> Self {
        Self { column: Some(column.to_owned()), message }
    }
}

impl std::fmt::Display for RowError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.column {
            Some(column) => write!(f, "column {column}: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

/// Which field of a record holds which input.
#[derive(Clone, Debug)]
pub(crate) struct Columns {
    params: [Option<usize>; PARAMS.len()],
    wo: [usize; 3],
    third: Option<([&'static str; 3], [usize; 3])>,
}

impl Columns {
    /// Finds the columns of the parameters, of `wo`, and of the query's other argument, `WI` or `U`.
    pub(crate) fn new(header: &ByteRecord, third: Option<[&'static str; 3]>) -> anyhow::Result<Self> {
        for (i, name) in header.iter().enumerate() {
            let same = |earlier: &[u8]| earlier.trim_ascii().eq_ignore_ascii_case(name.trim_ascii());
            if header.iter().take(i).any(same) {
                bail!("column {} appears twice", text(name));
            }
        }
        let is = |field: &[u8], name: &str| field.trim_ascii().eq_ignore_ascii_case(name.as_bytes());
        let position = |name: &str| header.iter().position(|field| is(field, name));
        let needed = ["roughness_u"].into_iter().chain(WO).chain(third.into_iter().flatten());
        let missing: Vec<&str> = needed.filter(|name| position(name).is_none()).collect();
        if !missing.is_empty() {
            let noun = if missing.len() == 1 { "column" } else { "columns" };
            let names: Vec<String> =
                header.iter().map(|name| String::from_utf8_lossy(name.trim_ascii()).into_owned()).collect();
            let meant = names.iter().find(|name| missing.iter().any(|other| alike(other, name)));
            let hint = meant.map_or(String::new(), |name| format!("; is {name:?} one of them?"));
            bail!("missing {noun} {}{hint}", missing.join(", "));
        }
        let all = |names: [&str; 3]| names.map(|name| position(name).unwrap_or_default());
        Ok(Self { params: PARAMS.map(position), wo: all(WO), third: third.map(|names| (names, all(names))) })
    }

    /// The optional input that is not there and has all but the same name as another column.
    pub(crate) fn like(&self, column: &str) -> Option<&'static str> {
        let absent = PARAMS.into_iter().zip(self.params).filter(|(_, field)| field.is_none());
        absent.map(|(name, _)| name).filter(|name| alike(name, column)).min_by_key(|name| typos(name, column))
    }

    /// Whether the compensation has a tint.
    pub(crate) fn has_multiscatter_tint(&self) -> bool {
        self.params[5..].iter().any(Option::is_some)
    }

    /// Whether a field is one of the query's inputs.
    pub(crate) fn is_input(&self, field: usize) -> bool {
        let mut rest = self.wo.iter().chain(self.third.iter().flat_map(|(_, fields)| fields));
        self.params.contains(&Some(field)) || rest.any(|&other| other == field)
    }
}

/// Whether a column that is no input of any verb may be meant as one.
fn alike(name: &str, column: &str) -> bool {
    let mut known = PARAMS.into_iter().chain(WO).chain(WI).chain(U);
    !known.any(|other| other.eq_ignore_ascii_case(column)) && typos(name, column) <= 2
}

/// How many letters are wrong, missing, too many or in the wrong order.
fn typos(name: &str, column: &str) -> usize {
    strsim::osa_distance(name, &column.to_ascii_lowercase())
}

/// A record and its meaning.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<'a> {
    /// The fields' text.
    pub(crate) record: &'a ByteRecord,
    /// The fields' meaning.
    pub(crate) columns: &'a Columns,
}

impl Row<'_> {
    /// The lobe's parameters, not validated.
    pub(crate) fn params<T: Scalar>(&self) -> Result<Params<T>, RowError> {
        let [u, v, tint @ .., mr, mg, mb] = self.columns.params;
        let name = |i: usize| PARAMS[i];
        let or = |i, field, default| self.number::<T>(name(i), field).map(|x| x.unwrap_or(default));
        let Some(roughness_u) = self.number(name(0), u)? else {
            return Err(RowError::cell(name(0), "is empty".to_owned()));
        };
        let [r, g, b] = tint;
        Ok(Params::isotropic(roughness_u)
            .with_roughness_v(self.number(name(1), v)?)
            .with_tint([or(2, r, T::ONE)?, or(3, g, T::ONE)?, or(4, b, T::ONE)?])
            .with_multiscatter_tint([or(5, mr, T::ZERO)?, or(6, mg, T::ZERO)?, or(7, mb, T::ZERO)?]))
    }

    /// A library's complaint about the parameters, as one about a column.
    pub(crate) fn out_of_range(error: &catseye::ParamError) -> RowError {
        let channel = error.channel().map_or("", |channel| ["_r", "_g", "_b"][channel]);
        let (value, range) = (error.value(), error.range());
        RowError::cell(&format!("{}{channel}", error.name()), format!("{value} is outside {range}"))
    }

    /// The direction towards the viewer.
    pub(crate) fn wo<T: Scalar>(&self) -> Result<Vec3<T>, RowError> {
        self.direction(WO, self.columns.wo)
    }

    /// The direction towards the light.
    pub(crate) fn wi<T: Scalar>(&self) -> Result<Vec3<T>, RowError> {
        let (names, fields) = self.columns.third.unwrap_or_default();
        self.direction(names, fields)
    }

    /// The uniform numbers.
    pub(crate) fn u<T: Scalar>(&self) -> Result<[T; 3], RowError> {
        let (names, fields) = self.columns.third.unwrap_or_default();
        let mut u = [T::ZERO; 3];
        for ((u, name), field) in u.iter_mut().zip(names).zip(fields) {
            let value: f64 = self.required(name, field)?;
            if !(0.0..1.0).contains(&value) {
                return Err(RowError::cell(name, format!("{value} is outside [0, 1)")));
            }
            // The nearest f32 of a number just below 1 is 1.
            let nearest = T::from_f64(value);
            *u = if nearest < T::ONE { nearest } else { T::BELOW_ONE };
        }
        Ok(u)
    }

    fn direction<T: Scalar>(&self, names: [&str; 3], fields: [usize; 3]) -> Result<Vec3<T>, RowError> {
        let mut xyz = [T::ZERO; 3];
        for ((x, name), field) in xyz.iter_mut().zip(names).zip(fields) {
            *x = self.required(name, field)?;
            if !x.is_finite() {
                return Err(RowError::cell(name, format!("{x} is not finite")));
            }
        }
        let w = Vec3::from(xyz);
        let length = w.dot(w).to_f64().sqrt();
        if (length - 1.0).abs() <= ROUNDING {
            return Ok(w);
        }
        if (length - 1.0).abs() <= UNIT_TOLERANCE {
            let scale = T::from_f64(1.0 / length);
            return Ok(Vec3::new(w.x * scale, w.y * scale, w.z * scale));
        }
        let columns = names.join(", ");
        Err(RowError::row(format!("columns {columns}: the direction's length is {length}, it must be 1")))
    }

    fn required<T: Scalar>(&self, name: &str, field: usize) -> Result<T, RowError> {
        self.number(name, Some(field))?.ok_or_else(|| RowError::cell(name, "is empty".to_owned()))
    }

    /// The number in a field; `None` where the column is missing or the field empty.
    fn number<T: Scalar>(&self, name: &str, field: Option<usize>) -> Result<Option<T>, RowError> {
        let Some(bytes) = field.and_then(|field| self.record.get(field)) else { return Ok(None) };
        let bytes = bytes.trim_ascii();
        if bytes.is_empty() {
            return Ok(None);
        }
        let number =
            str::from_utf8(bytes).ok().and_then(|text| text.parse::<T>().ok()).filter(|x| !x.is_nan());
        number.map(Some).ok_or_else(|| RowError::cell(name, format!("{} is not a number", text(bytes))))
    }
}

/// A field's text in quotes, cut short where it is long.
fn text(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    let text = String::from_utf8_lossy(bytes);
    let mut shown: String = text.chars().take(LONGEST).collect();
    if shown.len() < text.len() {
        shown.push_str("...");
    }
    format!("{shown:?}")
}
