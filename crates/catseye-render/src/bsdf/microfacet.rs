//! Reflection by rough facets with a coloured Fresnel curve: `conductor_bsdf` and `generalized_schlick_bsdf`.

use std::sync::LazyLock;

use glam::{Vec2, Vec3};

use super::albedo::{AlbedoTable, mean_over_square};
use super::fresnel::Fresnel;
use super::ggx::{Ggx, SMOOTH_ALPHA};

/// Rough facets that reflect, single scattering.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Microfacet {
    fresnel: Fresnel,
    ggx: Ggx,
    smooth: bool,
    /// Whether what is not reflected goes on to what lies below.
    transparent: bool,
}

impl Microfacet {
    pub(crate) fn new(fresnel: Fresnel, alpha: [f32; 2]) -> Self {
        let smooth = alpha[0].max(alpha[1]) < SMOOTH_ALPHA;
        let ggx = Ggx { alpha: alpha.map(|a| a.clamp(SMOOTH_ALPHA, 1.0)) };
        let transparent = matches!(fresnel, Fresnel::Schlick { .. });
        Self { fresnel, ggx, smooth, transparent }
    }

    /// Whether only `sample` can meet the lobe.
    pub(crate) fn is_dirac(&self) -> bool {
        self.smooth
    }

    /// f without cosine, and the density of `wi`. Both 0 for a mirror.
    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Vec3, f32) {
        if self.smooth || wo.z <= 0.0 || wi.z <= 0.0 {
            return (Vec3::ZERO, 0.0);
        }
        let Some(m) = (wo + wi).try_normalize() else { return (Vec3::ZERO, 0.0) };
        let cos = wo.dot(m).clamp(0.0, 1.0);
        let f = self.fresnel.at(cos) * (self.ggx.d(m) * self.ggx.g2(wo, wi) / (4.0 * wo.z * wi.z));
        let pdf = self.ggx.d_visible(wo, m) / (4.0 * cos);
        if f.is_finite() && pdf.is_finite() { (f, pdf) } else { (Vec3::ZERO, 0.0) }
    }

    /// A direction; `None` where the facets send it below the horizon.
    pub(crate) fn sample(&self, wo: Vec3, u: [f32; 2]) -> Option<Vec3> {
        let m = if self.smooth { Vec3::Z } else { self.ggx.sample_visible(wo, u) };
        let wi = m * (2.0 * wo.dot(m)) - wo;
        (wi.z > 0.0).then_some(wi)
    }

    /// What a mirror does with the energy.
    pub(crate) fn dirac_weight(&self, wo: Vec3) -> Vec3 {
        self.fresnel.at(wo.z.clamp(0.0, 1.0))
    }

    /// The share of energy that is reflected. Approximate: Schlick's curve of exponent 5 through the ends of
    /// the Fresnel curve.
    pub(crate) fn albedo(&self, wo: Vec3) -> Vec3 {
        if self.smooth {
            return self.dirac_weight(wo);
        }
        // An isotropic lobe of about the same width.
        let alpha = (self.ggx.alpha[0] * self.ggx.alpha[1]).sqrt();
        let [facing, grazing] = ALBEDO.look_up(alpha.sqrt(), wo.z).to_array();
        self.fresnel.at(1.0) * facing + self.fresnel.at(0.0) * grazing
    }

    /// The share of energy that goes on to what `layer` puts below.
    pub(crate) fn throughput(&self, wo: Vec3) -> Vec3 {
        if self.transparent { Vec3::ONE - self.albedo(wo) } else { Vec3::ZERO }
    }
}

/// What of the reflectances at normal and at grazing incidence counts, over the root of alpha and the cosine.
static ALBEDO: LazyLock<AlbedoTable<Vec2>> = LazyLock::new(|| {
    AlbedoTable::new(32, |root_alpha, wo| {
        let ggx = Ggx { alpha: [(root_alpha * root_alpha).max(SMOOTH_ALPHA); 2] };
        let part = |weight: fn(f32) -> f32| {
            mean_over_square(|u| {
                let m = ggx.sample_visible(wo, u);
                let cos = wo.dot(m).clamp(0.0, 1.0);
                let wi = m * (2.0 * cos) - wo;
                if wi.z > 0.0 { weight((1.0 - cos).powi(5)) * ggx.g2(wo, wi) / ggx.g1(wo) } else { 0.0 }
            })
        };
        Vec2::new(part(|s| 1.0 - s), part(|s| s))
    })
});

#[cfg(test)]
mod tests {
    use super::*;

    fn gold() -> Fresnel {
        Fresnel::Conductor { n: Vec3::new(0.183, 0.421, 1.373), k: Vec3::new(3.424, 2.346, 1.770) }
    }

    #[test]
    fn albedos_are_about_the_means_of_the_weights() {
        let schlick =
            Fresnel::Schlick { at_0: Vec3::splat(0.04), at_82: Vec3::ONE, at_90: Vec3::ONE, exponent: 5.0 };
        for (fresnel, tolerance) in [(gold(), 0.03), (schlick, 0.01)] {
            for alpha in [0.05, 0.25, 1.0] {
                let lobe = Microfacet::new(fresnel, [alpha; 2]);
                for cos in [0.1_f32, 0.5, 1.0] {
                    let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                    let mean = mean_over_square(|u| {
                        let Some(wi) = lobe.sample(wo, u) else { return 0.0 };
                        let (f, pdf) = lobe.eval_pdf(wo, wi);
                        if pdf > 0.0 { f.x * wi.z / pdf } else { 0.0 }
                    });
                    let albedo = lobe.albedo(wo).x;
                    assert!((albedo - mean).abs() < tolerance, "{fresnel:?} {alpha} {cos}: {albedo} {mean}");
                }
            }
        }
    }
}
