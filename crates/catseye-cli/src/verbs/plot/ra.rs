//! `catseye plot ra`: what a photometer would see, and what a standard asks.

use std::path::PathBuf;

use anyhow::bail;
use catseye::{AnyLobe, Lobe as _, Params};
use catseye_photometry::standards::StandardClass;
use catseye_photometry::{Geometry, Quantity, Row};
use clap::ArgGroup;

use crate::failure::Usage;
use crate::instrument::Channel;
use crate::instrument::goniometer::Photometer;
use crate::instrument::table;
use crate::options::{LibraryArgs, ModelArg, Roughness};
use crate::plot::axes::roughness_label;
use crate::plot::curves::without_width;
use crate::plot::figure::FigureArgs;
use crate::plot::ra::{self, MOST_CURVES, Over, Point, Request};
use crate::{help, report};

/// Entrance angles where neither the command nor a table names any.
const ENTRANCES_DEG: [f64; 3] = [-4.0, 30.0, 45.0];
/// The least observation angle that the axis ends at, in degrees.
const LEAST_END_DEG: f64 = 2.0;
const SIZE: (u32, u32) = (960, 640);

/// `R_A` at a geometry, in cd/lx/m2.
type Coefficient = Box<dyn Fn(&Geometry) -> anyhow::Result<f64>>;

/// R_A over the observation angle, one curve for each entrance angle, with the values of a standard or a
/// table
///
/// Of a material, or of one lobe with --roughness and --tint. Upright triangles are minima, inverted ones
/// maxima, dots are values; each has the colour of its entrance angle.
#[derive(Debug, clap::Args)]
#[command(after_help = help::PLOT_RA)]
#[command(group = ArgGroup::new("subject").required(true))]
pub(crate) struct Args {
    /// MaterialX document with the material to plot
    #[arg(value_name = "MATERIAL.mtlx", group = "subject")]
    document: Option<PathBuf>,
    /// Roughness of a lobe to plot instead, above 0: along the tangent, or along it and across it
    #[arg(long, value_name = "U[,V]", group = "subject")]
    roughness: Option<Roughness>,
    /// Tint of that lobe, in [0, 1]
    #[arg(long, value_name = "TINT", default_value_t = 1.0, conflicts_with = "document")]
    tint: f64,
    /// Values to show: a class of a standard (see `catseye standards list`) or a CSV table
    #[arg(long, value_name = "NAME|TABLE.csv")]
    standard: Option<String>,
    /// Entrance angles in degrees, 1 to 8 of them [default: those of the values]
    #[arg(long, value_name = "DEG,...", value_delimiter = ',', allow_hyphen_values = true)]
    entrance: Option<Vec<f64>>,
    /// Observation angle in degrees at the axis' end [default: where the values end]
    #[arg(long, value_name = "DEG")]
    observation: Option<f64>,
    /// Name of the surface material, where the document has several
    #[arg(long, value_name = "NAME", requires = "document")]
    material: Option<String>,
    #[command(flatten)]
    library: LibraryArgs,
    /// Which lobe reflects
    #[arg(long, value_enum, default_value_t)]
    model: ModelArg,
    /// What is made of the three colour channels
    #[arg(long, value_enum, default_value_t)]
    channel: Channel,
    #[command(flatten)]
    figure: FigureArgs,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let class = self.standard.as_deref().map(table::class).transpose()?;
        let points = class.as_ref().map(points).transpose()?.unwrap_or_default();
        let entrance_deg = self.entrances(&points)?;
        let last = points.iter().map(|point| point.observation_deg).fold(0.0, f64::max);
        let end_deg = self.observation.unwrap_or_else(|| LEAST_END_DEG.max(1.1 * last));
        let least = entrance_deg.iter().fold(f64::INFINITY, |least, &angle| least.min(angle));
        if !(end_deg > 0.0 && end_deg < 90.0 + least) {
            bail!(Usage(format!("--observation {end_deg}: must be above 0 and less than {}", 90.0 + least)));
        }
        let (title, r_a) = self.subject()?;
        let subtitle =
            class.map_or_else(String::new, |class| format!("with the values of {}", class.title()));
        let request = Request {
            title,
            subtitle: Some(subtitle),
            size: SIZE,
            over: Over::Observation,
            curves_deg: entrance_deg,
            x: [0.0, end_deg],
            known: None,
            points,
        };
        self.figure.write(&ra::chart(request, r_a)?, "ra.svg")
    }

    /// What is plotted: its name, and its `R_A`.
    fn subject(&self) -> anyhow::Result<(String, Coefficient)> {
        let r_a = |f, geometry: &Geometry| {
            Quantity::RetroReflectionCoefficient.of_brdf(f, geometry).unwrap_or_default()
        };
        if let Some(path) = &self.document {
            let material = self.library.material(path, self.material.as_deref())?;
            let photometer = Photometer::new(&material, self.model.0, self.channel, None)?;
            let title = format!("Coefficient of retro-reflection of {}", material.name);
            return Ok((title, Box::new(move |geometry| Ok(r_a(photometer.brdf(geometry)?, geometry)))));
        }
        let Roughness([u, v]) = self.roughness.unwrap_or(Roughness([0.0; 2]));
        let (label, tint, model) = (roughness_label([u, v]), self.tint, self.model.0);
        let lobe = AnyLobe::<f64>::new(model, &Params::anisotropic(u, v).with_tint([tint; 3]))?;
        if lobe.is_dirac() {
            bail!(without_width(&label, model));
        }
        let title = format!("Coefficient of retro-reflection of a lobe: roughness {label}, tint {tint}");
        Ok((title, Box::new(move |geometry| Ok(r_a(lobe.eval(geometry.wo, geometry.wi)[0], geometry)))))
    }

    /// The entrance angles: as asked, else those of the points, else the usual ones. Ascending.
    fn entrances(&self, points: &[Point]) -> anyhow::Result<Vec<f64>> {
        let mut angles = match &self.entrance {
            Some(angles) => angles.clone(),
            None if points.is_empty() => ENTRANCES_DEG.to_vec(),
            None => points.iter().map(|point| point.entrance_deg).collect(),
        };
        angles.sort_by(f64::total_cmp);
        angles.dedup();
        let legal = |angle: &f64| angle.abs() < 90.0;
        if angles.iter().all(legal) && angles.len() <= MOST_CURVES {
            return Ok(angles);
        }
        bail!(Usage(match (&self.entrance, &self.standard) {
            (None, Some(name)) => format!(
                "{name} has values at {} entrance angles; choose 1 to {MOST_CURVES} of them with --entrance",
                angles.len()
            ),
            _ => format!("--entrance takes 1 to {MOST_CURVES} angles, each in (-90, 90)"),
        }))
    }
}

/// The values as `R_A`.
fn points(class: &StandardClass) -> anyhow::Result<Vec<Point>> {
    let is_turned = |row: &&Row| row.entrance_2_deg != 0.0 || row.rotation_deg != 0.0;
    let turned = class.rows().iter().filter(is_turned).count();
    if turned > 0 {
        report::warn(format!(
            "{}: {turned} values with a beta_2 or rotation angle are left out: the curves are those of 0",
            class.id()
        ));
    }
    let points: Vec<Point> = class.rows().iter().filter(|row| !is_turned(row)).filter_map(point).collect();
    if points.is_empty() {
        bail!("{}: has no values that are R_A or follow from it without an area or an integral", class.id());
    }
    Ok(points)
}

fn point(row: &Row) -> Option<Point> {
    let geometry = row.geometry();
    let f = row.quantity.to_brdf(row.value?, &geometry)?;
    let uncertainty = row.uncertainty.and_then(|value| row.quantity.to_brdf(value, &geometry));
    let r_a = |f| Quantity::RetroReflectionCoefficient.of_brdf(f, &geometry);
    Some(Point {
        observation_deg: row.observation_deg,
        entrance_deg: row.entrance_deg,
        r_a: r_a(f)?,
        uncertainty: uncertainty.and_then(r_a),
        limit: row.limit,
    })
}
