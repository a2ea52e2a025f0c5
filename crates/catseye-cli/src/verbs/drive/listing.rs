//! What the driver sees, as text, CSV and JSON.

use catseye_photometry::drive::{Reading, Sight};
use catseye_photometry::significant;
use serde_json::{Map, Value, json};

use crate::instrument::subject::Subject;

/// What the driver sees at one distance.
#[derive(Debug)]
pub(super) struct Row {
    pub(super) distance_m: f64,
    pub(super) sight: Sight,
    /// Of each subject.
    pub(super) seen: Vec<Seen>,
}

/// One subject on the sign.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// For the left and the right headlamp.
    pub(super) readings: [Reading; 2],
    /// By each headlamp, in cd/m2.
    pub(super) luminances: [Option<f64>; 2],
    /// The same by rendering, both together.
    pub(super) rendered: Option<f64>,
}

impl Seen {
    /// The luminance in cd/m2, if both coefficients are known.
    pub(super) fn luminance(&self) -> Option<f64> {
        let [left, right] = self.luminances;
        Some(left? + right?)
    }

    /// Whether a table's value was held below its least angles.
    pub(super) fn is_held(&self) -> bool {
        let held = |reading: &Reading| {
            reading.r_a.is_some() && (reading.beyond_observation || reading.beyond_entrance)
        };
        self.readings.iter().any(held)
    }
}

/// A table for people.
pub(super) fn text(title: &str, subjects: &[Subject], rows: &[Row], required: Option<f64>) -> String {
    let names = ["distance", "observation", "entrance", "rotation", "lux"].map(str::to_owned);
    let mut lines = vec![names.to_vec()];
    for number in 1..=subjects.len() {
        lines[0].push(format!("({number})"));
    }
    let pair = |[left, right]: [f64; 2], decimals: usize| format!("{left:.decimals$} {right:.decimals$}");
    for row in rows {
        let lamps = &row.sight.view.lamps;
        let illuminance: f64 = row.sight.light.iter().map(|light| light.illuminance_lx).sum();
        let mut cells = vec![
            format!("{} m", significant(row.distance_m, 6)),
            pair(lamps.map(|lamp| lamp.geometry.observation().to_degrees()), 3),
            pair(lamps.map(|lamp| lamp.geometry.entrance().to_degrees()), 2),
            pair(lamps.map(|lamp| lamp.goniometer().rotation.to_degrees()), 0),
            significant(illuminance, 3),
        ];
        cells.extend(row.seen.iter().map(|seen| match seen.luminance() {
            Some(luminance) => {
                let rendered = seen.rendered.map(|value| format!(" ({})", significant(value, 3)));
                let mark = if seen.is_held() { "*" } else { "" };
                format!("{}{mark}{}", significant(luminance, 3), rendered.unwrap_or_default())
            }
            None => "-".to_owned(),
        }));
        lines.push(cells);
    }
    let notes: String =
        subjects.iter().enumerate().map(|(i, subject)| notes(i, subject, rows, required)).collect();
    format!(
        "{title}\n\n{}\n{notes}observation, entrance and rotation angle in degrees, of the left and the \
         right headlamp;\nlux at the sign from both, luminance in cd/m2 at the eye\n",
        aligned(&lines)
    )
}

/// A subject's name, and what is to be said of its numbers.
fn notes(i: usize, subject: &Subject, rows: &[Row], required: Option<f64>) -> String {
    let mut text = format!("({}) {}\n", i + 1, subject.name);
    let seen = || rows.iter().map(|row| &row.seen[i]);
    if let Some([[least_alpha, most_alpha], [least_beta, most_beta]]) = subject.range_deg() {
        let [least_alpha, most_alpha, least_beta, most_beta] =
            [least_alpha, most_alpha, least_beta, most_beta].map(|angle| significant(angle, 4));
        if seen().any(Seen::is_held) {
            text += &format!(
                "    * angles below the table's least, observation {least_alpha} and entrance {least_beta}: \
                 R_A is held there\n"
            );
        }
        if seen().any(|seen| seen.luminance().is_none()) {
            text += &format!(
                "    - angles beyond the table's greatest, observation {most_alpha} and entrance {most_beta}: \
                 R_A is not known\n"
            );
        }
    }
    let Some(required) = required else { return text };
    let meets = |row: &&Row| row.seen[i].luminance().is_some_and(|luminance| luminance >= required);
    let met: Vec<String> = rows.iter().filter(meets).map(|row| significant(row.distance_m, 6)).collect();
    let where_met = if met.is_empty() { "no distance".to_owned() } else { format!("{} m", met.join(", ")) };
    text + &format!("    at least {required} cd/m2 at {where_met}\n")
}

/// Columns, to the right.
fn aligned(lines: &[Vec<String>]) -> String {
    let columns = lines.first().map_or(0, Vec::len);
    let width = |column: usize| lines.iter().map(|cells| cells[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |cells: &Vec<String>| {
        let cells = cells.iter().zip(&widths).map(|(cell, &width)| format!("{cell:>width$}"));
        cells.collect::<Vec<_>>().join("  ") + "\n"
    };
    lines.iter().map(line).collect()
}

/// An object for each distance, subject and headlamp.
pub(super) fn objects(subjects: &[Subject], rows: &[Row]) -> Vec<Map<String, Value>> {
    let mut objects = Vec::new();
    for row in rows {
        for (subject, seen) in subjects.iter().zip(&row.seen) {
            objects.extend([0, 1].map(|lamp| object(row, subject, seen, lamp)));
        }
    }
    objects
}

fn object(row: &Row, subject: &Subject, seen: &Seen, number: usize) -> Map<String, Value> {
    let (lamp, light) = (&row.sight.view.lamps[number], &row.sight.light[number]);
    let (goniometer, intrinsic) = (lamp.goniometer(), lamp.intrinsic());
    let reading = seen.readings[number];
    let beyond = match (reading.beyond_observation, reading.beyond_entrance) {
        (true, true) => "observation and entrance",
        (true, false) => "observation",
        (false, true) => "entrance",
        (false, false) => "",
    };
    let mut object = Map::new();
    let mut put = |name: &str, value: Value| object.insert(name.to_owned(), value);
    put("subject", json!(subject.name));
    put("distance_m", json!(row.distance_m));
    put("lamp", json!(["left", "right"][number]));
    put("lamp_distance_m", json!(lamp.distance_m));
    put("right_deg", json!(lamp.right_deg));
    put("up_deg", json!(lamp.up_deg));
    for (name, angle) in [
        ("observation_deg", goniometer.observation),
        ("entrance_deg", intrinsic.entrance),
        ("entrance_1_deg", goniometer.entrance_1),
        ("entrance_2_deg", goniometer.entrance_2),
        ("rotation_deg", goniometer.rotation),
        ("presentation_deg", intrinsic.presentation),
        ("orientation_deg", intrinsic.orientation),
        ("viewing_deg", lamp.geometry.viewing()),
    ] {
        put(name, json!(angle.to_degrees()));
    }
    put("intensity_cd", json!(light.intensity_cd));
    put("illuminance_lx", json!(light.illuminance_lx));
    put("r_a", json!(reading.r_a));
    put("beyond_table", json!(beyond));
    put("luminance_cd_m2", json!(seen.luminances[number]));
    put("sign_luminance_cd_m2", json!(seen.luminance()));
    if let Some(rendered) = seen.rendered {
        put("rendered_cd_m2", json!(rendered));
    }
    object
}
