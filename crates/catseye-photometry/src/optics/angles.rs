//! Computed coefficients as a table that fits and plots read.

use rayon::prelude::*;

use super::within;
use crate::table::csv_text;
use crate::{Error, Geometry, Goniometer, Quantity, Table, significant};

/// The largest observation angle that is computed, in degrees: beyond, the scatter that is not modelled
/// rules.
pub const MAX_OBSERVATION_DEG: f64 = 20.0;
/// The largest entrance and viewing angle that is computed, in degrees.
pub const MAX_ENTRANCE_DEG: f64 = 85.0;
/// Digits of the values: more than the models are true to.
const DIGITS: i32 = 6;

/// Where coefficients are wanted: every observation angle at every entrance angle at every rotation.
#[derive(Clone, Debug, PartialEq)]
pub struct Angles {
    /// Observation angles in degrees, above 0, at most [`MAX_OBSERVATION_DEG`].
    pub observation_deg: Vec<f64>,
    /// Entrance angles `beta_1` in degrees, at most [`MAX_ENTRANCE_DEG`] either way, and the viewing angles,
    /// too.
    pub entrance_deg: Vec<f64>,
    /// Rotation angles in degrees, -360 to 360; none for what looks the same from all sides.
    pub rotation_deg: Vec<f64>,
}

impl Default for Angles {
    /// The angles of most standards for sheeting, and what lies between.
    fn default() -> Self {
        Self {
            observation_deg: vec![0.1, 0.2, 0.33, 0.5, 0.7, 1.0, 1.5, 2.0],
            entrance_deg: vec![5.0, 20.0, 30.0, 40.0],
            rotation_deg: Vec::new(),
        }
    }
}

/// A computed table, and how many rows were left out since no instrument would read their value.
#[derive(Clone, Debug, PartialEq)]
pub struct Computed {
    /// The rows in the order of rotation, entrance and observation angles.
    pub table: Table,
    /// How many values are outside [`Quantity::plausible`]: most often 0, or nearly.
    pub left_out: usize,
}

impl Angles {
    /// The table of a coefficient `r_a` in cd/lx/m2, computed in parallel. `source` and `wavelength_nm`
    /// (`None` for white light) are said in every row.
    ///
    /// # Errors
    /// An angle out of its range, no angle, or no value that an instrument would read.
    pub fn table(
        &self,
        source: &str,
        wavelength_nm: Option<f64>,
        r_a: impl Fn(&Geometry) -> f64 + Sync,
    ) -> Result<Computed, Error> {
        let places = self.places()?;
        let row = |&[observation, entrance, rotation]: &[f64; 3]| {
            let geometry = Geometry::from(Goniometer::from_degrees(observation, entrance, 0.0, rotation));
            let value = r_a(&geometry);
            let [least, most] = Quantity::RetroReflectionCoefficient.plausible(&geometry);
            (least..=most).contains(&value).then(|| {
                let angles = [observation, entrance, rotation].map(|angle| angle.to_string());
                let texts = ["R_A", &significant(value, DIGITS), "cd/lx/m2", source].map(str::to_owned);
                let nm = wavelength_nm.map_or_else(String::new, |nm| nm.to_string());
                angles.into_iter().chain(texts).chain([nm]).collect::<Vec<String>>()
            })
        };
        let rows: Vec<Option<Vec<String>>> = places.par_iter().map(row).collect();
        let left_out = rows.iter().filter(|row| row.is_none()).count();
        let header = [
            "observation_deg",
            "entrance_deg",
            "rotation_deg",
            "quantity",
            "value",
            "unit",
            "source",
            "wavelength_nm",
        ];
        // What says the same in every row is no column.
        let is_needed = |name: &str| match name {
            "rotation_deg" => !self.rotation_deg.is_empty(),
            "wavelength_nm" => wavelength_nm.is_some(),
            _ => true,
        };
        let kept: Vec<usize> = (0..header.len()).filter(|&i| is_needed(header[i])).collect();
        let rows = rows.into_iter().flatten().map(|row| kept.iter().map(|&i| row[i].clone()).collect());
        let text = csv_text(&kept.iter().map(|&i| header[i]).collect::<Vec<_>>(), rows);
        if left_out == places.len() {
            let problem =
                "no value at these angles is one that an instrument would read, 1e-6 to 50000 cd/lx/m2";
            return Err(Error::Table { table: source.to_owned(), problem: problem.to_owned() });
        }
        Ok(Computed { table: Table::parse_values(text.as_bytes(), source)?, left_out })
    }

    /// Every combination, checked.
    fn places(&self) -> Result<Vec<[f64; 3]>, Error> {
        let mut places = Vec::new();
        let rotations = if self.rotation_deg.is_empty() { &[0.0][..] } else { &self.rotation_deg };
        for &rotation in rotations {
            within("the rotation angle", rotation, rotation.abs() <= 360.0, "[-360, 360] degrees")?;
            for &entrance in &self.entrance_deg {
                within(
                    "the entrance angle",
                    entrance,
                    entrance.abs() <= MAX_ENTRANCE_DEG,
                    "[-85, 85] degrees",
                )?;
                for &observation in &self.observation_deg {
                    let legal = observation > 0.0 && observation <= MAX_OBSERVATION_DEG;
                    within("the observation angle", observation, legal, "(0, 20] degrees")?;
                    let viewing = (entrance - observation).abs();
                    within("the viewing angle", viewing, viewing <= MAX_ENTRANCE_DEG, "[0, 85] degrees")?;
                    places.push([observation, entrance, rotation]);
                }
            }
        }
        Ok(places)
    }
}
