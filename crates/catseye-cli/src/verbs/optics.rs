//! `catseye optics`: coefficients of retro-reflection from glass, size and geometry.

use std::path::PathBuf;
use std::str::FromStr;

use catseye_photometry::optics::{Angles, Back, Beads, Coating, Computed, Cubes, Light, Mount};
use catseye_photometry::{Error, Geometry, Row};
use clap::{Subcommand, ValueEnum};
use serde_json::{Value, json};

use crate::failure::Usage;
use crate::output::Output;
use crate::{help, report};

/// Compute R_A of glass beads or corner cubes from first principles, as a table that `fit` and `plot ra` read
///
/// Diffraction included; docs/optics.md has the formulas and says what is not modelled. Not a prediction of a
/// product.
#[derive(Debug, clap::Args)]
#[command(after_help = help::OPTICS)]
pub(crate) struct Args {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    Bead(BeadArgs),
    Cube(CubeArgs),
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        match &self.verb {
            Verb::Bead(args) => args.run(),
            Verb::Cube(args) => args.run(),
        }
    }
}

/// A layer of glass beads with a reflector behind them
#[derive(Debug, clap::Args)]
#[command(after_help = help::OPTICS_BEAD)]
struct BeadArgs {
    /// What is before the beads and between them and the reflector
    #[arg(long, value_enum, default_value_t)]
    mount: MountArg,
    /// Refractive index of the glass, above 1, at most 3 [default: 1.93 exposed, 1.9 encapsulated, 2.2
    /// enclosed]
    #[arg(long, value_name = "N")]
    index: Option<f64>,
    /// Mean diameter in micrometres, 5 to 1000
    #[arg(long, value_name = "UM", default_value_t = Beads::default().diameter_um)]
    diameter_um: f64,
    /// Standard deviation of the diameter over its mean, 0 to 0.3
    #[arg(long, value_name = "SHARE", default_value_t = Beads::default().spread)]
    spread: f64,
    /// Index of the medium that enclosed beads lie in, 1 to 2
    #[arg(long, value_name = "N", default_value_t = 1.5)]
    medium_index: f64,
    /// Radius of the reflector behind enclosed beads over theirs, 1 to 4 [default: in focus]
    #[arg(long, value_name = "RATIO")]
    spacing: Option<f64>,
    /// Transmittance of the film before the beads once through, without its surfaces, above 0, at most 1
    #[arg(long, value_name = "SHARE", default_value_t = 1.0)]
    film: f64,
    /// Share of the area of encapsulated beads that is no cell wall, above 0, at most 1
    #[arg(long, value_name = "SHARE", default_value_t = 0.75)]
    open: f64,
    /// What the reflector is
    #[arg(long, value_enum, default_value_t)]
    back: BackArg,
    /// Reflectance of the reflector, above 0, at most 1
    #[arg(long, value_name = "SHARE", default_value_t = 0.9)]
    reflectance: f64,
    /// Share of the area that the beads cover, above 0, at most 0.9069
    #[arg(long, value_name = "SHARE", default_value_t = Beads::default().packing)]
    packing: f64,
    #[command(flatten)]
    table: TableArgs,
}

/// A value of `--mount`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum MountArg {
    /// The front half in air, the reflector on the back half
    #[default]
    Exposed,
    /// As exposed, in cells of air below a film of index 1.5
    Encapsulated,
    /// In a medium with a flat front, a spacing layer before the reflector
    Enclosed,
}

/// A value of `--back`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum BackArg {
    /// A mirror
    #[default]
    Mirror,
    /// White paint, Lambertian: road markings
    Diffuse,
}

impl BeadArgs {
    fn run(&self) -> anyhow::Result<()> {
        let (mount, usual) = self.mount();
        let beads = Beads {
            index: usual,
            diameter_um: self.diameter_um,
            spread: self.spread,
            mount,
            back: match self.back {
                BackArg::Mirror => Back::Specular(self.reflectance),
                BackArg::Diffuse => Back::Diffuse(self.reflectance),
            },
            packing: self.packing,
            light: self.table.light(),
        };
        let prepared = beads.prepare().map_err(wrong)?;
        self.table.write(&beads.to_string(), &[], |geometry| prepared.r_a(geometry))
    }

    /// Where the beads lie, and their index.
    fn mount(&self) -> (Mount, f64) {
        let Self { film, open, medium_index: medium, .. } = *self;
        match self.mount {
            MountArg::Exposed => (Mount::Exposed, self.index.unwrap_or(1.93)),
            MountArg::Encapsulated => (Mount::Encapsulated { film, open }, self.index.unwrap_or(1.9)),
            MountArg::Enclosed => {
                let index = self.index.unwrap_or(2.2);
                let spacing = self.spacing.unwrap_or_else(|| Beads::focus(index, medium));
                (Mount::Enclosed { medium, spacing, film }, index)
            }
        }
    }
}

/// A sheet of corner cubes with triangular faces
#[derive(Debug, clap::Args)]
#[command(after_help = help::OPTICS_CUBE)]
struct CubeArgs {
    /// Refractive index, above 1, at most 3
    #[arg(long, value_name = "N", default_value_t = Cubes::default().index)]
    index: f64,
    /// Length of the edges that meet at the apex, in micrometres, 10 to 10000
    #[arg(long, value_name = "UM", default_value_t = Cubes::default().leg_um)]
    leg_um: f64,
    /// By how much the dihedral angles at the three edges exceed 90 degrees, in arc minutes: one for all, or
    /// three
    #[arg(long, value_name = "E[,E,E]", default_value = "0")]
    errors_arcmin: Errors,
    /// Standard deviation of random errors besides, in arc minutes, 0 to 60
    #[arg(long, value_name = "E", default_value_t = Cubes::default().error_sd_arcmin)]
    error_sd_arcmin: f64,
    /// Faces with a metal of this reflectance [default: bare, by total internal reflection]
    #[arg(long, value_name = "SHARE")]
    metal: Option<f64>,
    /// All cubes turned alike, not every second one by half a circle
    #[arg(long)]
    single: bool,
    /// Azimuth of the first edge from the datum axis in degrees [default: all azimuths; 0 with --rotation]
    #[arg(long, value_name = "DEG")]
    azimuth_deg: Option<f64>,
    /// Rotation angles in degrees, for cubes of one azimuth
    #[arg(long, value_name = "DEG,...", value_delimiter = ',', allow_hyphen_values = true)]
    rotation: Vec<f64>,
    /// Share of the area that works, above 0, at most 1
    #[arg(long, value_name = "SHARE", default_value_t = Cubes::default().fill)]
    fill: f64,
    #[command(flatten)]
    table: TableArgs,
}

/// A value of `--errors-arcmin`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Errors([f64; 3]);

impl FromStr for Errors {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
        match numbers.as_deref() {
            Ok([all]) => Ok(Self([*all; 3])),
            Ok([a, b, c]) => Ok(Self([*a, *b, *c])),
            _ => Err("one number or three are needed: 4, or 4,-2,0".to_owned()),
        }
    }
}

impl CubeArgs {
    fn run(&self) -> anyhow::Result<()> {
        let cubes = Cubes {
            index: self.index,
            leg_um: self.leg_um,
            errors_arcmin: self.errors_arcmin.0,
            error_sd_arcmin: self.error_sd_arcmin,
            coating: self.metal.map_or(Coating::Air, Coating::Metal),
            pairs: !self.single,
            azimuth_deg: self.azimuth_deg.or((!self.rotation.is_empty()).then_some(0.0)),
            fill: self.fill,
            light: self.table.light(),
        };
        let prepared = cubes.prepare().map_err(wrong)?;
        self.table.write(&cubes.to_string(), &self.rotation, |geometry| prepared.r_a(geometry))
    }
}

/// Where, with what light, and to which file.
#[derive(Debug, clap::Args)]
struct TableArgs {
    /// Observation angles in degrees, above 0, at most 20 [default: 0.1 to 2]
    #[arg(long, value_name = "DEG,...", value_delimiter = ',', allow_hyphen_values = true)]
    observation: Vec<f64>,
    /// Entrance angles in degrees, -85 to 85 [default: 5, 20, 30, 40]
    #[arg(long, value_name = "DEG,...", value_delimiter = ',', allow_hyphen_values = true)]
    entrance: Vec<f64>,
    /// Light of one wavelength in air, 300 to 2000 [default: illuminant A seen by the eye]
    #[arg(long, value_name = "NM")]
    wavelength_nm: Option<f64>,
    /// CSV file to write; `-` is standard output [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print a JSON array with one object per row
    #[arg(long)]
    json: bool,
}

impl TableArgs {
    fn light(&self) -> Light {
        self.wavelength_nm.map_or(Light::White, Light::Monochromatic)
    }

    /// Computes the table and writes it.
    fn write(
        &self,
        what: &str,
        rotation_deg: &[f64],
        r_a: impl Fn(&Geometry) -> f64 + Sync,
    ) -> anyhow::Result<()> {
        let output = self.output.as_deref().map(Output::new).transpose()?;
        let usual = Angles::default();
        let or = |given: &[f64], usual: Vec<f64>| if given.is_empty() { usual } else { given.to_vec() };
        let angles = Angles {
            observation_deg: or(&self.observation, usual.observation_deg),
            entrance_deg: or(&self.entrance, usual.entrance_deg),
            rotation_deg: rotation_deg.to_vec(),
        };
        let source = format!("computed by catseye optics: {what}");
        let Computed { table, left_out } = angles.table(&source, self.wavelength_nm, r_a).map_err(wrong)?;
        if left_out > 0 {
            report::warn(format!(
                "{left_out} of {} values are left out: they are 0 or beyond what instruments read",
                left_out + table.rows().len()
            ));
        }
        let facts: Vec<Value> = table.rows().iter().map(facts).collect();
        let csv = table.to_csv(&[]);
        match output {
            None if self.json => report::print(true, &Value::from(facts), ""),
            None => report::to_stdout(csv.as_bytes()),
            Some(output) => {
                output.write(csv.as_bytes())?;
                let text = format!("wrote {} ({} values)", output.name(), facts.len());
                output.messages().note(self.json, &Value::from(facts), &text)
            }
        }
    }
}

/// What is said of an option out of its range.
fn wrong(error: Error) -> anyhow::Error {
    if let Error::Range { .. } = error { Usage(error.to_string()).into() } else { error.into() }
}

fn facts(row: &Row) -> Value {
    json!({
        "observation_deg": row.observation_deg,
        "entrance_deg": row.entrance_deg,
        "rotation_deg": row.rotation_deg,
        "quantity": row.quantity.symbol(),
        "value": row.value,
        "unit": row.unit.symbol(),
        "source": row.source,
    })
}
