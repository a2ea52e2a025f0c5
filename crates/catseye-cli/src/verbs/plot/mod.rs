//! `catseye plot`: pictures of the lobes, of their albedo and of coefficients of retro-reflection.

mod ra;

use std::path::PathBuf;

use anyhow::bail;
use clap::Subcommand;

use crate::failure::Usage;
use crate::help;
use crate::options::{ModelArg, Roughness};
use crate::output::{Output, must_end_in};
use crate::plot::figure::{Figure as _, FigureArgs, PNG_SCALE};
use crate::plot::{albedo, lobe, optics, spheres};

/// Plot the lobes, their albedo, R_A or spheres, as SVG or PNG
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
    Optics(OpticsArgs),
    Spheres(SpheresArgs),
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        match &self.what {
            What::Lobe(args) => args.run(),
            What::Albedo(args) => args.run(),
            What::Ra(args) => args.run(),
            What::Optics(args) => args.run(),
            What::Spheres(args) => args.run(),
        }
    }
}

/// Which way the light goes: f cos in the plane of incidence, a panel for each roughness and angle, a curve
/// for each model
///
/// The back-vector model has the GGX alpha that gives it the peak of the others at normal incidence:
/// sqrt(r^2 / (r^2 + 2)) for the roughness r.
#[derive(Debug, clap::Args)]
#[command(after_help = help::PLOT_LOBE)]
struct LobeArgs {
    /// Roughnesses, above 0: along the tangent, or along it and across it
    #[arg(long, value_name = "U[,V]", num_args = 1.., default_value = "0.3")]
    roughness: Vec<Roughness>,
    /// Angles of the incoming light from the normal, in degrees
    #[arg(long, value_name = "DEG,...", value_delimiter = ',', default_values_t = [0.0, 30.0, 60.0])]
    #[arg(allow_hyphen_values = true)]
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
    #[command(flatten)]
    figure: FigureArgs,
}

impl LobeArgs {
    fn run(&self) -> anyhow::Result<()> {
        if self.theta.iter().any(|theta| !(0.0..90.0).contains(theta)) {
            bail!(Usage("--theta takes angles in [0, 90)".to_owned()));
        }
        let panels = self.roughness.len() * self.theta.len();
        if panels > 4 {
            bail!(Usage(format!("--roughness and --theta ask for {panels} panels; there is room for 4")));
        }
        if !self.phi.is_finite() {
            bail!(Usage("--phi must be finite".to_owned()));
        }
        let request = lobe::Request {
            roughness: self.roughness.iter().map(|roughness| roughness.0).collect(),
            theta_deg: self.theta.clone(),
            phi_deg: self.phi,
            models: self.model.map_or_else(|| catseye::Model::ALL.to_vec(), |model| vec![model.0]),
            axes: self.axes,
        };
        self.figure.write(&lobe::LobeFigure::new(request)?, "lobe.svg")
    }
}

/// How much light comes back: albedo over the angle of incidence, one curve for each roughness
#[derive(Debug, clap::Args)]
#[command(after_help = help::PLOT_ALBEDO)]
struct AlbedoArgs {
    /// Roughness of each curve, 1 to 12 of them [default: from 0.05 to infinity]
    #[arg(long, value_name = "U[,V]", num_args = 1..)]
    roughness: Vec<Roughness>,
    /// Which lobe
    #[arg(long, value_enum, default_value_t)]
    model: ModelArg,
    #[command(flatten)]
    figure: FigureArgs,
}

impl AlbedoArgs {
    fn run(&self) -> anyhow::Result<()> {
        if self.roughness.len() > 12 {
            bail!(Usage("--roughness takes at most 12 values here".to_owned()));
        }
        let roughnesses: Vec<[f64; 2]> = self.roughness.iter().map(|roughness| roughness.0).collect();
        self.figure.write(&albedo::AlbedoFigure::new(self.model.0, &roughnesses)?, "albedo.svg")
    }
}

/// R_A of glass beads and corner cubes, and of the lobes that are fitted to them
#[derive(Debug, clap::Args)]
#[command(after_help = help::PLOT_OPTICS)]
struct OpticsArgs {
    #[command(flatten)]
    figure: FigureArgs,
}

impl OpticsArgs {
    fn run(&self) -> anyhow::Result<()> {
        self.figure.write(&optics::OpticsFigure::new()?, "optics.svg")
    }
}

/// What the node looks like beside MaterialX's `retroreflective`: spheres of both lobes, a lamp half way to
/// the camera
#[derive(Debug, clap::Args)]
#[command(after_help = help::PLOT_SPHERES)]
struct SpheresArgs {
    /// Picture to write, .png; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "spheres.png")]
    output: PathBuf,
    /// Roughnesses, 1 to 4 of them, each from 0.01 to 10
    #[arg(long, value_name = "R", num_args = 1.., default_values_t = [0.05, 0.15, 0.5])]
    roughness: Vec<f32>,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
}

impl SpheresArgs {
    fn run(&self) -> anyhow::Result<()> {
        if self.roughness.len() > 4 || self.roughness.iter().any(|r| !(0.01..=10.0).contains(r)) {
            bail!(Usage("--roughness takes 1 to 4 values, each from 0.01 to 10".to_owned()));
        }
        must_end_in(&self.output, "png")?;
        let output = Output::new(&self.output)?;
        let sheet = spheres::figure(&self.roughness)?;
        output.write(&sheet.png()?)?;
        let (width, height) = sheet.size();
        let (width, height) = (width * PNG_SCALE, height * PNG_SCALE);
        let facts = serde_json::json!({ "output": output.name(), "width": width, "height": height });
        output.messages().note(self.json, &facts, &format!("wrote {} ({width} x {height})", output.name()))
    }
}
