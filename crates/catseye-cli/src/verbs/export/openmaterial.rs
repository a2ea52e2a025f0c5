//! `catseye export openmaterial`: a material for simulators of sensors.

use std::cell::RefCell;
use std::ffi::OsStr;

use anyhow::bail;
use catseye_photometry::export::LobeRows;
use catseye_photometry::openmaterial::{Assumption, Band, BrdfTable, Metadata, write_material};
use catseye_photometry::{Geometry, Goniometer, Quantity};
use serde_json::json;

use crate::failure::Usage;
use crate::options::Tint;
use crate::output::Output;

use super::original::Original;
use super::{Args, Deviations, beside};

/// The options of OpenMATERIAL 3D.
#[derive(Debug, clap::Args)]
pub(super) struct OpenMaterialArgs {
    /// Observation angle of openmaterial's coefficient, in degrees [default: 0.2]
    #[arg(long, value_name = "DEG")]
    observation_deg: Option<f64>,
    /// Entrance angle of openmaterial's coefficient, in degrees [default: -4]
    #[arg(long, value_name = "DEG")]
    entrance_deg: Option<f64>,
    /// Light of this wavelength in nanometres comes back so many times as much as visible light, for lidar
    /// for instance: 905=0.3. For openmaterial; may be given several times; colours say nothing of it
    #[arg(long = "tint", value_name = "NM=FACTOR")]
    tints: Vec<Tint>,
}

impl OpenMaterialArgs {
    /// Whether any option was given.
    pub(super) fn are_given(&self) -> bool {
        self.observation_deg.is_some() || self.entrance_deg.is_some() || !self.tints.is_empty()
    }
}

/// Writes a material as ASAM `OpenMATERIAL` 3D: its coefficient of retro-reflection, and a table of its BRDF.
///
/// The `.xomp` gets the one coefficient that the format has room for, in cd/lx/m2, and names in its `sources`
/// the angles that it is for, which the format has no room for. The `_brdf.xompt` beside it gets the BRDF at
/// 555 nm and at the wavelengths of `--tint`, over directions that are dense around the retro direction.
pub(super) fn run(args: &Args) -> anyhow::Result<()> {
    let table_path = beside(&args.output, "xomp", "_brdf.xompt")?;
    let output = Output::new(&args.output)?;
    let table_output = Output::new(&table_path)?;
    let original = Original::load(args)?;
    let photometer = original.photometer();

    let Assumption { observation_deg, entrance_deg, .. } = Assumption::default();
    let observation_deg = args.openmaterial.observation_deg.unwrap_or(observation_deg);
    let entrance_deg = args.openmaterial.entrance_deg.unwrap_or(entrance_deg);
    let angles = Goniometer::from_degrees(observation_deg, entrance_deg, 0.0, 0.0);
    let geometry = Geometry::from(angles);
    if !(observation_deg > 0.0 && geometry.is_above_horizon()) {
        bail!(Usage(
            "--observation-deg must be above 0, and source and receiver above the surface".to_owned()
        ));
    }
    let r_a = photometer.measure(Quantity::RetroReflectionCoefficient, &geometry)?;
    let at = format!("{observation_deg} deg observation and {entrance_deg} deg entrance");
    let sources = format!("computed from {} by catseye: R_A at {at}", original.name);
    let metadata = Metadata::named(&original.material.name);
    let uri = table_path.file_name().and_then(OsStr::to_str);
    let scalar = write_material(&metadata, r_a, &sources, uri)?;
    let table = table(args, &original, &metadata)?;
    table_output.write(table.as_bytes())?;
    output.write(scalar.as_bytes())?;

    let numbers = json!({
        "coefficient": r_a,
        "observation_deg": observation_deg,
        "entrance_deg": entrance_deg,
    });
    let deviations = Deviations::new(&original, &LobeRows::default(), |geometry| original.brdf(geometry));
    let wavelengths = match args.openmaterial.tints.len() {
        0 => "1 wavelength".to_owned(),
        more => format!("{} wavelengths", more + 1),
    };
    let text = format!("{r_a:.4} cd/lx/m2 at {at}; the BRDF at {wavelengths}");
    args.say(&[&output, &table_output], &deviations, &text, &numbers)
}

fn table(args: &Args, original: &Original, metadata: &Metadata) -> anyhow::Result<String> {
    let bands = std::iter::once(Band::VISIBLE).chain(args.openmaterial.tints.iter().map(|tint| tint.0));
    let table = BrdfTable { bands: bands.collect(), receiver_solid_angle: None };
    let failure = RefCell::new(None);
    let brdf = |geometry: &Geometry| {
        let value = original.photometer().brdf(geometry);
        value.unwrap_or_else(|error| {
            failure.replace(Some(error));
            0.0
        })
    };
    let sources = format!("computed from {} by catseye", original.name);
    let text = table.write(metadata, &sources, brdf)?;
    match failure.into_inner() {
        Some(error) => Err(error),
        None => Ok(text),
    }
}
