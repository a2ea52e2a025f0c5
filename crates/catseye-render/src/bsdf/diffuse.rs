//! Lobes that are sampled by the cosine: `oren_nayar_diffuse_bsdf`, `burley_diffuse_bsdf`, `translucent_bsdf`
//! and `sheen_bsdf`.

use std::f32::consts::{FRAC_1_PI, PI};
use std::sync::LazyLock;

use glam::{Vec2, Vec3};

use super::albedo::{AlbedoTable, mean_over_square};
use super::oren_nayar::OrenNayar;

/// A lobe that is sampled like Lambert's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Diffuse {
    OrenNayar(OrenNayar),
    /// Burley, "Physically Based Shading at Disney", SIGGRAPH 2012.
    Burley {
        color: Vec3,
        roughness: f32,
    },
    /// Lambert's law on the other side.
    Translucent {
        color: Vec3,
    },
    /// Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", 2017.
    Sheen {
        color: Vec3,
        roughness: f32,
    },
}

impl Diffuse {
    pub(crate) fn burley(color: Vec3, roughness: f32) -> Self {
        Self::Burley { color, roughness: roughness.clamp(0.0, 1.0) }
    }

    pub(crate) fn sheen(color: Vec3, roughness: f32) -> Self {
        Self::Sheen { color, roughness: roughness.clamp(SMALLEST_SHEEN, 1.0) }
    }

    #[inline]
    pub(crate) fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if wo.z <= 0.0 || self.cosine(wi) <= 0.0 {
            return Vec3::ZERO;
        }
        match *self {
            Self::OrenNayar(lobe) => lobe.eval(wo, wi),
            Self::Burley { color, roughness } => color * burley(wo, wi, roughness),
            Self::Translucent { color } => color * FRAC_1_PI,
            Self::Sheen { color, roughness } => color * sheen(wo, wi, roughness),
        }
    }

    /// The cosine of a direction on the side that the lobe scatters to.
    fn cosine(&self, wi: Vec3) -> f32 {
        if matches!(self, Self::Translucent { .. }) { -wi.z } else { wi.z }
    }

    #[inline]
    pub(crate) fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if wo.z > 0.0 { self.cosine(wi).max(0.0) * FRAC_1_PI } else { 0.0 }
    }

    #[inline]
    pub(crate) fn sample(&self, u: [f32; 2]) -> Vec3 {
        let wi = cosine_hemisphere(u);
        Vec3::new(wi.x, wi.y, self.cosine(wi))
    }

    #[inline]
    pub(crate) fn albedo(&self, wo: Vec3) -> Vec3 {
        match *self {
            Self::OrenNayar(lobe) => lobe.albedo(wo),
            Self::Burley { color, roughness } => color * ALBEDO.look_up(roughness, wo.z).x,
            Self::Translucent { color } => color,
            Self::Sheen { color, roughness } => color * sheen_albedo(roughness, wo),
        }
    }

    /// The share of energy that goes on to what `layer` puts below: fibres let through what they don't
    /// scatter, diffuse surfaces nothing.
    #[inline]
    pub(crate) fn throughput(&self, wo: Vec3) -> Vec3 {
        match *self {
            Self::Sheen { roughness, .. } => Vec3::splat(1.0 - sheen_albedo(roughness, wo)),
            Self::OrenNayar(_) | Self::Burley { .. } | Self::Translucent { .. } => Vec3::ZERO,
        }
    }
}

/// A direction distributed as the cosine of its polar angle (Malley's method).
pub(crate) fn cosine_hemisphere(u: [f32; 2]) -> Vec3 {
    let (sin_phi, cos_phi) = (2.0 * PI * u[0]).sin_cos();
    let radius = u[1].sqrt();
    // Keeps the direction above the horizon where u rounds to 1.
    Vec3::new(radius * cos_phi, radius * sin_phi, (1.0 - u[1]).max(1e-12).sqrt())
}

/// Below it the fibres' distribution is too steep for single precision.
const SMALLEST_SHEEN: f32 = 0.05;

/// Directional albedos over roughness and cosine: Burley's and the sheen's, both white.
static ALBEDO: LazyLock<AlbedoTable<Vec2>> = LazyLock::new(|| {
    AlbedoTable::new(32, |roughness, wo| {
        let mean = |f: fn(Vec3, Vec3, f32) -> f32, roughness| {
            mean_over_square(|u| PI * f(wo, cosine_hemisphere(u), roughness))
        };
        Vec2::new(mean(burley, roughness), mean(sheen, roughness.max(SMALLEST_SHEEN)))
    })
});

fn sheen_albedo(roughness: f32, wo: Vec3) -> f32 {
    ALBEDO.look_up(roughness, wo.z).y.min(1.0)
}

fn burley(wo: Vec3, wi: Vec3, roughness: f32) -> f32 {
    let cos_d = (wo + wi).normalize_or(Vec3::Z).dot(wi);
    let grazing = 0.5 + 2.0 * roughness * cos_d * cos_d;
    let factor = |cos: f32| 1.0 + (grazing - 1.0) * (1.0 - cos).max(0.0).powi(5);
    FRAC_1_PI * factor(wo.z) * factor(wi.z)
}

fn sheen(wo: Vec3, wi: Vec3, roughness: f32) -> f32 {
    let cos_h = (wo + wi).normalize_or(Vec3::Z).z;
    let sin_h = (1.0 - cos_h * cos_h).max(0.0).sqrt();
    let distribution = (2.0 + 1.0 / roughness) * sin_h.powf(1.0 / roughness) / (2.0 * PI);
    distribution / (4.0 * (wo.z + wi.z - wo.z * wi.z)).max(1e-6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn albedos_are_the_means_of_what_is_evaluated() {
        let color = Vec3::ONE;
        for lobe in [Diffuse::burley(color, 0.4), Diffuse::Translucent { color }, Diffuse::sheen(color, 0.3)]
        {
            for cos in [0.2_f32, 0.6, 1.0] {
                let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                let mean = mean_over_square(|u| {
                    let wi = lobe.sample(u);
                    lobe.eval(wo, wi).x * wi.z.abs() / lobe.pdf(wo, wi)
                });
                let albedo = lobe.albedo(wo).x;
                assert!((albedo - mean).abs() < 0.01, "{lobe:?} {cos}: {albedo} {mean}");
            }
        }
    }
}
