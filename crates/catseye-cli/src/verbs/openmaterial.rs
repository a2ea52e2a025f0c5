//! `catseye openmaterial`: a material for simulators of sensors.

use std::cell::RefCell;
use std::ffi::OsStr;
use std::path::PathBuf;
use std::str::FromStr;

use anyhow::bail;
use catseye_photometry::openmaterial::{Assumption, Band, BrdfTable, Metadata, write_material};
use catseye_photometry::{Geometry, Goniometer, Quantity};
use serde_json::json;

use crate::failure::Usage;
use crate::help;
use crate::instrument::Channel;
use crate::instrument::goniometer::Photometer;
use crate::options::MaterialArgs;
use crate::output::Output;

/// Write a material as ASAM `OpenMATERIAL` 3D: its coefficient of retro-reflection, and a table of its BRDF
///
/// `OUT.xomp` gets the one coefficient that the format has room for, in cd/lx/m2, and names in its `sources`
/// the angles that it is for, which the format has no room for. `OUT_brdf.xompt` beside it gets the BRDF at
/// 555 nm and at the wavelengths of --tint, over directions that are dense around the retro direction.
#[derive(Debug, clap::Args)]
#[command(after_help = help::OPENMATERIAL)]
pub(crate) struct Args {
    #[command(flatten)]
    subject: MaterialArgs,
    /// File to write, .xomp; the table's name is made from it
    #[arg(short, long, value_name = "OUT.xomp")]
    output: PathBuf,
    /// Observation angle of the coefficient, in degrees
    #[arg(long, value_name = "DEG", default_value_t = Assumption::default().observation_deg)]
    observation_deg: f64,
    /// Entrance angle of the coefficient, in degrees
    #[arg(long, value_name = "DEG", default_value_t = Assumption::default().entrance_deg)]
    entrance_deg: f64,
    /// Light of this wavelength in nanometres comes back so many times as much as visible light, for lidar
    /// for instance: 905=0.3. May be given several times; colours say nothing of it
    #[arg(long = "tint", value_name = "NM=FACTOR")]
    tints: Vec<Tint>,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
}

/// A value of `--tint`.
#[derive(Clone, Copy, Debug)]
struct Tint(Band);

impl FromStr for Tint {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let parts = text
            .split_once('=')
            .and_then(|(nm, factor)| Some(Band { wavelength_nm: number(nm)?, tint: number(factor)? }));
        let band = parts.ok_or("a wavelength in nanometres and a factor are needed: 905=0.3")?;
        if !(band.wavelength_nm > 0.0 && (0.0..=1.0).contains(&band.tint)) {
            return Err("the wavelength must be above 0, the factor from 0 to 1".to_owned());
        }
        Ok(Self(band))
    }
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let table_path = self.table_path()?;
        let output = Output::new(&self.output)?;
        let table_output = Output::new(&table_path)?;
        let material = self.subject.load()?;
        let photometer = Photometer::new(&material, self.subject.model(), Channel::Luminance, None)?;

        let Self { observation_deg, entrance_deg, .. } = *self;
        let angles = Goniometer::from_degrees(observation_deg, entrance_deg, 0.0, 0.0);
        let geometry = Geometry::from(angles);
        if !(observation_deg > 0.0 && geometry.is_above_horizon()) {
            bail!(Usage(
                "--observation-deg must be above 0, and source and receiver above the surface".to_owned()
            ));
        }
        let r_a = photometer.measure(Quantity::RetroReflectionCoefficient, &geometry)?;
        let at = format!("{observation_deg} deg observation and {entrance_deg} deg entrance");
        let sources = format!("computed from {} by catseye: R_A at {at}", self.subject.name());
        let metadata = Metadata::named(&material.name);
        let uri = table_path.file_name().and_then(OsStr::to_str);
        let scalar = write_material(&metadata, r_a, &sources, uri)?;
        let table = self.table(&photometer, &metadata)?;
        table_output.write(table.as_bytes())?;
        output.write(scalar.as_bytes())?;

        let facts = json!({
            "output": output.name(),
            "table": table_output.name(),
            "coefficient": r_a,
            "observation_deg": observation_deg,
            "entrance_deg": entrance_deg,
        });
        let wavelengths = match self.tints.len() {
            0 => "1 wavelength".to_owned(),
            more => format!("{} wavelengths", more + 1),
        };
        let text = format!(
            "wrote {}: {r_a:.4} cd/lx/m2 at {at}\nwrote {}: {wavelengths}",
            output.name(),
            table_output.name(),
        );
        output.messages().note(self.json, &facts, &text)
    }

    /// The table's file: beside the output, its name ending as the format demands.
    fn table_path(&self) -> anyhow::Result<PathBuf> {
        let is_xomp = self.output.extension() == Some(OsStr::new("xomp"));
        match self.output.file_stem().and_then(OsStr::to_str) {
            Some(stem) if is_xomp => Ok(self.output.with_file_name(format!("{stem}_brdf.xompt"))),
            _ => bail!(Usage(format!("{}: the name must end in .xomp", self.output.display()))),
        }
    }

    fn table(&self, photometer: &Photometer, metadata: &Metadata) -> anyhow::Result<String> {
        let bands = std::iter::once(Band::VISIBLE).chain(self.tints.iter().map(|tint| tint.0)).collect();
        let table = BrdfTable { bands, receiver_solid_angle: None };
        let failure = RefCell::new(None);
        let brdf = |geometry: &Geometry| {
            let value = photometer.brdf(geometry);
            value.unwrap_or_else(|error| {
                failure.replace(Some(error));
                0.0
            })
        };
        let sources = format!("computed from {} by catseye", self.subject.name());
        let text = table.write(metadata, &sources, brdf)?;
        match failure.into_inner() {
            Some(error) => Err(error),
            None => Ok(text),
        }
    }
}
