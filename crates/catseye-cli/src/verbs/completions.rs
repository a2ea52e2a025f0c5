//! `catseye completions`: what a shell needs to complete the command's words.

use clap::Command;
use clap_complete::Shell;

use crate::{help, report};

/// Print the completions of a shell
///
/// Put them where the shell looks for them: `~/.local/share/bash-completion/completions/catseye` for bash, a
/// folder of `fpath` as `_catseye` for zsh, `~/.config/fish/completions/catseye.fish` for fish.
#[derive(Debug, clap::Args)]
#[command(after_help = help::COMPLETIONS)]
pub(crate) struct Args {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

impl Args {
    pub(crate) fn run(&self, mut command: Command) -> anyhow::Result<()> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut command, "catseye", &mut script);
        report::to_stdout(&script)
    }
}
