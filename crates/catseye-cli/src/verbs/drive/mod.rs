//! `catseye drive`: what a driver sees of a sign.

mod listing;
mod setting;

use std::path::PathBuf;

use anyhow::{Context as _, bail};
use catseye_photometry::drive::{Scene, Sight};
use catseye_photometry::lamp::Lamp;
use serde_json::Value;

use self::listing::{Row, Seen};
use self::setting::SettingArgs;
use crate::failure::Usage;
use crate::instrument::headlamps;
use crate::instrument::subject::{Subject, SubjectArgs};
use crate::output::Output;
use crate::plot::drive::{DriveFigure, Point, Request};
use crate::plot::figure::FigureArgs;
use crate::progress::Progress;
use crate::{help, report};

/// Subjects that are compared at most: more curves can't be told apart.
const MOST_SUBJECTS: usize = 8;
/// Distances of a table, and points of a curve.
const MOST_DISTANCES: usize = 10_000;
const CURVE_POINTS: u32 = 280;

/// Compute the luminance of a sign in a vehicle's headlamps, as its driver sees it
///
/// Angles between headlamps, sign and eye are exact, on a straight road, a curve, a dip or a crest. A
/// material's R_A is evaluated at them; a table's is read between its rows, its logarithm linear in both
/// angles, the lowest where there are several rotations: below the least angle it is held and marked with *,
/// beyond the greatest there is none. Light of the sky and of other vehicles is left out.
#[derive(Debug, clap::Args)]
#[command(after_help = help::DRIVE)]
pub(crate) struct Args {
    /// What the sign is made of: MaterialX documents, CSV tables of R_A, classes of standards (see `catseye
    /// standards list`), whose values are minima
    #[arg(value_name = "MATERIAL.mtlx|TABLE.csv|STANDARD", required = true)]
    subjects: Vec<String>,
    #[command(flatten)]
    setting: SettingArgs,
    #[command(flatten)]
    reading: SubjectArgs,
    /// Luminance in cd/m2 that the sign should have
    #[arg(long, value_name = "CD/M2")]
    required: Option<f64>,
    /// Trace the light of the headlamps through the scene, too; the values stand in parentheses
    #[arg(long)]
    render: bool,
    /// Draw luminance over distance, .svg or .png, instead of the table
    #[arg(long, value_name = "FILE", conflicts_with_all = ["csv", "json", "render", "output"])]
    plot: Option<PathBuf>,
    /// Print CSV, a row for each distance, subject and headlamp
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Print a JSON array with an object for each distance, subject and headlamp
    #[arg(long)]
    json: bool,
    /// File to write, which appears whole or not at all; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        self.check()?;
        let output = Output::new(&self.output)?;
        let plot = self.plot.as_deref().map(FigureArgs::at).transpose()?;
        let (scene, lamp) = (self.setting.scene(), self.setting.lamp()?);
        let subjects = self.subjects.iter().map(|name| self.reading.subject(name));
        let subjects = subjects.collect::<anyhow::Result<Vec<Subject>>>()?;
        if let Some(plot) = plot {
            return plot.write(&self.figure(&scene, &lamp, &subjects)?, "");
        }
        let progress = Progress::new("distances", self.setting.distance_m.len() as u64);
        let mut rows = Vec::new();
        for &distance in &self.setting.distance_m {
            progress.set(rows.len() as u64);
            rows.push(self.row(&scene, &lamp, &subjects, distance)?);
        }
        let text = if self.csv || self.json {
            let objects = listing::objects(&subjects, &rows);
            match self.csv {
                true => report::csv(&objects)?,
                false => report::json(&objects.into_iter().map(Value::Object).collect())?,
            }
        } else {
            listing::text(&self.setting.title(), &subjects, &rows, self.required)
        };
        output.write(text.as_bytes())
    }

    fn check(&self) -> anyhow::Result<()> {
        if self.subjects.len() > MOST_SUBJECTS {
            bail!(Usage(format!("{} subjects; there is room for {MOST_SUBJECTS}", self.subjects.len())));
        }
        if self.setting.distance_m.len() > MOST_DISTANCES {
            bail!(Usage(format!("--distance-m takes at most {MOST_DISTANCES} distances")));
        }
        if self.required.is_some_and(|required| !(required > 0.0 && required.is_finite())) {
            bail!(Usage("--required must be above 0".to_owned()));
        }
        Ok(())
    }

    /// What is seen at one distance.
    fn row(&self, scene: &Scene, lamp: &Lamp, subjects: &[Subject], distance_m: f64) -> anyhow::Result<Row> {
        let sight = scene.sight(distance_m, lamp).context("--distance-m")?;
        let mut seen = subjects
            .iter()
            .map(|subject| self.seen(&sight, subject))
            .collect::<anyhow::Result<Vec<Seen>>>()?;
        if self.render {
            for (seen, subject) in seen.iter_mut().zip(subjects) {
                let Some((material, model)) = subject.material() else { continue };
                let traced = headlamps::luminance(&sight.view, lamp, material, model, self.reading.channel)?;
                seen.rendered = Some(traced * self.setting.windscreen());
            }
        }
        Ok(Row { distance_m, sight, seen })
    }

    fn seen(&self, sight: &Sight, subject: &Subject) -> anyhow::Result<Seen> {
        let [left, right] = &sight.view.lamps;
        let readings = [subject.read(&left.geometry)?, subject.read(&right.geometry)?];
        let luminances = sight.luminances(readings.map(|reading| reading.r_a.unwrap_or(f64::NAN)));
        let known = |luminance: f64| (!luminance.is_nan()).then_some(luminance * self.setting.windscreen());
        Ok(Seen { readings, luminances: luminances.map(known), rendered: None })
    }

    /// Curves between the least and the greatest distance.
    fn figure(&self, scene: &Scene, lamp: &Lamp, subjects: &[Subject]) -> anyhow::Result<DriveFigure> {
        let fold =
            |start, pick: fn(f64, f64) -> f64| self.setting.distance_m.iter().copied().fold(start, pick);
        let (least, most) = (fold(f64::INFINITY, f64::min), fold(f64::NEG_INFINITY, f64::max));
        if !(most > least) {
            bail!(Usage("--plot needs two distances or more".to_owned()));
        }
        let mut curves = vec![Vec::new(); subjects.len()];
        for step in 0..=CURVE_POINTS {
            let distance_m = least + (most - least) * f64::from(step) / f64::from(CURVE_POINTS);
            for (curve, seen) in curves.iter_mut().zip(self.row(scene, lamp, subjects, distance_m)?.seen) {
                curve.push(Point { distance_m, luminance: seen.luminance(), is_held: seen.is_held() });
            }
        }
        let names = subjects.iter().map(|subject| subject.name.clone());
        DriveFigure::new(Request {
            subtitle: self.setting.title(),
            curves: names.zip(curves).collect(),
            required: self.required,
        })
    }
}
