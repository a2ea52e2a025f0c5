//! What the sign is made of: a material, a table of values, or a class of a standard.

use std::path::Path;

use anyhow::bail;
use catseye::Model;
use catseye_materialx::Material;
use catseye_photometry::drive::{CoefficientTable, Reading};
use catseye_photometry::{Geometry, Goniometer, Quantity, significant};

use super::goniometer::Photometer;
use super::{Channel, table};
use crate::options::ReadingArgs;
use crate::report;

/// `R_A` close to the lamp is so many times that far from it, where there is a retro-reflective lobe: matte
/// paint has 1.1 times as much.
const LEAST_RATIO: f64 = 1.5;
/// Observation angles that are compared, and the entrance angle, in degrees.
const NEAR_DEG: f64 = 0.2;
const FAR_DEG: f64 = 20.0;
const ENTRANCE_DEG: f64 = 5.0;

/// How subjects are read.
#[derive(Debug, clap::Args)]
pub(crate) struct SubjectArgs {
    #[command(flatten)]
    reading: ReadingArgs,
    /// What is made of the three colour channels
    #[arg(long, value_enum, default_value_t)]
    pub(crate) channel: Channel,
}

/// Something with coefficients of retro-reflection.
#[derive(Debug)]
pub(crate) struct Subject {
    pub(crate) name: String,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    Material(Box<Material>, Model, Photometer),
    Table(CoefficientTable),
}

impl SubjectArgs {
    /// Reads a document, a table or a class by its name.
    pub(crate) fn subject(&self, name: &str) -> anyhow::Result<Subject> {
        let is_document =
            Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("mtlx"));
        if !is_document {
            let class = table::class(name)?;
            return Ok(Subject {
                name: class.id().to_owned(),
                kind: Kind::Table(CoefficientTable::new(class.table())?),
            });
        }
        let material = self.reading.material(Path::new(name))?;
        let photometer = Photometer::new(&material, self.reading.model(), self.channel, None)?;
        let subject = Subject {
            name: name.to_owned(),
            kind: Kind::Material(Box::new(material), self.reading.model(), photometer),
        };
        subject.warn_without_lobe()?;
        Ok(subject)
    }
}

impl Subject {
    /// `R_A` in cd/lx/m2.
    pub(crate) fn read(&self, geometry: &Geometry) -> anyhow::Result<Reading> {
        Ok(match &self.kind {
            Kind::Table(table) => table.read(geometry),
            Kind::Material(_, _, photometer) => Reading {
                r_a: Some(photometer.measure(Quantity::RetroReflectionCoefficient, geometry)?),
                beyond_observation: false,
                beyond_entrance: false,
            },
        })
    }

    /// The least and the greatest observation and entrance angle, in degrees, of a table.
    pub(crate) fn range_deg(&self) -> Option<[[f64; 2]; 2]> {
        match &self.kind {
            Kind::Table(table) => Some(table.range_deg()),
            Kind::Material(..) => None,
        }
    }

    /// The material and its model, of a document.
    pub(crate) fn material(&self) -> Option<(&Material, Model)> {
        match &self.kind {
            Kind::Table(_) => None,
            Kind::Material(material, model, _) => Some((material, *model)),
        }
    }

    fn warn_without_lobe(&self) -> anyhow::Result<()> {
        let at = |observation| {
            let geometry = Geometry::from(Goniometer::from_degrees(observation, ENTRANCE_DEG, 0.0, 0.0));
            Ok::<_, anyhow::Error>(self.read(&geometry)?.r_a.unwrap_or_default())
        };
        let [near, far] = [at(NEAR_DEG)?, at(FAR_DEG)?];
        if near == 0.0 {
            bail!(
                "{}: sends nothing back, R_A is 0 at {NEAR_DEG} degree; `catseye fit` makes a material that \
                 does",
                self.name
            );
        }
        if near < LEAST_RATIO * far {
            report::warn(format!(
                "{}: has no retro-reflective lobe, R_A is {} at {NEAR_DEG} degree and {} at {FAR_DEG}; \
                 `catseye fit` makes a material with one",
                self.name,
                significant(near, 3),
                significant(far, 3)
            ));
        }
        Ok(())
    }
}
