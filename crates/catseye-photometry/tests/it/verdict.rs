//! Promise: a class is met where all its limits are, and a near miss is said to be one.

use catseye_photometry::standards::Catalogue;
use catseye_photometry::verdict::{Verdict, verdicts};
use catseye_photometry::{Geometry, Quantity};

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
    let met = Verdict::new(class, even(250.0)).unwrap();
    assert!(met.is_met());
    assert_eq!(
        met.to_string(),
        "meets FMVSS 108 Grade DOT-C2 white, nearest at 0.2 degree, entrance -4 degree: R_A 250, at least 250 cd/lx/m2"
    );
    let failed = Verdict::new(class, even(100.0)).unwrap();
    assert_eq!(
        failed.to_string(),
        "fails FMVSS 108 Grade DOT-C2 white at 0.2 degree, entrance -4 degree: R_A 100, at least 250 cd/lx/m2 (2 of 6 points)"
    );
}

#[test]
fn a_near_miss_does_not_look_like_a_hit() {
    let catalogue = Catalogue::embedded().unwrap();
    let class = catalogue.find("fmvss108:dot-c2:white").unwrap();
    let text = Verdict::new(class, even(249.999)).unwrap().to_string();
    assert!(text.contains("R_A 249.999, at least 250 cd/lx/m2"), "{text}");
}

#[test]
fn maxima_are_met_from_below() {
    let catalogue = Catalogue::embedded().unwrap();
    let class = catalogue.find("fr-plate:white").unwrap();
    assert!(Verdict::new(class, even(100.0)).unwrap().is_met());
    let dazzling = Verdict::new(class, even(300.0)).unwrap();
    assert!(dazzling.to_string().contains("R_A 300, at most 250"), "{dazzling}");
}

#[test]
fn products_and_whole_reflectors_give_no_verdict() {
    let catalogue = Catalogue::embedded().unwrap();
    for name in ["3m-8830", "fmvss108:reflex:white"] {
        assert!(Verdict::new(catalogue.find(name).unwrap(), even(100.0)).is_none(), "{name}");
    }
}

#[test]
fn the_most_demanding_class_that_is_met_comes_first() {
    let catalogue = Catalogue::embedded().unwrap();
    let white = catalogue.classes().iter().filter(|class| class.id().ends_with(":white"));
    let all = verdicts(white, even(251.0));
    assert!(all[0].is_met() && all[0].class().id() == "fmvss108:dot-c2:white", "{}", all[0]);
    let first_failed = all.iter().position(|verdict| !verdict.is_met()).unwrap();
    assert!(all[first_failed..].iter().all(|verdict| !verdict.is_met()));
}
