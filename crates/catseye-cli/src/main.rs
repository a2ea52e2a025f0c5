//! The `catseye` command: one verb, one file under `verbs`.

mod cli;
mod failure;
mod help;
mod instrument;
mod options;
mod output;
mod plot;
mod progress;
mod query;
mod report;
mod verbs;

use std::process::ExitCode;

use clap::Parser as _;

fn main() -> ExitCode {
    failure::exit_code(cli::Cli::parse().run())
}
