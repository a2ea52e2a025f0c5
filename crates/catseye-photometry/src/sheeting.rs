//! Sheeting as a sum of lobes: what a fit looks for, and what a written material is.

use std::f64::consts::PI;
use std::sync::LazyLock;

use catseye::{BackVector, Lobe as _, Model, ParamError, Vec3};

use crate::entrance::{EntranceLaw, LEAST_COSINE, LogGradient, log_squared_tangent};
use crate::lobe::{Pair, UnitLobe};

/// Cosines over which the energy is bounded.
const ENERGY_STEPS: usize = 96;

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
    /// Roughness of the coat's surface, GGX's alpha in [0, 1]; 0 is smooth. What lies below sees a smooth
    /// one.
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
        self.greatest_albedo().0
    }

    /// [`Sheeting::albedo_bound`], and where it is: the logarithm of the squared tangent.
    pub(crate) fn greatest_albedo(&self) -> (f64, f64) {
        static NODES: LazyLock<Vec<f64>> = LazyLock::new(|| {
            let cosine = |i| LEAST_COSINE + (1.0 - LEAST_COSINE) * i as f64 / ENERGY_STEPS as f64;
            (0..=ENERGY_STEPS).map(cosine).map(log_squared_tangent).collect()
        });
        let at = |&log_tangent: &f64| (self.tints(log_tangent).map(|tint| tint.0).sum(), log_tangent);
        let (greatest, place) = NODES.iter().map(at).fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a });
        (self.diffuse + greatest, place)
    }

    /// Whether the albedo may exceed a limit, without a look at every direction: of a law that falls as the
    /// cosine at least, F / (N.V) is nowhere above 1 / cos b0 (docs/theory.md, section 10).
    pub(crate) fn may_exceed(&self, limit: f64) -> bool {
        let greatest = |lobe: &RetroLobe| match lobe.entrance {
            Some(law) if law.slope < 1.0 => f64::INFINITY,
            Some(law) if !law.is_power() => lobe.strength * (1.0 + law.bend).sqrt(),
            _ => lobe.strength,
        };
        self.diffuse + self.lobes.iter().map(greatest).sum::<f64>() > limit
    }

    /// The lobes' tints for a direction to the viewer, by the logarithm of its squared tangent, with the
    /// gradients of their laws.
    pub(crate) fn tints(
        &self,
        log_tangent: f64,
    ) -> impl Iterator<Item = (f64, Option<LogGradient>)> + use<'_> {
        self.lobes.iter().map(move |lobe| {
            let gradient = lobe.entrance.map(|law| law.log_gradient(log_tangent));
            // 1 / (N.V)^2 is 1 more than the squared tangent.
            let secant = (1.0 + log_tangent.exp()).sqrt();
            let width = if lobe.keeps_width(self.model) { secant } else { 1.0 };
            (lobe.strength * gradient.map_or(1.0, |gradient| gradient.log.exp()) * width, gradient)
        })
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
        let pair = Pair::new(model, wo, wi);
        let lobes = self.sheeting.lobes.iter().zip(&self.lobes);
        let retro: f64 =
            lobes.map(|(own, lobe)| own.strength * own.factor(model, wo.z) * lobe.eval(&pair)).sum();
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

/// Reflectance of a smooth dielectric for unpolarised light that arrives from outside.
pub(crate) fn fresnel(cosine: f64, ior: f64) -> f64 {
    let c = cosine.clamp(0.0, 1.0);
    let g = (ior * ior - 1.0 + c * c).max(0.0).sqrt();
    let (s, p) = ((c - g) / (c + g), (ior * ior * c - g) / (ior * ior * c + g));
    0.5 * (s * s + p * p)
}
