//! `catseye render` writes the picture that was asked for, whole, or nothing and says why.

use std::fs;

use crate::run::Bench;

const SMALL: &str = "--size 32x18 --spp 1";

const DOCUMENT: &str = r#"<?xml version="1.0"?>
<materialx version="1.39">
  <retro_reflective_bsdf name="beads" type="BSDF">
    <input name="roughness_u" type="float" value="0.15" />
  </retro_reflective_bsdf>
  <surface name="skin" type="surfaceshader">
    <input name="bsdf" type="BSDF" nodename="beads" />
  </surface>
  <surfacematerial name="vest" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="skin" />
  </surfacematerial>
</materialx>
"#;

/// Width and height in a PNG's header.
fn png_size(bytes: &[u8]) -> [u32; 2] {
    assert!(bytes.starts_with(b"\x89PNG\r\n\x1a\n"), "a PNG");
    [16, 20].map(|at| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()))
}

#[test]
fn without_arguments_the_built_in_scene_is_rendered() {
    let bench = Bench::new();
    let outcome = bench.catseye(&format!("render {SMALL}"), "");
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    assert!(
        outcome.stdout.starts_with("wrote catseye.png (32 x 18, 1 samples per pixel, "),
        "{}",
        outcome.stdout
    );
    assert_eq!(png_size(&fs::read(bench.path("catseye.png")).unwrap()), [32, 18]);
    assert_eq!(bench.files(), ["catseye.png"]);
}

#[test]
fn a_material_is_rendered_in_both_scenes_and_formats() {
    let bench = Bench::new();
    bench.write("vest.mtlx", DOCUMENT);
    for (args, file) in
        [("", "a.png"), ("--scene night --material vest", "b.exr"), ("--model edwards", "c.png")]
    {
        let outcome = bench.catseye(&format!("render vest.mtlx {SMALL} {args} -o {file} --json"), "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
        let facts: serde_json::Value = serde_json::from_str(&outcome.stdout).unwrap();
        assert_eq!(facts["output"], file);
    }
    assert!(fs::read(bench.path("b.exr")).unwrap().starts_with(&[0x76, 0x2f, 0x31, 0x01]), "an EXR");
    assert_eq!(bench.files(), ["a.png", "b.exr", "c.png", "vest.mtlx"]);
}

#[test]
fn the_number_of_threads_changes_nothing_but_the_seed_does() {
    let bench = Bench::new();
    for args in ["-o a.png --threads 1", "-o b.png --threads 3", "-o c.png --seed 1"] {
        assert_eq!(bench.catseye(&format!("render {SMALL} {args}"), "").code, 0, "{args}");
    }
    let [a, b, c] = ["a.png", "b.png", "c.png"].map(|name| fs::read(bench.path(name)).unwrap());
    assert_eq!(a, b);
    assert_ne!(a, c);
}

#[test]
fn a_bad_document_is_one_line_and_no_picture() {
    let bench = Bench::new();
    bench.write("bad.mtlx", &DOCUMENT.replace("0.15", "shiny"));
    bench.write("cut.mtlx", &DOCUMENT[..200]);
    bench.write("vest.mtlx", DOCUMENT);
    let cases = [
        ("bad.mtlx", "catseye: bad.mtlx:4:5: retro_reflective_bsdf \"beads\", input \"roughness_u\": "),
        ("cut.mtlx", "catseye: cut.mtlx:"),
        ("none.mtlx", "catseye: none.mtlx: can't be read: No such file"),
        ("vest.mtlx --material hat", "catseye: vest.mtlx: "),
    ];
    for (args, message) in cases {
        let outcome = bench.catseye(&format!("render {args} {SMALL}"), "");
        assert_eq!((outcome.code, outcome.stdout.as_str()), (1, ""), "{args}");
        assert!(outcome.stderr.starts_with(message), "{args}: {}", outcome.stderr);
        assert_eq!(outcome.stderr.lines().count(), 1, "{}", outcome.stderr);
    }
    assert_eq!(bench.files(), ["bad.mtlx", "cut.mtlx", "vest.mtlx"]);
}

#[test]
fn an_unwritable_picture_fails_before_it_is_rendered() {
    let bench = Bench::new();
    // At this size the picture itself would take hours.
    let outcome = bench.catseye("render --size 16384x16384 --spp 4096 -o no/such/a.png", "");
    assert_eq!((outcome.code, outcome.stdout.as_str()), (1, ""));
    assert!(outcome.stderr.starts_with("catseye: no/such/a.png: can't be written: "), "{}", outcome.stderr);
    assert_eq!(bench.files(), [] as [&str; 0]);
}

#[test]
fn wrong_use_has_exit_code_2() {
    for args in [
        "-o a.jpg",
        "-o picture",
        "--size 0x10",
        "--size 10",
        "--spp 0",
        "--threads 0",
        "--material vest",
        "--scene preview",
        "--model phong",
    ] {
        let outcome = Bench::new().catseye(&format!("render {args}"), "");
        assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{args}");
    }
}

#[test]
fn a_look_assigns_materials_to_a_scene_s_geometry() {
    let bench = Bench::new();
    let second = r#"<surfacematerial name="belt" type="material"><input name="surfaceshader" type="surfaceshader" nodename="skin" /></surfacematerial>
        <look name="worn"><materialassign name="a" material="vest" geom="/preview, /night/cones" />
          <materialassign name="b" material="belt" geom="/preview/sheet" /></look>
        <look name="bare"><materialassign name="c" material="belt" geom="/car" /></look></materialx>"#;
    bench.write("worn.mtlx", &DOCUMENT.replace("</materialx>", second));
    for (args, code, message) in [
        ("--look worn", 0, ""),
        ("--look worn --scene night", 0, ""),
        ("--look bare", 1, "worn.mtlx: the look assigns nothing to /preview/sphere, /preview/sheet"),
        ("--look none", 1, "worn.mtlx: no look \"none\"; its looks: worn, bare"),
        ("--look worn --material vest", 2, "cannot be used with"),
    ] {
        let outcome = bench.catseye(&format!("render worn.mtlx {SMALL} {args} -o a.png"), "");
        assert_eq!(outcome.code, code, "{args}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{args}: {}", outcome.stderr);
    }
}

#[test]
fn lamp_and_exposure_are_those_asked_for_and_said() {
    let bench = Bench::new();
    bench.write("vest.mtlx", DOCUMENT);
    let facts = |args: &str| -> serde_json::Value {
        let outcome = bench.catseye(&format!("render vest.mtlx {SMALL} --json {args}"), "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
        serde_json::from_str(&outcome.stdout).unwrap()
    };
    let own = facts("-o own.png");
    assert_eq!((&own["lamp_deg"][0], &own["exposure_ev"][0]), (&0.2_f32.into(), &3.0.into()));
    assert_eq!(facts("--exposure -2 -o dark.png")["exposure_ev"][0], 1.0);
    assert_ne!(facts("--exposure auto -o auto.png")["exposure_ev"], own["exposure_ev"]);
    let aside = facts("--lamp-deg 5 -o aside.exr");
    assert_eq!(aside["lamp_deg"][0], 5.0);
    let bytes = fs::read(bench.path("aside.exr")).unwrap();
    for attribute in ["chromaticities", "software", "comments", "exposureEv", "lampDeg", "--lamp-deg 5"] {
        assert!(bytes.windows(attribute.len()).any(|part| part == attribute.as_bytes()), "{attribute}");
    }
    let size = |file: &str| png_size(&fs::read(bench.path(file)).unwrap());
    facts("--lamp-deg 0.2,5 -o both.png");
    assert!(size("both.png")[0] > 2 * 32 && size("both.png")[1] > 18, "{:?}", size("both.png"));
    for refused in ["--lamp-deg 0.2,5 -o a.exr", "--lamp-deg 60", "--exposure bright", "--labels -o a.exr"] {
        assert_eq!(bench.catseye(&format!("render vest.mtlx {SMALL} {refused}"), "").code, 2, "{refused}");
    }
}

#[test]
fn the_signs_of_the_built_in_scene_are_read() {
    let bench = Bench::new();
    let outcome = bench.catseye("render --size 160x90 --spp 4 --labels --json -o night.png", "");
    let facts: serde_json::Value = serde_json::from_str(&outcome.stdout).unwrap();
    let [left, right] = [0, 1].map(|i| facts["signs_cd_m2"][i].as_f64().unwrap());
    // What the README says of its picture.
    assert!((left / right - 30.0).abs() < 2.0, "{left} {right}");
}
