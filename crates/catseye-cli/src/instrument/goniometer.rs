//! A material on a goniometer: its BSDF in closed form.

use std::f64::consts::FRAC_PI_2;

use anyhow::anyhow;
use catseye_photometry::{Geometry, Quantity, diffuse_luminance_coefficient, fractional_retro_reflectance};
use catseye_render::Specimen;

use super::{Channel, area_needed};

/// A material on a goniometer: source and receiver are points, far away.
#[derive(Debug)]
pub(crate) struct Photometer {
    pub(crate) specimen: Specimen,
    pub(crate) channel: Channel,
    /// Area of a whole reflector in square metres, without which there is no `R_I`.
    pub(crate) area: Option<f64>,
}

impl Photometer {
    /// The BSDF in 1/sr.
    pub(crate) fn brdf(&self, geometry: &Geometry) -> anyhow::Result<f64> {
        Ok(self.channel.of(self.specimen.eval(geometry.wo, geometry.wi)?))
    }

    /// The quantity in its SI unit.
    pub(crate) fn measure(&self, quantity: Quantity, geometry: &Geometry) -> anyhow::Result<f64> {
        let f = self.brdf(geometry)?;
        let anywhere = |geometry: &Geometry| self.brdf(geometry).unwrap_or(f64::NAN);
        let value = match quantity {
            Quantity::LuminousIntensity => {
                let r_a = Quantity::RetroReflectionCoefficient.of_brdf(f, geometry);
                let area = self.area.ok_or_else(area_needed)?;
                r_a.map(|r_a| r_a * area)
            }
            Quantity::FractionalRetroReflectance => Some(fractional_retro_reflectance(
                anywhere,
                geometry.entrance(),
                geometry.observation().min(FRAC_PI_2),
            )),
            Quantity::DaytimeLuminance => Some(diffuse_luminance_coefficient(anywhere, geometry.viewing())),
            _ => quantity.of_brdf(f, geometry),
        };
        value.filter(|value| value.is_finite()).ok_or_else(|| anyhow!("{quantity} is not a finite number"))
    }
}
