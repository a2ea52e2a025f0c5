//! One back-vector lobe of constant inputs over a diffuse base: what engines have.

use catseye::{BackVector, Lobe as _, Model, Vec3, width};

use crate::fit::{EntranceKind, FitError, FitOptions, Observation, fit};
use crate::{Colour, luminance, significant};

/// Digits of the numbers that are written, and that errors are those of.
const DIGITS: i32 = 6;

/// A back-vector GGX lobe (Portsmouth et al., JCGT 15(1), 2026) whose reflectance is the same at every angle,
/// and a Lambertian base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingleLobe {
    /// Reflectance of the lobe per channel, linear Rec. 709, in `[0, 1]`.
    pub tint: [f64; 3],
    /// GGX's alpha, the square of an engine's roughness.
    pub alpha: f64,
    /// Albedo of the base per channel, linear Rec. 709, in `[0, 1]`.
    pub base: [f64; 3],
}

/// Colours of a material: of what comes back, and of what is seen by day.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colours {
    /// Of the lobe.
    pub lobe: Colour,
    /// Of the base.
    pub base: Colour,
}

impl Colours {
    /// The greatest channel for luminance 1.
    #[must_use]
    pub fn peak(&self) -> f64 {
        self.lobe.peak().max(self.base.peak())
    }
}

impl SingleLobe {
    /// The lobe that is nearest to the observations: in the least squares of logarithms, and then in the
    /// worst of them.
    ///
    /// A lobe narrower than `least_alpha` is not looked for. `base` is the luminance of the base's albedo,
    /// what it returns is not part of the observations.
    ///
    /// # Errors
    /// As [`fit`].
    pub fn fit(
        observations: &[Observation],
        colours: &Colours,
        base: f64,
        least_alpha: f64,
    ) -> Result<Self, FitError> {
        let options = FitOptions {
            model: Model::BackVector,
            lobes: Some(1),
            entrance: Some(EntranceKind::Constant),
            isotropic: true,
            channel_peak: colours.peak(),
            ..FitOptions::default()
        };
        let mut found = fit(observations, &options)?;
        if width(found.sheeting.lobes[0].roughness[0]) < least_alpha {
            // The roughness whose width is alpha.
            let roughness = (2.0 / (1.0 / (least_alpha * least_alpha) - 1.0)).sqrt();
            found = fit(observations, &FitOptions { roughness: Some(roughness), ..options })?;
        }
        let lobe = &found.sheeting.lobes[0];
        let share =
            |colour: Colour, luminance| colour.of_luminance(luminance).map(|x: f64| rounded(x.min(1.0)));
        Ok(Self {
            tint: share(colours.lobe, lobe.strength),
            alpha: width(lobe.roughness[0]).max(least_alpha),
            base: share(colours.base, base),
        })
    }

    /// What engines call roughness: the square root of alpha.
    fn roughness(&self) -> f64 {
        rounded(self.alpha.sqrt())
    }
}

/// The inputs of a dielectric in glTF with `KHR_materials_specular` and `KHR_materials_retroreflection`, and
/// of three.js, whose names differ.
///
/// Schlick's curve would make the lobe stronger towards grazing angles, where sheeting's becomes weaker. With
/// a `specular_color` that raises the reflectance of the interface to 1 it is flat, and `specular` alone is
/// the lobe's reflectance; a hue fades to white at grazing angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Colour of the base, linear Rec. 709.
    pub color: [f64; 3],
    /// The square root of GGX's alpha.
    pub roughness: f64,
    /// Strength of the reflection at every angle.
    pub specular: f64,
    /// Colour that multiplies the reflectance of the interface, linear Rec. 709, above 1.
    pub specular_color: [f64; 3],
    /// Whether the base loses what is reflected channel by channel, as in three.js, or what is reflected in
    /// the greatest channel, as in glTF.
    pub by_channel: bool,
}

/// Reflectance at normal incidence of the index of refraction 1.5, which both have where none is given.
const F0: f64 = 0.04;

impl Dielectric {
    /// The inputs for a lobe.
    #[must_use]
    pub fn new(lobe: &SingleLobe, by_channel: bool) -> Self {
        let specular = lobe.tint.into_iter().fold(0.0, f64::max);
        let lost = |c: usize| if by_channel { lobe.tint[c] } else { specular };
        Self {
            color: [0, 1, 2].map(|c| rounded((lobe.base[c] / (1.0 - lost(c)).max(1e-9)).min(1.0))),
            roughness: lobe.roughness(),
            specular,
            specular_color: lobe.tint.map(|tint| rounded(tint / specular / F0)),
            by_channel,
        }
    }

    /// The BSDF in 1/sr per channel, as the glTF specification's appendix B and the two extensions have it.
    #[must_use]
    pub fn eval(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> [f64; 3] {
        let shape = ggx(self.roughness.powi(2), wo, wi);
        let f = [0, 1, 2].map(|c| self.specular * schlick((F0 * self.specular_color[c]).min(1.0), wo, wi));
        let greatest = f.into_iter().fold(0.0, f64::max);
        let lost = |c: usize| if self.by_channel { f[c] } else { greatest };
        let base = |c: usize| self.color[c] / std::f64::consts::PI * (1.0 - lost(c));
        [0, 1, 2].map(|c| f[c] * shape + base(c))
    }
}

/// The inputs of OpenPBR 1.2 with `specular_retroreflectivity` 1.
///
/// A metal whose greatest channel is 1 has no Fresnel curve in it, and `specular_weight` dims it; beside it,
/// mixed by `base_metalness`, is the diffuse base under an interface of index 1, which reflects nothing. Both
/// have the same hue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenPbr {
    /// `base_color`, linear Rec. 709.
    pub base_color: [f64; 3],
    /// `base_metalness`.
    pub base_metalness: f64,
    /// `specular_weight`.
    pub specular_weight: f64,
    /// `specular_roughness`.
    pub specular_roughness: f64,
}

impl OpenPbr {
    /// The inputs for a lobe, of the hue of its base where it has one. The luminances of both are the lobe's.
    #[must_use]
    pub fn new(lobe: &SingleLobe) -> Self {
        let hue = if luminance(lobe.base) > 0.0 { lobe.base } else { lobe.tint };
        let greatest = hue.into_iter().fold(0.0, f64::max);
        let color = hue.map(|x| rounded(x / greatest));
        let base = luminance(lobe.base) / luminance(color);
        let metalness = rounded(1.0 - base);
        Self {
            base_color: color,
            base_metalness: metalness,
            specular_weight: rounded(luminance(lobe.tint) / luminance(color) / metalness.max(1e-9)),
            specular_roughness: lobe.roughness(),
        }
    }

    /// The BSDF in 1/sr per channel: OpenPBR's model without coat, fuzz and what is transmitted.
    #[must_use]
    pub fn eval(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> [f64; 3] {
        let shape = self.base_metalness * self.specular_weight * ggx(self.specular_roughness.powi(2), wo, wi);
        let base = (1.0 - self.base_metalness) / std::f64::consts::PI;
        self.base_color.map(|color| shape * schlick(color, wo, wi) + base * color)
    }
}

/// The back-vector GGX lobe of reflectance 1.
fn ggx(alpha: f64, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
    BackVector::new([alpha.min(1.0); 2], [1.0; 3]).map_or(0.0, |lobe| lobe.eval(wo, wi)[0])
}

/// Schlick's curve from `f0` to 1, at the half vector of the light and the mirrored viewer.
fn schlick(f0: f64, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
    let between = wo.z * wi.z - wo.x * wi.x - wo.y * wi.y;
    let cosine = (0.5 * (1.0 + between)).max(0.0).sqrt();
    f0 + (1.0 - f0) * (1.0 - cosine).powi(5)
}

/// A number as it is written.
fn rounded(x: f64) -> f64 {
    significant(x, DIGITS).parse().unwrap_or(x)
}
