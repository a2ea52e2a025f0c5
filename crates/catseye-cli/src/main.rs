//! The `catseye` command: one verb, one file under `verbs`.

mod cli;
mod failure;
mod help;
mod instrument;
mod interrupt;
mod options;
mod output;
mod plot;
mod progress;
mod query;
mod report;
mod verbs;

use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = cli::Cli::from_command_line();
    interrupt::install();
    failure::exit_code(cli.run())
}
