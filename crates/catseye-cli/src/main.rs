//! The `catseye` command: one verb, one file under `verbs`.

mod args;
mod canvas;
mod failure;
mod figure;
mod fitting;
mod help;
mod input;
mod layout;
mod library;
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
    failure::exit_code(args::Cli::parse().run())
}
