//! What a photometer reads off a material.

use std::f64::consts::FRAC_PI_2;

use anyhow::{anyhow, bail};
use catseye_photometry::{
    Geometry, LUMINANCE, Quantity, diffuse_luminance_coefficient, fractional_retro_reflectance,
};
use catseye_render::Specimen;
use clap::ValueEnum;

use crate::failure::Usage;

/// What is made of three colour channels.
///
/// Photometers measure in illuminant A; a material that is given in three channels can't say what changes in that light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Channel {
    /// 0.2126 R + 0.7152 G + 0.0722 B
    #[default]
    Luminance,
    /// Red
    R,
    /// Green
    G,
    /// Blue
    B,
}

impl Channel {
    /// What each channel of linear Rec. 709 counts for.
    pub(crate) fn weights(self) -> [f64; 3] {
        match self {
            Self::Luminance => LUMINANCE,
            Self::R => [1.0, 0.0, 0.0],
            Self::G => [0.0, 1.0, 0.0],
            Self::B => [0.0, 0.0, 1.0],
        }
    }

    fn of(self, rgb: [f64; 3]) -> f64 {
        rgb.iter().zip(self.weights()).map(|(x, weight)| x * weight).sum()
    }
}

/// Refuses an `--area-m2` that is none.
pub(crate) fn check_area(area_m2: Option<f64>) -> anyhow::Result<()> {
    if area_m2.is_some_and(|area| !(area > 0.0 && area.is_finite())) {
        bail!(Usage("--area-m2 must be above 0".to_owned()));
    }
    Ok(())
}

/// A material on a goniometer, in closed form: source and receiver are points, far away.
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
                let Some(area) = self.area else {
                    bail!("R_I is of a whole reflector, R_A times its area: say which with --area-m2");
                };
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
