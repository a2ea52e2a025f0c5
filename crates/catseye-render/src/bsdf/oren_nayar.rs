//! Rough diffuse reflection: `oren_nayar_diffuse_bsdf`.

use std::f32::consts::{FRAC_1_PI, PI};
use std::sync::LazyLock;

use glam::Vec3;

use super::albedo::{AlbedoTable, mean_over_square};
use super::diffuse::cosine_hemisphere;

/// Oren and Nayar's model of diffuse facets, in one of MaterialX's two forms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OrenNayar {
    color: Vec3,
    form: Form,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// The qualitative model, Oren and Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994,
    /// Eq. 27.
    Qualitative { a: f32, b: f32 },
    /// EON: Portsmouth, Kutz and Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT 14(1),
    /// 2025.
    EnergyPreserving { a: f32, roughness: f32 },
}

impl OrenNayar {
    /// `roughness` is the slope's standard deviation, or in the energy-preserving form EON's roughness in
    /// `[0, 1]`.
    pub(crate) fn new(color: Vec3, roughness: f32, energy_compensation: bool) -> Self {
        let form = if energy_compensation {
            let roughness = roughness.clamp(0.0, 1.0);
            Form::EnergyPreserving { a: 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * roughness), roughness }
        } else {
            let sigma2 = roughness * roughness;
            let a = 1.0 - 0.5 * sigma2 / (sigma2 + 0.33);
            let b = 0.45 * sigma2 / (sigma2 + 0.09);
            Form::Qualitative { a, b }
        };
        Self { color: color.clamp(Vec3::ZERO, Vec3::ONE), form }
    }

    /// f for directions above the surface.
    #[inline]
    pub(crate) fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        match &self.form {
            Form::Qualitative { a, b } => self.color * (FRAC_1_PI * (a + b * qualitative_slope(wo, wi))),
            Form::EnergyPreserving { a, roughness } => {
                let s = wo.dot(wi) - wo.z * wi.z;
                let s_over_t = if s > 0.0 { s / wo.z.max(wi.z) } else { s };
                let single = self.color * (FRAC_1_PI * a * (1.0 + roughness * s_over_t));
                single + multiple(self.color, *a, *roughness, wo.z, wi.z)
            }
        }
    }

    #[inline]
    pub(crate) fn albedo(&self, wo: Vec3) -> Vec3 {
        match &self.form {
            Form::Qualitative { a, b } => self.color * (a + b * SLOPE_ALBEDO.look_up(0.0, wo.z)),
            Form::EnergyPreserving { a, roughness } => {
                let single = facet_albedo(*a, *roughness, wo.z);
                self.color * single + multiple_tint(self.color, *a, *roughness) * (1.0 - single)
            }
        }
    }
}

/// The mean of [`qualitative_slope`], cosine-weighted: the same for all roughnesses.
static SLOPE_ALBEDO: LazyLock<AlbedoTable> = LazyLock::new(|| {
    AlbedoTable::new(1, |_, wo| mean_over_square(|u| qualitative_slope(wo, cosine_hemisphere(u))))
});

/// The part of the qualitative model that depends on the azimuth between the directions.
fn qualitative_slope(wo: Vec3, wi: Vec3) -> f32 {
    let s = wo.dot(wi) - wo.z * wi.z;
    if s > 0.0 { s / wo.z.max(wi.z) } else { 0.0 }
}

/// EON, Eq. 17: light that left a facet towards another.
fn multiple(color: Vec3, a: f32, roughness: f32, cos_o: f32, cos_i: f32) -> Vec3 {
    let lost = (1.0 - facet_albedo(a, roughness, cos_o)) * (1.0 - facet_albedo(a, roughness, cos_i));
    let lost_mean = (1.0 - mean_facet_albedo(a, roughness)).max(1e-7);
    multiple_tint(color, a, roughness) * (FRAC_1_PI * lost.max(0.0) / lost_mean)
}

/// The share of the light that leaves a facet towards another and comes back out.
fn multiple_tint(color: Vec3, a: f32, roughness: f32) -> Vec3 {
    let mean = mean_facet_albedo(a, roughness);
    color * color * mean / (Vec3::ONE - color * (1.0 - mean).max(1e-7))
}

/// The hemispherical mean of [`facet_albedo`].
fn mean_facet_albedo(a: f32, roughness: f32) -> f32 {
    a * (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * PI)) * roughness)
}

/// The directional albedo of single scattering by white facets (Fujii's improved Oren-Nayar model).
fn facet_albedo(a: f32, roughness: f32, cos_theta: f32) -> f32 {
    let cos = cos_theta.max(1e-4);
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let theta = cos.min(1.0).acos();
    let g = sin * (theta - sin * cos) + (2.0 / 3.0) * ((sin / cos) * (1.0 - sin * sin * sin) - sin);
    a * (1.0 + roughness * FRAC_1_PI * g)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn albedos_are_the_means_of_what_is_evaluated() {
        for (roughness, compensated) in [(0.0, true), (0.4, true), (1.0, true), (0.4, false), (2.0, false)] {
            let lobe = OrenNayar::new(Vec3::new(1.0, 0.5, 0.1), roughness, compensated);
            for cos_theta in [0.05_f32, 0.3, 0.7, 1.0] {
                let wo = Vec3::new((1.0 - cos_theta * cos_theta).sqrt(), 0.0, cos_theta);
                for channel in 0..3 {
                    let mean = mean_over_square(|u| PI * lobe.eval(wo, cosine_hemisphere(u))[channel]);
                    let albedo = lobe.albedo(wo)[channel];
                    let case =
                        format!("roughness {roughness}, {compensated}, cos {cos_theta}: {albedo} {mean}");
                    // 512 points of the quadrature.
                    assert!((albedo - mean).abs() < 5e-3, "{case}");
                }
            }
        }
    }

    #[test]
    fn qualitative_diffuse_gains_no_more_than_known() {
        // At grazing the albedo is A + B / 2, which exceeds 1 by up to 0.015 (at a roughness of 0.2).
        for roughness in [0.0, 0.2, 1.0, 10.0] {
            let lobe = OrenNayar::new(Vec3::ONE, roughness, false);
            for cos_theta in [0.01_f32, 0.3, 1.0] {
                let wo = Vec3::new((1.0 - cos_theta * cos_theta).sqrt(), 0.0, cos_theta);
                assert!(lobe.albedo(wo).x < 1.02);
            }
        }
    }
}
