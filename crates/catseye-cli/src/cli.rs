//! The command line's verbs.

use clap::{Parser, Subcommand};

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
