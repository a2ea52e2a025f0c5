//! `catseye plot` writes whole files in the format that their name asks for.

use std::fs;

use crate::run::Bench;

#[test]
fn svg_and_png_by_the_name_s_ending() {
    let bench = Bench::new();
    for args in
        ["plot lobe --axes cartesian", "plot lobe -o a.png --theta 45", "plot albedo --roughness 1,inf"]
    {
        let outcome = bench.catseye(args, "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
    }
    assert_eq!(bench.files(), ["a.png", "albedo.svg", "lobe.svg"]);
    assert!(fs::read(bench.path("a.png")).unwrap().starts_with(b"\x89PNG"));
    for name in ["lobe.svg", "albedo.svg"] {
        let text = fs::read_to_string(bench.path(name)).unwrap();
        assert!(text.starts_with("<svg") && text.trim_end().ends_with("</svg>"), "{name}: {text:.80}");
        assert!(!text.contains("NaN") && !text.contains("inf"), "{name} has no undefined coordinate");
    }
}

#[test]
fn what_was_written_is_said() {
    let outcome = Bench::new().catseye("plot lobe --json", "");
    let facts: serde_json::Value = serde_json::from_str(&outcome.stdout).unwrap();
    assert_eq!(facts["output"], "lobe.svg");
}

#[test]
fn every_roughness_can_be_plotted() {
    for roughness in ["0", "0.003", "1", "inf"] {
        let albedo = Bench::new().catseye(&format!("plot albedo --roughness {roughness}"), "");
        assert_eq!((albedo.code, albedo.stderr.as_str()), (0, ""), "albedo of roughness {roughness}");
        let bench = Bench::new();
        let outcome =
            bench.catseye(&format!("plot lobe --roughness {roughness} --roughness-v 0.5 --theta 0,89"), "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "roughness {roughness}");
    }
}

#[test]
fn a_lobe_without_width_is_refused() {
    let bench = Bench::new();
    let outcome = bench.catseye("plot lobe --roughness 0", "");
    assert_eq!((outcome.code, outcome.stdout.as_str()), (1, ""));
    assert!(
        outcome.stderr.starts_with("catseye: roughness 0 is a perfect retro-reflector"),
        "{}",
        outcome.stderr
    );
    assert_eq!(bench.files(), [] as [&str; 0]);
}
