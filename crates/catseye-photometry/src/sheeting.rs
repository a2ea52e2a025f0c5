//! Sheeting as a sum of lobes: what a fit looks for, and what a written material is.

use catseye::{AnyLobe, Lobe as _, Model, ParamError, Params, Vec3};

use crate::entrance::{EntranceFactor, LEAST_COSINE};

/// Cosines over which the energy is bounded.
const ENERGY_STEPS: usize = 96;

/// Which cosine the entrance factors see.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EntranceCosine {
    /// That of the direction to the viewer: all that a node graph knows. The sum is not reciprocal.
    #[default]
    Viewer,
    /// The geometric mean of both cosines: reciprocal, and the same in the retro direction.
    Reciprocal,
}

/// One lobe of a sheeting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RetroLobe {
    /// Luminance of the tint at normal incidence.
    pub strength: f64,
    /// Roughness along and across the datum axis, the proposal's in every model.
    pub roughness: [f64; 2],
    /// How the strength depends on the entrance angle.
    pub entrance: EntranceFactor,
}

/// A retro-reflective material in terms of luminance: lobes, a diffuse base, and a clear coat over both.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheeting {
    /// Which lobe model.
    pub model: Model,
    /// The lobes.
    pub lobes: Vec<RetroLobe>,
    /// Albedo of the diffuse base.
    pub diffuse: f64,
    /// Refractive index of a smooth clear coat, where there is one.
    pub coat_ior: Option<f64>,
    /// Which cosine the entrance factors see.
    pub form: EntranceCosine,
}

impl Sheeting {
    /// The sheeting with its lobes prepared for evaluation.
    ///
    /// # Errors
    /// The first roughness that is NaN or outside the range of the lobe model.
    pub fn prepare(&self) -> Result<PreparedSheeting<'_>, ParamError> {
        let lobes = self.lobes.iter().map(|lobe| unit_lobe(self.model, lobe.roughness));
        Ok(PreparedSheeting { sheeting: self, lobes: lobes.collect::<Result<_, _>>()? })
    }

    /// The cosine that the entrance factors see.
    #[must_use]
    pub(crate) fn entrance_cosine(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        match self.form {
            EntranceCosine::Viewer => wo.z,
            EntranceCosine::Reciprocal => (wo.z * wi.z).max(0.0).sqrt(),
        }
    }

    /// What the coat lets through: as a layer in MaterialX, once, by the direction to the viewer.
    #[must_use]
    pub(crate) fn transmitted(&self, wo: Vec3<f64>) -> f64 {
        self.coat_ior.map_or(1.0, |ior| 1.0 - fresnel(wo.z, ior))
    }

    /// An upper bound of the albedo over all directions, in luminance: the lobes lose nothing.
    #[must_use]
    pub fn albedo_bound(&self) -> f64 {
        let at = |i: usize| {
            let c = LEAST_COSINE + (1.0 - LEAST_COSINE) * i as f64 / ENERGY_STEPS as f64;
            self.lobes.iter().map(|lobe| lobe.strength * lobe.entrance.at(c)).sum::<f64>()
        };
        self.diffuse + (0..=ENERGY_STEPS).map(at).fold(0.0, f64::max)
    }
}

/// A lobe of strength 1.
pub(crate) fn unit_lobe(model: Model, [u, v]: [f64; 2]) -> Result<AnyLobe<f64>, ParamError> {
    AnyLobe::new(model, &Params::anisotropic(u, v))
}

/// A [`Sheeting`] ready for evaluation.
#[derive(Clone, Debug)]
pub struct PreparedSheeting<'a> {
    sheeting: &'a Sheeting,
    lobes: Vec<AnyLobe<f64>>,
}

impl PreparedSheeting<'_> {
    /// The BSDF in 1/sr, in luminance, without the reflection by the surface of the coat.
    #[must_use]
    pub fn eval(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        let cosine = self.sheeting.entrance_cosine(wo, wi);
        let lobes = self.sheeting.lobes.iter().zip(&self.lobes);
        let retro: f64 =
            lobes.map(|(own, lobe)| own.strength * own.entrance.at(cosine) * lobe.eval(wo, wi)[0]).sum();
        let diffuse = if wo.z.min(wi.z) > 0.0 { self.sheeting.diffuse / core::f64::consts::PI } else { 0.0 };
        self.sheeting.transmitted(wo) * (retro + diffuse)
    }
}

/// Reflectance of a smooth dielectric for unpolarised light that arrives from outside.
fn fresnel(cosine: f64, ior: f64) -> f64 {
    let c = cosine.clamp(0.0, 1.0);
    let g = (ior * ior - 1.0 + c * c).max(0.0).sqrt();
    let (s, p) = ((c - g) / (c + g), (ior * ior * c - g) / (ior * ior * c + g));
    0.5 * (s * s + p * p)
}
