//! A material without a scene: its BSDF for a pair of directions, as a goniometer would measure it.

use catseye::Model;
use catseye_materialx::{Material, ShadingPoint};
use glam::Vec3;

use crate::bsdf::Albedo;
use crate::material::MaterialBsdf;
use crate::{Error, Frame};

/// A flat specimen of a material: the normal is z, the tangent x, the texture coordinates are (0, 0).
#[derive(Debug)]
pub struct Specimen(MaterialBsdf);

impl Specimen {
    /// Prepares a material; its retro-reflective lobes are of the given model.
    ///
    /// # Errors
    /// As [`Bsdf::with_model`](crate::Bsdf::with_model).
    pub fn new(material: &Material, model: Model) -> Result<Self, Error> {
        MaterialBsdf::new(material, model, Vec3::ONE).map(Self)
    }

    /// The BSDF f(wo, wi) in 1/sr, the cosine not included, in linear Rec. 709. Unit directions that point
    /// away from the specimen, `wo` to the viewer, whom patterns see; 0 below the horizon.
    ///
    /// What the specimen lets through (`opacity` below 1) is not reflected, and what it emits is not part of
    /// it. Mirrors take no part, as no pair of directions meets them exactly: a smooth coat weakens what is
    /// below and adds nothing. Computed in `f32`: within 1e-3 of the exact lobe from a tenth of a degree on,
    /// down to a millionth of the peak (a test measures 6e-4).
    ///
    /// # Errors
    /// As [`Bsdf::with_model`](crate::Bsdf::with_model), where patterns make the BSDF; and
    /// [`Error::RetroMirror`] where light is sent back by a lobe of roughness 0, which returns everything in
    /// one direction.
    pub fn eval(&self, wo: catseye::Vec3<f64>, wi: catseye::Vec3<f64>) -> Result<[f64; 3], Error> {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return Ok([0.0; 3]);
        }
        let [wo, wi] = [wo, wi].map(|w| Vec3::new(w.x as f32, w.y as f32, w.z as f32));
        let point = || ShadingPoint { view: (-wo).to_array(), ..ShadingPoint::default() };
        let here = self.0.at(point, Albedo::Exact)?;
        if here.bsdf.has_retro_mirror() {
            return Err(Error::RetroMirror);
        }
        let frame = Frame { x: Vec3::X, y: Vec3::Y, z: Vec3::Z };
        let (f_cos, _) = here.bsdf.at(frame, wo, false).eval_pdf(wi);
        let share = f64::from(here.opacity) / f64::from(wi.z);
        Ok(f_cos.to_array().map(|channel| f64::from(channel) * share))
    }
}
