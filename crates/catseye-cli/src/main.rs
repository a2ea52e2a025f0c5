//! The `catseye` command: one verb, one file under `verbs`.

mod args;
mod failure;
mod help;
mod input;
mod layout;
mod output;
mod point;
mod progress;
mod query;
mod table;
mod verbs;

use std::process::ExitCode;

use clap::Parser as _;

fn main() -> ExitCode {
    failure::exit_code(args::Cli::parse().run())
}
