//! A single query given as options: a CSV table of one row.

use anyhow::bail;

use super::input::Input;
use super::row::{PARAMS, WO};
use crate::failure::Usage;

/// The options for everything but the query's own argument.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "A single query instead of a table")]
pub(crate) struct PointArgs {
    /// Roughness: `roughness_u`, or `roughness_u` and `roughness_v`
    #[arg(long, value_name = "U[,V]", allow_hyphen_values = true)]
    roughness: Option<String>,
    /// Direction towards the viewer
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    wo: Option<String>,
    /// Colour of single scattering [default: 1,1,1]
    #[arg(long, value_name = "R,G,B", allow_hyphen_values = true)]
    tint: Option<String>,
    /// Colour of the multiple-scattering compensation [default: 0,0,0]
    #[arg(long, value_name = "R,G,B", allow_hyphen_values = true)]
    multiscatter_tint: Option<String>,
}

impl PointArgs {
    /// The table that the options make, `None` where there are none.
    ///
    /// `argument` is the query's own option: its name, its columns and its value.
    pub(crate) fn table(
        &self,
        argument: Option<(&str, [&str; 3], Option<&str>)>,
        has_file: bool,
    ) -> anyhow::Result<Option<Input>> {
        let mut options: Vec<(&str, &[&str], Option<&str>)> = vec![
            ("roughness", &PARAMS[..2], self.roughness.as_deref()),
            ("wo", &WO, self.wo.as_deref()),
            ("tint", &PARAMS[2..5], self.tint.as_deref()),
            ("multiscatter-tint", &PARAMS[5..], self.multiscatter_tint.as_deref()),
        ];
        if let Some((name, columns, value)) = &argument {
            options.push((name, columns, *value));
        }
        if options.iter().all(|(_, _, value)| value.is_none()) {
            return Ok(None);
        }
        if has_file {
            bail!(Usage("give a table or the options of a single query, not both".to_owned()));
        }
        one_row(&options).map(Some)
    }
}

fn one_row(options: &[(&str, &[&str], Option<&str>)]) -> anyhow::Result<Input> {
    let (mut header, mut row) = (Vec::new(), Vec::new());
    for (name, columns, value) in options {
        let Some(value) = value else {
            if name.ends_with("tint") {
                continue;
            }
            bail!(Usage(format!("a single query needs --{name} (see --help)")));
        };
        let mut numbers: Vec<&str> = value.split(',').collect();
        if *name == "roughness" && numbers.len() == 1 {
            numbers.push("");
        }
        if numbers.len() != columns.len() {
            let needed = if *name == "roughness" { "1 or 2".to_owned() } else { columns.len().to_string() };
            bail!(Usage(format!("--{name} {value}: {needed} numbers with commas between them are needed")));
        }
        header.extend_from_slice(columns);
        row.extend(numbers);
    }
    Ok(Input::from_options(&header.join(","), &row.join(",")))
}
