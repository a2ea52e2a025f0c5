//! Promise: a class is met where all its limits are, and a near miss is said to be one.

use catseye_photometry::standards::{Catalogue, StandardClass};
use catseye_photometry::verdict::{EVALUATION, Kind, Standing, Unjudged, Verdict, verdicts};
use catseye_photometry::{Geometry, Quantity, Table};

/// A sheeting that returns `r_a` at all angles.
fn even(r_a: f64) -> impl Fn(Quantity, &Geometry) -> Option<f64> {
    move |quantity, geometry| {
        let f = Quantity::RetroReflectionCoefficient.to_brdf(r_a, geometry)?;
        quantity.of_brdf(f, geometry)
    }
}

#[test]
fn a_class_is_met_where_all_its_limits_are() {
    let catalogue = Catalogue::embedded().unwrap();
    let class = catalogue.find("fmvss108:dot-c2:white").unwrap();
    let met = Verdict::new(class, 0.0, even(250.0)).unwrap();
    assert!(met.is_met());
    assert_eq!(
        met.to_string(),
        "meets FMVSS 108 Grade DOT-C2 white in R_A, nearest at 0.2 degree, entrance -4 degree: R_A 250, \
         at least 250 cd/lx/m2; not judged: luminance factor, colour, rotation"
    );
    let failed = Verdict::new(class, 0.0, even(100.0)).unwrap();
    assert_eq!(
        failed.to_string(),
        "fails FMVSS 108 Grade DOT-C2 white at 0.2 degree, entrance -4 degree: R_A 100, \
         at least 250 cd/lx/m2 (2 of 6 points)"
    );
}

#[test]
fn a_near_miss_does_not_look_like_a_hit() {
    let catalogue = Catalogue::embedded().unwrap();
    let class = catalogue.find("fmvss108:dot-c2:white").unwrap();
    let text = Verdict::new(class, 0.0, even(249.96)).unwrap().to_string();
    assert!(text.starts_with("fails") && text.contains("R_A 249.96, at least 250 cd/lx/m2"), "{text}");
}

#[test]
fn maxima_are_met_from_below() {
    let catalogue = Catalogue::embedded().unwrap();
    let class = catalogue.find("fr-plate:white").unwrap();
    assert!(Verdict::new(class, 0.0, even(100.0)).unwrap().is_met());
    let dazzling = Verdict::new(class, 0.0, even(300.0)).unwrap();
    assert!(dazzling.to_string().contains("R_A 300, at most 250"), "{dazzling}");
}

#[test]
fn products_and_whole_reflectors_give_no_verdict() {
    let catalogue = Catalogue::embedded().unwrap();
    let reason = |name: &str| Verdict::new(catalogue.find(name).unwrap(), 0.0, even(100.0)).unwrap_err();
    assert_eq!(reason("3m-8830"), Unjudged::NoLimit);
    assert_eq!(
        reason("fmvss108:reflex:white").to_string(),
        "R_I can't be measured; R_I needs the reflector's area"
    );
}

/// Just below the limit by the evaluation's rounding is met; by twice that it is not.
#[test]
fn rounding_does_not_decide() {
    let catalogue = Catalogue::embedded().unwrap();
    let class = catalogue.find("fmvss108:dot-c2:white").unwrap();
    let standing = |r_a: f64, guard: f64| Verdict::new(class, guard, even(r_a)).unwrap().standing();
    assert_eq!(standing(250.0 * (1.0 - 0.9 * EVALUATION), 0.0), Standing::Meets);
    assert_eq!(standing(250.0 * (1.0 - 2.0 * EVALUATION), 0.0), Standing::Fails);
    assert_eq!(standing(257.5 * (1.0 - 0.9 * EVALUATION), 0.03), Standing::Meets);
    assert_eq!(standing(257.5 * (1.0 - 2.0 * EVALUATION), 0.03), Standing::WithinGuard);
    assert_eq!(standing(249.9, 0.03), Standing::Fails);
}

#[test]
fn the_guard_band_is_a_third_state_and_is_kept_from_maxima_too() {
    let catalogue = Catalogue::embedded().unwrap();
    let plate = catalogue.find("fr-plate:white").unwrap();
    for (r_a, expected) in
        [(240.0, Standing::Meets), (245.0, Standing::WithinGuard), (251.0, Standing::Fails)]
    {
        let verdict = Verdict::new(plate, 0.03, even(r_a)).unwrap();
        assert_eq!(verdict.standing(), expected, "{verdict}");
        assert_eq!(verdict.is_met(), expected == Standing::Meets);
    }
    let text = Verdict::new(plate, 0.03, even(245.0)).unwrap().to_string();
    assert!(text.starts_with("within the guard band of French licence plates"), "{text}");
    assert!(text.contains("R_A 245, at most 250 cd/lx/m2 and 3 % to spare"), "{text}");
}

#[test]
fn what_was_not_judged_is_named() {
    let table = |rows: &str| {
        let text = format!("observation_deg,entrance_deg,rotation_deg,quantity,value,unit,limit\n{rows}");
        StandardClass::from_table(Table::parse_values(text.as_bytes(), "own.csv").unwrap()).unwrap()
    };
    let judged = |rows: &str| {
        let class = table(rows);
        let verdict = Verdict::new(&class, 0.0, |_, _| Some(1e3)).unwrap();
        (verdict.judged(), verdict.not_judged(), Kind::of(&class))
    };
    let (r_a, y) = (Quantity::RetroReflectionCoefficient, Quantity::LuminanceFactor);
    let one = "0.2,5,0,R_A,100,cd/lx/m2,minimum\n";
    let turned = "0.2,5,90,R_A,100,cd/lx/m2,minimum\n";
    let by_day = "45,45,0,Y,0.27,1,minimum\n";
    let road = "1.05,88.76,0,R_L,150,mcd/lx/m2,minimum\n";
    let cases = [
        (one.to_owned(), vec![r_a], vec!["luminance factor", "colour", "rotation"], Kind::Sheeting),
        (format!("{one}{turned}{by_day}"), vec![r_a, y], vec!["colour"], Kind::Sheeting),
        (
            road.to_owned(),
            vec![Quantity::RetroReflectedLuminance],
            vec!["luminance by day", "colour", "rotation"],
            Kind::Marking,
        ),
        (
            "0.2,0,0,R_I,100,mcd/lx,minimum\n".to_owned(),
            vec![Quantity::LuminousIntensity],
            vec!["colour", "rotation"],
            Kind::Reflector,
        ),
    ];
    for (rows, quantities, missing, kind) in cases {
        assert_eq!(judged(&rows), (quantities, missing, kind), "{rows}");
    }
}

#[test]
fn the_most_demanding_class_that_is_met_comes_first() {
    let catalogue = Catalogue::embedded().unwrap();
    let white = catalogue.classes().iter().filter(|class| class.id().ends_with(":white"));
    let (all, none) = verdicts(white, 0.0, even(251.0));
    assert!(none.iter().any(|(class, _)| class.id() == "3m:8830:white"), "{none:?}");
    assert!(all[0].is_met() && all[0].class().id() == "fmvss108:dot-c2:white", "{}", all[0]);
    let first_failed = all.iter().position(|verdict| !verdict.is_met()).unwrap();
    assert!(all[first_failed..].iter().all(|verdict| !verdict.is_met()));
}
