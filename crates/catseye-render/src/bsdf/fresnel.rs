//! How much a smooth interface reflects, and where it refracts to.

use glam::Vec3;

/// The share of unpolarised light that a smooth interface reflects.
///
/// `cos_i` is the cosine of the angle of incidence, in `[0, 1]`; `eta` the index behind the interface over
/// the index before it. 1 at total internal reflection.
#[inline]
pub(crate) fn fresnel_dielectric(cos_i: f32, eta: f32) -> f32 {
    let sin2_t = (1.0 - cos_i * cos_i) / (eta * eta);
    if sin2_t >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin2_t).sqrt();
    let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}

/// The direction in which light from `wo` goes on behind a facet with the unit normal `m`, `wo.dot(m) > 0`.
///
/// `None` at total internal reflection.
#[inline]
pub(crate) fn refract(wo: Vec3, m: Vec3, eta: f32) -> Option<Vec3> {
    let cos_i = wo.dot(m);
    let sin2_t = (1.0 - cos_i * cos_i).max(0.0) / (eta * eta);
    let cos_t = (1.0 - sin2_t).sqrt();
    (sin2_t < 1.0).then(|| -wo / eta + m * (cos_i / eta - cos_t))
}

/// How much a facet reflects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fresnel {
    /// A metal's complex refractive index.
    Conductor { n: Vec3, k: Vec3 },
    /// Schlick's curve with any exponent, multiplied by `at_82` at 82 degrees (Hoffman, "Fresnel Equations
    /// Considered Harmful", 2019; Kutz et al., "Novel aspects of the Adobe Standard Material", 2021).
    Schlick { at_0: Vec3, at_82: Vec3, at_90: Vec3, exponent: f32 },
}

impl Fresnel {
    pub(crate) fn at(&self, cos: f32) -> Vec3 {
        match *self {
            Self::Conductor { n, k } => Vec3::from_array(std::array::from_fn(|i| conductor(cos, n[i], k[i]))),
            Self::Schlick { at_0, at_82, at_90, exponent } => schlick(cos, at_0, at_82, at_90, exponent),
        }
    }
}

/// The share of unpolarised light that a metal of index `n + ik` reflects (Born and Wolf, section 14.2).
fn conductor(cos: f32, n: f32, k: f32) -> f32 {
    let (cos2, sin2) = (cos * cos, 1.0 - cos * cos);
    let t0 = n * n - k * k - sin2;
    let a2_plus_b2 = (t0 * t0 + 4.0 * n * n * k * k).max(0.0).sqrt();
    let a = (0.5 * (a2_plus_b2 + t0)).max(0.0).sqrt();
    let t1 = a2_plus_b2 + cos2;
    let t2 = 2.0 * cos * a;
    let perpendicular = (t1 - t2) / (t1 + t2).max(1e-12);
    let t3 = cos2 * a2_plus_b2 + sin2 * sin2;
    let t4 = t2 * sin2;
    let parallel = perpendicular * (t3 - t4) / (t3 + t4).max(1e-12);
    (0.5 * (perpendicular + parallel)).clamp(0.0, 1.0)
}

fn schlick(cos: f32, at_0: Vec3, at_82: Vec3, at_90: Vec3, exponent: f32) -> Vec3 {
    /// The cosine of about 82 degrees, where the correction is largest.
    const COS_82: f32 = 1.0 / 7.0;
    let curve = |cos: f32| at_0.lerp(at_90, (1.0 - cos).max(0.0).powf(exponent));
    let bump = |cos: f32| cos * (1.0 - cos).powi(6);
    let dip = curve(COS_82) * (Vec3::ONE - at_82) * (bump(cos) / bump(COS_82));
    (curve(cos) - dip).clamp(Vec3::ZERO, Vec3::ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gold() -> Fresnel {
        Fresnel::Conductor { n: Vec3::new(0.183, 0.421, 1.373), k: Vec3::new(3.424, 2.346, 1.770) }
    }

    #[test]
    fn gold_is_golden_and_white_at_grazing() {
        let [r, g, b] = gold().at(1.0).to_array();
        assert!(
            (r - 0.944).abs() < 2e-3 && (g - 0.776).abs() < 2e-3 && (b - 0.373).abs() < 2e-3,
            "{r} {g} {b}"
        );
        assert!(gold().at(0.0).min_element() > 0.999);
    }

    #[test]
    fn schlick_passes_through_its_colours() {
        let (at_0, at_82) = (Vec3::new(0.9, 0.5, 0.2), Vec3::new(1.0, 0.8, 0.6));
        let curve = |at_82| Fresnel::Schlick { at_0, at_82, at_90: Vec3::ONE, exponent: 5.0 };
        assert!(curve(at_82).at(1.0).distance(at_0) < 1e-6);
        assert!(curve(at_82).at(0.0).distance(Vec3::ONE) < 1e-6);
        let at = 1.0 / 7.0;
        assert!(curve(at_82).at(at).distance(curve(Vec3::ONE).at(at) * at_82) < 1e-5);
    }

    #[test]
    fn glass_reflects_four_percent_head_on_and_everything_at_grazing() {
        assert!((fresnel_dielectric(1.0, 1.5) - 0.04).abs() < 1e-6);
        assert!((fresnel_dielectric(0.0, 1.5) - 1.0).abs() < 1e-6);
        assert_eq!(fresnel_dielectric(0.5, 1.0 / 1.5), 1.0);
    }

    #[test]
    fn refraction_obeys_snell_both_ways() {
        let wo = Vec3::new(0.6, 0.0, 0.8);
        let wi = refract(wo, Vec3::Z, 1.5).unwrap();
        assert!((wi.x + 0.4).abs() < 1e-6 && wi.z < 0.0);
        let back = refract(-wi, Vec3::NEG_Z * -1.0, 1.0 / 1.5);
        assert!(back.is_none() || (-wi).z > 0.0);
    }
}
