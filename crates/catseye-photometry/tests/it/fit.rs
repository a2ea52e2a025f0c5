//! A fit gives back what data say, says what they leave open, and refuses what says nothing.

use catseye::Model;
use catseye_photometry::fit::{Aim, FitError, FitOptions, MAX_VALUES, Observation, fit};
use catseye_photometry::standards::Catalogue;
use catseye_photometry::{
    Apertures, Colour, EntranceCosine, EntranceFactor, Geometry, Goniometer, Limit, Quantity, RetroLobe,
    Sheeting,
};

/// The values that a sheeting has at some angles.
fn values_of(sheeting: &Sheeting, angles: &[(f64, f64, f64)]) -> Vec<Observation> {
    let prepared = sheeting.prepare().expect("roughness in range");
    let value = |&(observation, entrance, rotation): &(f64, f64, f64)| {
        let geometry = Geometry::from(Goniometer::from_degrees(observation, entrance, 0.0, rotation));
        let f = prepared.eval(geometry.wo, geometry.wi);
        let factor = Quantity::RetroReflectionCoefficient.of_brdf(1.0, &geometry).unwrap_or(f64::NAN);
        let view = catseye_photometry::fit::View { wo: geometry.wo, wi: geometry.wi, factor };
        Observation { value: f * factor, aim: Aim::Equal, views: vec![view] }
    };
    angles.iter().map(value).collect()
}

fn lobe(strength: f64, roughness: [f64; 2], power: f64) -> RetroLobe {
    RetroLobe { strength, roughness, entrance: EntranceFactor { power, knee: None } }
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
        assert!((found_lobe.entrance.power - 2.5).abs() < 1e-3, "{found_lobe:?}");
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

/// Every table with two observation angles or more is within 5 % of each value, or a proof says why not.
#[test]
fn standards_are_met_within_5_percent_or_it_is_said_why_not() {
    let mut unmet = Vec::new();
    let mut fitted = 0;
    for class in Catalogue::embedded().unwrap().classes() {
        // A product's typical values, or else a standard's minima.
        let has = |limit| class.rows().iter().any(|row| row.limit == limit);
        let wanted = if has(Limit::Typical) { Limit::Typical } else { Limit::Minimum };
        let rows = class.rows().iter().filter(|row| row.limit == wanted);
        let rows: Result<Vec<_>, _> =
            rows.map(|row| Observation::from_row(row, Aim::Equal, Some(0.01))).collect();
        let colour = Colour::named(&class.rows()[0].colour).unwrap();
        let options = FitOptions { channel_peak: colour.peak(), ..FitOptions::default() };
        match fit(&rows.unwrap(), &options) {
            Err(FitError::OneObservationAngle { .. } | FitError::Empty) => {}
            Err(error) => panic!("{}: {error}", class.id()),
            Ok(found) => {
                fitted += 1;
                assert!(found.sheeting.albedo_bound() * colour.peak() <= 1.0 + 1e-6, "{}", class.id());
                if !found.acceptable {
                    assert!(
                        found.shape.is_some(),
                        "{}: {:.3} off and no reason why",
                        class.id(),
                        found.worst
                    );
                    unmet.push((class.id().to_owned(), found.worst));
                }
            }
        }
    }
    println!("{fitted} tables fitted; beyond 5 %: {unmet:?}");
    assert_eq!(fitted, 39, "tables with two observation angles or more");
    let [(id, worst)] = &unmet[..] else { panic!("{unmet:?}") };
    // No sum of lobes is within 7.5 %; 12 to 13 % is what three of them reach.
    assert!(id == "iso20471:separate:white" && *worst < 0.14, "{id}: {worst}");
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

/// Numbers of the model are compared with sums written out by hand.
#[test]
fn the_reciprocal_form_is_reciprocal_and_the_same_in_the_retro_direction() {
    let view = Sheeting { lobes: vec![lobe(0.06, [0.2; 2], 3.0)], diffuse: 0.2, ..Sheeting::default() };
    let reciprocal = Sheeting { form: EntranceCosine::Reciprocal, ..view.clone() };
    let (view, reciprocal) = (view.prepare().unwrap(), reciprocal.prepare().unwrap());
    let (a, b) = (catseye::Vec3::from_angles(0.5, 0.1), catseye::Vec3::from_angles(0.7, 0.3));
    assert_eq!(view.eval(a, a), reciprocal.eval(a, a));
    assert!((reciprocal.eval(a, b) / reciprocal.eval(b, a) - 1.0).abs() < 1e-12);
    assert!((view.eval(a, b) / view.eval(b, a) - 1.0).abs() > 0.01);
}

#[test]
fn the_back_vector_lobe_is_fitted_as_well() {
    let class = Catalogue::embedded().unwrap().find("fra-224:white").unwrap().clone();
    let rows = class.rows().iter().map(|row| Observation::from_row(row, Aim::Equal, None).unwrap());
    let options = FitOptions { model: Model::BackVector, ..FitOptions::default() };
    let found = fit(&rows.collect::<Vec<_>>(), &options).unwrap();
    assert!(found.acceptable && found.shape.is_none(), "{found:?}");
}
