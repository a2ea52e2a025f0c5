//! Promise: integrals over directions agree with closed forms and with the albedo.

use std::f64::consts::PI;

use catseye::{Lobe as _, Params, Reciprocal, Vec3};
use catseye_photometry::{Geometry, diffuse_luminance_coefficient, fractional_retro_reflectance};

#[test]
fn a_white_diffuser_under_an_even_sky_has_1_over_pi() {
    for viewing_deg in [0.0_f64, 45.0, 87.71] {
        let q_d = diffuse_luminance_coefficient(|_| 1.0 / PI, viewing_deg.to_radians());
        assert!((q_d * PI - 1.0).abs() < 1e-3, "{viewing_deg}: {q_d}");
    }
}

#[test]
fn everything_that_a_lobe_returns_is_within_its_albedo() {
    for roughness in [1e-3, 0.0057, 0.05, 0.3] {
        let lobe = Reciprocal::<f64>::new(&Params::isotropic(roughness)).unwrap();
        let brdf = |g: &Geometry| lobe.eval(g.wo, g.wi)[0];
        for entrance in [0.0_f64, 0.5, 1.0] {
            let all = fractional_retro_reflectance(brdf, entrance, PI);
            let albedo = lobe.albedo(Vec3::from_angles(entrance, 0.0))[0];
            assert!((all - albedo).abs() < 3e-4, "{roughness} {entrance}: {all} {albedo}");
        }
    }
}

#[test]
fn the_share_within_a_cone_is_that_of_a_gaussian_for_a_narrow_lobe() {
    let roughness = 0.0057;
    let lobe = Reciprocal::<f64>::new(&Params::isotropic(roughness)).unwrap();
    let brdf = |g: &Geometry| lobe.eval(g.wo, g.wi)[0];
    for angle_deg in [0.1_f64, 0.3, 1.0] {
        let angle = angle_deg.to_radians();
        let share = fractional_retro_reflectance(brdf, 0.0, angle);
        // R_A(alpha) = R_A(0) exp(-(n+1) alpha^2 / 4), integrated over the cone.
        let gaussian = 1.0 - (-(2.0 / (roughness * roughness) + 1.0) * angle * angle / 4.0).exp();
        assert!((share - gaussian).abs() < 3e-4, "{angle_deg}: {share} {gaussian}");
    }
}
