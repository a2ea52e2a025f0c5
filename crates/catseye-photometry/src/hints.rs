//! What is legal in a table, and still odd enough to say.

use crate::{Quantity, Row};

/// Observation angles of retro-reflectometers end here, in degrees: beyond are values by day, and tails.
const USUAL_OBSERVATION_DEG: f64 = 4.0;
/// `R_A` that no sheet has so far from the retro direction: a white wall has 0.3 cd/lx/m2.
const BRIGHT: f64 = 2.0;
/// Entrance angles of tables go further than this, in degrees.
const USUAL_ENTRANCE_DEG: f64 = 3.0;
/// A value this much below the greatest one is of a tail.
const TAIL: f64 = 1e-4;

/// A sentence for each oddity: angles in minutes of arc or in each other's column, tails without
/// uncertainties.
pub(crate) fn hints(rows: &[Row]) -> Vec<String> {
    let retro: Vec<&Row> =
        rows.iter().filter(|row| row.quantity == Quantity::RetroReflectionCoefficient).collect();
    [angles(&retro), tails(&retro)].into_iter().flatten().collect()
}

fn angles(retro: &[&Row]) -> Option<String> {
    let least = retro.iter().min_by(|a, b| a.observation_deg.total_cmp(&b.observation_deg))?;
    // Geometries have no values, and are then taken for what they say.
    let is_bright = retro.iter().filter_map(|row| row.value).any(|value| value > BRIGHT);
    if least.observation_deg < USUAL_OBSERVATION_DEG || !is_bright {
        return None;
    }
    let angle = least.observation_deg;
    Some(if retro.iter().all(|row| row.entrance_deg.abs() < USUAL_ENTRANCE_DEG) {
        format!(
            "every observation angle is {angle} degrees or more, and the entrance angles are small: have the \
             two columns changed places?"
        )
    } else {
        format!(
            "every observation angle is {angle} degrees or more, where sheeting hardly shines; are they \
             minutes of arc? Then name the column observation_min, or write {angle}'"
        )
    })
}

fn tails(retro: &[&Row]) -> Option<String> {
    let most = retro.iter().filter_map(|row| row.value).fold(0.0, f64::max);
    let is_tail = |row: &&&Row| row.uncertainty.is_none() && row.value.is_some_and(|v| v < TAIL * most);
    let count = retro.iter().filter(is_tail).count();
    (count > 0).then(|| {
        format!(
            "{count} values are below a ten thousandth of the greatest: without a column uncertainty they \
             count in percent as much as the others do"
        )
    })
}
