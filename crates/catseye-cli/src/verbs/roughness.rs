//! `catseye roughness`: from the width and height of a measured peak to the node's inputs, and back.

use anyhow::bail;
use catseye::DIRAC_ROUGHNESS;
use catseye_photometry::half_power::{
    half_power_angle, peak_coefficient, relative_coefficient, roughness_from_half_power_angle,
};
use catseye_photometry::significant;
use clap::ArgGroup;
use serde_json::json;

use crate::failure::Usage;
use crate::{help, report};

/// Convert between half-power angle and roughness, and between R_A and tint
///
/// The half-power angle is the observation angle at which R_A has fallen to half of its peak, at entrance
/// angle 0: half of the full width at half maximum, and what the node `retro_sheeting_surface` takes as
/// `half_power_angle`. Exact for the lobe of the proposal.
#[derive(Debug, clap::Args)]
#[command(after_help = help::ROUGHNESS, arg_required_else_help = true)]
#[command(group = ArgGroup::new("width").required(true))]
pub(crate) struct Args {
    /// Half-power angle in degrees, in (0, 44.19]
    #[arg(long, value_name = "DEG", group = "width")]
    half_power_deg: Option<f64>,
    /// Roughness, above 0
    #[arg(long, value_name = "R", group = "width")]
    roughness: Option<f64>,
    /// Find the tint that has this R_A, in cd/lx/m2
    #[arg(long, value_name = "R_A", conflicts_with = "tint")]
    ra: Option<f64>,
    /// Observation angle in degrees at which --ra is given: that of the data sheet
    #[arg(long, value_name = "DEG", default_value_t = 0.0, requires = "ra")]
    at_deg: f64,
    /// Find the R_A that this tint has
    #[arg(long, value_name = "TINT", default_value_t = 1.0)]
    tint: f64,
    /// Print the numbers as JSON
    #[arg(long)]
    json: bool,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let roughness = match (self.roughness, self.half_power_deg) {
            (Some(roughness), _) => roughness,
            (None, Some(angle_deg)) => roughness_from_half_power_angle(angle_deg.to_radians())?,
            (None, None) => bail!(Usage("give --half-power-deg or --roughness".to_owned())),
        };
        let angle_deg = half_power_angle(roughness)?.to_degrees();
        if roughness < DIRAC_ROUGHNESS {
            bail!(
                "roughness {roughness} is a perfect retro-reflector (all are below {DIRAC_ROUGHNESS}): its \
                 R_A is infinite in one direction and 0 in all others"
            );
        }
        let tint = self.tint(roughness)?;
        let peak = peak_coefficient(tint, [roughness; 2]);
        let facts = json!({
            "roughness": if roughness.is_finite() { json!(roughness) } else { json!("inf") },
            "half_power_angle_deg": angle_deg,
            "full_width_deg": 2.0 * angle_deg,
            "tint": tint,
            "peak_r_a": peak,
        });
        let [angle, full, shown_tint, shown_peak] = [angle_deg, 2.0 * angle_deg, tint, peak].map(rounded);
        let text = format!(
            "roughness         {}\n\
             half-power angle  {angle} deg (full width {full} deg)\n\
             tint              {shown_tint}\n\
             peak R_A          {shown_peak} cd/lx/m2",
            rounded(roughness)
        );
        report::print(self.json, &facts, &text)
    }

    /// The tint that was given, or the one that has the given `R_A`.
    fn tint(&self, roughness: f64) -> anyhow::Result<f64> {
        if !(0.0..=1.0).contains(&self.tint) {
            bail!(Usage(format!("--tint {} is outside [0, 1]", self.tint)));
        }
        let Some(r_a) = self.ra else { return Ok(self.tint) };
        if !(r_a > 0.0 && r_a.is_finite()) {
            bail!(Usage(format!("--ra {r_a} must be above 0")));
        }
        if !(0.0..90.0).contains(&self.at_deg) {
            bail!(Usage(format!("--at-deg {} is outside [0, 90)", self.at_deg)));
        }
        let white =
            peak_coefficient(1.0, [roughness; 2]) * relative_coefficient(roughness, self.at_deg.to_radians());
        let tint = r_a / white;
        if !(tint <= 1.0) {
            bail!(
                "no lobe this wide has R_A = {r_a} cd/lx/m2 at {} deg: with tint 1 it is {}",
                self.at_deg,
                rounded(white)
            );
        }
        Ok(tint)
    }
}

/// Six digits, more than any photometer has.
fn rounded(value: f64) -> String {
    significant(value, 6)
}
