//! Tables of BRDFs over wavelength and directions.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Write as _;

use catseye::Vec3;
use serde_json::{Value, json};

use super::Metadata;
use crate::{Error, Geometry};

/// The wavelength that stands for visible light, in nanometres: where the eye sees best (CIE 1924).
pub const VISIBLE_NM: f64 = 555.0;
/// Wavelengths that the format can hold, nanometres.
const WAVELENGTHS_NM: [f64; 2] = [1.0, 17.16e6];
/// Greatest angles, in radians: the schema's are pi / 2 and 2 pi, cut off after six decimals.
const MAX_ZENITH: f64 = FRAC_PI_2 - 1e-6;
const MAX_AZIMUTH: f64 = TAU - 1e-6;
/// Decimals of the angles that are written: finer than a hundredth of the narrowest step.
const DECIMALS: usize = 7;

/// Zenith angles of the incident light, degrees.
const INCIDENT_DEG: [f64; 13] = [0.0, 5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 75.0, 80.0, 85.0];
/// Distances from the retro direction, degrees: those of data sheets and between, where the lobe is.
const NEAR_DEG: [f64; 14] = [0.1, 0.2, 0.33, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 9.0, 13.0, 18.0];
/// Angles between directions that are far from it, degrees.
const FAR_DEG: f64 = 15.0;

/// A wavelength, and how much light comes back there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Wavelength in nanometres, 1 to 17 160 000.
    pub wavelength_nm: f64,
    /// The BRDF relative to that for visible light, at least 0: measured, never guessed from the colour.
    pub tint: f64,
}

impl Band {
    /// Visible light, as it is.
    pub const VISIBLE: Self = Self { wavelength_nm: VISIBLE_NM, tint: 1.0 };
}

/// What a table is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct BrdfTable {
    /// The wavelengths.
    pub bands: Vec<Band>,
    /// Solid angle of the receiver that the values are averages over, in sr; `None` where they are the BRDF
    /// itself.
    pub receiver_solid_angle: Option<f64>,
}

impl BrdfTable {
    /// A `_brdf.xompt` file of a BRDF, in 1/sr for visible light.
    ///
    /// The light arrives in the plane of the datum axis: the format knows no rotation. Directions are dense
    /// around the retro direction, which the format has at the light's own zenith angle and azimuth 0, and 15
    /// degrees apart elsewhere.
    ///
    /// # Errors
    /// No band, a wavelength or tint out of range or twice the same, a solid angle that is not above 0.
    pub fn write(
        &self,
        metadata: &Metadata,
        sources: &str,
        brdf: impl Fn(&Geometry) -> f64,
    ) -> Result<String, Error> {
        let bands = self.checked(metadata)?;
        let rows = rows(brdf);
        // By a power of ten that is exact, so that 555 nm are written as 5.55e-7.
        let metres = |band: &Band| band.wavelength_nm / 1e9;
        let mut document = metadata.document("material_brdf_schema", "brdf", Some(sources));
        let wavelengths: Vec<f64> = bands.iter().map(metres).collect();
        let mut brdf = json!({ "wavelengths": wavelengths });
        if let Some(solid_angle) = self.receiver_solid_angle {
            let entry = |band: &Band| json!({ "wavelength": metres(band), "solidAngle": solid_angle });
            brdf["receiverSolidAngles"] = bands.iter().map(entry).collect();
        }
        brdf["lookupTable"] = json!([]);
        document.insert("brdf".to_owned(), brdf);
        let text = format!("{:#}\n", Value::Object(document));
        // One row a line: a value a line, as a printer of JSON has it, is five times as long.
        let mut table = String::from("[");
        for band in &bands {
            for (angles, value) in &rows {
                let [incident, exit, azimuth] = angles;
                let separator = if table.len() > 1 { "," } else { "" };
                // Writing to a string can't fail.
                write!(
                    table,
                    "{separator}\n      [{}, {incident:.DECIMALS$}, {exit:.DECIMALS$}, {azimuth:.DECIMALS$}, {}]",
                    json!(metres(band)),
                    json!(band.tint * value)
                )
                .ok();
            }
        }
        table += "\n    ]";
        Ok(text.replacen("[]", &table, 1))
    }

    /// The bands by rising wavelength.
    fn checked(&self, metadata: &Metadata) -> Result<Vec<Band>, Error> {
        let fail = |problem: String| Error::Table { table: metadata.name.clone(), problem };
        let mut bands = self.bands.clone();
        bands.sort_by(|a, b| a.wavelength_nm.total_cmp(&b.wavelength_nm));
        if bands.is_empty() {
            return Err(fail("needs a wavelength at least".to_owned()));
        }
        let [least, greatest] = WAVELENGTHS_NM;
        for Band { wavelength_nm, tint } in &bands {
            if !(least..=greatest).contains(wavelength_nm) {
                return Err(fail(format!("wavelength {wavelength_nm} nm is outside {least} to {greatest}")));
            }
            if !(tint.is_finite() && *tint >= 0.0) {
                return Err(fail(format!("tint {tint} at {wavelength_nm} nm: it must be 0 or above")));
            }
        }
        if let Some(pair) = bands.windows(2).find(|pair| pair[0].wavelength_nm == pair[1].wavelength_nm) {
            return Err(fail(format!("wavelength {} nm is given twice", pair[0].wavelength_nm)));
        }
        match self.receiver_solid_angle {
            Some(angle) if !(angle.is_finite() && angle > 0.0) => {
                Err(fail(format!("the receiver's solid angle is {angle} sr: it must be above 0")))
            }
            _ => Ok(bands),
        }
    }
}

/// Incident zenith, exit zenith and exit azimuth, sorted, with the value there.
fn rows(brdf: impl Fn(&Geometry) -> f64) -> Vec<([f64; 3], f64)> {
    let mut rows = Vec::new();
    for incident in INCIDENT_DEG.map(|degrees| rounded(degrees.to_radians())) {
        for exit in exits(incident) {
            for azimuth in azimuths(incident, exit) {
                let wi = Vec3::from_angles(incident, 0.0);
                let wo = Vec3::from_angles(exit, azimuth);
                rows.push(([incident, exit, azimuth], brdf(&Geometry { wo, wi })));
            }
        }
    }
    rows
}

/// An angle with the digits that it is written with: values belong to what is written.
fn rounded(angle: f64) -> f64 {
    let scale = 10_f64.powi(DECIMALS as i32);
    (angle * scale).round() / scale
}

/// Angles from 0 to `max` as a column has them: sorted, none twice.
fn column(angles: impl Iterator<Item = f64>, max: f64) -> Vec<f64> {
    let mut angles: Vec<f64> = angles.map(rounded).filter(|angle| (0.0..=max).contains(angle)).collect();
    angles.sort_by(f64::total_cmp);
    angles.dedup();
    angles
}

/// Zenith angles of the exit direction.
fn exits(incident: f64) -> Vec<f64> {
    let near = NEAR_DEG.map(f64::to_radians);
    let around = near.iter().flat_map(|step| [incident - step, incident + step]);
    let far = (0..6).map(|i| f64::from(i) * FAR_DEG.to_radians());
    column(around.chain(far).chain([incident]), MAX_ZENITH)
}

/// Azimuths of the exit direction: steps across are as long as those along, which the sine of the zenith
/// makes wider.
fn azimuths(incident: f64, exit: f64) -> Vec<f64> {
    let sine = exit.sin();
    if sine < 1e-9 {
        return vec![0.0];
    }
    let far = (0..24).map(|i| f64::from(i) * FAR_DEG.to_radians());
    // Away from the lobe's ring the steps of 15 degrees will do.
    let is_near = (exit - incident).abs() < FAR_DEG.to_radians();
    let near: &[f64] = if is_near { &NEAR_DEG } else { &[] };
    let steps = near.iter().map(|step| step.to_radians() / sine).filter(|step| *step < PI);
    let around = steps.flat_map(|step| [step, TAU - step]);
    column(around.chain(far), MAX_AZIMUTH)
}
