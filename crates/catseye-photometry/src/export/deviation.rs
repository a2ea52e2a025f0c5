//! How far an exported material is from its original.

use std::fmt;

use crate::{Geometry, Row, significant};

/// Shares of the greatest value at an entrance angle: from the first on there is the lobe, from the second on
/// its tail, which is seen beside other lights only.
const LOBE: f64 = 0.1;
const TAIL: f64 = 0.01;

/// An error that is none.
const EXACT: f64 = 1e-4;

/// How far a material's values are from those that they should be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// How many values were compared.
    pub rows: usize,
    /// The error that is greatest in size, as a share of the value.
    pub worst: f64,
    /// Observation and entrance angle of the worst one, in degrees.
    pub worst_at_deg: [f64; 2],
    /// Root mean square of the errors, as shares of the values.
    pub rms: f64,
}

impl Deviation {
    /// Compares a BRDF, in 1/sr, with the values of rows.
    ///
    /// Rows without a value, and of quantities that a BRDF and a geometry don't determine, are left out;
    /// `None` where no row is left.
    pub fn of(rows: &[Row], brdf: impl Fn(&Geometry) -> f64) -> Option<Self> {
        let error = |row: &Row| {
            let geometry = row.geometry();
            let found = row.quantity.of_brdf(brdf(&geometry), &geometry)?;
            Some((found / row.value? - 1.0, [row.observation_deg, row.entrance_deg]))
        };
        let errors: Vec<(f64, [f64; 2])> = rows.iter().filter_map(error).collect();
        let &(worst, worst_at_deg) = errors.iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
        let sum: f64 = errors.iter().map(|(error, _)| error * error).sum();
        Some(Self { rows: errors.len(), worst, worst_at_deg, rms: (sum / errors.len() as f64).sqrt() })
    }
}

impl fmt::Display for Deviation {
    /// `worst -12 % (0.2 deg observation, 30 deg entrance), rms 7 % of 6 values`, or `within 0.01 % at all 21
    /// values`, below which single precision decides.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.worst.abs() < EXACT {
            return write!(f, "within {} % at all {} values", 100.0 * EXACT, self.rows);
        }
        let percent = |share: f64| significant(100.0 * share, if share.abs() < 0.1 { 2 } else { 3 });
        let [observation, entrance] = self.worst_at_deg.map(|angle| significant(angle, 3));
        write!(
            f,
            "worst {} % ({observation} deg observation, {entrance} deg entrance), rms {} % of {} values",
            percent(self.worst),
            percent(self.rms),
            self.rows
        )
    }
}

/// The rows of a lobe, and of its tail.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LobeRows {
    /// Those whose value is at least a tenth of the greatest one at the same entrance angle.
    pub lobe: Vec<Row>,
    /// Those from a hundredth to a tenth.
    pub tail: Vec<Row>,
}

impl LobeRows {
    /// Sorts rows; what is less than a hundredth is left out, as are rows without a value.
    #[must_use]
    pub fn of(rows: &[Row]) -> Self {
        let greatest = |entrance_deg: f64| {
            let same = rows.iter().filter(|row| row.entrance_deg == entrance_deg);
            same.filter_map(|row| row.value).fold(0.0, f64::max)
        };
        let share = |row: &Row| row.value.map_or(0.0, |value| value / greatest(row.entrance_deg));
        let within = |from: f64, to: f64| {
            rows.iter().filter(move |row| (from..to).contains(&share(row))).cloned().collect()
        };
        Self { lobe: within(LOBE, f64::INFINITY), tail: within(TAIL, LOBE) }
    }
}
