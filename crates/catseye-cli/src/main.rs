//! The `catseye` command: one verb, one file under `verbs`.

mod canvas;
mod cli;
mod failure;
mod figure;
mod fitting;
mod help;
mod input;
mod layout;
mod options;
mod output;
mod photometer;
mod plot;
mod point;
mod progress;
mod query;
mod report;
mod table;
mod traced;
mod values;
mod verbs;

use std::process::ExitCode;

use clap::Parser as _;

fn main() -> ExitCode {
    failure::exit_code(cli::Cli::parse().run())
}
