//! `catseye plot`: pictures of the lobes, of their albedo and of coefficients of retro-reflection.

mod ra;

use std::path::PathBuf;

use anyhow::bail;
use clap::Subcommand;

use crate::failure::Usage;
use crate::help;
use crate::options::ModelArg;
use crate::plot::figure::finish;
use crate::plot::{albedo, lobe};

/// Plot the lobes, their albedo or R_A, as SVG or PNG
#[derive(Debug, clap::Args)]
#[command(after_help = help::PLOT, arg_required_else_help = true)]
pub(crate) struct Args {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    Lobe(LobeArgs),
    Albedo(AlbedoArgs),
    Ra(Box<ra::Args>),
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        match &self.what {
            What::Lobe(args) => args.run(),
            What::Albedo(args) => args.run(),
            What::Ra(args) => args.run(),
        }
    }
}

/// Which way the light goes: f cos in the plane of incidence, one panel for each angle, one curve for each model
///
/// The back-vector model has the GGX alpha that gives it the peak of the others at normal incidence:
/// sqrt(r^2 / (r^2 + 2)) for the roughness r.
#[derive(Debug, clap::Args)]
#[command(after_help = help::PLOT_LOBE)]
struct LobeArgs {
    /// File to write, .svg or .png
    #[arg(short, long, value_name = "FILE", default_value = "lobe.svg")]
    output: PathBuf,
    /// Roughness along the tangent, above 0
    #[arg(long, value_name = "R", default_value_t = 0.3)]
    roughness: f64,
    /// Roughness across the tangent [default: as --roughness]
    #[arg(long, value_name = "R")]
    roughness_v: Option<f64>,
    /// Angles of the incoming light from the normal, in degrees, 1 to 4 of them
    #[arg(long, value_name = "DEG,...", value_delimiter = ',', default_values_t = [0.0, 30.0, 60.0])]
    theta: Vec<f64>,
    /// Angle of the plane of incidence from the tangent, in degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true)]
    phi: f64,
    /// Show only this model [default: all]
    #[arg(long, value_enum)]
    model: Option<ModelArg>,
    /// Shape of the diagram [default: polar, for narrow lobes cartesian]
    #[arg(long, value_enum)]
    axes: Option<lobe::Axes>,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
}

impl LobeArgs {
    fn run(&self) -> anyhow::Result<()> {
        if self.theta.len() > 4 || self.theta.iter().any(|theta| !(0.0..90.0).contains(theta)) {
            bail!(Usage("--theta takes 1 to 4 angles, each in [0, 90)".to_owned()));
        }
        if !self.phi.is_finite() {
            bail!(Usage("--phi must be finite".to_owned()));
        }
        let request = lobe::Request {
            roughness: [self.roughness, self.roughness_v.unwrap_or(self.roughness)],
            theta_deg: self.theta.clone(),
            phi_deg: self.phi,
            models: self.model.map_or_else(|| catseye::Model::ALL.to_vec(), |model| vec![model.0]),
            axes: self.axes,
        };
        finish(&lobe::LobeFigure::new(request)?, &self.output, self.json)
    }
}

/// How much light comes back: albedo over the angle of incidence, one curve for each roughness
#[derive(Debug, clap::Args)]
#[command(after_help = help::PLOT_ALBEDO)]
struct AlbedoArgs {
    /// File to write, .svg or .png
    #[arg(short, long, value_name = "FILE", default_value = "albedo.svg")]
    output: PathBuf,
    /// Roughnesses, 1 to 12 of them [default: a range of them]
    #[arg(long, value_name = "R,...", value_delimiter = ',')]
    roughness: Option<Vec<f64>>,
    /// Which lobe
    #[arg(long, value_enum, default_value_t)]
    model: ModelArg,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
}

impl AlbedoArgs {
    fn run(&self) -> anyhow::Result<()> {
        if self.roughness.as_ref().is_some_and(|values| values.len() > 12) {
            bail!(Usage("--roughness takes at most 12 values here".to_owned()));
        }
        finish(&albedo::AlbedoFigure::new(self.model.0, self.roughness.as_deref())?, &self.output, self.json)
    }
}
