//! What is fitted: the rows of one material, or a measured BRDF, from a file or a standard.

use std::path::Path;

use anyhow::{Context as _, anyhow, bail};
use catseye_photometry::brdf::{Brdf, Cosine, Selection};
use catseye_photometry::fit::{Aim, Observation};
use catseye_photometry::openmaterial::{Assumption, OpenMaterial};
use catseye_photometry::standards::StandardClass;
use catseye_photometry::{ApertureRule, Colour, Error, Limit, Quantity, Row, Table};

use crate::failure::Usage;
use crate::instrument::table;

/// Samples of a measured BRDF that a fit looks at: more of them make it slower and no better.
const BRDF_SAMPLES: usize = 400;

/// The values of one material.
#[derive(Clone, Debug)]
pub(crate) struct Subject {
    /// The name of the file or of the standard's class.
    pub(crate) name: String,
    /// What the rows say they are of, such as `ASTM D4956 Type I white`; the name where they say nothing.
    pub(crate) title: String,
    /// The rows with values that can be fitted; none of a measured BRDF, which has too many to list.
    pub(crate) rows: Vec<Row>,
    /// The measured BRDF, where it is one.
    brdf: Option<Brdf>,
    /// The roughness that goes with the values, where the file's format says so little that one is assumed.
    pub(crate) roughness: Option<f64>,
    /// What was assumed, a sentence each.
    pub(crate) remarks: Vec<String>,
}

impl Subject {
    /// The material that `name` means: a file, of a kind that its ending tells, or else a class of a
    /// standard.
    pub(crate) fn find(name: &str, only: Option<&str>, cosine: Cosine) -> anyhow::Result<Self> {
        let path = Path::new(name);
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match ending.as_str() {
            "xomp" => Self::of_open_material(path),
            "dat" | "alta" | "binary" => Self::of_brdf(path, cosine),
            "mtlx" if path.is_file() => {
                bail!("{name}: is a material; fit makes one from values, measure takes values from it")
            }
            _ if table::is_table(name) => Self::of_table(&table::read(path)?, only),
            _ => Self::of_table(table::class(name)?.table(), only),
        }
    }

    fn of_open_material(path: &Path) -> anyhow::Result<Self> {
        let material = OpenMaterial::read(path)?;
        let assumption = Assumption::default();
        let subject = Self::of_table(&material.table(&assumption)?, None)?;
        let title = if material.name.is_empty() { subject.title } else { material.name };
        Ok(Self {
            title,
            roughness: Some(assumption.roughness()?),
            remarks: vec![assumption.sentence()],
            ..subject
        })
    }

    fn of_brdf(path: &Path, cosine: Cosine) -> anyhow::Result<Self> {
        let brdf = Brdf::read(path, cosine).map_err(|error| match error {
            Error::Cosine { found, .. } if found.included => anyhow!("{error}; --cosine reads them so"),
            Error::Cosine { .. } => anyhow!("{error}; --cosine=false reads them so"),
            _ => error.into(),
        })?;
        let (name, mut remarks) = (brdf.name.clone(), brdf.remarks.clone());
        let skipped = brdf.skipped.invalid + brdf.skipped.below_horizon;
        if skipped > 0 {
            remarks.push(format!(
                "{skipped} samples are negative, not finite, above 1e9/sr or below the surface, and left out"
            ));
        }
        Ok(Self { title: name.clone(), name, rows: Vec::new(), brdf: Some(brdf), roughness: None, remarks })
    }

    fn of_table(table: &Table, only: Option<&str>) -> anyhow::Result<Self> {
        let rows = table.rows().iter().filter(|row| only.is_none_or(|only| row.mentions(only)));
        let rows: Vec<Row> = rows.cloned().collect();
        let Some(first) = rows.first() else {
            bail!(
                "{}: no row is of {:?}; there are: {}",
                table.name(),
                only.unwrap_or_default(),
                materials(table.rows())
            );
        };
        // The tables that come with the program have a column that names the class; others say it in two.
        let id = table.header().iter().position(|name| name == "id");
        let class = |row: &Row| match id {
            Some(id) => vec![row.cells.get(id).cloned().unwrap_or_default()],
            None => vec![row.class.clone(), row.colour.clone()],
        };
        if only.is_none() && rows.iter().any(|row| class(row) != class(first)) {
            bail!("{}: holds several materials; choose one with --only: {}", table.name(), materials(&rows));
        }
        let name = table.name().to_owned();
        let class = StandardClass::from_table(Table::from_rows(&name, table.header(), rows.clone()));
        let title = class.map_or_else(|| name.clone(), |class| class.title());
        Ok(Self { name, title, rows, brdf: None, roughness: None, remarks: Vec::new() })
    }

    /// The colour that the rows name or the samples have near the retro direction, or white.
    pub(crate) fn colour(&self) -> Colour {
        let measured = self.brdf.as_ref().and_then(|brdf| {
            let samples = self.selection().of(brdf);
            let sum = |channel: usize| samples.iter().map(|sample| sample.value[channel]).sum();
            Colour::from_rec709([sum(0), sum(1), sum(2)])
        });
        let named = || self.rows.first().and_then(|row| Colour::named(&row.colour));
        measured.or_else(named).unwrap_or(Colour::WHITE)
    }

    /// What of a measured BRDF is fitted.
    pub(crate) fn selection(&self) -> Selection {
        Selection { count: BRDF_SAMPLES, ..Selection::default() }
    }

    /// The measured BRDF, where it is one.
    pub(crate) fn brdf(&self) -> Option<&Brdf> {
        self.brdf.as_ref()
    }

    /// Whether the values are those of a measured BRDF.
    pub(crate) fn is_brdf(&self) -> bool {
        self.brdf.is_some()
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

    /// Leaves out the minima where there are typical values, which say what the material is.
    pub(crate) fn drop_minima_beside_values(&mut self) {
        let before = self.rows.len();
        if self.rows.iter().any(|row| row.limit == Limit::Typical) {
            self.rows.retain(|row| row.limit != Limit::Minimum);
        }
        if self.rows.len() < before {
            let remark = "minima beside typical values are left out; --at-least takes them for limits";
            self.remarks.push(remark.to_owned());
        }
    }

    /// The values as a fit sees them, through the apertures of the instrument.
    pub(crate) fn observations(
        &self,
        limits: bool,
        area_m2: Option<f64>,
        apertures: &ApertureRule,
    ) -> anyhow::Result<Vec<Observation>> {
        let observation = |row: &Row| {
            let aim = match (row.limit, limits) {
                (Limit::Minimum, true) => Aim::AtLeast,
                (Limit::Maximum, _) => Aim::AtMost,
                _ => Aim::Equal,
            };
            let seen = Observation::from_row(row, aim, area_m2).map(|row| row.through(apertures));
            seen.map_err(|error| anyhow!(error).context(format!("{}:{}", self.name, row.line)))
        };
        let observations: anyhow::Result<Vec<_>> = self.rows.iter().map(observation).collect();
        if area_m2.is_none() && self.rows.iter().any(|row| row.quantity == Quantity::LuminousIntensity) {
            return observations.context("these are coefficients of luminous intensity: --area-m2 is needed");
        }
        observations
    }

    /// Adds the luminance factor Y by day, at 45/0, of the option `--luminance-factor`.
    pub(crate) fn add_luminance_factor(&mut self, value: f64) -> anyhow::Result<()> {
        if !(value > 0.0 && value <= 2.0) {
            bail!(Usage(format!("--luminance-factor is {value}: it must be in (0, 2]")));
        }
        let row = self.rows.first().cloned();
        self.rows.extend(row.map(|row| Row {
            observation_deg: 45.0,
            entrance_deg: 45.0,
            rotation_deg: 0.0,
            quantity: Quantity::LuminanceFactor,
            unit: Quantity::LuminanceFactor.unit(),
            value: Some(value),
            limit: Limit::Typical,
            source: String::new(),
            ..row
        }));
        Ok(())
    }

    /// Whether a row is the luminance of the material by day.
    pub(crate) fn has_luminance_factor(&self) -> bool {
        self.rows.iter().any(|row| row.quantity == Quantity::LuminanceFactor)
    }
}

/// Standard, class and colour of the materials among some rows, each once.
fn materials(rows: &[Row]) -> String {
    let words =
        |row: &Row| row.words().into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ");
    let mut names: Vec<String> = rows.iter().map(words).collect();
    names.sort();
    names.dedup();
    names.join("; ")
}
