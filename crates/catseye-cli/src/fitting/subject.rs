//! What is fitted: the rows of one material, from a file or a standard.

use std::path::Path;

use anyhow::{Context as _, anyhow, bail};
use catseye_photometry::fit::{Aim, Observation};
use catseye_photometry::standards::Catalogue;
use catseye_photometry::{Colour, Limit, Need, Quantity, Row, Table};

/// The values of one material.
#[derive(Clone, Debug)]
pub(crate) struct Subject {
    /// The name of the file or of the standard's class.
    pub(crate) name: String,
    /// What the rows say they are of, such as `ASTM D4956-01 Type I white`; empty where they say nothing.
    pub(crate) title: String,
    /// The rows with values that can be fitted.
    pub(crate) rows: Vec<Row>,
}

impl Subject {
    /// The material that `name` means: a CSV file, or else a class of a standard.
    pub(crate) fn find(name: &str, only: Option<&str>) -> anyhow::Result<Self> {
        let path = Path::new(name);
        let is_file = path.exists() || path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
        let table = if is_file {
            Table::read(path, Need::Values)?
        } else {
            Catalogue::embedded()?.find(name)?.table().clone()
        };
        Self::of_table(&table, only)
    }

    fn of_table(table: &Table, only: Option<&str>) -> anyhow::Result<Self> {
        let wanted = only.map(plain);
        let rows = table.rows().iter();
        let rows: Vec<Row> = rows
            .filter(|row| wanted.as_ref().is_none_or(|wanted| plain(&title(row)).contains(wanted)))
            .cloned()
            .collect();
        let Some(first) = rows.first() else {
            bail!("{}: no row is of {:?}; there are: {}", table.name(), only.unwrap_or_default(), titles(table.rows()));
        };
        // A standard's class may come from several of its editions: the catalogue has joined them.
        let is_class = |row: &Row| (&row.class, &row.colour) == (&first.class, &first.colour);
        if only.is_none() && !rows.iter().all(is_class) && !is_joined(&rows) {
            bail!("{}: holds several materials; choose one with --only: {}", table.name(), titles(&rows));
        }
        Ok(Self { name: table.name().to_owned(), title: title(first), rows })
    }

    /// The colour that the rows name, or white.
    pub(crate) fn colour(&self) -> Colour {
        self.rows.first().and_then(|row| Colour::named(&row.colour)).unwrap_or(Colour::WHITE)
    }

    /// Where the values come from, each source once.
    pub(crate) fn sources(&self) -> Vec<&str> {
        let mut sources = Vec::new();
        for row in &self.rows {
            if !row.source.is_empty() && !sources.contains(&row.source.as_str()) {
                sources.push(&row.source);
            }
        }
        sources
    }

    /// The rows as a fit sees them.
    pub(crate) fn observations(
        &self,
        limits: bool,
        area_m2: Option<f64>,
    ) -> anyhow::Result<Vec<Observation>> {
        let observation = |row: &Row| {
            let aim = match (row.limit, limits) {
                (Limit::Minimum, true) => Aim::AtLeast,
                (Limit::Maximum, _) => Aim::AtMost,
                _ => Aim::Equal,
            };
            Observation::from_row(row, aim, area_m2).map_err(|error| {
                anyhow!(error).context(format!("{}:{}", self.name, row.line))
            })
        };
        let observations: anyhow::Result<Vec<_>> = self.rows.iter().map(observation).collect();
        if area_m2.is_none() && self.rows.iter().any(|row| row.quantity == Quantity::LuminousIntensity) {
            return observations.context("these are coefficients of luminous intensity: --area-m2 is needed");
        }
        observations
    }

    /// Whether a row is the luminance of the material by day.
    pub(crate) fn has_luminance_factor(&self) -> bool {
        self.rows.iter().any(|row| row.quantity == Quantity::LuminanceFactor)
    }
}

/// Whether the rows are those of one class that came with the program.
fn is_joined(rows: &[Row]) -> bool {
    let mut colours: Vec<&str> = rows.iter().map(|row| row.colour.as_str()).collect();
    colours.dedup();
    let mut ids: Vec<_> = rows.iter().map(|row| row.cells.first()).collect();
    ids.dedup();
    colours.len() == 1 && ids.len() == 1 && ids[0].is_some_and(|id| id.contains(':'))
}

fn title(row: &Row) -> String {
    let words = [&row.standard, &row.class, &row.colour];
    words.into_iter().filter(|word| !word.is_empty()).cloned().collect::<Vec<_>>().join(" ")
}

fn titles(rows: &[Row]) -> String {
    let mut titles: Vec<String> = rows.iter().map(title).collect();
    titles.sort();
    titles.dedup();
    titles.join("; ")
}

/// Letters and digits alone, in lower case.
fn plain(text: &str) -> String {
    text.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
