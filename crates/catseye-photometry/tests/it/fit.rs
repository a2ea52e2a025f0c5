//! A fit gives back what data say, says what they leave open, and refuses what says nothing.

use catseye::Model;
use catseye_photometry::fit::{Aim, FitError, FitOptions, MAX_VALUES, Observation, fit};
use catseye_photometry::standards::{Catalogue, StandardClass};
use catseye_photometry::{
    Apertures, Colour, EntranceLaw, Geometry, Goniometer, Limit, Quantity, RetroLobe, Sheeting,
};

/// The values that a sheeting has at some angles.
fn values_of(sheeting: &Sheeting, angles: &[(f64, f64, f64)]) -> Vec<Observation> {
    let prepared = sheeting.prepare().expect("roughness in range");
    let value = |&(observation, entrance, rotation): &(f64, f64, f64)| {
        let geometry = Geometry::from(Goniometer::from_degrees(observation, entrance, 0.0, rotation));
        let f = prepared.eval(geometry.wo, geometry.wi);
        let factor = Quantity::RetroReflectionCoefficient.of_brdf(1.0, &geometry).unwrap_or(f64::NAN);
        let view = catseye_photometry::fit::View { wo: geometry.wo, wi: geometry.wi, factor };
        Observation { value: f * factor, uncertainty: None, aim: Aim::Equal, views: vec![view] }
    };
    angles.iter().map(value).collect()
}

fn lobe(strength: f64, roughness: [f64; 2], power: f64) -> RetroLobe {
    let entrance = (power > 0.0).then(|| EntranceLaw::power(power));
    RetroLobe { strength, roughness, entrance }
}

fn grid(rotations: &[f64]) -> Vec<(f64, f64, f64)> {
    let mut angles = Vec::new();
    for &rotation in rotations {
        for observation in [0.1, 0.2, 0.33, 0.5, 1.0, 1.5] {
            for entrance in [-4.0, 20.0, 30.0, 40.0] {
                angles.push((observation, entrance, rotation));
            }
        }
    }
    angles
}

#[test]
fn a_single_lobe_is_found_again() {
    for roughness in [0.003, 0.0057, 0.02] {
        let sheeting = Sheeting { lobes: vec![lobe(0.06, [roughness; 2], 2.5)], ..Sheeting::default() };
        let found = fit(&values_of(&sheeting, &grid(&[0.0])[..20]), &FitOptions::default()).unwrap();
        let [found_lobe] = found.sheeting.lobes[..] else { panic!("{:?}", found.form) };
        // The weak prior of the fit and the accuracy of a round are left: 1e-4.
        assert!((found_lobe.roughness[0] / roughness - 1.0).abs() < 1e-4, "{found_lobe:?}");
        assert!((found_lobe.strength / 0.06 - 1.0).abs() < 1e-3, "{found_lobe:?}");
        assert!((found_lobe.entrance.unwrap().slope - 2.5).abs() < 1e-3, "{found_lobe:?}");
    }
}

#[test]
fn an_anisotropic_lobe_needs_a_turned_sample_and_is_found_then() {
    let sheeting = Sheeting { lobes: vec![lobe(0.1, [0.005, 0.015], 1.5)], ..Sheeting::default() };
    let found = fit(&values_of(&sheeting, &grid(&[0.0, 90.0])), &FitOptions::default()).unwrap();
    let [found_lobe] = found.sheeting.lobes[..] else { panic!("{:?}", found.form) };
    assert!((found_lobe.roughness[0] / 0.005 - 1.0).abs() < 1e-3, "{found_lobe:?}");
    assert!((found_lobe.roughness[1] / 0.015 - 1.0).abs() < 1e-3, "{found_lobe:?}");
}

#[test]
fn two_lobes_are_told_from_one() {
    let lobes = vec![lobe(0.05, [0.005; 2], 1.5), lobe(0.06, [0.02; 2], 1.5)];
    let sheeting = Sheeting { lobes, ..Sheeting::default() };
    let found = fit(&values_of(&sheeting, &grid(&[0.0])), &FitOptions::default()).unwrap();
    assert_eq!(found.form.lobes, 2);
    assert!(found.worst < 0.02, "{}", found.worst);
}

#[test]
fn a_blurred_lobe_is_found_through_the_apertures() {
    let sheeting = Sheeting { lobes: vec![lobe(0.06, [0.006; 2], 2.0)], ..Sheeting::default() };
    let rule = Apertures::both_deg(0.4).rule().unwrap();
    let prepared = sheeting.prepare().unwrap();
    let seen: Vec<Observation> = values_of(&sheeting, &grid(&[0.0]))
        .iter()
        .map(|row| {
            let mut row = row.through(&rule);
            row.value = row.views.iter().map(|view| view.factor * prepared.eval(view.wo, view.wi)).sum();
            row
        })
        .collect();
    let found = fit(&seen, &FitOptions::default()).unwrap();
    assert!((found.sheeting.lobes[0].roughness[0] / 0.006 - 1.0).abs() < 1e-3, "{:?}", found.sheeting);
    // The same values taken for those between points are of a wider lobe.
    let points: Vec<Observation> = values_of(&sheeting, &grid(&[0.0]))
        .into_iter()
        .zip(&seen)
        .map(|(point, seen)| Observation { value: seen.value, ..point })
        .collect();
    let wider = fit(&points, &FitOptions { lobes: Some(1), ..FitOptions::default() }).unwrap();
    assert!(wider.sheeting.lobes[0].roughness[0] > 0.0061, "{:?}", wider.sheeting);
}

/// Tables that are not met within 5 %, and within what they are: reflectors whose positions are one colour's
/// mean, a table with four entrance laws that no sum of lobes comes closer to than 7.5 %, and one whose
/// values have a single digit.
const UNMET: [(&str, f64); 5] = [
    ("fmvss108:reflex:red", 0.08),
    ("fmvss108:reflex:amber", 0.08),
    ("fmvss108:reflex:white", 0.08),
    ("iso20471:separate:white", 0.23),
    ("fr-plate:sheeting:blue", 0.15),
];

/// Tables that came after the laws were chosen, and how far from their values the fits are. Their three
/// entrance angles and three observation angles, in minima of one or two digits, are met as limits if at all.
const LATER: [&str; 6] = ["at-stvzvo:", "it-dpr495:", "3m:dg3:", "3m:hip:", "3m:egp:", "3m:3970:"];

/// Every other table with two observation angles or more is within 5 % of each value, and all are physical
/// between them.
#[test]
fn standards_are_met_within_5_percent_by_what_sheeting_can_be() {
    let (mut met, mut unmet) = (0, 0);
    let is_later = |class: &StandardClass| LATER.iter().any(|later| class.id().starts_with(later));
    for class in Catalogue::embedded().unwrap().classes().iter().filter(|class| !is_later(class)) {
        // A product's typical values, or else a standard's minima.
        let has = |limit| class.rows().iter().any(|row| row.limit == limit);
        let wanted = if has(Limit::Typical) { Limit::Typical } else { Limit::Minimum };
        let rows = class.rows().iter().filter(|row| row.limit == wanted);
        let rows: Result<Vec<_>, _> =
            rows.map(|row| Observation::from_row(row, Aim::Equal, Some(0.01))).collect();
        let colour = Colour::named(&class.rows()[0].colour).unwrap();
        let options = FitOptions { channel_peak: colour.peak(), ..FitOptions::default() };
        let found = match fit(&rows.unwrap(), &options) {
            Err(FitError::OneObservationAngle { .. } | FitError::Empty) => continue,
            Err(error) => panic!("{}: {error}", class.id()),
            Ok(found) => found,
        };
        let id = class.id();
        println!("{id}: {} numbers, worst {:.4}", found.estimates.len(), found.worst);
        assert!(found.sheeting.albedo_bound() * colour.peak() <= 1.0 + 1e-6, "{id}");
        assert!(found.shape.is_none_or(|bound| bound.error <= found.worst), "{id}: {:?}", found.shape);
        assert_eq!(found.fault, None, "{id}");
        match UNMET.iter().find(|(name, _)| *name == id) {
            Some((_, worst)) => {
                assert!(!found.acceptable && found.worst < *worst, "{id}: {}", found.worst);
                unmet += 1;
            }
            None => {
                assert!(found.acceptable, "{id}: {}", found.worst);
                met += 1;
            }
        }
    }
    assert_eq!((met, unmet), (34, 5));
}

/// What docs/photometry.md says of tables that the laws were not chosen on.
#[test]
fn tables_that_came_later_are_met_as_well_as_is_said() {
    let catalogue = Catalogue::embedded().unwrap();
    let cases = [
        ("at-stvzvo:typ-1:green", 0.05),
        ("it-dpr495:triangle:white", 0.06),
        ("3m:dg3:white", 0.10),
        ("3m:hip:white", 0.05),
        ("3m:egp:red", 0.05),
    ];
    for (name, worst) in cases {
        let rows = catalogue.find(name).unwrap().rows();
        let rows: Vec<_> =
            rows.iter().map(|row| Observation::from_row(row, Aim::Equal, Some(0.01)).unwrap()).collect();
        let found = fit(&rows, &FitOptions::default()).unwrap();
        println!("{name}: {} numbers, worst {:.4}", found.estimates.len(), found.worst);
        assert!(found.worst < worst && found.fault.is_none(), "{name}: {}", found.worst);
    }
}

/// A maximum is no value: that a plate may be seven times as bright draws nothing towards it.
#[test]
fn a_maximum_far_away_changes_nothing() {
    let class = Catalogue::embedded().unwrap().find("fr-plate:yellow").unwrap().clone();
    let aim = |limit| if limit == Limit::Maximum { Aim::AtMost } else { Aim::Equal };
    let rows = class.rows().iter().map(|row| Observation::from_row(row, aim(row.limit), None).unwrap());
    let found = fit(&rows.collect::<Vec<_>>(), &FitOptions::default()).unwrap();
    assert!(found.worst < 0.05, "{}", found.worst);
}

/// Tables with several minima, or at the edge of the tolerance: noise in the tenth digit must not decide
/// where a search ends.
#[test]
fn a_fit_does_not_hang_on_the_last_digits() {
    let catalogue = Catalogue::embedded().unwrap();
    for name in [
        "astm-d4956:i:green",
        "fr-plate:yellow",
        "fr-plate:blue",
        "fmvss108:reflex:red",
        "iso20471",
        "16cfr1512:bicycle:clear",
    ] {
        let class = catalogue.find(name).unwrap();
        let rows = class.rows().iter().filter(|row| row.limit != Limit::Maximum);
        let rows: Vec<_> =
            rows.map(|row| Observation::from_row(row, Aim::Equal, Some(0.01)).unwrap()).collect();
        let mut uniform = uniform(7);
        let worsts: Vec<f64> = (0..4)
            .map(|_| {
                let moved = |row: &Observation| {
                    let value = row.value * (1.0 + 1e-9 * (2.0 * uniform() - 1.0));
                    Observation { value, ..row.clone() }
                };
                let rows: Vec<_> = rows.iter().map(moved).collect();
                fit(&rows, &FitOptions::default()).unwrap().worst
            })
            .collect();
        let [least, most] = [f64::min, f64::max].map(|better| worsts.iter().copied().fold(worsts[0], better));
        assert!(most - least < 1e-3, "{name}: {worsts:?}");
    }
}

#[test]
fn minima_can_be_met_as_limits() {
    let class = Catalogue::embedded().unwrap().find("iso20471").unwrap().clone();
    let rows = class.rows().iter().map(|row| Observation::from_row(row, Aim::AtLeast, None).unwrap());
    let found =
        fit(&rows.collect::<Vec<_>>(), &FitOptions { tolerance: 1e-2, ..FitOptions::default() }).unwrap();
    assert!(found.acceptable, "{}", found.worst);
    assert!(found.ratios.iter().all(|&ratio| (0.99..2.0).contains(&ratio)), "{:?}", found.ratios);
}

#[test]
fn no_albedo_is_above_1() {
    // Values that a lobe of energy 2 would have.
    let generous = Sheeting { lobes: vec![lobe(2.0, [0.006; 2], 0.0)], ..Sheeting::default() };
    let found = fit(&values_of(&generous, &grid(&[0.0])), &FitOptions::default()).unwrap();
    assert!(!found.acceptable && found.sheeting.albedo_bound() <= 1.0 + 1e-6, "{found:?}");
}

#[test]
fn what_data_leave_open_is_said() {
    let sheeting = Sheeting { lobes: vec![lobe(0.06, [0.006; 2], 2.0)], ..Sheeting::default() };
    let one_entrance = values_of(&sheeting, &[(0.2, 5.0, 0.0), (0.5, 5.0, 0.0)]);
    let found = fit(&one_entrance, &FitOptions::default()).unwrap();
    assert!(found.warnings.iter().any(|warning| warning.contains("entrance angle")), "{:?}", found.warnings);
    let three_lobes = FitOptions { lobes: Some(3), ..FitOptions::default() };
    let found = fit(&one_entrance, &three_lobes).unwrap();
    assert!(found.estimates.iter().any(|estimate| !estimate.determined), "{:?}", found.estimates);
    assert!(
        found.warnings.iter().any(|warning| warning.contains("can't determine 6 numbers")),
        "{:?}",
        found.warnings
    );
}

#[test]
fn a_table_that_says_nothing_is_refused() {
    let sheeting = Sheeting { lobes: vec![lobe(0.06, [0.006; 2], 2.0)], ..Sheeting::default() };
    let one = values_of(&sheeting, &[(0.2, 5.0, 0.0)]);
    let options = FitOptions::default();
    assert!(matches!(fit(&[], &options), Err(FitError::Empty)));
    assert!(matches!(fit(&one, &options), Err(FitError::OneObservationAngle { .. })));
    // A luminance factor is another angle, but says nothing of the lobes.
    let by_day = values_of(&Sheeting { diffuse: 0.3, ..Sheeting::default() }, &[(45.0, 45.0, 0.0)]);
    let and_by_day = [one.clone(), by_day.clone()].concat();
    let with_base = FitOptions { diffuse: true, ..options };
    assert!(matches!(fit(&and_by_day, &with_base), Err(FitError::OneObservationAngle { .. })));
    assert!(matches!(fit(&by_day, &with_base), Err(FitError::NotRetro)));
    let with_width = fit(&one, &FitOptions { roughness: Some(0.006), ..options }).unwrap();
    assert!((with_width.sheeting.lobes[0].strength / 0.06 - 1.0).abs() < 0.01, "{with_width:?}");
    let many = vec![one[0].clone(); MAX_VALUES + 1];
    let message = fit(&many, &options).unwrap_err().to_string();
    assert_eq!(message, "10001 values are more than the 10000 that are fitted; keep one row in 2");
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let bad = vec![one[0].clone(), Observation { value, ..one[0].clone() }];
        assert!(matches!(fit(&bad, &options), Err(FitError::NotPositive { row: 2, .. })), "{value}");
    }
    for bad in [
        FitOptions { lobes: Some(4), ..options },
        FitOptions { roughness: Some(f64::NAN), ..options },
        FitOptions { coat_ior: Some(0.5), ..options },
        FitOptions { tolerance: 0.0, ..options },
        FitOptions { channel_peak: 0.5, ..options },
    ] {
        assert!(matches!(fit(&one, &bad), Err(FitError::Option { .. })), "{bad:?}");
    }
    let two_of_given = FitOptions { lobes: Some(2), roughness: Some(0.006), ..options };
    assert!(matches!(fit(&one, &two_of_given), Err(FitError::RoughnessOfMany { lobes: 2 })));
}

#[test]
fn a_form_with_more_numbers_is_never_worse() {
    let catalogue = Catalogue::embedded().unwrap();
    for name in ["iso20471", "fmvss108:dot-c3:red", "fr-plate:blue", "astm-d4956:iii:white"] {
        let class = catalogue.find(name).unwrap();
        let rows = class.rows().iter().filter(|row| row.limit != Limit::Maximum);
        let rows: Vec<_> = rows.map(|row| Observation::from_row(row, Aim::Equal, None).unwrap()).collect();
        // A tolerance that nothing meets, so that all forms are tried.
        let found = fit(&rows, &FitOptions { tolerance: 1e-9, ..FitOptions::default() }).unwrap();
        assert_eq!(found.trials.len(), 6, "{name}");
        for (i, more) in found.trials.iter().enumerate() {
            for less in &found.trials[..i] {
                let is_case = less.form.lobes <= more.form.lobes
                    && less.form.entrance <= more.form.entrance
                    && (less.form.shared || !more.form.shared);
                assert!(!is_case || more.worst <= less.worst * (1.0 + 1e-9), "{name}: {less:?} {more:?}");
            }
        }
    }
}

/// Evenly distributed numbers in [0, 1): Knuth's linear congruence.
fn uniform(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Two lobes of constant width times cos^3, with noise of 3 %: 600 rows at entrance angles up to 50 degrees
/// either way.
#[test]
fn data_of_constant_width_are_fitted_to_their_noise() {
    let mut uniform = uniform(1);
    let mut rows = Vec::new();
    for i in 0..600 {
        let (observation, entrance) = (0.1 + 1.9 * uniform(), -50.0 + 100.0 * uniform());
        let gaussian = |half_power: f64| (-(observation / half_power).powi(2) * 2.0_f64.ln()).exp();
        let r_a = (300.0 * gaussian(0.35) + 60.0 * gaussian(1.0)) * entrance.to_radians().cos().powi(3);
        let noise: f64 = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let geometry = Geometry::from(Goniometer::from_degrees(observation, entrance, 0.0, 0.0));
        let factor = Quantity::RetroReflectionCoefficient.of_brdf(1.0, &geometry).unwrap();
        let view = catseye_photometry::fit::View { wo: geometry.wo, wi: geometry.wi, factor };
        let value = r_a * (1.0 + 0.03 * noise);
        assert!(value > 0.0, "row {i}");
        rows.push(Observation { value, uncertainty: None, aim: Aim::Equal, views: vec![view] });
    }
    let found = fit(&rows, &FitOptions { isotropic: true, lobes: Some(2), ..FitOptions::default() }).unwrap();
    assert!(found.rms < 0.04, "{}", found.rms);
    assert!(found.fault.is_none(), "{:?}", found.fault);
}

#[test]
fn the_back_vector_lobe_is_fitted_as_well() {
    let class = Catalogue::embedded().unwrap().find("fra-224:white").unwrap().clone();
    let rows = class.rows().iter().map(|row| Observation::from_row(row, Aim::Equal, None).unwrap());
    let options = FitOptions { model: Model::BackVector, ..FitOptions::default() };
    let found = fit(&rows.collect::<Vec<_>>(), &options).unwrap();
    assert!(found.acceptable && found.shape.is_none(), "{found:?}");
}
