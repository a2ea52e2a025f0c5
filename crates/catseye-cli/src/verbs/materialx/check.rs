//! `catseye materialx check`: everything that is wrong with documents.

use std::path::PathBuf;

use anyhow::bail;
use catseye_materialx::{Finding, Report, Severity, check};
use serde_json::{Value, json};

use crate::help;
use crate::options::LibraryArgs;
use crate::report;

/// Findings of a file that are printed as text.
const MOST: usize = 50;

/// Check documents: every problem with its place
///
/// An error is what `render`, `measure` and `fit` refuse; a warning what they leave out or approximate, what
/// other programs read otherwise, and what is wrong with nodes that no material uses. One line for each,
/// `file:line:column: ...`; exit code 1 if there is any error.
#[derive(Debug, clap::Args)]
#[command(after_help = help::MATERIALX_CHECK)]
pub(crate) struct Check {
    /// Documents to check
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    library: LibraryArgs,
    /// Print the findings as JSON: file, line, column, severity, element and message of each
    #[arg(long)]
    json: bool,
}

impl Check {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let library = self.library.load()?;
        let (mut errors, mut facts, mut lines) = (0, Vec::new(), Vec::new());
        for file in &self.files {
            let report = check(file, &library);
            let is_error = |finding: &&Finding| finding.severity == Severity::Error;
            errors += report.findings.iter().filter(is_error).count();
            if report.has_errors() {
                errors += report.more;
            }
            facts.extend(report.findings.iter().map(fact));
            lines.extend(text(&file.display().to_string(), &report));
        }
        report::print(self.json, &Value::Array(facts), &lines.join("\n"))?;
        match (errors, self.files.len()) {
            (0, _) => Ok(()),
            (1, _) => bail!("1 error"),
            (errors, 1) => bail!("{errors} errors"),
            (errors, files) => bail!("{errors} errors in {files} files"),
        }
    }
}

fn text(file: &str, report: &Report) -> Vec<String> {
    let mut lines: Vec<String> = report.findings.iter().take(MOST).map(ToString::to_string).collect();
    let more = report.findings.len().saturating_sub(MOST) + report.more;
    if lines.is_empty() {
        lines.push(format!("{file}: no problems"));
    } else if more > 0 {
        lines.push(format!("{file}: and at least {more} more"));
    }
    lines
}

fn fact(finding: &Finding) -> Value {
    let place = finding.place.as_ref();
    json!({
        "file": *finding.file,
        "line": place.map(|place| place.line),
        "column": place.map(|place| place.column),
        "severity": match finding.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
        },
        "element": place.map(|place| &place.element),
        "message": finding.message,
    })
}
