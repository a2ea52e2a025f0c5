//! f(o, i) = f(i, o): exactly for single scattering, and for the compensation.

use crate::common::Random;
use catseye::{BackVector, Edwards, Lobe as _, Params, Reciprocal};

#[test]
fn reciprocal() {
    let mut random = Random(1);
    for _ in 0..20_000 {
        let params = Params::anisotropic(random.roughness(), random.roughness())
            .with_tint(random.triple())
            .with_multiscatter_tint(random.triple());
        let lobe = Reciprocal::new(&params).unwrap();
        let (wo, wi) = (random.direction(), random.direction());
        let (forth, back) = (lobe.eval(wo, wi), lobe.eval(wi, wo));
        for c in 0..3 {
            assert!(
                (forth[c] - back[c]).abs() <= 1e-11 * forth[c],
                "{params:?} {wo:?} {wi:?}: {forth:?} {back:?}"
            );
        }
    }
}

#[test]
fn back_vector() {
    let mut random = Random(2);
    for _ in 0..20_000 {
        let lobe = BackVector::new([random.uniform(), random.uniform()], [1.0; 3]).unwrap();
        let (wo, wi) = (random.direction(), random.direction());
        let (forth, back) = (lobe.eval(wo, wi)[0], lobe.eval(wi, wo)[0]);
        assert!((forth - back).abs() <= 1e-11 * forth);
    }
}

/// The paper's own lobe is the one that is not.
#[test]
fn edwards_is_not() {
    let lobe = Edwards::new(&Params::isotropic(0.5)).unwrap();
    let (wo, wi) = (catseye::Vec3::from_angles(0.2, 0.0), catseye::Vec3::from_angles(1.0, 0.0));
    let ratio = lobe.eval(wo, wi)[0] / lobe.eval(wi, wo)[0];
    // (z_o / z_i)^3
    assert!((ratio - (0.2_f64.cos() / 1.0_f64.cos()).powi(3)).abs() < 1e-9, "{ratio}");
}
