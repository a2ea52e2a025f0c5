//! `catseye measure`: a virtual retroreflectometer.

use std::path::PathBuf;

use anyhow::{Context as _, bail};
use catseye_materialx::Material;
use catseye_photometry::standards::{Catalogue, StandardClass};
use catseye_photometry::verdict::{Verdict, verdicts};
use catseye_photometry::{Row, Table};
use catseye_render::Estimate;
use serde_json::{Map, Value, json};

use crate::failure::Usage;
use crate::instrument::goniometer::Photometer;
use crate::instrument::retroreflectometer::{Retroreflectometer, SAMPLES};
use crate::instrument::{Channel, check_area, table};
use crate::options::MaterialArgs;
use crate::output::Output;
use crate::progress::Progress;
use crate::{help, report};

/// The geometries that are measured where none are given: those of the standards for sheeting.
const OBSERVATIONS_DEG: [&str; 7] = ["0.1", "0.2", "0.33", "0.5", "1", "1.5", "2"];
const ENTRANCES_DEG: [&str; 5] = ["-4", "5", "20", "30", "40"];

/// Measure a material as a retroreflectometer would
///
/// Answers the rows of a table with the material's value in a column `model`, in the row's unit: R_A in
/// cd/lx/m2 where neither `quantity` nor `unit` say something else. Observation and entrance angles are those
/// of the CIE goniometer system, with `beta_2` 0. Colours count as luminance in linear Rec. 709. What the
/// surface emits and the mirror image of the lamp in a smooth coat are not measured; a lobe of roughness 0,
/// which returns all light in one direction, is an error.
#[derive(Debug, clap::Args)]
#[command(after_help = help::measure())]
pub(crate) struct Args {
    #[command(flatten)]
    subject: MaterialArgs,
    /// CSV table of the geometries, `-` for standard input [default: those of the standards for sheeting]
    #[arg(long, value_name = "TABLE.csv", conflicts_with = "standard")]
    geometry: Option<PathBuf>,
    /// Measure at the geometries of a standard or class (see `catseye standards list`), or of a table with
    /// values
    #[arg(long, value_name = "NAME|TABLE.csv")]
    standard: Option<String>,
    /// What is made of the three colour channels
    #[arg(long, value_enum, default_value_t)]
    channel: Channel,
    /// Area of the reflector in square metres, for rows of R_I
    #[arg(long, value_name = "AREA")]
    area_m2: Option<f64>,
    /// Trace the light of an instrument as ASTM E810 describes it (15 m away, apertures of 0.1 degrees,
    /// specimen of 20 cm) instead of evaluating the BSDF; adds a column `standard_error`
    #[arg(long, conflicts_with = "verdict")]
    instrument: bool,
    /// Light paths of each row
    #[arg(long, value_name = "N", default_value_t = SAMPLES, requires = "instrument")]
    #[arg(value_parser = clap::value_parser!(u32).range(32..=1 << 24))]
    samples: u32,
    /// Say which classes of standards the material meets, and where it fails the others, instead of the rows
    #[arg(long, conflicts_with = "geometry")]
    verdict: bool,
    /// Judge by the classes of this colour
    #[arg(long, value_name = "COLOUR", default_value = "white", conflicts_with = "standard")]
    colour: String,
    /// File to write, which appears whole or not at all; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
    /// Print a JSON array with one object per row or verdict
    #[arg(long)]
    json: bool,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        check_area(self.area_m2)?;
        let output = Output::new(&self.output)?;
        let material = self.subject.load()?;
        let photometer = Photometer::new(&material, self.subject.model(), self.channel, self.area_m2)?;
        let text = match self.verdict {
            true => self.judge(&photometer)?,
            false if self.instrument => self.trace(&material)?,
            false => self.measure(&photometer)?,
        };
        output.write(text.as_bytes())
    }

    /// The rows with the column `model`.
    fn measure(&self, photometer: &Photometer) -> anyhow::Result<String> {
        self.answer(["model"], |row| Ok([photometer.measure(row.quantity, &row.geometry())?]))
    }

    /// The rows with the columns `model` and `standard_error`.
    fn trace(&self, material: &Material) -> anyhow::Result<String> {
        let (model, channel, area, samples) =
            (self.subject.model(), self.channel, self.area_m2, self.samples);
        let instrument = Retroreflectometer { material, model, channel, area, samples };
        self.answer(["model", "standard_error"], |row| {
            let Estimate { value, standard_error } = instrument.measure(row.quantity, &row.geometry())?;
            Ok([value, standard_error])
        })
    }

    /// The rows with columns added, whose values are given in the SI unit of the row's quantity.
    fn answer<const N: usize>(
        &self,
        names: [&str; N],
        values: impl Fn(&Row) -> anyhow::Result<[f64; N]>,
    ) -> anyhow::Result<String> {
        let table = self.table()?;
        let progress = Progress::new("rows", table.rows().len() as u64);
        let mut answers = Vec::new();
        for row in table.rows() {
            progress.set(answers.len() as u64);
            let values = values(row).with_context(|| format!("{}:{}", table.name(), row.line))?;
            answers.push(values.map(|value| row.unit.of_si(value)));
        }
        if self.json {
            let rows = table.rows().iter().zip(&answers);
            let rows = rows.map(|(row, answer)| object(&table, row, names.iter().copied().zip(*answer)));
            return report::json(&rows.collect());
        }
        // As in every table of the command: the digits that give the same value back.
        let column = |i: usize| answers.iter().map(|answer| format!("{:?}", answer[i])).collect();
        let columns: Vec<(&str, Vec<String>)> =
            names.iter().enumerate().map(|(i, name)| (*name, column(i))).collect();
        Ok(table.to_csv(&columns))
    }

    fn table(&self) -> anyhow::Result<Table> {
        if let Some(path) = &self.geometry {
            return table::read_geometries(path);
        }
        if let Some(name) = &self.standard {
            return Ok(table::joined(name, &table::classes(name)?));
        }
        let mut text = String::from("observation_deg,entrance_deg,quantity,unit\n");
        for observation in OBSERVATIONS_DEG {
            for entrance in ENTRANCES_DEG {
                text += &format!("{observation},{entrance},R_A,cd/lx/m2\n");
            }
        }
        Ok(Table::parse_geometries(text.as_bytes(), "built-in geometries")?)
    }

    /// A line for each class.
    fn judge(&self, photometer: &Photometer) -> anyhow::Result<String> {
        let classes = match &self.standard {
            Some(name) => table::classes(name)?,
            None => of_colour(&self.colour)?,
        };
        // A material that can't be measured fails no standard.
        let first = classes.first().map(|class| class.rows()[0].geometry());
        first.map(|geometry| photometer.brdf(&geometry)).transpose()?;
        let all = verdicts(&classes, |quantity, geometry| photometer.measure(quantity, geometry).ok());
        if all.is_empty() {
            bail!(
                "none of these has limits that can be judged: R_I needs --area-m2, and typical values are no \
                 limits"
            );
        }
        if self.json {
            return report::json(&all.iter().map(verdict_object).collect());
        }
        Ok(all.iter().map(|verdict| format!("{verdict}\n")).collect())
    }
}

/// The embedded classes of a colour, by the last part of their name.
fn of_colour(colour: &str) -> anyhow::Result<Vec<StandardClass>> {
    let catalogue = Catalogue::embedded()?;
    let colour_of = |class: &StandardClass| class.id().rsplit(':').next().unwrap_or_default().to_owned();
    let wanted = colour.to_lowercase().replace(' ', "-");
    let found: Vec<StandardClass> =
        catalogue.classes().iter().filter(|class| colour_of(class) == wanted).cloned().collect();
    if found.is_empty() {
        let mut known: Vec<String> = catalogue.classes().iter().map(colour_of).collect();
        known.sort();
        known.dedup();
        bail!(Usage(format!("--colour {colour}: no class has it; known are {}", known.join(", "))));
    }
    Ok(found)
}

/// A row as JSON: its cells by their column, numbers where the column is one of numbers, and what was
/// measured.
fn object<'a>(table: &Table, row: &Row, answer: impl Iterator<Item = (&'a str, f64)>) -> Value {
    const NUMBERS: [&str; 4] = ["observation_deg", "entrance_deg", "rotation_deg", "value"];
    let mut object = Map::new();
    for (name, cell) in table.header().iter().zip(&row.cells) {
        let number =
            cell.parse::<f64>().ok().filter(|_| NUMBERS.iter().any(|other| name.eq_ignore_ascii_case(other)));
        object.insert(name.clone(), number.map_or_else(|| json!(cell), |number| json!(number)));
    }
    object.extend(answer.map(|(name, value)| (name.to_owned(), json!(value))));
    Value::Object(object)
}

fn verdict_object(verdict: &Verdict<'_>) -> Value {
    let points: Vec<Value> = verdict
        .checks()
        .iter()
        .map(|check| {
            let unit = check.row.unit;
            json!({
                "observation_deg": check.row.observation_deg,
                "entrance_deg": check.row.entrance_deg,
                "quantity": check.row.quantity.symbol(),
                "limit": check.row.limit.name(),
                "asked": unit.of_si(check.asked),
                "found": unit.of_si(check.found),
                "unit": unit.symbol(),
                "met": check.is_met(),
            })
        })
        .collect();
    json!({
        "class": verdict.class().id(),
        "met": verdict.is_met(),
        "margin": verdict.tightest().margin(),
        "text": verdict.to_string(),
        "points": points,
    })
}
