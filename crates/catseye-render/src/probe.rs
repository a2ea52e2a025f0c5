//! A material without a scene: its BSDF for a pair of directions, as a goniometer would measure it.

use catseye::Model;
use catseye_materialx::{Material, ShadingPoint};
use glam::Vec3;

use crate::{Bsdf, Error, Frame};

/// A point of a flat sample of a material: the normal is z, the tangent x, the texture coordinates are (0, 0).
#[derive(Debug)]
pub struct Probe {
    material: Material,
    model: Model,
    /// The BSDF of a material that is the same from everywhere.
    constant: Option<Bsdf>,
}

impl Probe {
    /// Prepares a material; its retro-reflective lobes are of the given model.
    ///
    /// # Errors
    /// As [`Bsdf::with_model`].
    pub fn new(material: &Material, model: Model) -> Result<Self, Error> {
        let prepared = Bsdf::with_model(&material.bsdf, model)?;
        let constant = material.patterns.is_none().then_some(prepared);
        Ok(Self { material: material.clone(), model, constant })
    }

    /// The BSDF f(wo, wi) in 1/sr, the cosine not included, in linear Rec. 709. Unit directions that point away from the
    /// sample, `wo` to the viewer, whom patterns see; 0 below the horizon.
    ///
    /// What the sample lets through (`opacity` below 1) is not reflected, and what it emits is not part of it. Mirrors
    /// take no part, as no pair of directions meets them exactly: a smooth coat weakens what is below and adds nothing.
    /// Computed in `f32`: within 1e-3 of the exact lobe from a tenth of a degree on, down to a millionth of the peak (a test measures 6e-4).
    ///
    /// # Errors
    /// As [`Bsdf::with_model`], where patterns make the BSDF; and [`Error::RetroMirror`] where light is sent back by a
    /// lobe of roughness 0, which returns everything in one direction.
    pub fn eval(&self, wo: catseye::Vec3<f64>, wi: catseye::Vec3<f64>) -> Result<[f64; 3], Error> {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return Ok([0.0; 3]);
        }
        let [wo, wi] = [wo, wi].map(|w| Vec3::new(w.x as f32, w.y as f32, w.z as f32));
        let here;
        let (bsdf, opacity) = match &self.constant {
            Some(bsdf) => (bsdf, self.material.opacity),
            None => {
                let (prepared, opacity) = self.seen_from(wo)?;
                here = prepared;
                (&here, opacity)
            }
        };
        if bsdf.has_retro_mirror() {
            return Err(Error::RetroMirror);
        }
        let frame = Frame { x: Vec3::X, y: Vec3::Y, z: Vec3::Z };
        let (f_cos, _) = bsdf.at(frame, wo, false).eval_pdf(wi);
        let share = f64::from(opacity.clamp(0.0, 1.0)) / f64::from(wi.z);
        Ok(f_cos.to_array().map(|channel| f64::from(channel) * share))
    }

    /// BSDF and opacity where patterns make them.
    fn seen_from(&self, wo: Vec3) -> Result<(Bsdf, f32), Error> {
        let point = ShadingPoint { view: (-wo).to_array(), ..ShadingPoint::default() };
        let surface = self.material.patterns.as_ref().map(|patterns| patterns.at(&point));
        let (closure, opacity) = match &surface {
            Some(surface) => (&surface.bsdf, surface.opacity),
            None => (&self.material.bsdf, self.material.opacity),
        };
        Ok((Bsdf::with_model(closure, self.model)?, opacity))
    }
}

#[cfg(test)]
mod tests {
    use catseye::{Lobe as _, Params, Reciprocal, Vec3};
    use catseye_materialx::{Closure, Document};

    use super::*;

    /// Directions at an observation and an entrance angle in the plane of the normal, in degrees.
    fn directions(observation_deg: f64, entrance_deg: f64) -> [Vec3<f64>; 2] {
        [entrance_deg - observation_deg, entrance_deg].map(|deg| Vec3::from_angles(deg.to_radians(), 0.0))
    }

    fn retro(roughness: f32) -> Material {
        let params = Params::isotropic(roughness).with_tint([0.5, 0.25, 0.125]);
        let bsdf = Closure::RetroReflective { weight: 1.0, params, tangent_u: None };
        Material { name: "sheeting".to_owned(), bsdf, ..Material::default() }
    }

    #[test]
    fn single_precision_is_enough_from_a_tenth_of_a_degree_on() {
        let mut worst: f64 = 0.0;
        for roughness in [0.0005_f32, 0.001, 0.003, 0.0057, 0.02, 0.1, 1.0] {
            let probe = Probe::new(&retro(roughness), Model::Reciprocal).unwrap();
            let exact = Reciprocal::<f64>::new(&Params::isotropic(f64::from(roughness))).unwrap();
            for observation in [0.1, 0.2, 0.33, 0.5, 1.0, 1.5, 2.0] {
                for entrance in [-40.0, -4.0, 5.0, 30.0, 60.0, 88.76] {
                    let [wo, wi] = directions(observation, entrance);
                    let expected = 0.5 * exact.eval(wo, wi)[0];
                    // What is a millionth of the peak is nothing to a photometer.
                    if expected < 1e-6 * 0.5 * exact.eval(wi, wi)[0] {
                        continue;
                    }
                    let [r, g, _] = probe.eval(wo, wi).unwrap();
                    worst = worst.max((r / expected - 1.0).abs());
                    assert!((g / r - 0.5).abs() < 1e-6);
                }
            }
        }
        println!("worst {worst:e}");
        assert!(worst < 1e-3, "{worst:e}");
    }

    #[test]
    fn patterns_see_the_receiver() {
        let text = r#"
            <materialx version="1.39">
              <facingratio name="cosine" type="float" />
              <oren_nayar_diffuse_bsdf name="paint" type="BSDF">
                <input name="weight" type="float" nodename="cosine" />
              </oren_nayar_diffuse_bsdf>
              <surface name="skin" type="surfaceshader">
                <input name="bsdf" type="BSDF" nodename="paint" />
                <input name="opacity" type="float" value="0.5" />
              </surface>
              <surfacematerial name="m" type="material">
                <input name="surfaceshader" type="surfaceshader" nodename="skin" />
              </surfacematerial>
            </materialx>"#;
        let material = Document::parse(text, "t.mtlx").unwrap().material(None).unwrap();
        let probe = Probe::new(&material, Model::Reciprocal).unwrap();
        let at = |deg: f64| {
            probe.eval(Vec3::from_angles(deg.to_radians(), 0.4), Vec3::new(0.0, 0.0, 1.0)).unwrap()[0]
        };
        let ratio = at(60.0) / at(0.0);
        assert!((ratio - 0.5).abs() < 1e-5, "{ratio}: the weight is the cosine to the viewer");
        assert!((at(0.0) - 0.5 * 0.18 / std::f64::consts::PI).abs() < 1e-6, "{}", at(0.0));
        let below = probe.eval(Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.0, 0.0, 1.0)).unwrap();
        assert_eq!(below, [0.0; 3]);
    }

    #[test]
    fn a_perfect_retro_reflector_is_refused() {
        let [wo, wi] = directions(0.2, 5.0);
        let error = Probe::new(&retro(0.0), Model::Reciprocal).unwrap().eval(wo, wi).unwrap_err();
        assert!(matches!(error, Error::RetroMirror), "{error}");
    }
}
