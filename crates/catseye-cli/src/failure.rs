//! How a failed command ends: one line on standard error and an exit code.

use std::fmt;
use std::io;
use std::process::ExitCode;

/// The command was asked for something that it can't do, as opposed to failing at something that it can: exit code 2.
#[derive(Debug)]
pub(crate) struct Usage(pub(crate) String);

impl fmt::Display for Usage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Usage {}

/// Prints the error, if there is one, and chooses the exit code: 0 done, 1 failed, 2 used wrongly.
pub(crate) fn exit_code(result: anyhow::Result<()>) -> ExitCode {
    let Err(error) = result else { return ExitCode::SUCCESS };
    if is_broken_pipe(&error) {
        return ExitCode::SUCCESS;
    }
    // A message of several lines would hide the place that it names.
    eprintln!("catseye: {}", format!("{error:#}").replace('\n', " "));
    if error.is::<Usage>() { ExitCode::from(2) } else { ExitCode::FAILURE }
}

/// Whether the reader of our output has gone, `catseye ... | head` for instance: it has all it wanted.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        cause.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
    })
}
