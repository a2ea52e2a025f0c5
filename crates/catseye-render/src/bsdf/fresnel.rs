//! Smooth interfaces between two dielectrics.

use glam::Vec3;

/// The share of unpolarised light that a smooth interface reflects.
///
/// `cos_i` is the cosine of the angle of incidence, in `[0, 1]`; `eta` the index behind the interface over the index
/// before it. 1 at total internal reflection.
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

#[cfg(test)]
mod tests {
    use super::*;

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
