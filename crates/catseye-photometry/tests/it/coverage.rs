//! "One standard deviation" holds the truth 68 times of 100, whether it is from the values' own uncertainties
//! or from their scatter, and it does not know the tolerance.
//!
//! One form is fitted, the true one: a choice of forms that depends on the noise is not covered by any of the
//! intervals, which are those of the form that was chosen.
//!
//! Beside it, what the tolerance means, and which values are named as unlike the others.

use catseye_photometry::fit::{
    Aim, Deviation, EntranceKind, Estimate, FitOptions, Meaning, Observation, View, fit,
};
use catseye_photometry::{EntranceLaw, Geometry, Goniometer, Quantity, RetroLobe, Sheeting};

/// Share of a normal distribution within one standard deviation.
const WITHIN: f64 = 0.6827;
/// By how much the share may be off. Of [`DRAWS`] independent draws one standard deviation of the share is
/// 0.006, so that 0.02 is more than three of them; the seed is fixed.
const BOUND: f64 = 0.02;
const DRAWS: usize = 6000;
const STRENGTH: f64 = 0.06;
const ROUGHNESS: f64 = 0.006;
const POWER: f64 = 2.0;

/// Uniform numbers by Knuth's linear congruence, and normal ones by Box and Muller's method.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * self.uniform().ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// The values of one lobe at so many observation angles and four entrance angles, without noise.
fn truth(observations_deg: &[f64]) -> Vec<Observation> {
    let lobe = RetroLobe {
        strength: STRENGTH,
        roughness: [ROUGHNESS; 2],
        entrance: Some(EntranceLaw::power(POWER)),
    };
    let sheeting = Sheeting { lobes: vec![lobe], ..Sheeting::default() };
    let prepared = sheeting.prepare().unwrap();
    let mut rows = Vec::new();
    for &observation in observations_deg {
        for entrance in [-4.0, 15.0, 30.0, 45.0] {
            let geometry = Geometry::from(Goniometer::from_degrees(observation, entrance, 0.0, 0.0));
            let factor = Quantity::RetroReflectionCoefficient.of_brdf(1.0, &geometry).unwrap();
            let value = factor * prepared.eval(geometry.wo, geometry.wi);
            let views = vec![View { wo: geometry.wo, wi: geometry.wi, factor }];
            rows.push(Observation { value, uncertainty: None, aim: Aim::Equal, views });
        }
    }
    rows
}

fn options() -> FitOptions {
    FitOptions { lobes: Some(1), entrance: Some(EntranceKind::Power), ..FitOptions::default() }
}

fn true_value(meaning: Meaning) -> f64 {
    match meaning {
        Meaning::Strength(_) => STRENGTH,
        Meaning::Roughness(..) => ROUGHNESS,
        _ => POWER,
    }
}

fn holds(estimate: &Estimate) -> bool {
    let [low, high] = estimate.interval.unwrap();
    (low..=high).contains(&true_value(estimate.meaning))
}

/// For each fitted number the share of intervals that hold the truth.
fn coverage(rows: &[Observation], sigma: fn(usize) -> f64, is_stated: bool) -> Vec<f64> {
    let (mut noise, mut held) = (Noise(9), vec![0_usize; 3]);
    for _ in 0..DRAWS {
        let noisy = rows.iter().enumerate().map(|(i, row)| {
            let value = row.value * (1.0 + sigma(i) * noise.normal());
            Observation { value, uncertainty: is_stated.then(|| sigma(i)), ..row.clone() }
        });
        let found = fit(&noisy.collect::<Vec<_>>(), &options()).unwrap();
        assert_eq!(matches!(found.deviation, Deviation::Stated { .. }), is_stated, "{:?}", found.deviation);
        for (held, estimate) in held.iter_mut().zip(&found.estimates) {
            *held += usize::from(holds(estimate));
        }
    }
    held.into_iter().map(|held| held as f64 / DRAWS as f64).collect()
}

fn check(shares: &[f64]) {
    println!("{shares:?}");
    assert!(shares.iter().all(|share| (share - WITHIN).abs() < BOUND), "{shares:?}");
}

#[test]
fn intervals_from_the_scatter_hold_the_truth_68_times_of_100() {
    check(&coverage(&truth(&[0.1, 0.2, 0.4]), |_| 0.015, false));
}

#[test]
fn intervals_from_the_scatter_of_two_spare_values_do_too() {
    check(&coverage(&truth(&[0.2, 0.4])[1..6], |_| 0.015, false));
}

/// A third of the values is ten times as uncertain as another one.
#[test]
fn intervals_from_stated_uncertainties_hold_the_truth_68_times_of_100() {
    let sigma = |i: usize| [0.002, 0.007, 0.02][i % 3];
    check(&coverage(&truth(&[0.1, 0.2, 0.4]), sigma, true));
}

#[test]
fn intervals_don_t_know_the_tolerance() {
    let with = |tolerance| fit(&truth(&[0.1, 0.2, 0.4]), &FitOptions { tolerance, ..options() }).unwrap();
    let (strict, lax) = (with(0.05), with(0.12));
    assert_eq!(strict.estimates, lax.estimates);
    let [low, high] = strict.estimates[0].interval.unwrap();
    assert!(high / low < 1.001, "{low} to {high}: there is no noise");
}

#[test]
fn what_is_not_known_is_said() {
    let rows = truth(&[0.1, 0.2]);
    let exact = fit(&[0, 1, 4].map(|i| rows[i].clone()), &options()).unwrap();
    assert_eq!(exact.deviation, Deviation::NoneToSpare);
    assert!(exact.estimates.iter().all(|estimate| estimate.interval.is_none()), "{:?}", exact.estimates);
    let limits: Vec<Observation> =
        truth(&[0.1, 0.2]).into_iter().map(|row| Observation { aim: Aim::AtLeast, ..row }).collect();
    let met = fit(&limits, &options()).unwrap();
    assert_eq!(met.deviation, Deviation::Limits);
    assert!(met.estimates.iter().all(|estimate| estimate.interval.is_none()), "{:?}", met.estimates);
}

#[test]
fn uncertainties_that_are_too_small_are_told() {
    let mut noise = Noise(3);
    let rows = truth(&[0.1, 0.2, 0.4]).into_iter().map(|row| {
        let value = row.value * (1.0 + 0.03 * noise.normal());
        Observation { value, uncertainty: Some(0.005), ..row }
    });
    let found = fit(&rows.collect::<Vec<_>>(), &options()).unwrap();
    assert!(found.warnings.iter().any(|warning| warning.contains("times their uncertainties")), "{found:?}");
}

/// Values that are 8 % up and down in turn: no lobe follows them, and their root mean square is 8 %.
#[test]
fn the_tolerance_is_of_the_worst_value_at_every_size_of_table() {
    for observations in [16, 17, 100] {
        let angles: Vec<f64> =
            (1..=observations).map(|i| 0.8 * f64::from(i) / f64::from(observations)).collect();
        let mut rows = truth(&angles);
        for (i, row) in rows.iter_mut().enumerate() {
            row.value *= if (i / 4 + i) % 2 == 0 { 1.08 } else { 0.92 };
        }
        let with = |tolerance, of_rms| fit(&rows, &FitOptions { tolerance, of_rms, ..options() }).unwrap();
        let found = with(0.081, false);
        assert!(found.worst > 0.081 && found.rms < 0.082, "{} {}", found.worst, found.rms);
        assert!(!found.acceptable && !with(0.079, true).acceptable && with(0.082, true).acceptable);
        assert!(with(0.12, false).acceptable && found.outliers.is_empty(), "{:?}", found.outliers);
    }
}

#[test]
fn a_value_unlike_the_others_is_named() {
    for (factor, row) in [(10.0, 7), (0.1, 20), (1.3, 13), (0.8, 2)] {
        let mut noise = Noise(5);
        let mut rows = truth(&[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
        rows.iter_mut().for_each(|row| row.value *= 1.0 + 0.01 * noise.normal());
        rows[row].value *= factor;
        let found = fit(&rows, &options()).unwrap();
        let [outlier] = found.outliers[..] else { panic!("{factor}: {:?}", found.outliers) };
        assert_eq!(outlier.row, row);
        assert!((outlier.ratio / factor - 1.0).abs() < 0.04 && outlier.times > 8.0, "{outlier:?}");
    }
}

/// Of 600 values with normal noise none is as far off as that.
#[test]
fn noise_is_no_outlier() {
    let mut noise = Noise(6);
    let angles: Vec<f64> = (1..=150).map(|i| 0.8 * f64::from(i) / 150.0).collect();
    let mut rows = truth(&angles);
    rows.iter_mut().for_each(|row| row.value *= 1.0 + 0.03 * noise.normal());
    let found = fit(&rows, &options()).unwrap();
    assert!(!found.acceptable && found.outliers.is_empty(), "{:?}", found.outliers);
    // As uncertain as they are, they are weighed, and say how uncertain the numbers are.
    let stated: Vec<Observation> =
        rows.iter().map(|row| Observation { uncertainty: Some(0.03), ..row.clone() }).collect();
    let found = fit(&stated, &options()).unwrap();
    let Deviation::Stated { scatter: Some(scatter) } = found.deviation else {
        panic!("{:?}", found.deviation)
    };
    // 1 within three standard deviations of the mean square of 597 residuals.
    assert!((scatter - 1.0).abs() < 3.0 / (2.0 * 597.0_f64).sqrt(), "{scatter}");
    assert!(found.outliers.is_empty(), "{:?}", found.outliers);
}
