//! How a failed command ends: one line on standard error and an exit code.

use std::fmt;
use std::io;
use std::process::ExitCode;

use crate::interrupt::INTERRUPTED;

/// The command was asked for something that it can't do, as opposed to failing at something that it can: exit
/// code 2.
#[derive(Debug)]
pub(crate) struct Usage(pub(crate) String);

impl fmt::Display for Usage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Usage {}

/// The command was interrupted and has kept what it had: exit code 130, as where it is ended at once.
#[derive(Debug)]
pub(crate) struct Interrupted(pub(crate) String);

impl fmt::Display for Interrupted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "interrupted{}", self.0)
    }
}

impl std::error::Error for Interrupted {}

/// Prints the error, if there is one, and chooses the exit code: 0 done, 1 failed, 2 used wrongly.
pub(crate) fn exit_code(result: anyhow::Result<()>) -> ExitCode {
    let Err(error) = result else { return ExitCode::SUCCESS };
    if is_broken_pipe(&error) {
        return ExitCode::SUCCESS;
    }
    eprintln!("catseye: {}", line(&error));
    match &error {
        error if error.is::<Usage>() => ExitCode::from(2),
        error if error.is::<Interrupted>() => ExitCode::from(INTERRUPTED),
        _ => ExitCode::FAILURE,
    }
}

/// The error and its causes on one line, which several would hide the place in. A cause that the error before
/// it has named already is left out.
fn line(error: &anyhow::Error) -> String {
    let mut text = String::new();
    for cause in error.chain().map(ToString::to_string) {
        if !text.contains(&cause) {
            let colon = if text.is_empty() { "" } else { ": " };
            text = format!("{text}{colon}{cause}");
        }
    }
    text.replace('\n', " ")
}

/// Whether the reader of our output has gone, `catseye ... | head` for instance: it has all it wanted.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        cause.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
    })
}

#[cfg(test)]
mod tests {
    use super::line;

    #[test]
    fn a_cause_is_named_once() {
        let full = || anyhow::anyhow!("no space left");
        assert_eq!(line(&full().context("x.png: no space left")), "x.png: no space left");
        assert_eq!(
            line(&full().context("x.png: can't be written")),
            "x.png: can't be written: no space left"
        );
    }
}
