//! The batch interface answers like the scalar one, bit for bit, for every lobe, precision and length.

use crate::common::Random;
use catseye::batch::{self, SampleSlices};
use catseye::{AnyLobe, Component, Lobe, Model, Params, Real, Vec3};

/// Nine columns: wo, wi and uniform numbers, among them directions below the horizon and NaN.
fn columns<T: Real>(n: usize) -> Vec<Vec<T>> {
    let mut random = Random(n as u64);
    let mut columns = vec![Vec::new(); 9];
    for i in 0..n {
        let (mut wo, wi, u) = (random.direction(), random.direction(), random.triple());
        match i % 50 {
            7 => wo.z = -wo.z,
            8 => wo.x = f64::NAN,
            9 => wo = wi,
            _ => {}
        }
        let row = [wo.x, wo.y, wo.z, wi.x, wi.y, wi.z, u[0], u[1], u[2].min(0.999_999)];
        columns.iter_mut().zip(row).for_each(|(column, x)| column.push(T::from_f64(x)));
    }
    columns
}

fn check<T: Real, L: Lobe<T> + Copy>(lobe: &L, n: usize) {
    let c = columns::<T>(n);
    let (wo, wi, u) = ([&c[0][..], &c[1], &c[2]], [&c[3][..], &c[4], &c[5]], [&c[6][..], &c[7], &c[8]]);
    let mut out = vec![vec![T::ONE; n]; 15];
    let mut components = vec![Component::Dirac; n];
    let [a, b, c0, d, e, f, g, h, x, y, z, r, s, t, p] = &mut out[..] else { unreachable!() };
    batch::eval(lobe, wo, wi, [a, b, c0]);
    batch::pdf(lobe, wo, wi, d);
    batch::eval_pdf(lobe, wo, wi, [e, f, g], h);
    let slices = SampleSlices { wi: [x, y, z], weight: [r, s, t], pdf: p, component: &mut components };
    batch::sample(lobe, wo, u, slices);
    // NaN equals itself here.
    let same = |found: T, expected: T| found == expected || found.is_nan() && expected.is_nan();
    for k in 0..n {
        let [wo, wi] = [wo, wi].map(|[x, y, z]| Vec3::new(x[k], y[k], z[k]));
        let u = u.map(|u| u[k]);
        let (value, pdf) = lobe.eval_pdf(wo, wi);
        let sample = lobe.sample(wo, u);
        let (direction, weight, density) =
            sample.map_or((Vec3::default(), [T::ZERO; 3], T::ZERO), |s| (s.wi, s.weight, s.pdf));
        let expected = [
            value[0],
            value[1],
            value[2],
            pdf,
            value[0],
            value[1],
            value[2],
            pdf,
            direction.x,
            direction.y,
            direction.z,
            weight[0],
            weight[1],
            weight[2],
            density,
        ];
        for (column, expected) in out.iter().zip(expected) {
            assert!(same(column[k], expected), "{} for {expected} at {k}: {wo:?} {wi:?} {u:?}", column[k]);
        }
        assert_eq!(components[k], sample.map_or(Component::Single, |s| s.component));
    }
}

#[test]
fn equals_scalar() {
    println!("instruction set: {}", batch::instruction_set());
    for model in Model::ALL {
        for [u, v] in [[0.0, 0.0], [0.006, 0.006], [0.3, 0.3], [1.0, 0.05], [0.02, 0.9]] {
            for [tint, multiscatter_tint] in [[1.0, 0.0], [1.0, 1.0], [0.3, 0.7]] {
                let params = Params::anisotropic(u, v).with_tint([tint, 1.0, 0.5]);
                let params = params.with_multiscatter_tint([multiscatter_tint; 3]);
                let single = Params::anisotropic(u as f32, v as f32).with_tint([tint as f32, 1.0, 0.5]);
                let single = single.with_multiscatter_tint([multiscatter_tint as f32; 3]);
                for n in [0, 1, 5, 31, 400] {
                    check(&AnyLobe::<f32>::new(model, &single).unwrap(), n);
                    check(&AnyLobe::<f64>::new(model, &params).unwrap(), n);
                }
            }
        }
    }
}

#[test]
#[should_panic(expected = "the slices of a batch differ in length")]
fn lengths_must_agree() {
    let lobe = AnyLobe::<f32>::new(Model::Reciprocal, &Params::isotropic(0.1)).unwrap();
    let (two, one) = ([0.0; 2], [0.0; 1]);
    batch::pdf(&lobe, [&two, &two, &two], [&two, &one, &two], &mut [0.0; 2]);
}
