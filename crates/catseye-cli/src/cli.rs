//! The command line's verbs.

use clap::{Command, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

use crate::report;
use crate::verbs::{
    albedo, completions, drive, eval, export, fit, furnace, lidar, man, materialx, measure, merge, optics,
    plot, render, roughness, sample, standards,
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
    /// Print results and errors only: no warnings, no progress, no word on what was written
    #[arg(short, long, global = true)]
    quiet: bool,
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    Render(render::Args),
    Merge(merge::Args),
    Furnace(furnace::Args),
    Eval(eval::Args),
    Sample(sample::Args),
    Albedo(albedo::Args),
    Measure(measure::Args),
    Fit(fit::Args),
    Export(export::Args),
    Standards(standards::Args),
    Roughness(roughness::Args),
    Drive(Box<drive::Args>),
    Lidar(lidar::Args),
    Plot(plot::Args),
    Materialx(materialx::Args),
    Optics(optics::Args),
    Completions(completions::Args),
    Man(man::Args),
}

impl Cli {
    /// Reads the command line; wrong use, `--help` and `--version` end the program here.
    pub(crate) fn from_command_line() -> Self {
        Self::from_arg_matches(&command().get_matches()).unwrap_or_else(|error| error.exit())
    }

    /// Runs the verb.
    pub(crate) fn run(self) -> anyhow::Result<()> {
        if self.quiet {
            report::be_quiet();
        }
        match self.verb {
            Verb::Render(args) => args.run(),
            Verb::Merge(args) => args.run(),
            Verb::Furnace(args) => args.run(),
            Verb::Eval(args) => args.run(),
            Verb::Sample(args) => args.run(),
            Verb::Albedo(args) => args.run(),
            Verb::Measure(args) => args.run(),
            Verb::Fit(args) => args.run(),
            Verb::Export(args) => args.run(),
            Verb::Standards(args) => args.run(),
            Verb::Roughness(args) => args.run(),
            Verb::Drive(args) => args.run(),
            Verb::Lidar(args) => args.run(),
            Verb::Plot(args) => args.run(),
            Verb::Materialx(args) => args.run(),
            Verb::Optics(args) => args.run(),
            Verb::Completions(args) => args.run(command()),
            Verb::Man(args) => args.run(command()),
        }
    }
}

/// The whole command line.
fn command() -> Command {
    take_negative_numbers(Cli::command())
}

/// Takes `-1` for the value of the option before it, which knows what is wrong with it, and for no option.
fn take_negative_numbers(command: Command) -> Command {
    let negative = |arg: clap::Arg| {
        let takes_value = arg.get_long().is_some() && arg.get_action().takes_values();
        if takes_value { arg.allow_negative_numbers(true) } else { arg }
    };
    command.mut_args(negative).mut_subcommands(take_negative_numbers)
}
