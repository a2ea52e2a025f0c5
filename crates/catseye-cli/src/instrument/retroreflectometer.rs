//! A material in a retroreflectometer whose light is traced: lamp and receiver have apertures and stand
//! nearby.

use anyhow::anyhow;
use catseye::Model;
use catseye_materialx::Material;
use catseye_photometry::{Geometry, Quantity};
use catseye_render::{Estimate, Retroreflectometer as Instrument};

use super::{Channel, area_needed};

/// Paths of each measurement where none are asked for: a standard error of 0.1 % within the lobe.
pub(crate) const SAMPLES: u32 = 1 << 16;

/// A material on the instrument of ASTM E810: 15 m away, apertures of 0.1 degrees, a specimen of 20 cm.
#[derive(Debug)]
pub(crate) struct Retroreflectometer<'a> {
    pub(crate) material: &'a Material,
    pub(crate) model: Model,
    pub(crate) channel: Channel,
    /// Area of a whole reflector in square metres, without which there is no `R_I`.
    pub(crate) area: Option<f64>,
    /// Paths of each measurement.
    pub(crate) samples: u32,
}

impl Retroreflectometer<'_> {
    /// The quantity in its SI unit, with its standard error.
    pub(crate) fn measure(&self, quantity: Quantity, geometry: &Geometry) -> anyhow::Result<Estimate> {
        // The instrument measures R_A; the others are it times cosines or an area.
        let r_a = Quantity::RetroReflectionCoefficient;
        let factor = match quantity {
            Quantity::LuminousIntensity => self.area,
            _ => r_a.to_brdf(1.0, geometry).and_then(|f| quantity.of_brdf(f, geometry)),
        };
        let Some(factor) = factor else {
            return Err(match quantity {
                Quantity::LuminousIntensity => area_needed(),
                _ => anyhow!("{quantity} is an integral over directions; measure it without --instrument"),
            });
        };
        let directions = [geometry.wo, geometry.wi];
        let reading =
            Instrument::default().measure(self.material, self.model, directions, self.samples, 0)?;
        let Estimate { value, standard_error } = reading.r_a(self.channel.weights());
        Ok(Estimate { value: value * factor, standard_error: standard_error * factor })
    }
}
