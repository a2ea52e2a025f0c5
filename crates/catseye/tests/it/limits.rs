//! The ends of the parameters' ranges, line by line as in docs/theory.md, section 9.

use crate::common::{Random, directions, to_f32};
use catseye::albedo::exact;
use catseye::{AnyLobe, Component, Edwards, Lobe as _, Model, Params, Reciprocal, Vec3};

#[test]
fn default_is_a_perfect_retro_reflector() {
    let tint = [0.9, 0.5, 0.1];
    for model in Model::ALL {
        for roughness in [0.0, 0.99e-4] {
            let lobe = AnyLobe::new(model, &Params::isotropic(roughness).with_tint(tint)).unwrap();
            for wo in directions() {
                let s = lobe.sample(wo, [0.3, 0.7, 0.5]).unwrap();
                assert_eq!((s.wi, s.weight, s.component), (wo, tint, Component::Dirac));
                assert_eq!(lobe.eval_pdf(wo, wo), ([0.0; 3], 0.0));
                assert_eq!(lobe.albedo(wo), tint);
                assert!(lobe.is_dirac());
            }
        }
    }
    assert!(Reciprocal::<f64>::new(&Params::default()).unwrap().is_dirac());
}

#[test]
fn single_scattering_of_a_dirac_lobe_leaves_nothing_to_compensate() {
    let lobe = Reciprocal::new(&Params::isotropic(0.0).with_multiscatter_tint([1.0; 3])).unwrap();
    assert_eq!(lobe.albedo(Vec3::new(0.0, 0.0, 1.0)), [1.0; 3]);
}

#[test]
fn narrow_lobes_tend_to_the_dirac_lobe() {
    for roughness in [1e-4, 3e-4] {
        let lobe =
            Reciprocal::new(&Params::<f32>::isotropic(roughness).with_multiscatter_tint([1.0; 3])).unwrap();
        let mut random = Random(4);
        for wo in directions().into_iter().map(to_f32) {
            for _ in 0..1000 {
                let u = [random.uniform_f32(), random.uniform_f32(), 0.5 * random.uniform_f32()];
                let s = lobe.sample(wo, u).unwrap();
                assert!(s.wi.dot(wo) > 1.0 - 20.0 * roughness * roughness / wo.z, "{s:?}");
                assert!(s.pdf.is_finite() && (s.weight[0] - 1.0).abs() < 1e-5);
            }
        }
    }
}

#[test]
fn one_roughness_of_zero_is_the_threshold() {
    let mut random = Random(6);
    for [u, v] in [[0.0_f64, 0.5], [0.5, 0.0]] {
        let zero = Reciprocal::new(&Params::anisotropic(u, v)).unwrap();
        let clamped = Reciprocal::new(&Params::anisotropic(u.max(1e-4), v.max(1e-4))).unwrap();
        assert!(!zero.is_dirac());
        for wo in directions() {
            let numbers = random.triple();
            assert_eq!(zero.sample(wo, numbers), clamped.sample(wo, numbers));
        }
    }
}

#[test]
fn infinite_roughness_is_finite() {
    // n = 0: B = (1-|d|^2) / (2 pi), f = B min / (max^2 (z_o + z_i)).
    let lobe = Reciprocal::new(&Params::isotropic(f64::INFINITY)).unwrap();
    let huge = Reciprocal::new(&Params::isotropic(1e9)).unwrap();
    let mut random = Random(8);
    for _ in 0..10_000 {
        let (wo, wi) = (random.direction(), random.direction());
        let sum = wo.z + wi.z;
        let rest = 2.0 * wo.z * wi.z * (1.0 + wo.dot(wi)) / (sum * sum);
        let f = rest * wo.z.min(wi.z) / (std::f64::consts::TAU * wo.z.max(wi.z).powi(2) * sum);
        assert!((lobe.eval(wo, wi)[0] / f - 1.0).abs() < 1e-9, "{wo:?} {wi:?}");
        assert!((huge.eval(wo, wi)[0] / f - 1.0).abs() < 1e-9);
    }
    assert!((exact::average([f64::INFINITY; 2]) - 0.25).abs() < 1e-9);
}

#[test]
fn grazing_directions_give_finite_values() {
    for roughness in [0.006, 0.3, 1.0, f64::INFINITY] {
        let params = Params::isotropic(roughness).with_multiscatter_tint([1.0; 3]);
        let lobe = Reciprocal::new(&params).unwrap();
        let params = Params::isotropic(roughness as f32).with_multiscatter_tint([1.0; 3]);
        let lobe_f32 = Reciprocal::new(&params).unwrap();
        for z in [1e-2, 1e-4, 1e-6, 1e-9, 1e-12, 1e-20, 1e-40, 0.0] {
            for x in [1.0, -1.0, 0.3] {
                let wo = Vec3::new(1.0, 0.0, z);
                let wi = Vec3::new(x, (1.0_f64 - x * x).sqrt(), 0.5 * z);
                let (f, pdf) = lobe.eval_pdf(wo, wi);
                assert!(f[0].is_finite() && pdf.is_finite() && f[0] >= 0.0 && pdf >= 0.0);
                let (f, pdf) = lobe_f32.eval_pdf(to_f32(wo), to_f32(wi));
                assert!(
                    f[0].is_finite() && pdf.is_finite() && f[0] >= 0.0 && pdf >= 0.0,
                    "{roughness} {z}: {f:?} {pdf}"
                );
            }
        }
    }
}

#[test]
fn below_the_horizon_is_black() {
    let up = Vec3::from_angles(0.4, 0.2);
    for model in Model::ALL {
        let lobe = AnyLobe::new(model, &Params::isotropic(0.3).with_multiscatter_tint([1.0; 3])).unwrap();
        for z in [-1.0, -1e-3, -0.0, 0.0] {
            let down = Vec3::new((1.0_f64 - z * z).sqrt(), 0.0, z);
            assert_eq!(lobe.eval_pdf(up, down), ([0.0; 3], 0.0));
            assert_eq!(lobe.eval_pdf(down, up), ([0.0; 3], 0.0));
            assert_eq!(lobe.sample(down, [0.5; 3]), None);
            assert_eq!(lobe.albedo(down), [0.0; 3]);
        }
    }
}

#[test]
fn bad_parameters_are_named() {
    let message = |p: Params<f64>| Reciprocal::new(&p).unwrap_err().to_string();
    assert_eq!(message(Params::isotropic(-0.1)), "roughness_u is -0.1, outside [0, inf]");
    assert_eq!(message(Params::anisotropic(0.1, f64::NAN)), "roughness_v is NaN, outside [0, inf]");
    assert_eq!(message(Params::default().with_tint([0.0, 1.5, 0.0])), "tint[1] is 1.5, outside [0, 1]");
    assert_eq!(
        message(Params::default().with_multiscatter_tint([f64::NAN; 3])),
        "multiscatter_tint[0] is NaN, outside [0, 1]"
    );
    let clamped = Params::anisotropic(-1.0, f64::NAN).with_tint([2.0, f64::NAN, -1.0]).clamped();
    assert_eq!(clamped, Params::anisotropic(0.0, 0.0).with_tint([1.0, 0.0, 0.0]));
}

/// Retro-reflection at no observation angle: `R_A = (n+1) / (4 pi)` for every entrance angle, theory.md
/// section 10.
#[test]
fn coefficient_of_retroreflection_does_not_depend_on_entrance() {
    let n: f64 = 6e4;
    let lobe = Reciprocal::new(&Params::isotropic((2.0 / n).sqrt())).unwrap();
    for wo in directions() {
        let coefficient = lobe.eval(wo, wo)[0] * wo.z * wo.z;
        assert!((coefficient * 4.0 * std::f64::consts::PI / (n + 1.0) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn edwards_tends_to_the_same_limits() {
    let lobe = Edwards::new(&Params::isotropic(f64::INFINITY)).unwrap();
    let wo = Vec3::from_angles(0.5, 0.0);
    assert!(lobe.eval(wo, Vec3::new(1.0, 0.0, 1e-11))[0].is_finite());
}
