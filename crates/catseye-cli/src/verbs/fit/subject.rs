//! What is fitted: the rows of one material, or a measured BRDF, from a file or a standard.

use std::path::Path;

use anyhow::{Context as _, anyhow, bail};
use catseye_photometry::brdf::{Brdf, Cosine, Selection};
use catseye_photometry::fit::{Aim, Fit, Observation, Outlier};
use catseye_photometry::openmaterial::{Assumption, OpenMaterial};
use catseye_photometry::standards::StandardClass;
use catseye_photometry::verdict::Kind;
use catseye_photometry::{ApertureRule, Apertures, Colour, Error, Limit, Quantity, Row, Table, significant};

use super::provenance::sha256;
use crate::failure::Usage;
use crate::instrument::table;

/// Columns that a report repeats: what was measured, by whom and with what.
const FACTS: [&str; 4] = ["Instrument", "Illuminant", "Laboratory", "Specimen"];
/// Samples of a measured BRDF that a fit looks at: more of them make it slower and no better.
const BRDF_SAMPLES: usize = 400;

/// Values unlike the others that are named.
const MOST_OUTLIERS: usize = 5;

/// The values of one material.
#[derive(Clone, Debug, Default)]
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
    /// What the table says of the measurement, each with what it says.
    pub(crate) facts: Vec<(&'static str, Vec<String>)>,
    /// The digest of what was read: the file, or the rows of a standard's class as `standards show` prints
    /// them.
    pub(crate) sha256: String,
}

impl Subject {
    /// The material that `name` means: a file, of a kind that its ending tells, or else a class of a
    /// standard.
    pub(crate) fn find(name: &str, only: Option<&str>, cosine: Cosine) -> anyhow::Result<Self> {
        let path = Path::new(name);
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        if ending == "mtlx" && path.is_file() {
            bail!("{name}: is a material; fit makes one from values, measure takes values from it");
        }
        let is_file = matches!(ending.as_str(), "xomp" | "dat" | "alta" | "binary") || table::is_table(name);
        if !is_file {
            let class = table::class(name)?;
            let sha256 = sha256(class.table().to_csv(&[]).as_bytes());
            return Ok(Self { sha256, ..Self::of_table(class.table(), only)? });
        }
        let (bytes, name) = table::bytes(path)?;
        let subject = match ending.as_str() {
            "xomp" => Self::of_open_material(&bytes, &name),
            "dat" | "alta" | "binary" => Self::of_brdf(&bytes, &name, cosine),
            _ => Self::of_table(&Table::parse_values(&bytes, &name)?, only),
        };
        Ok(Self { sha256: sha256(&bytes), ..subject? })
    }

    fn of_open_material(bytes: &[u8], name: &str) -> anyhow::Result<Self> {
        let text = str::from_utf8(bytes).map_err(|_| anyhow!("{name}: is not UTF-8 text"))?;
        let material = OpenMaterial::parse(text, name)?;
        let assumption = Assumption::default();
        let subject = Self::of_table(&material.table(&assumption)?, None)?;
        let title = if material.name.is_empty() { subject.title } else { material.name };
        Ok(Self {
            title,
            roughness: Some(assumption.roughness()?),
            remarks: [subject.remarks, vec![assumption.sentence()]].concat(),
            ..subject
        })
    }

    fn of_brdf(bytes: &[u8], name: &str, cosine: Cosine) -> anyhow::Result<Self> {
        let brdf = Brdf::parse(bytes, name, cosine).map_err(|error| match error {
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
        Ok(Self { title: file_name(&name), name, brdf: Some(brdf), remarks, ..Self::default() })
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
        let title = class.map(|class| class.title()).filter(|title| *title != name);
        let title = title.unwrap_or_else(|| file_name(&name));
        let facts = facts(table.header(), &rows);
        let mut remarks = table.hints();
        remarks.extend(wavelength(&name, &rows)?);
        check_uncertainties(&name, &rows)?;
        Ok(Self { name, title, rows, facts, remarks, ..Self::default() })
    }

    /// What the values are of; `None` of a BRDF.
    pub(crate) fn kind(&self) -> Option<Kind> {
        let class = StandardClass::from_table(Table::from_rows(&self.name, &[], self.rows.clone()))?;
        Some(Kind::of(&class))
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

    /// The instrument's apertures, where all rows name the same.
    pub(crate) fn apertures(&self) -> Option<Apertures> {
        let first = self.rows.first()?.apertures?;
        let retro = self.rows.iter().filter(|row| row.quantity != Quantity::LuminanceFactor);
        retro.map(|row| row.apertures).all(|own| own == Some(first)).then_some(first)
    }

    /// Whether the values are those of a measured BRDF.
    pub(crate) fn is_brdf(&self) -> bool {
        self.brdf.is_some()
    }

    /// Where the values come from, each source once.
    pub(crate) fn sources(&self) -> Vec<&str> {
        each_once(self.rows.iter().map(|row| row.source.as_str()))
    }

    /// Refuses `--at-least` where nothing is a minimum.
    pub(crate) fn check_for_minima(&self) -> anyhow::Result<()> {
        if self.rows.iter().any(|row| row.limit == Limit::Minimum) {
            return Ok(());
        }
        bail!(Usage(format!(
            "--at-least: no row of {} is a minimum; write `minimum` in a column `limit`",
            self.name
        )))
    }

    /// A sentence for each value that is unlike the others, those farthest off first.
    pub(crate) fn outliers(&self, fit: &Fit) -> Vec<String> {
        let sentence = |outlier: &Outlier| {
            let row = self.rows.get(outlier.row)?;
            Some(format!(
                "{}:{}: {} {} at observation {} deg and entrance {} deg is {} times what the other \
                 values say, off by {} times their scatter: is it a slip?",
                self.name,
                row.line,
                significant(row.value_as_written()?, 4),
                row.unit,
                row.observation_deg,
                row.entrance_deg,
                significant(outlier.ratio, 3),
                significant(outlier.times, 2),
            ))
        };
        let mut named: Vec<String> = fit.outliers.iter().take(MOST_OUTLIERS).filter_map(sentence).collect();
        let more = fit.outliers.len().saturating_sub(MOST_OUTLIERS);
        if more > 0 && !named.is_empty() {
            named.push(format!("{more} more values are unlike the others"));
        }
        named
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
            let place = || format!("{}:{}", self.name, row.line);
            let seen = Observation::from_row(row, aim, area_m2).with_context(place)?;
            match row.apertures {
                Some(own) => Ok(seen.through(&own.rule().with_context(place)?)),
                None => Ok(seen.through(apertures)),
            }
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
            entrance_2_deg: 0.0,
            rotation_deg: 0.0,
            apertures: None,
            quantity: Quantity::LuminanceFactor,
            unit: Quantity::LuminanceFactor.unit(),
            value: Some(value),
            // Given, not measured.
            uncertainty: Some(0.0),
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

/// The last part of a path.
fn file_name(path: &str) -> String {
    Path::new(path).file_name().map_or_else(|| path.to_owned(), |name| name.to_string_lossy().into_owned())
}

/// Texts that are not empty, each once, in their order.
fn each_once<'a>(texts: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut found = Vec::new();
    for text in texts.filter(|text| !text.is_empty()) {
        if !found.contains(&text) {
            found.push(text);
        }
    }
    found
}

/// What the columns of [`FACTS`] say.
fn facts(header: &[String], rows: &[Row]) -> Vec<(&'static str, Vec<String>)> {
    let fact = |name: &'static str| {
        let column = header.iter().position(|other| other.eq_ignore_ascii_case(name))?;
        let cells = rows.iter().filter_map(|row| row.cells.get(column)).map(String::as_str);
        let found: Vec<String> = each_once(cells).into_iter().map(str::to_owned).collect();
        (!found.is_empty()).then_some((name, found))
    };
    FACTS.iter().filter_map(|name| fact(name)).collect()
}

/// What to say of the wavelength that the values are of: a fit is of one.
fn wavelength(name: &str, rows: &[Row]) -> anyhow::Result<Option<String>> {
    let first = rows[0].wavelength_nm;
    let said = |wavelength: Option<f64>| wavelength.map_or("white light".to_owned(), |nm| format!("{nm} nm"));
    if let Some(other) = rows.iter().find(|row| row.wavelength_nm != first) {
        bail!(
            "{name}:{}: is of {}, the first row of {}; keep the rows of one",
            other.line,
            said(other.wavelength_nm),
            said(first)
        );
    }
    Ok(first.map(|nm| format!("the values are of {nm} nm: the material is what it is in that light")))
}

/// Either every value has an uncertainty, or none.
fn check_uncertainties(name: &str, rows: &[Row]) -> anyhow::Result<()> {
    let without = rows.iter().find(|row| row.uncertainty.is_none());
    match without.filter(|_| rows.iter().any(|row| row.uncertainty.is_some())) {
        Some(row) => bail!(
            "{name}:{}: column uncertainty: is empty, other rows have one; give every row one, or delete \
             the column",
            row.line
        ),
        None => Ok(()),
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
