//! Energy: in a white furnace the lobe with both tints 1 returns 1, and no lobe returns more than it
//! receives.

use crate::common::{ROUGHNESS, Random, directions, to_f32};
use catseye::albedo::exact;
use catseye::{AnyLobe, BackVector, Edwards, Lobe, Model, Params, Reciprocal, Vec3};

/// Mean weight over a regular grid of uniform numbers.
fn by_sampling(lobe: &impl Lobe<f64>, wo: Vec3<f64>) -> f64 {
    const N: usize = 40;
    let mut sum = 0.0;
    for i in 0..N * N * N {
        let u = [i % N, i / N % N, i / (N * N)].map(|k| (k as f64 + 0.5) / N as f64);
        sum += lobe.sample(wo, u).map_or(0.0, |s| s.weight[0]);
    }
    sum / (N * N * N) as f64
}

/// The integral of f cos over the hemisphere. Substituting the lobe's own warp flattens the integrand,
/// whatever the roughness: the quadrature runs over the disk samples of a lobe without compensation, whose
/// density is known.
fn by_quadrature(lobe: &impl Lobe<f64>, plain: &Edwards<f64>, wo: Vec3<f64>) -> f64 {
    const N: usize = 160;
    let mut single = 0.0;
    for i in 0..N * N {
        let u = [i % N, i / N].map(|k| (k as f64 + 0.5) / N as f64);
        if let Some(s) = plain.sample(wo, [u[0], u[1], 0.5]) {
            // Only the part of f that the warp resolves: f_ms is integrated below, over the projected
            // hemisphere.
            single += (lobe.eval(wo, s.wi)[0] - lobe.eval(wo, s.wi)[2]) * s.wi.z / s.pdf;
        }
    }
    let mut multiple = 0.0;
    for i in 0..N * N {
        let (s, phi) =
            (((i % N) as f64 + 0.5) / N as f64, ((i / N) as f64 + 0.5) / N as f64 * std::f64::consts::TAU);
        let wi = Vec3::new(s * phi.cos(), s * phi.sin(), (1.0 - s * s).sqrt());
        multiple += lobe.eval(wo, wi)[2] * std::f64::consts::TAU * s / (N * N) as f64;
    }
    single / (N * N) as f64 + multiple
}

#[test]
fn white_by_sampling() {
    for roughness in ROUGHNESS {
        let params = Params::anisotropic(roughness[0], roughness[1]).with_multiscatter_tint([1.0; 3]);
        let lobe = Reciprocal::new(&params).unwrap();
        for wo in directions() {
            let energy = by_sampling(&lobe, wo);
            assert!((energy - 1.0).abs() < 1e-9, "{roughness:?} {wo:?}: {energy}");
        }
    }
}

#[test]
fn white_by_quadrature() {
    for roughness in ROUGHNESS {
        // Red is single and multiple scattering, blue multiple scattering alone.
        let params = Params::anisotropic(roughness[0], roughness[1])
            .with_tint([1.0, 1.0, 0.0])
            .with_multiscatter_tint([1.0; 3]);
        let lobe = Reciprocal::new(&params).unwrap();
        let plain = Edwards::new(&Params::anisotropic(roughness[0], roughness[1])).unwrap();
        for wo in directions() {
            let energy = by_quadrature(&lobe, &plain, wo);
            assert!((energy - 1.0).abs() < 1e-3, "{roughness:?} {wo:?}: {energy}");
        }
    }
}

#[test]
fn single_scattering_returns_the_exact_albedo() {
    for roughness in ROUGHNESS {
        let lobe = Reciprocal::new(&Params::anisotropic(roughness[0], roughness[1])).unwrap();
        for wo in directions() {
            let energy = by_sampling(&lobe, wo);
            let rho = exact::directional(roughness, wo);
            assert!((energy - rho).abs() < 1.5e-3, "{roughness:?} {wo:?}: {energy} for {rho}");
            assert!(
                (lobe.albedo(wo)[0] - rho).abs() < 1e-3,
                "{roughness:?} {wo:?}: {:?} for {rho}",
                lobe.albedo(wo)
            );
        }
    }
}

#[test]
fn average_albedo_is_the_mean_over_the_hemisphere() {
    for roughness in ROUGHNESS {
        let lobe =
            Reciprocal::new(&Params::anisotropic(roughness[0], roughness[1]).with_tint([1.0, 0.5, 0.0]))
                .unwrap();
        let (found, exact) = (lobe.average_albedo(), exact::average(roughness));
        assert!((found[0] - exact).abs() < 3e-4, "{roughness:?}: {found:?} for {exact}");
        assert!((found[1] - 0.5 * found[0]).abs() < 1e-12 && found[2] == 0.0);
    }
}

#[test]
fn edwards_returns_everything() {
    for roughness in ROUGHNESS {
        let lobe = Edwards::new(&Params::anisotropic(roughness[0], roughness[1])).unwrap();
        for wo in directions() {
            assert_eq!(by_sampling(&lobe, wo), 1.0);
        }
    }
}

#[test]
fn back_vector_returns_its_albedo() {
    for alpha in [[0.05, 0.05], [0.3, 0.3], [1.0, 1.0], [0.5, 0.1]] {
        let lobe = BackVector::new(alpha, [1.0; 3]).unwrap();
        for wo in directions() {
            // Random numbers: the tail of the distribution slips through a regular grid.
            const N: usize = 200_000;
            let mut random = Random(9);
            let weight = |_| lobe.sample(wo, random.triple()).map_or(0.0, |s| s.weight[0]);
            let energy = (0..N).map(weight).sum::<f64>() / N as f64;
            let albedo = lobe.albedo(wo)[0];
            // The weights spread by less than 0.2, so four standard deviations of the mean are below 1.8e-3.
            assert!(
                (energy - albedo).abs() < 2e-3 && albedo <= 1.0,
                "{alpha:?} {wo:?}: {energy} for {albedo}"
            );
        }
    }
}

#[test]
fn tints_scale_the_channels() {
    let (tint, multiscatter_tint) = ([0.9, 0.5, 0.0], [0.0, 1.0, 0.3]);
    let params = Params::anisotropic(0.6, 0.2).with_tint(tint).with_multiscatter_tint(multiscatter_tint);
    let lobe = Reciprocal::new(&params).unwrap();
    for wo in directions() {
        let mut random = Random(3);
        let mut sum = [0.0; 3];
        const N: usize = 100_000;
        for _ in 0..N {
            let weight = lobe.sample(wo, random.triple()).unwrap().weight;
            [0, 1, 2].iter().for_each(|&c| sum[c] += weight[c] / N as f64);
        }
        let rho = exact::directional([0.6, 0.2], wo);
        for c in 0..3 {
            let expected = tint[c] * rho + multiscatter_tint[c] * (1.0 - rho);
            assert!((sum[c] - expected).abs() < 8e-3, "channel {c}: {} for {expected}", sum[c]);
            assert!((lobe.albedo(wo)[c] - expected).abs() < 1e-3);
        }
    }
}

/// Every sample of a lobe with equal grey tints weighs the same, for every roughness pair, in both
/// precisions.
#[test]
fn weights_are_one() {
    let mut random = Random(11);
    for roughness in ROUGHNESS {
        let [u, v] = roughness;
        let lobe = Reciprocal::new(&Params::anisotropic(u, v).with_multiscatter_tint([1.0; 3])).unwrap();
        let params = Params::anisotropic(u as f32, v as f32).with_multiscatter_tint([1.0; 3]);
        let lobe_f32 = Reciprocal::new(&params).unwrap();
        for wo in directions() {
            for _ in 0..4000 {
                let weight = lobe.sample(wo, random.triple()).unwrap().weight[0];
                assert!((weight - 1.0).abs() < 1e-12, "{roughness:?} {wo:?}: {weight}");
                let u = [random.uniform_f32(), random.uniform_f32(), random.uniform_f32()];
                let weight = lobe_f32.sample(to_f32(wo), u).unwrap().weight[0];
                assert!((weight - 1.0).abs() < 2e-6, "{roughness:?} {wo:?}: {weight} in f32");
            }
        }
    }
}

/// `weight * pdf = f cos` to rounding, for all tints, and `pdf` is the density that `sample` states.
#[test]
fn sample_eval_and_pdf_agree() {
    let mut random = Random(5);
    for model in Model::ALL {
        for _ in 0..40 {
            let params = Params::anisotropic(random.roughness(), random.roughness())
                .with_tint(random.triple())
                .with_multiscatter_tint(random.triple());
            let lobe = AnyLobe::new(model, &params).unwrap();
            for _ in 0..300 {
                let wo = random.direction();
                let Some(s) = lobe.sample(wo, random.triple()) else { continue };
                let (f, pdf) = lobe.eval_pdf(wo, s.wi);
                assert!((pdf / s.pdf - 1.0).abs() < 1e-6, "{params:?} {wo:?} {s:?}: {pdf}");
                for c in 0..3 {
                    let expected = f[c] * s.wi.z;
                    assert!(
                        (s.weight[c] * s.pdf - expected).abs() <= 1e-6 * expected,
                        "{params:?} {wo:?} {s:?} {f:?}"
                    );
                }
            }
        }
    }
}
