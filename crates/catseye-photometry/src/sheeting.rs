//! Sheeting as a sum of lobes: what a fit looks for, and what a written material is.

use std::f64::consts::PI;
use std::sync::LazyLock;

use catseye::{AnyLobe, BackVector, Edwards, Lobe as _, Model, ParamError, Params, Vec3};

use crate::entrance::{EntranceLaw, LEAST_COSINE, log_squared_tangent};

/// Cosines over which the energy is bounded.
const ENERGY_STEPS: usize = 96;
/// Length of a projected direction below which it has no azimuth: there all lobes are round.
const NO_AZIMUTH: f64 = 1e-12;

/// One lobe of a sheeting.
///
/// A lobe of one roughness with a law has the same angular width at every entrance angle, as beads and prisms
/// have: along the viewer's projection its roughness is that over N.V, and its tint is `strength` F / (N.V),
/// so that `R_A` at the observation angle 0 is F times that at normal incidence (docs/theory.md, section 10).
/// A lobe of two roughnesses lies along the datum axis, its tint is `strength` F, and in the plane of
/// incidence it narrows with the cosine, as the node does. The back-vector lobe keeps its width there by
/// itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RetroLobe {
    /// Luminance of the tint at normal incidence.
    pub strength: f64,
    /// Roughness along and across the datum axis, the proposal's in every model.
    pub roughness: [f64; 2],
    /// How the strength depends on the entrance angle, if it does.
    pub entrance: Option<EntranceLaw>,
}

/// A retro-reflective material in terms of luminance: lobes, a diffuse base, and a clear coat over both.
///
/// The laws see the direction to the viewer: all that a node graph knows. So the sum is not reciprocal;
/// [`crate::fit::Fit::reciprocity_cost`] says by how much.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheeting {
    /// Which lobe model.
    pub model: Model,
    /// The lobes.
    pub lobes: Vec<RetroLobe>,
    /// Albedo of the diffuse base.
    pub diffuse: f64,
    /// Refractive index of a clear coat, where there is one.
    pub coat_ior: Option<f64>,
    /// Roughness of the coat's surface, GGX's alpha in [0, 1]; 0 is smooth. What lies below sees a smooth one.
    pub coat_roughness: f64,
}

impl RetroLobe {
    /// Whether the lobe is made to keep its angular width over the entrance angle.
    #[must_use]
    pub fn keeps_width(&self, model: Model) -> bool {
        self.entrance.is_some() && self.roughness[0] == self.roughness[1] && model != Model::BackVector
    }

    /// The factor of the strength for a cosine of the viewer's direction.
    pub(crate) fn factor(&self, model: Model, cosine: f64) -> f64 {
        let law = self.entrance.map_or(1.0, |law| law.at(cosine));
        if self.keeps_width(model) { law / cosine.clamp(LEAST_COSINE, 1.0) } else { law }
    }
}

impl Sheeting {
    /// The sheeting with its lobes prepared for evaluation.
    ///
    /// # Errors
    /// The first roughness that is NaN or outside the range of the lobe model.
    pub fn prepare(&self) -> Result<PreparedSheeting<'_>, ParamError> {
        let lobes = self.lobes.iter().map(|lobe| UnitLobe::new(self.model, lobe));
        let surface = self.coat_ior.map(|ior| Surface::new(ior, self.coat_roughness)).transpose()?;
        Ok(PreparedSheeting { sheeting: self, lobes: lobes.collect::<Result<_, _>>()?, surface })
    }

    /// What the coat lets through: as a layer in MaterialX, once, by the direction to the viewer.
    #[must_use]
    pub(crate) fn transmitted(&self, wo: Vec3<f64>) -> f64 {
        self.coat_ior.map_or(1.0, |ior| 1.0 - fresnel(wo.z, ior))
    }

    /// An upper bound of the albedo over all directions, in luminance: the lobes lose nothing.
    ///
    /// The greatest sum of tints over the viewer's direction, at 97 cosines from 0.01 to 1.
    #[must_use]
    pub fn albedo_bound(&self) -> f64 {
        /// 1 / c and the logarithm of the squared tangent.
        static NODES: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
            let cosine = |i| LEAST_COSINE + (1.0 - LEAST_COSINE) * i as f64 / ENERGY_STEPS as f64;
            (0..=ENERGY_STEPS).map(cosine).map(|c| [1.0 / c, log_squared_tangent(c)]).collect()
        });
        let at = |[inverse, log_tangent]: &[f64; 2]| -> f64 {
            let tint = |lobe: &RetroLobe| {
                let law = lobe.entrance.map_or(1.0, |law| law.log_gradient(*log_tangent).log.exp());
                lobe.strength * law * if lobe.keeps_width(self.model) { *inverse } else { 1.0 }
            };
            self.lobes.iter().map(tint).sum()
        };
        self.diffuse + NODES.iter().map(at).fold(0.0, f64::max)
    }
}

/// A [`Sheeting`] ready for evaluation.
#[derive(Clone, Debug)]
pub struct PreparedSheeting<'a> {
    sheeting: &'a Sheeting,
    lobes: Vec<UnitLobe>,
    surface: Option<Surface>,
}

impl PreparedSheeting<'_> {
    /// The BSDF in 1/sr, in luminance, without the reflection by the surface of the coat.
    #[must_use]
    pub fn eval(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        let Sheeting { model, diffuse, .. } = *self.sheeting;
        let lobes = self.sheeting.lobes.iter().zip(&self.lobes);
        let retro: f64 =
            lobes.map(|(own, lobe)| own.strength * own.factor(model, wo.z) * lobe.eval(wo, wi)).sum();
        let diffuse = if wo.z.min(wi.z) > 0.0 { diffuse / PI } else { 0.0 };
        self.sheeting.transmitted(wo) * (retro + diffuse)
    }

    /// The BSDF in 1/sr with the reflection by the coat's surface, where that is rough.
    #[must_use]
    pub fn eval_with_surface(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        self.eval(wo, wi) + self.surface.as_ref().map_or(0.0, |surface| surface.eval(wo, wi))
    }
}

/// The surface of a coat: GGX facets of a dielectric, which reflect once.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    ior: f64,
    facets: BackVector<f64>,
}

impl Surface {
    pub(crate) fn new(ior: f64, roughness: f64) -> Result<Self, ParamError> {
        Ok(Self { ior, facets: BackVector::new([roughness; 2], [1.0; 3])? })
    }

    /// The BSDF in 1/sr; 0 of a smooth surface.
    pub(crate) fn eval(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        // The back-vector lobe is GGX's reflection with the viewer mirrored.
        let facets = self.facets.eval(Vec3::new(-wo.x, -wo.y, wo.z), wi)[0];
        facets * fresnel((0.5 + 0.5 * wo.dot(wi)).max(0.0).sqrt(), self.ior)
    }
}

/// A lobe of strength 1.
#[derive(Clone, Debug)]
pub(crate) enum UnitLobe {
    /// Along the datum axis, the same for all directions.
    Fixed(Box<AnyLobe<f64>>),
    /// Along the viewer's projection, of this roughness over N.V there and of this roughness across it.
    KeepsWidth(Model, f64),
}

impl UnitLobe {
    pub(crate) fn new(model: Model, lobe: &RetroLobe) -> Result<Self, ParamError> {
        let [u, v] = lobe.roughness;
        let fixed = AnyLobe::new(model, &Params::anisotropic(u, v))?;
        Ok(if lobe.keeps_width(model) { Self::KeepsWidth(model, u) } else { Self::Fixed(Box::new(fixed)) })
    }

    /// The BSDF in 1/sr.
    pub(crate) fn eval(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        match self {
            Self::Fixed(lobe) => lobe.eval(wo, wi)[0],
            &Self::KeepsWidth(model, roughness) => {
                let [wo, wi] = along_projection(wo, wi);
                let params = Params::anisotropic(roughness / wo.z.max(LEAST_COSINE), roughness);
                // Edwards' lobe has nothing to prepare; the reciprocal one is it times min(1, z_i/z_o)^3
                // (theory.md, 3).
                let reciprocal =
                    if model == Model::Reciprocal { (wi.z / wo.z).clamp(0.0, 1.0).powi(3) } else { 1.0 };
                let edwards = Edwards::new(&params);
                edwards.map_or(0.0, |lobe| reciprocal * lobe.eval(wo, wi)[0])
            }
        }
    }
}

/// Both directions in the frame whose x axis is the projection of `wo`.
pub(crate) fn along_projection(wo: Vec3<f64>, wi: Vec3<f64>) -> [Vec3<f64>; 2] {
    let length = wo.x.hypot(wo.y);
    if length < NO_AZIMUTH {
        return [wo, wi];
    }
    let (cos, sin) = (wo.x / length, wo.y / length);
    [wo, wi].map(|w| Vec3::new(w.x * cos + w.y * sin, w.y * cos - w.x * sin, w.z))
}

/// Reflectance of a smooth dielectric for unpolarised light that arrives from outside.
pub(crate) fn fresnel(cosine: f64, ior: f64) -> f64 {
    let c = cosine.clamp(0.0, 1.0);
    let g = (ior * ior - 1.0 + c * c).max(0.0).sqrt();
    let (s, p) = ((c - g) / (c + g), (ior * ior * c - g) / (ior * ior * c + g));
    0.5 * (s * s + p * p)
}
