//! `catseye man`: the manual's pages.

use anyhow::bail;
use clap::Command;
use clap_mangen::Man;

use crate::failure::Usage;
use crate::{help, report};

/// Print a page of the manual, in the form that `man -l` reads
#[derive(Debug, clap::Args)]
#[command(after_help = help::MAN)]
pub(crate) struct Args {
    /// The verb that the page is about, such as `plot lobe` [default: the whole command]
    #[arg(value_name = "VERB")]
    verb: Vec<String>,
}

impl Args {
    pub(crate) fn run(&self, mut command: Command) -> anyhow::Result<()> {
        // Gives the verbs their whole names.
        command.build();
        let mut about = &command;
        for name in &self.verb {
            let Some(found) = about.find_subcommand(name) else {
                bail!(Usage(format!(
                    "there is no verb {:?}; `catseye --help` lists them",
                    self.verb.join(" ")
                )));
            };
            about = found;
        }
        let mut page = Vec::new();
        Man::new(about.clone()).render(&mut page)?;
        report::to_stdout(&page)
    }
}
