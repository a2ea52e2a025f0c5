//! The command line: the verbs, and the options that several of them share.

use catseye::Model;
use clap::{Parser, Subcommand, ValueEnum};

use crate::verbs::{
    albedo, eval, fit, furnace, materialx, measure, openmaterial, plot, render, roughness, sample, standards,
};

/// The retro-reflective BSDF: evaluate it, sample it, plot it, render with it.
#[derive(Debug, Parser)]
#[command(
    name = "catseye",
    version,
    arg_required_else_help = true,
    after_help = "Exit codes: 0 done, 1 failed, 2 used wrongly.\n\
                  Example: catseye eval --roughness 0.15 --wo 0,0,1 --wi 0,0,1"
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    Render(render::Args),
    Furnace(furnace::Args),
    Eval(eval::Args),
    Sample(sample::Args),
    Albedo(albedo::Args),
    Measure(measure::Args),
    Fit(fit::Args),
    Standards(standards::Args),
    Roughness(roughness::Args),
    Plot(plot::Args),
    Materialx(materialx::Args),
    Openmaterial(openmaterial::Args),
}

impl Cli {
    /// Runs the verb.
    pub(crate) fn run(self) -> anyhow::Result<()> {
        match self.verb {
            Verb::Render(args) => args.run(),
            Verb::Furnace(args) => args.run(),
            Verb::Eval(args) => args.run(),
            Verb::Sample(args) => args.run(),
            Verb::Albedo(args) => args.run(),
            Verb::Measure(args) => args.run(),
            Verb::Fit(args) => args.run(),
            Verb::Standards(args) => args.run(),
            Verb::Roughness(args) => args.run(),
            Verb::Plot(args) => args.run(),
            Verb::Materialx(args) => args.run(),
            Verb::Openmaterial(args) => args.run(),
        }
    }
}

/// The lobe's model, by the names of [`Model::name`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct ModelArg(pub(crate) Model);

impl ValueEnum for ModelArg {
    fn value_variants<'a>() -> &'a [Self] {
        const { &[Self(Model::ALL[0]), Self(Model::ALL[1]), Self(Model::ALL[2])] }
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        let help = match self.0 {
            Model::Reciprocal => "The proposal's lobe, with multiple-scattering compensation",
            Model::Edwards => "The paper's own lobe: albedo 1, not reciprocal",
            Model::BackVector => {
                "The microfacet lobe of MaterialX 1.39.5 with retroreflective = true, of the same peak"
            }
        };
        Some(clap::builder::PossibleValue::new(self.0.name()).help(help))
    }
}

/// The type that a query is answered in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Precision {
    /// Double precision.
    #[default]
    F64,
    /// Single precision, as shaders and renderers use it.
    F32,
}

/// What computes the answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Backend {
    /// The Rust code.
    #[default]
    Cpu,
    /// The shader twin: part of the command line's contract, not of this version.
    #[value(hide = true)]
    Gpu,
}
