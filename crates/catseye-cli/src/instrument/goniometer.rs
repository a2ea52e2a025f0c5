//! A material on a goniometer: its BSDF in closed form.

use std::f64::consts::FRAC_PI_2;

use anyhow::anyhow;
use catseye::Model;
use catseye_materialx::{Material, ShadingPoint};
use catseye_photometry::{Geometry, Quantity, diffuse_luminance_coefficient, fractional_retro_reflectance};
use catseye_render::Specimen;

use super::{Channel, area_needed};
use crate::report;

/// A material on a goniometer: source and receiver are points, far away.
#[derive(Debug)]
pub(crate) struct Photometer {
    specimen: Specimen,
    channel: Channel,
    /// Area of a whole reflector in square metres, without which there is no `R_I`.
    area: Option<f64>,
}

impl Photometer {
    /// Mounts a specimen, and warns where another piece of the material would read differently.
    pub(crate) fn new(
        material: &Material,
        model: Model,
        channel: Channel,
        area: Option<f64>,
    ) -> anyhow::Result<Self> {
        if varies_over_the_surface(material) {
            report::warn(format!(
                "the material {:?} varies over the surface: it is measured at the texture coordinates 0, 0",
                material.name
            ));
        }
        Ok(Self { specimen: Specimen::new(material, model)?, channel, area })
    }

    /// The BSDF in 1/sr.
    pub(crate) fn brdf(&self, geometry: &Geometry) -> anyhow::Result<f64> {
        Ok(self.channel.of(self.rgb(geometry)?))
    }

    /// The BSDF in 1/sr per channel of linear Rec. 709.
    pub(crate) fn rgb(&self, geometry: &Geometry) -> anyhow::Result<[f64; 3]> {
        Ok(self.specimen.eval(geometry.wo, geometry.wi)?)
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

/// Whether some other places, each seen head on, are unlike the origin.
pub(crate) fn varies_over_the_surface(material: &Material) -> bool {
    /// Places that are looked at; their coordinates are multiples of the golden and the silver ratio.
    const PLACES: u16 = 64;
    let Some(patterns) = &material.patterns else { return false };
    let origin = patterns.at(&ShadingPoint::default());
    (1..=PLACES).any(|i| {
        let [u, v] = [0.618_034, 0.414_214].map(|step| (f32::from(i) * step).fract());
        let (texcoord, position) = ([u, v], [u, v, 0.0]);
        let point = ShadingPoint { texcoord, position, position_object: position, ..ShadingPoint::default() };
        patterns.at(&point) != origin
    })
}
