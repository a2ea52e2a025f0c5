//! `catseye plot` writes whole files in the format that their name asks for.

use std::fs;

use crate::run::Bench;

#[test]
fn svg_and_png_by_the_name_s_ending() {
    let bench = Bench::new();
    for args in [
        "plot lobe --axes cartesian",
        "plot lobe -o a.png --theta 45",
        "plot albedo --roughness 1 inf 0.5,0.1",
    ] {
        let outcome = bench.catseye(args, "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
    }
    assert_eq!(bench.files(), ["a.png", "albedo.svg", "lobe.svg"]);
    assert!(fs::read(bench.path("a.png")).unwrap().starts_with(b"\x89PNG"));
    for name in ["lobe.svg", "albedo.svg"] {
        let text = fs::read_to_string(bench.path(name)).unwrap();
        assert!(text.starts_with("<svg") && text.trim_end().ends_with("</svg>"), "{name}: {text:.80}");
        assert!(!text.contains("NaN") && !text.contains("inf"), "{name} has no undefined coordinate");
        assert!(text.contains("role=\"img\"") && text.contains("<title>"), "{name} says what it shows");
    }
}

#[test]
fn logarithmic_diagrams_and_spheres_are_plotted() {
    let bench = Bench::new();
    for args in [
        "plot lobe --axes log --roughness 0.006 0.3 --theta 0 -o log.svg",
        "plot spheres --roughness 0.3 -o spheres.png",
    ] {
        let outcome = bench.catseye(args, "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
    }
    let text = fs::read_to_string(bench.path("log.svg")).unwrap();
    assert!(text.contains("roughness 0.006, light at 0°") && text.contains("10⁻⁸"), "{text:.300}");
    assert!(!text.contains("NaN") && !text.contains("inf"));
    for (args, message) in [
        ("plot lobe --roughness 0.1 0.2 0.3 --theta 0,30", "6 panels"),
        ("plot spheres --roughness 0.001", "0.01 to 10"),
        ("plot spheres -o a.svg", "must end in .png"),
    ] {
        let outcome = bench.catseye(args, "");
        assert_eq!(outcome.code, 2, "{args}");
        assert!(outcome.stderr.contains(message), "{args}: {}", outcome.stderr);
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
        let outcome = bench.catseye(&format!("plot lobe --roughness {roughness},0.5 --theta 0,89"), "");
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

#[test]
fn coefficients_are_plotted_with_the_values_of_any_standard_or_table() {
    let bench = Bench::with_materials();
    bench.write("t.csv", "observation_deg,entrance_deg,value,unit\n0.2,5,200,cd/lx/m2\n45,45,0.3,1\n");
    let cases = [
        "plot ra --roughness 0.006 -o a.svg",
        "plot ra --roughness inf --entrance -4,30 --observation 60 -o b.svg",
        "plot ra materials/sheeting.mtlx --standard fmvss108:dot-c2:white -o c.png",
        "plot ra materials/sheeting.mtlx --standard t.csv -o d.svg",
        "plot ra materials/matte_white.mtlx --standard en1436:r3 -o e.svg",
        "plot ra --roughness 0.0001 --tint 0 -o f.svg",
        "plot ra --roughness 0.02 --standard fr-plate:white -o g.svg",
    ];
    for args in cases {
        let outcome = bench.catseye(args, "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
    }
    for name in ["a.svg", "b.svg", "d.svg", "e.svg", "f.svg", "g.svg"] {
        let text = fs::read_to_string(bench.path(name)).unwrap();
        assert!(!text.contains("NaN") && !text.contains("inf"), "{name} has no undefined coordinate");
    }
    let refused = [
        ("plot ra", 2, "--roughness"),
        ("plot ra --roughness 0", 1, "perfect retro-reflector"),
        ("plot ra --roughness 1 --entrance 90", 2, "--entrance takes 1 to 8 angles"),
        ("plot ra --roughness 1 --observation 87", 2, "must be above 0 and less than 86"),
        ("plot ra --roughness 1 --standard fmvss108:dot-c2", 1, "names several classes"),
        ("plot ra --roughness 1 --standard fmvss108:reflex:red", 1, "has no values that are R_A"),
    ];
    for (args, code, message) in refused {
        let outcome = bench.catseye(args, "");
        assert_eq!(outcome.code, code, "{args}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{args}: {}", outcome.stderr);
    }
}
