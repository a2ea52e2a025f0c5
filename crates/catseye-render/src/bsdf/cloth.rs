//! Diffuse lobes beside Oren and Nayar's: `burley_diffuse_bsdf`, `translucent_bsdf` and `sheen_bsdf`.

use std::f32::consts::{FRAC_1_PI, PI};
use std::sync::LazyLock;

use glam::{Vec2, Vec3};

use super::albedo_table::mean_over_square;
use super::diffuse::cosine_hemisphere;
use super::table::FamilyTable;

/// A lobe that is sampled like Lambert's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cloth {
    color: Vec3,
    form: Form,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    Burley { roughness: f32 },
    Translucent,
    Sheen { roughness: f32 },
}

impl Cloth {
    /// Burley, "Physically Based Shading at Disney", SIGGRAPH 2012.
    pub(crate) fn burley(color: Vec3, roughness: f32) -> Self {
        Self { color, form: Form::Burley { roughness: roughness.clamp(0.0, 1.0) } }
    }

    /// Lambert's law on the other side.
    pub(crate) fn translucent(color: Vec3) -> Self {
        Self { color, form: Form::Translucent }
    }

    /// Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", 2017.
    pub(crate) fn sheen(color: Vec3, roughness: f32) -> Self {
        Self { color, form: Form::Sheen { roughness: roughness.clamp(SMALLEST_SHEEN, 1.0) } }
    }

    pub(crate) fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        let reflects = wo.z > 0.0 && wi.z > 0.0;
        let f = match self.form {
            Form::Translucent => return if wi.z < 0.0 { self.color * FRAC_1_PI } else { Vec3::ZERO },
            _ if !reflects => 0.0,
            Form::Burley { roughness } => burley(wo, wi, roughness),
            Form::Sheen { roughness } => sheen(wo, wi, roughness),
        };
        self.color * f
    }

    pub(crate) fn pdf(&self, wi: Vec3) -> f32 {
        let above = if self.form == Form::Translucent { -wi.z } else { wi.z };
        above.max(0.0) * FRAC_1_PI
    }

    pub(crate) fn sample(&self, u: [f32; 2]) -> Vec3 {
        let wi = cosine_hemisphere(u);
        if self.form == Form::Translucent { Vec3::new(wi.x, wi.y, -wi.z) } else { wi }
    }

    pub(crate) fn albedo(&self, wo: Vec3) -> Vec3 {
        self.color
            * match self.form {
                Form::Translucent => 1.0,
                Form::Burley { roughness } => ALBEDO.look_up(roughness, wo.z).x,
                Form::Sheen { roughness } => ALBEDO.look_up(roughness, wo.z).y.min(1.0),
            }
    }

    /// The share of energy that goes on to what `layer` puts below: fibres let through what they don't scatter,
    /// diffuse surfaces nothing.
    pub(crate) fn throughput(&self, wo: Vec3) -> Vec3 {
        match self.form {
            Form::Sheen { roughness } => Vec3::splat(1.0 - ALBEDO.look_up(roughness, wo.z).y.min(1.0)),
            _ => Vec3::ZERO,
        }
    }
}

/// Below it the fibres' distribution is too steep for single precision.
const SMALLEST_SHEEN: f32 = 0.05;

/// Directional albedos over roughness and cosine: Burley's and the sheen's, both white.
static ALBEDO: LazyLock<FamilyTable> = LazyLock::new(|| {
    FamilyTable::new(|roughness, wo| {
        let mean = |f: fn(Vec3, Vec3, f32) -> f32, roughness| {
            mean_over_square(|u| PI * f(wo, cosine_hemisphere(u), roughness))
        };
        Vec2::new(mean(burley, roughness), mean(sheen, roughness.max(SMALLEST_SHEEN)))
    })
});

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
        let lobes =
            [Cloth::burley(Vec3::ONE, 0.4), Cloth::translucent(Vec3::ONE), Cloth::sheen(Vec3::ONE, 0.3)];
        for lobe in lobes {
            for cos in [0.2_f32, 0.6, 1.0] {
                let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                let mean = mean_over_square(|u| {
                    let wi = lobe.sample(u);
                    lobe.eval(wo, wi).x * wi.z.abs() / lobe.pdf(wi)
                });
                assert!(
                    (lobe.albedo(wo).x - mean).abs() < 0.01,
                    "{lobe:?} {cos}: {} {mean}",
                    lobe.albedo(wo).x
                );
            }
        }
    }
}
