//! No panic and no NaN, whatever the parameters and directions, finite or not.

use catseye::albedo::exact;
use catseye::{AnyLobe, Lobe as _, Model, Params, Real, Vec3};
use proptest::prelude::*;

/// Any `f64` or a tame one: both ends of the search.
fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>(), -1.5..1.5_f64, Just(0.0), Just(1.0), Just(f64::INFINITY), Just(f64::NAN)]
}

fn any_vector() -> impl Strategy<Value = [f64; 3]> {
    prop_oneof![[any_number(), any_number(), any_number()], unit_vector()]
}

fn unit_vector() -> impl Strategy<Value = [f64; 3]> {
    (-1.0..1.0_f64, 0.0..std::f64::consts::TAU)
        .prop_map(|(z, phi)| [(1.0 - z * z).sqrt() * phi.cos(), (1.0 - z * z).sqrt() * phi.sin(), z])
}

fn any_params() -> impl Strategy<Value = Params<f64>> {
    let roughness = || prop_oneof![any_number(), (-6.0..6.0_f64).prop_map(|x| 10.0_f64.powf(x))];
    let colour = || [any_number(), any_number(), any_number()];
    (roughness(), proptest::option::of(roughness()), colour(), colour()).prop_map(
        |(u, v, tint, multiscatter_tint)| {
            let params = Params::isotropic(u).with_roughness_v(v);
            params.with_tint(tint).with_multiscatter_tint(multiscatter_tint)
        },
    )
}

/// Finite and not negative.
fn is_sane<T: Real>(x: T) -> bool {
    x.is_finite() && x >= T::ZERO
}

/// What holds for unit vectors and numbers in `[0, 1)`; for anything else, that nothing panics.
fn check<T: Real>(
    params: &Params<f64>,
    wo: [f64; 3],
    wi: [f64; 3],
    u: [f64; 3],
    unit: bool,
) -> Result<(), TestCaseError> {
    let [wo, wi] = [wo, wi].map(|w| Vec3::from(w.map(T::from_f64)));
    let u = u.map(|u| T::from_f64(u.min(0.999_999_9)));
    for model in Model::ALL {
        let params = params.map(T::from_f64);
        let (valid, clamped) = (AnyLobe::new(model, &params), params.clamped());
        let lobe = AnyLobe::new(model, &clamped).unwrap_or_else(|error| panic!("{clamped:?}: {error}"));
        for lobe in [lobe].into_iter().chain(valid.ok()) {
            let (f, pdf) = lobe.eval_pdf(wo, wi);
            let (albedo, sample) = (lobe.albedo(wo), lobe.sample(wo, u));
            if !unit {
                continue;
            }
            prop_assert!(f.into_iter().chain([pdf]).all(is_sane), "{model:?} {wo:?} {wi:?}: {f:?} {pdf}");
            prop_assert!(
                albedo.into_iter().all(|x| is_sane(x) && x.to_f64() <= 1.000_001),
                "{model:?} {wo:?}: {albedo:?}"
            );
            if let Some(s) = sample {
                prop_assert!(
                    s.weight.into_iter().chain([s.pdf]).all(is_sane),
                    "{model:?} {wo:?} {u:?}: {s:?}"
                );
                prop_assert!(
                    s.wi.z > T::ZERO && (s.wi.dot(s.wi).to_f64() - 1.0).abs() < 1e-2,
                    "{model:?} {wo:?} {u:?}: {s:?}"
                );
                // Lobes are chosen by the channels' mean: one channel alone can weigh three times as much.
                prop_assert!(
                    s.weight.into_iter().all(|w| w.to_f64() < 3.01),
                    "{model:?} {wo:?} {u:?}: {s:?}"
                );
            }
        }
    }
    Ok(())
}

fn config(cases: u32, seed: u64) -> ProptestConfig {
    let rng_seed = proptest::test_runner::RngSeed::Fixed(seed);
    ProptestConfig { cases, failure_persistence: None, rng_seed, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config(4000, 1))]

    #[test]
    fn directions_give_sane_values(
        params in any_params(),
        wo in unit_vector(),
        wi in unit_vector(),
        u in [0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64],
    ) {
        check::<f64>(&params, wo, wi, u, true)?;
        check::<f32>(&params, wo, wi, u, true)?;
    }

    #[test]
    fn nonsense_does_not_panic(
        params in any_params(),
        wo in any_vector(),
        wi in any_vector(),
        u in [any_number(), any_number(), any_number()],
    ) {
        check::<f64>(&params, wo, wi, u, false)?;
        check::<f32>(&params, wo, wi, u, false)?;
    }
}

proptest! {
    #![proptest_config(config(200, 2))]

    #[test]
    fn exact_albedo_is_a_share(u in 0.0..1.0_f64, v in 0.0..1.0_f64, wo in unit_vector()) {
        let roughness = [u, v].map(|u| 10.0_f64.powf(-4.0 + 8.0 * u));
        let rho = exact::directional(roughness, wo.into());
        prop_assert!((0.0..=1.0).contains(&rho), "{roughness:?} {wo:?}: {rho}");
    }
}
