//! The materials of the built-in scene.

use catseye::{Model, Params};
use catseye_materialx::{Closure, Material};
use glam::Vec3;

use crate::{Bsdf, Error, Frame, MaterialId, SceneBuilder};

/// White.
pub(crate) const WHITE: Vec3 = Vec3::ONE;
/// Red of warning signs.
pub(crate) const RED: Vec3 = Vec3::new(0.62, 0.035, 0.03);
/// Yellow-green of cats' eyes.
pub(crate) const CAT_GREEN: Vec3 = Vec3::new(0.55, 0.85, 0.06);
/// Amber of road studs.
pub(crate) const AMBER: Vec3 = Vec3::new(0.95, 0.45, 0.03);

/// Albedo of matte white paint.
const PAINT: f32 = 0.8;

/// What signs, bands and studs are covered with, in any colour.
#[derive(Debug)]
pub(crate) struct Finish {
    white: Material,
    model: Model,
}

impl Finish {
    /// Retro-reflective sheeting: the given material, or one like beaded sheeting.
    pub(crate) fn sheeting(material: Option<&Material>, model: Model) -> Self {
        match material {
            Some(material) => Self { white: material.clone(), model },
            None => Self::of(beaded_sheeting(), model),
        }
    }

    fn of(bsdf: Closure, model: Model) -> Self {
        Self { white: Material::of(bsdf), model }
    }

    /// Matte paint of the same colour: of albedo 0.8 in the channel that the finish scatters most of,
    /// head-on.
    pub(crate) fn paint(&self) -> Result<Self, Error> {
        let bsdf = Bsdf::with_model(&self.white.surface.bsdf, self.model)?;
        let albedo = bsdf.at(Frame::from_normal(Vec3::Z), Vec3::Z, false).albedo();
        let peak = albedo.max_element();
        let color = if peak > 0.0 { albedo / peak } else { Vec3::ONE };
        Ok(Self::of(diffuse((color * PAINT).to_array()), self.model))
    }

    /// Adds the finish in a colour to a scene.
    pub(crate) fn material(&self, builder: &mut SceneBuilder, color: Vec3) -> Result<MaterialId, Error> {
        builder.tinted_materialx(&self.white, self.model, color)
    }
}

/// Sheeting with a wide lobe: seen from 1.4 degrees beside the lamps it still returns some thirty times the
/// light of white paint.
fn beaded_sheeting() -> Closure {
    let retro =
        Closure::RetroReflective { weight: 1.0, params: Params::isotropic(0.02).with_tint([0.04; 3]) };
    Closure::Layer { top: Box::new(retro), base: Box::new(diffuse([0.35; 3])) }
}

fn diffuse(color: [f32; 3]) -> Closure {
    Closure::OrenNayarDiffuse { weight: 1.0, color, roughness: 0.2, energy_compensation: true }
}
