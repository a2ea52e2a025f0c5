//! R_A between the rows of a table.

use crate::{Error, Geometry, Limit, Quantity, Row, Table};

/// The least difference of two angles in degrees that are not the same: a thousandth of what tables state.
const SAME_DEG: f64 = 1e-6;

/// The coefficients of retro-reflection of one class, read between the table's rows.
///
/// The logarithm of `R_A` is linear in the observation angle between rows of one entrance angle, and linear
/// in the entrance angle between such series. The entrance angle is the angle to the normal: the signs of the
/// tables' -4 and 5 degrees don't matter. Where a table has several values for the same two angles, of
/// several rotations for instance, the lowest counts. Nothing is extrapolated: below the least angle, where
/// sheeting is about flat, the value there is held and said to be so; beyond the greatest there is none.
#[derive(Clone, Debug, PartialEq)]
pub struct CoefficientTable {
    name: String,
    /// Ascending in the entrance angle; never none.
    series: Vec<Series>,
}

/// The values at one entrance angle.
#[derive(Clone, Debug, PartialEq)]
struct Series {
    entrance_deg: f64,
    /// Observation angle in degrees and the logarithm of `R_A`, ascending; never none.
    points: Vec<(f64, f64)>,
}

/// What a table says at a geometry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// `R_A` in cd/lx/m2; nothing beyond the table's greatest angles.
    pub r_a: Option<f64>,
    /// Whether the observation angle is beyond the table, so that the value at its least one is held, or
    /// there is none.
    pub beyond_observation: bool,
    /// The same of the entrance angle.
    pub beyond_entrance: bool,
}

impl CoefficientTable {
    /// Takes the rows that are `R_A`, or become it without an area or an integral; upper limits and luminance
    /// factors are left out.
    ///
    /// # Errors
    /// A table without such rows, and one of several classes, colours or standards.
    pub fn new(table: &Table) -> Result<Self, Error> {
        let fail = |problem: String| Error::Table { table: table.name().to_owned(), problem };
        let usable: Vec<(&Row, f64)> = table.rows().iter().filter_map(|row| Some((row, r_a(row)?))).collect();
        let Some((first, _)) = usable.first() else {
            return Err(fail(
                "has no values that are R_A or follow from it without an area or an integral".to_owned(),
            ));
        };
        if let Some((other, _)) = usable.iter().find(|(row, _)| row.words() != first.words()) {
            let (a, b) = (first.words().join(" "), other.words().join(" "));
            return Err(fail(format!(
                "has values of several classes, {:?} and {:?}; keep the rows of one",
                a.trim(),
                b.trim()
            )));
        }
        let mut series: Vec<Series> = Vec::new();
        for (row, r_a) in usable {
            let entrance_deg = row.geometry().entrance().to_degrees();
            let same = |series: &Series| (series.entrance_deg - entrance_deg).abs() < SAME_DEG;
            let at = series.iter().position(same).unwrap_or_else(|| {
                series.push(Series { entrance_deg, points: Vec::new() });
                series.len() - 1
            });
            series[at].add(row.observation_deg, r_a.ln());
        }
        series.sort_by(|a, b| a.entrance_deg.total_cmp(&b.entrance_deg));
        Ok(Self { name: table.name().to_owned(), series })
    }

    /// The table's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The greatest and the least observation and entrance angle, in degrees: `[[0.2, 2.0], [4.0, 45.0]]`.
    #[must_use]
    pub fn range_deg(&self) -> [[f64; 2]; 2] {
        let bounds = |angles: &mut dyn Iterator<Item = f64>| {
            angles.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| [least.min(x), most.max(x)])
        };
        let points = self.series.iter().flat_map(|series| &series.points);
        [
            bounds(&mut points.map(|point| point.0)),
            bounds(&mut self.series.iter().map(|series| series.entrance_deg)),
        ]
    }

    /// The value at a geometry, of which observation and entrance angle count.
    #[must_use]
    pub fn read(&self, geometry: &Geometry) -> Reading {
        let (observation, entrance) = (geometry.observation().to_degrees(), geometry.entrance().to_degrees());
        let mut beyond_observation = false;
        let mut at = |series: &Series| {
            let (value, held) = interpolated(&series.points, observation);
            beyond_observation |= held || value.is_none();
            value
        };
        let above = self.series.iter().position(|series| series.entrance_deg >= entrance);
        let (value, beyond_entrance) = match above {
            None => (None, true),
            Some(0) => {
                let first = &self.series[0];
                (at(first), entrance < first.entrance_deg - SAME_DEG)
            }
            Some(i) => {
                let [low, high] = [&self.series[i - 1], &self.series[i]];
                let ends = at(low).zip(at(high));
                let t = (entrance - low.entrance_deg) / (high.entrance_deg - low.entrance_deg);
                (ends.map(|(a, b)| a + (b - a) * t), false)
            }
        };
        Reading { r_a: value.map(f64::exp), beyond_observation, beyond_entrance }
    }
}

impl Series {
    /// Adds a value in its place; of two at the same angle the lower one stays.
    fn add(&mut self, observation: f64, log: f64) {
        let at = self.points.partition_point(|point| point.0 < observation - SAME_DEG);
        match self.points.get_mut(at) {
            Some(point) if (point.0 - observation).abs() <= SAME_DEG => point.1 = point.1.min(log),
            _ => self.points.insert(at, (observation, log)),
        }
    }
}

/// The value between two points, and whether that at the first is held; none beyond the last.
fn interpolated(points: &[(f64, f64)], x: f64) -> (Option<f64>, bool) {
    let at = points.partition_point(|point| point.0 < x - SAME_DEG);
    match (at.checked_sub(1).map(|i| points[i]), points.get(at)) {
        (None, Some(&(first, value))) => (Some(value), x < first - SAME_DEG),
        (Some((x0, a)), Some(&(x1, b))) => (Some(a + (b - a) * (x - x0) / (x1 - x0)), false),
        (_, None) => (None, false),
    }
}

/// A row's value as `R_A`. A luminance factor is of daylight, at 45 degrees: no point of a lobe.
fn r_a(row: &Row) -> Option<f64> {
    if row.limit == Limit::Maximum || row.quantity == Quantity::LuminanceFactor {
        return None;
    }
    let geometry = row.geometry();
    let f = row.quantity.to_brdf(row.value?, &geometry)?;
    Quantity::RetroReflectionCoefficient.of_brdf(f, &geometry).filter(|r_a| *r_a > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Goniometer;

    fn read(table: &CoefficientTable, observation: f64, entrance: f64) -> Reading {
        table.read(&Geometry::from(Goniometer::from_degrees(observation, entrance, 0.0, 0.0)))
    }

    fn table() -> CoefficientTable {
        let text = "observation_deg,entrance_deg,rotation_deg,value\n\
                    0.2,-4,0,400\n0.2,-4,90,200\n1,-4,0,2\n0.2,30,0,100\n0.5,30,0,50\n";
        let table = Table::parse_values(text.as_bytes(), "t").unwrap_or_else(|error| panic!("{error}"));
        CoefficientTable::new(&table).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn rows_are_met_and_the_logarithm_is_linear_between_them() {
        let table = table();
        let near = |reading: Reading, expected: f64| {
            let r_a = reading.r_a.unwrap_or(f64::NAN);
            assert!((r_a / expected - 1.0).abs() < 1e-9, "{r_a} {expected}");
            assert!(!reading.beyond_observation && !reading.beyond_entrance, "{reading:?}");
        };
        // Two rotations: the lower one.
        near(read(&table, 0.2, 4.0), 200.0);
        near(read(&table, 0.2, 30.0), 100.0);
        // Half way from 200 to 2 is 20, half way from 100 to 50 is 70.7; half way between both series.
        near(read(&table, 0.6, -4.0), 20.0);
        near(read(&table, 0.35, 30.0), 50.0 * 2.0_f64.sqrt());
        near(read(&table, 0.2, -17.0), 20_000.0_f64.sqrt());
        let [observations, [least, most]] = table.range_deg();
        assert_eq!(observations, [0.2, 1.0]);
        assert!((least - 4.0).abs() < 1e-12 && (most - 30.0).abs() < 1e-12, "{least} {most}");
    }

    #[test]
    fn nothing_is_extrapolated() {
        let table = table();
        let held = read(&table, 0.1, 2.0);
        assert!((held.r_a.unwrap_or(f64::NAN) - 200.0).abs() < 1e-9, "{held:?}");
        assert!(held.beyond_observation && held.beyond_entrance, "{held:?}");
        for (observation, entrance) in [(1.1, 4.0), (0.6, 20.0), (0.2, 31.0)] {
            assert_eq!(read(&table, observation, entrance).r_a, None, "{observation} {entrance}");
        }
    }
}
