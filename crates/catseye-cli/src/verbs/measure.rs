//! `catseye measure`: a virtual retroreflectometer.

use std::path::PathBuf;

use anyhow::{Context as _, bail};
use catseye_materialx::Material;
use catseye_photometry::standards::{Catalogue, StandardClass};
use catseye_photometry::verdict::{Kind, Unjudged, Verdict, verdicts};
use catseye_photometry::{Apertures, Geometry, Limit, Quantity, Row, Table};
use catseye_render::Estimate;
use clap::ValueEnum;
use clap::builder::PossibleValue;
use serde_json::{Map, Value, json};

use crate::failure::Usage;
use crate::instrument::goniometer::Photometer;
use crate::instrument::retroreflectometer::{Retroreflectometer, SAMPLES};
use crate::instrument::table::{ENTRANCES_DEG, OBSERVATIONS_DEG};
use crate::instrument::{Channel, check_area, table};
use crate::options::MaterialArgs;
use crate::output::Output;
use crate::progress::Progress;
use crate::{help, report};

/// Measure a material as a retroreflectometer would
///
/// Answers the rows of a table with the material's value in a column `model`, in the row's unit: R_A in
/// cd/lx/m2 where neither `quantity` nor `unit` say something else. Observation and entrance angles are those
/// of the CIE goniometer system; where a row has apertures, the value is the mean over them. Colours count as
/// luminance in linear Rec. 709. What the surface emits and the mirror image of the lamp in a smooth coat are
/// not measured; a lobe of roughness 0, which returns all light in one direction, is an error.
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
    /// Say which classes of standards the material meets, and where it fails the others, instead of the
    /// rows; exit code 1 where a class that --standard asks for is not met
    #[arg(long, conflicts_with = "geometry")]
    verdict: bool,
    /// Judge by the classes of this colour [default: white; of --standard, all that it names]
    #[arg(long, value_name = "COLOUR", requires = "verdict")]
    colour: Option<String>,
    /// Judge by the classes of this kind [default: reflector with --area-m2, else sheeting; of --standard,
    /// the kind that it names]
    #[arg(long, value_enum, requires = "verdict")]
    kind: Option<KindArg>,
    /// Guard band: a limit is met only with so much to spare
    #[arg(long, value_name = "PERCENT", default_value = "0", requires = "verdict", value_parser = guard)]
    guard: f64,
    /// File to write, which appears whole or not at all; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
    /// Write the rows as measured data that `fit` and `plot ra` read: the model's value as `value`, with
    /// --instrument its uncertainty and apertures, and the material as source
    #[arg(long, conflicts_with_all = ["verdict", "json"])]
    submission: bool,
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
        let (text, missed) = match self.verdict {
            true => self.judge(&photometer)?,
            false if self.instrument => (self.trace(&material)?, None),
            false => (self.measure(&photometer)?, None),
        };
        output.write(text.as_bytes())?;
        missed.map_or(Ok(()), |missed| bail!("{}: {missed}", self.subject.name()))
    }

    /// The rows with the column `model`.
    fn measure(&self, photometer: &Photometer) -> anyhow::Result<String> {
        self.answer(["model"], |row| {
            let Geometry { wo, wi } = row.geometry();
            let Some(apertures) = row.apertures else {
                return Ok([photometer.measure(row.quantity, &row.geometry())?]);
            };
            let mut failure = None;
            let at = |wo, wi| {
                let value = photometer.measure(row.quantity, &Geometry { wo, wi });
                value.unwrap_or_else(|error| {
                    failure = Some(error);
                    f64::NAN
                })
            };
            let mean = apertures.rule()?.mean(wo, wi, at);
            failure.map_or(Ok([mean]), Err)
        })
    }

    /// The rows with the columns `model` and `standard_error`.
    fn trace(&self, material: &Material) -> anyhow::Result<String> {
        let (model, channel, area, samples) =
            (self.subject.model(), self.channel, self.area_m2, self.samples);
        let instrument = Retroreflectometer { material, model, channel, area, samples };
        self.answer(["model", "standard_error"], |row| {
            if row.apertures.is_some_and(|apertures| !is_of_instrument(apertures)) {
                bail!("the instrument's apertures are 0.1 degrees; others are measured without --instrument");
            }
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
        if table.rows().iter().any(|row| row.wavelength_nm.is_some()) {
            report::warn(format!(
                "{}: wavelength_nm is not looked at: a material has three channels of visible light",
                table.name()
            ));
        }
        if self.submission {
            return Ok(self.submitted(&table, &answers));
        }
        // As in every table of the command: the digits that give the same value back.
        let column = |i: usize| answers.iter().map(|answer| format!("{:?}", answer[i])).collect();
        let columns: Vec<(&str, Vec<String>)> =
            names.iter().enumerate().map(|(i, name)| (*name, column(i))).collect();
        Ok(table.to_csv(&columns))
    }

    /// The rows as measured data.
    fn submitted<const N: usize>(&self, table: &Table, answers: &[[f64; N]]) -> String {
        let each = |text: &str| vec![text.to_owned(); answers.len()];
        let column = |i: usize| answers.iter().map(|answer| format!("{:?}", answer[i])).collect();
        let of_rows = |text: fn(&Row) -> &'static str| {
            table.rows().iter().map(|row| text(row).to_owned()).collect::<Vec<_>>()
        };
        let mut columns = vec![
            ("quantity", of_rows(|row| row.quantity.symbol())),
            ("value", column(0)),
            ("unit", of_rows(|row| row.unit.symbol())),
        ];
        if N > 1 {
            columns.push(("uncertainty", column(1)));
            let degrees = Apertures::ASTM_E810.source.to_degrees().to_string();
            columns.push(("source_aperture_deg", each(&degrees)));
            columns.push(("receiver_aperture_deg", each(&degrees)));
        }
        columns.push(("limit", each(Limit::Typical.name())));
        columns.push(("source", each(&format!("measured from {} by catseye", self.subject.name()))));
        table.to_csv(&columns)
    }

    fn table(&self) -> anyhow::Result<Table> {
        if let Some(path) = &self.geometry {
            return table::read_geometries(path);
        }
        if let Some(name) = &self.standard {
            return Ok(table::joined(name, &table::classes(name)?));
        }
        table::grid(&OBSERVATIONS_DEG, &ENTRANCES_DEG)
    }

    /// A line for each class, and what is said where one that was asked for is not met.
    fn judge(&self, photometer: &Photometer) -> anyhow::Result<(String, Option<String>)> {
        let classes = self.classes()?;
        // A material that can't be measured fails no standard.
        let first = classes.first().map(|class| class.rows()[0].geometry());
        first.map(|geometry| photometer.brdf(&geometry)).transpose()?;
        let measure = |quantity, geometry: &_| photometer.measure(quantity, geometry).ok();
        let (all, none) = verdicts(&classes, 0.01 * self.guard, measure);
        if all.is_empty() {
            bail!(
                "none of these has limits that can be judged: R_I needs --area-m2, and typical values are no \
                 limits"
            );
        }
        let is_asked = self.standard.is_some();
        let unjudged = none.iter().filter(|_| is_asked);
        let text = if self.json {
            let rest = unjudged.clone().map(|(class, reason)| unjudged_object(class, *reason));
            report::json(&all.iter().map(verdict_object).chain(rest).collect())?
        } else {
            let rest = unjudged.clone().map(|(class, reason)| unjudged_line(class, *reason));
            all.iter().map(Verdict::to_string).chain(rest).map(|line| line + "\n").collect()
        };
        let (asked, met) = (all.len() + none.len(), all.iter().filter(|verdict| verdict.is_met()).count());
        let missed = format!("{} of {asked} classes asked for not met", asked - met);
        Ok((text, (is_asked && met < asked).then_some(missed)))
    }

    /// The classes to judge by, of one kind.
    fn classes(&self) -> anyhow::Result<Vec<StandardClass>> {
        let mut classes = match (&self.standard, &self.colour) {
            (Some(name), None) => table::classes(name)?,
            (Some(name), Some(colour)) => of_colour(table::classes(name)?, colour)?,
            (None, colour) => {
                let mut all = Catalogue::embedded()?.classes().to_vec();
                all.retain(|class| !class.is_product());
                of_colour(all, colour.as_deref().unwrap_or("white"))?
            }
        };
        let has = |kind: &Kind| classes.iter().any(|class| Kind::of(class) == *kind);
        let usual = [Kind::Sheeting, Kind::Marking, Kind::Reflector];
        let usual = self.area_m2.map(|_| Kind::Reflector).into_iter().chain(usual);
        let Some(kind) = self.kind.map_or_else(|| usual.clone().find(has), |kind| Some(kind.0).filter(has))
        else {
            let names: Vec<&str> = usual.filter(has).map(Kind::name).collect();
            bail!(Usage(format!("--kind: the classes are of the kind {}", names.join(" and "))));
        };
        let before = classes.len();
        classes.retain(|class| Kind::of(class) == kind);
        if self.standard.is_some() && classes.len() < before {
            let others = before - classes.len();
            report::warn(format!("{others} classes of another kind than {} are left out", kind.name()));
        }
        Ok(classes)
    }
}

/// A kind of classes as an option.
#[derive(Clone, Copy, Debug)]
struct KindArg(Kind);

impl ValueEnum for KindArg {
    fn value_variants<'a>() -> &'a [Self] {
        &[Self(Kind::Sheeting), Self(Kind::Marking), Self(Kind::Reflector)]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.0.name()))
    }
}

/// A guard band in percent, with or without the sign.
fn guard(text: &str) -> Result<f64, String> {
    let number = text.trim_end_matches('%').trim_end().parse::<f64>().ok();
    number.filter(|guard| (0.0..=100.0).contains(guard)).ok_or_else(|| "must be 0 to 100 %".to_owned())
}

/// The classes of a colour, by the last part of their name.
fn of_colour(mut classes: Vec<StandardClass>, colour: &str) -> anyhow::Result<Vec<StandardClass>> {
    let colour_of = |class: &StandardClass| class.id().rsplit(':').next().unwrap_or_default().to_owned();
    let wanted = colour.to_lowercase().replace(' ', "-");
    let mut known: Vec<String> = classes.iter().map(colour_of).collect();
    classes.retain(|class| colour_of(class) == wanted);
    if classes.is_empty() {
        known.sort();
        known.dedup();
        bail!(Usage(format!("--colour {colour}: no class has it; known are {}", known.join(", "))));
    }
    Ok(classes)
}

/// A row as JSON: its cells by their column, numbers where the column is one of numbers, and what was
/// measured.
fn object<'a>(table: &Table, row: &Row, answer: impl Iterator<Item = (&'a str, f64)>) -> Value {
    let is_number = |name: &str| ["_deg", "_nm"].iter().any(|unit| name.ends_with(unit)) || name == "value";
    let mut object = Map::new();
    for (name, cell) in table.header().iter().zip(&row.cells) {
        let number = cell.parse::<f64>().ok().filter(|_| is_number(name));
        object.insert(name.clone(), number.map_or_else(|| json!(cell), |number| json!(number)));
    }
    object.extend(answer.map(|(name, value)| (name.to_owned(), json!(value))));
    Value::Object(object)
}

/// Whether apertures are those of the traced instrument.
fn is_of_instrument(apertures: Apertures) -> bool {
    let Apertures { source, receiver } = Apertures::ASTM_E810;
    (apertures.source / source - 1.0).abs() < 1e-6 && (apertures.receiver / receiver - 1.0).abs() < 1e-6
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
                "rotation_deg": check.row.rotation_deg,
                "quantity": check.row.quantity.symbol(),
                "limit": check.row.limit.name(),
                "asked": unit.of_si(check.asked),
                "found": unit.of_si(check.found),
                "unit": unit.symbol(),
                "standing": check.standing(verdict.guard()).name(),
            })
        })
        .collect();
    let judged: Vec<&str> = verdict.judged().into_iter().map(Quantity::symbol).collect();
    json!({
        "class": verdict.class().id(),
        "kind": Kind::of(verdict.class()).name(),
        "met": verdict.is_met(),
        "standing": verdict.standing().name(),
        "margin": verdict.tightest().margin(),
        "guard": verdict.guard(),
        "judged": judged,
        "not_judged": verdict.not_judged(),
        "text": verdict.to_string(),
        "points": points,
    })
}

/// A class without a verdict that was asked for.
fn unjudged_object(class: &StandardClass, reason: Unjudged) -> Value {
    let (kind, text) = (Kind::of(class).name(), unjudged_line(class, reason));
    json!({ "class": class.id(), "kind": kind, "met": false, "standing": "not judged", "text": text })
}

fn unjudged_line(class: &StandardClass, reason: Unjudged) -> String {
    format!("not judged: {}: {reason}", class.title())
}
