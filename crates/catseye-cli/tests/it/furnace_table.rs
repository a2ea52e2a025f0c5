//! `catseye furnace` prints what it expects beside what it measured, and the two agree.

use std::fs;

use serde_json::Value;

use crate::run::{Bench, output};

/// The numbers of a run with few samples.
fn numbers(args: &str) -> Vec<Value> {
    let facts: Value = serde_json::from_str(&output(&format!("furnace --spp 1 --json {args}"), "")).unwrap();
    facts["rows"].as_array().unwrap().clone()
}

/// Asserts that measured and expected values agree as well as 4096 samples can tell.
fn assert_agreement(rows: &[Value], args: &str) {
    for row in rows {
        for place in ["normal", "sphere"] {
            let [measured, expected] = ["measured", "expected"].map(|key| row[place][key].as_f64().unwrap());
            assert!(
                (measured - expected).abs() < 1e-2,
                "{args} {place}: {measured}, expected {expected} in {row}"
            );
        }
    }
}

#[test]
fn measured_agrees_with_expected() {
    for (args, spheres) in [
        ("", 20),
        ("--roughness 0.1,0.05 0.5,0.05 0.9,0.05", 6),
        ("--roughness 0,inf 0.3,inf", 4),
        ("--model edwards", 10),
        ("--model back-vector", 10),
    ] {
        let rows = numbers(args);
        assert_eq!(rows.len(), spheres, "{args}: the models without compensation have one row");
        assert_agreement(&rows, args);
    }
}

#[test]
fn multiple_scattering_returns_everything() {
    for row in numbers("").iter().filter(|row| row["scattering"] == "multiple") {
        for place in ["normal", "sphere"] {
            assert_eq!(row[place]["expected"], 1.0);
            assert!((row[place]["measured"].as_f64().unwrap() - 1.0).abs() < 1e-3, "{row}");
        }
    }
}

#[test]
fn single_scattering_is_the_proposal_s_first_figure() {
    let rows = numbers("");
    let expected = |roughness: f64| {
        let row = rows.iter().find(|row| row["roughness_u"] == roughness && row["scattering"] == "single");
        row.unwrap()["sphere"]["expected"].as_f64().unwrap()
    };
    assert_eq!(expected(0.0), 1.0, "a perfect retro-reflector");
    let roughness: Vec<f64> = (0..10).map(|i| f64::from(i) / 10.0).collect();
    assert!(
        roughness.windows(2).all(|pair| expected(pair[0]) > expected(pair[1])),
        "rough loses more: {rows:?}"
    );
}

#[test]
fn the_picture_is_a_png_with_both_rows() {
    let bench = Bench::new();
    let outcome = bench.catseye("furnace --spp 1 -o f.png", "");
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    for heading in ["single scattering", "multiple scattering", "measured  expected", "largest difference"] {
        assert!(outcome.stdout.contains(heading), "{heading} in {}", outcome.stdout);
    }
    assert!(outcome.stdout.ends_with("wrote f.png\n"), "{}", outcome.stdout);
    assert!(fs::read(bench.path("f.png")).unwrap().starts_with(b"\x89PNG"));
    assert_eq!(bench.files(), ["f.png"]);
}
