//! `catseye lidar`: what a lidar gets back from a material, as one number.

use std::path::PathBuf;

use anyhow::{anyhow, bail};
use catseye_photometry::{Geometry, Goniometer, Quantity, significant};
use clap::ArgGroup;
use serde_json::{Map, Value, json};

use crate::failure::Usage;
use crate::instrument::subject::{Subject, SubjectArgs};
use crate::options::Tint;
use crate::output::Output;
use crate::{help, report};

/// Rows of an answer at most.
const MOST_ROWS: usize = 100_000;

/// Compute the reflectance of the matte surface that a lidar would take a material for
///
/// It is pi R_A / (cos beta cos nu), 1 for perfect white, some hundreds for sheeting. R_A is a material's at
/// these angles, or a table's between its rows, as in `catseye drive`. Coefficients are of visible light:
/// what a material returns at 905 or 1550 nm has to be measured, --tint states it.
#[derive(Debug, clap::Args)]
#[command(after_help = help::LIDAR)]
#[command(group = ArgGroup::new("offset").required(true))]
pub(crate) struct Args {
    /// MaterialX document, CSV table of R_A, or class of a standard (see `catseye standards list`)
    #[arg(value_name = "MATERIAL.mtlx|TABLE.csv|STANDARD")]
    subject: String,
    #[command(flatten)]
    reading: SubjectArgs,
    /// Angle between the emitter and the receiver, seen from the surface; 0 where they share a lens
    #[arg(long, value_name = "DEG", group = "offset")]
    observation_deg: Option<f64>,
    /// Distance between emitter and receiver, instead; needs --distance-m
    #[arg(long, value_name = "MM", group = "offset", requires = "distance_m")]
    spacing_mm: Option<f64>,
    /// Distance between the emitter and the surface
    #[arg(long, value_name = "M", requires = "spacing_mm")]
    distance_m: Option<f64>,
    /// Entrance angles, between the beam and the surface's normal
    #[arg(long, value_name = "DEG,...", value_delimiter = ',', default_value = "0,10,20,30,40,50,60")]
    #[arg(allow_hyphen_values = true)]
    entrance_deg: Vec<f64>,
    /// Wavelength in nanometres and the share of light that comes back there, of what comes back of visible
    /// light: 905=0.6. May be given several times
    #[arg(long = "tint", value_name = "NM=FACTOR")]
    tints: Vec<Tint>,
    /// Print CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Print a JSON array with an object for each wavelength and entrance angle
    #[arg(long)]
    json: bool,
    /// Print an SDF element `laser_retro` for one entrance angle and wavelength
    #[arg(long, conflicts_with_all = ["csv", "json"])]
    sdf: bool,
    /// `laser_retro` of a perfect white surface, in the scale of the simulator's sensor
    #[arg(long, value_name = "VALUE", default_value_t = 1.0, requires = "sdf")]
    white: f64,
    /// File to write, which appears whole or not at all; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

/// The answer at one geometry.
#[derive(Debug)]
struct Row {
    /// Wavelength and factor; visible light has none.
    tint: Option<Tint>,
    entrance_deg: f64,
    viewing_deg: f64,
    /// In cd/lx/m2, with the factor; not known beyond a table.
    r_a: Option<f64>,
    /// Relative to perfect white.
    reflectance: Option<f64>,
    is_held: bool,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let observation_deg = self.observation()?;
        let output = Output::new(&self.output)?;
        let tints: Vec<Option<Tint>> = match self.tints.is_empty() {
            true => vec![None],
            false => self.tints.iter().copied().map(Some).collect(),
        };
        if tints.len() * self.entrance_deg.len() > MOST_ROWS {
            bail!(Usage(format!("more than {MOST_ROWS} rows; ask for fewer angles or wavelengths")));
        }
        let subject = self.reading.subject(&self.subject)?;
        if self.tints.is_empty() {
            report::warn(
                "the values are of visible light, which says nothing of what comes back at 905 or 1550 nm; \
                 state it with --tint 905=FACTOR",
            );
        }
        let mut rows = Vec::new();
        for tint in tints {
            for &entrance_deg in &self.entrance_deg {
                rows.push(row(&subject, observation_deg, entrance_deg, tint)?);
            }
        }
        let objects = || rows.iter().map(|row| object(&subject, observation_deg, row)).collect::<Vec<_>>();
        let text = match (self.sdf, self.csv, self.json) {
            (true, ..) => self.sdf_element(&subject, observation_deg, &rows)?,
            (_, true, _) => report::csv(&objects())?,
            (.., true) => report::json(&objects().into_iter().map(Value::Object).collect())?,
            _ => text(&subject, observation_deg, &rows),
        };
        output.write(text.as_bytes())
    }

    /// The observation angle in degrees.
    fn observation(&self) -> anyhow::Result<f64> {
        let length = |name: &str, value: f64| {
            let legal = value > 0.0 && value <= 1e6;
            if legal {
                Ok(value)
            } else {
                Err(anyhow!(Usage(format!("--{name} {value}: must be above 0 and at most 1e6"))))
            }
        };
        let angle = match (self.observation_deg, self.spacing_mm, self.distance_m) {
            (Some(angle), ..) => angle,
            (_, Some(spacing), Some(distance)) => {
                let spacing = length("spacing-mm", spacing)? / 1000.0;
                spacing.atan2(length("distance-m", distance)?).to_degrees()
            }
            _ => bail!(Usage("--observation-deg, or --spacing-mm and --distance-m are needed".to_owned())),
        };
        if !(0.0..90.0).contains(&angle) {
            bail!(Usage(format!("--observation-deg {angle}: must be in [0, 90)")));
        }
        Ok(angle)
    }

    /// The element for a collision or a visual of an SDF file.
    fn sdf_element(&self, subject: &Subject, observation_deg: f64, rows: &[Row]) -> anyhow::Result<String> {
        if !(self.white > 0.0 && self.white.is_finite()) {
            bail!(Usage(format!("--white {}: must be above 0", self.white)));
        }
        let [row] = rows else {
            bail!(Usage(
                "--sdf has room for one number: choose it with one --entrance-deg and at most one --tint"
                    .to_owned()
            ));
        };
        let reflectance = row.reflectance.ok_or_else(|| {
            anyhow!("{}: the angles are beyond the table's greatest, where R_A is not known", subject.name)
        })?;
        // Two hyphens would end the comment early.
        let name = subject.name.replace("--", "- -");
        Ok(format!(
            "<!-- {name}: {} times a perfect white surface at observation {} deg, entrance {} deg, {} -->\n\
             <laser_retro>{}</laser_retro>\n",
            significant(reflectance, 4),
            significant(observation_deg, 4),
            significant(row.entrance_deg, 4),
            light(row.tint),
            significant(reflectance * self.white, 6)
        ))
    }
}

fn row(
    subject: &Subject,
    observation_deg: f64,
    entrance_deg: f64,
    tint: Option<Tint>,
) -> anyhow::Result<Row> {
    let geometry = Geometry::from(Goniometer::from_degrees(observation_deg, entrance_deg, 0.0, 0.0));
    if !(entrance_deg.abs() < 90.0 && geometry.is_above_horizon()) {
        bail!(Usage(format!(
            "--entrance-deg {entrance_deg}: emitter and receiver must be above the surface, \
             within 90 degrees of its normal"
        )));
    }
    let reading = subject.read(&geometry)?;
    let factor = tint.map_or(1.0, |tint| tint.0.tint);
    let reflectance = |r_a| {
        let f = Quantity::RetroReflectionCoefficient.to_brdf(r_a, &geometry)?;
        Quantity::LuminanceFactor.of_brdf(f, &geometry)
    };
    let r_a = reading.r_a.map(|r_a| r_a * factor);
    Ok(Row {
        tint,
        entrance_deg,
        viewing_deg: geometry.viewing().to_degrees(),
        r_a,
        reflectance: r_a.and_then(reflectance),
        is_held: r_a.is_some() && (reading.beyond_observation || reading.beyond_entrance),
    })
}

fn object(subject: &Subject, observation_deg: f64, row: &Row) -> Map<String, Value> {
    let value = json!({
        "subject": subject.name,
        "wavelength_nm": row.tint.map(|tint| tint.0.wavelength_nm),
        "tint": row.tint.map(|tint| tint.0.tint),
        "observation_deg": observation_deg,
        "entrance_deg": row.entrance_deg,
        "viewing_deg": row.viewing_deg,
        "r_a": row.r_a,
        "reflectance": row.reflectance,
        "held": row.is_held,
    });
    if let Value::Object(object) = value { object } else { Map::new() }
}

/// A table for people.
fn text(subject: &Subject, observation_deg: f64, rows: &[Row]) -> String {
    let mut text = format!("{}, observation angle {} deg\n", subject.name, significant(observation_deg, 4));
    let mut before = None;
    for row in rows {
        if before != Some(row.tint) {
            text += &format!("\n{}\nentrance         R_A   reflectance\n", light(row.tint));
        }
        before = Some(row.tint);
        let number = |value: Option<f64>| value.map_or("-".to_owned(), |value| significant(value, 4));
        let mark = if row.is_held { "*" } else { "" };
        text += &format!(
            "{:>4} deg  {:>10}  {:>12}{mark}\n",
            significant(row.entrance_deg, 4),
            number(row.r_a),
            number(row.reflectance)
        );
    }
    text += "\nR_A in cd/lx/m2; reflectance of the matte surface that returns as much, 1 for perfect white\n";
    if rows.iter().any(|row| row.is_held) {
        text += "* angles below the table's least: R_A is held there\n";
    }
    if rows.iter().any(|row| row.r_a.is_none()) {
        text += "- angles beyond the table's greatest: R_A is not known\n";
    }
    text
}

fn light(tint: Option<Tint>) -> String {
    match tint {
        None => "visible light".to_owned(),
        Some(Tint(band)) => format!("{} nm, {} of visible light", band.wavelength_nm, band.tint),
    }
}
