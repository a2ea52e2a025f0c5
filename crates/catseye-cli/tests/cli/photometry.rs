//! `measure`, `standards` and `roughness`: the contract of their CSV, and that their numbers are the library's.

use catseye::{Lobe as _, Params, Reciprocal};
use catseye_photometry::{Geometry, Goniometer, Quantity, RoadMarking};

use crate::run::{Bench, column};

/// A lobe of the given roughness, tint (0.06, 0.05, 0.02).
fn document(roughness: &str) -> String {
    format!(
        r#"<materialx version="1.39" colorspace="lin_rec709">
          <retro_reflective_bsdf name="beads" type="BSDF">
            <input name="roughness_u" type="float" value="{roughness}" />
            <input name="tint" type="color3" value="0.06, 0.05, 0.02" />
          </retro_reflective_bsdf>
          <surface name="skin" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="beads" /></surface>
          <surfacematerial name="m" type="material">
            <input name="surfaceshader" type="surfaceshader" nodename="skin" />
          </surfacematerial>
        </materialx>"#
    )
}

fn bench() -> Bench {
    let bench = Bench::new();
    bench.write("m.mtlx", &document("0.006"));
    bench
}

/// Standard output of a run that succeeds.
fn measured(args: &str, stdin: &str) -> String {
    let outcome = bench().catseye(&format!("measure m.mtlx {args}"), stdin);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
    outcome.stdout
}

/// The exact lobe's green channel in 1/sr.
fn green(roughness: f64, geometry: &Geometry) -> f64 {
    let lobe = Reciprocal::<f64>::new(&Params::isotropic(roughness).with_tint([0.05; 3])).unwrap();
    lobe.eval(geometry.wo, geometry.wi)[1]
}

#[test]
fn rows_come_back_with_the_models_value_in_their_unit() {
    let table = "note,entrance_deg,observation_deg,unit,quantity\n\
                 \"a, b\",-4,0.2,cd/lx/m2,\n,30,0.33,cd/fc/ft2,R_A\n,5,0.2,1/sr,f\n,5,0.5,1,Y\n,5,0.5,%,Y\n";
    let text = measured("--geometry - --channel g", table);
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("note,entrance_deg,observation_deg,unit,quantity,model"));
    assert!(lines.next().unwrap().starts_with("\"a, b\",-4,0.2,cd/lx/m2,,"));
    let model = |line: &str| line.rsplit(',').next().unwrap().parse::<f64>().unwrap();
    let values: Vec<f64> = text.lines().skip(1).map(model).collect();
    let geometry = |o, e| Geometry::from(Goniometer::from_degrees(o, e, 0.0, 0.0));
    let r_a = |g: Geometry| Quantity::RetroReflectionCoefficient.of_brdf(green(0.006, &g), &g).unwrap();
    let y = std::f64::consts::PI * green(0.006, &geometry(0.5, 5.0));
    let expected = [
        r_a(geometry(0.2, -4.0)),
        r_a(geometry(0.33, 30.0)),
        green(0.006, &geometry(0.2, 5.0)),
        y,
        100.0 * y,
    ];
    for (value, expected) in values.iter().zip(expected) {
        // Renderers' single precision.
        assert!((value / expected - 1.0).abs() < 1e-3, "{value} {expected}");
    }
}

#[test]
fn colours_count_as_luminance() {
    let one = "observation_deg,entrance_deg\n0.2,5\n";
    let of = |channel: &str| column(&measured(&format!("--geometry - --channel {channel}"), one), "model")[0];
    let luminance = 0.2126 * of("r") + 0.7152 * of("g") + 0.0722 * of("b");
    assert!((of("luminance") / luminance - 1.0).abs() < 1e-12);
    assert!((of("r") / of("b") - 3.0).abs() < 1e-5);
}

#[test]
fn road_markings_are_measured_in_millicandela() {
    let bench = Bench::new();
    bench.write("m.mtlx", &document("0.3"));
    let table = "observation_deg,entrance_deg,unit\n1.05,88.76,mcd/lx/m2\n";
    let value = column(&bench.catseye("measure m.mtlx --geometry - --channel g", table).stdout, "model")[0];
    let road = Geometry::from(RoadMarking::standard_30_m());
    let expected = 1e3 * Quantity::RetroReflectedLuminance.of_brdf(green(0.3, &road), &road).unwrap();
    assert!((value / expected - 1.0).abs() < 1e-3, "{value} {expected}");
}

#[test]
fn whole_reflectors_need_an_area() {
    let outcome = bench().catseye("measure m.mtlx --standard fmvss108:reflex:red", "");
    assert_eq!((outcome.code, outcome.stdout.as_str()), (1, ""));
    assert!(outcome.stderr.contains("say which with --area-m2"), "{}", outcome.stderr);
    let table = "observation_deg,entrance_deg,quantity,unit\n0.2,5,R_I,mcd/lx\n0.2,5,R_A,cd/lx/m2\n";
    let model = column(&measured("--geometry - --area-m2 0.002", table), "model");
    assert!((model[0] - 2.0 * model[1]).abs() < 1e-9 * model[0], "{model:?}");
}

#[test]
fn integrals_are_measured_too() {
    let table =
        "observation_deg,entrance_deg,quantity,unit\n40,0,R_T,%\n0.4,0,R_T,1\n1.05,88.76,Q_d,mcd/lx/m2\n";
    let model = column(&measured("--geometry - --channel g", table), "model");
    // A narrow lobe returns its tint, half of it within the half-power angle, 0.4048 degree.
    assert!((model[0] - 5.0).abs() < 0.01 && (model[1] - 0.0247).abs() < 0.0003, "{model:?}");
    // What an even sky returns at grazing angles is the albedo over pi.
    assert!(model[2] > 0.0 && model[2] < 0.05 / std::f64::consts::PI * 1e3, "{model:?}");
}

#[test]
fn without_a_table_the_geometries_of_sheeting_are_measured() {
    let text = measured("", "");
    assert!(text.starts_with("observation_deg,entrance_deg,quantity,unit,model\n0.1,-4,R_A,cd/lx/m2,"));
    assert_eq!(text.lines().count(), 36);
}

#[test]
fn json_has_the_same_rows() {
    let text = measured("--standard fra-224:white --json", "");
    let rows: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(rows.as_array().unwrap().len(), 4);
    assert_eq!(rows[0]["observation_deg"], 0.2);
    assert_eq!(rows[0]["id"], "fra-224:rail:white");
    let csv = measured("--standard fra-224:white", "");
    let last = csv.lines().nth(1).unwrap().rsplit(',').next().unwrap().parse::<f64>().unwrap();
    assert_eq!(rows[0]["model"].as_f64(), Some(last));
}

#[test]
fn what_standards_show_prints_is_measured_like_the_standard() {
    let bench = bench();
    let shown = bench.catseye("standards show iso20471", "").stdout;
    bench.write("own.csv", &shown);
    let own = bench.catseye("measure m.mtlx --standard own.csv", "").stdout;
    assert_eq!(own, bench.catseye("measure m.mtlx --standard iso20471", "").stdout);
    assert_eq!(own, bench.catseye("measure m.mtlx --geometry own.csv", "").stdout);
    assert_eq!(own.lines().count(), 17);
}

#[test]
fn verdicts_say_where_a_class_is_missed_and_by_how_much() {
    let text = measured("--verdict", "");
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines.iter().any(|line| line.starts_with("meets ASTM D4956 Type I white")), "{text}");
    assert!(
        lines.iter().any(|line| line.starts_with("fails ISO 20471") && line.contains(" at 1.5 degree")),
        "{text}"
    );
    let first_failed = lines.iter().position(|line| line.starts_with("fails ")).unwrap();
    assert!(lines[first_failed..].iter().all(|line| line.starts_with("fails ")), "{text}");
    let facts: serde_json::Value = serde_json::from_str(&measured("--verdict --json", "")).unwrap();
    assert_eq!(facts.as_array().unwrap().len(), lines.len());
    assert_eq!(facts[0]["text"], lines[0]);
    let one = measured("--verdict --standard fmvss108:dot-c2:white", "");
    assert_eq!(one.lines().count(), 1);
}

#[test]
fn a_failed_measurement_writes_no_file() {
    let bench = Bench::new();
    bench.write("m.mtlx", &document("0"));
    let outcome = bench.catseye("measure m.mtlx -o out.csv", "");
    assert_eq!((outcome.code, outcome.stdout.as_str()), (1, ""));
    assert!(outcome.stderr.contains("in a single direction (roughness 0)"), "{}", outcome.stderr);
    assert_eq!(bench.files(), ["m.mtlx"]);
}

#[test]
fn bad_tables_and_names_are_told_with_place_and_way_out() {
    let head = "observation_deg,entrance_deg,value,unit";
    let cases: &[(&str, &str, i32, &str)] = &[
        ("--geometry -", "", 1, "<stdin>: is empty"),
        ("--geometry -", "a\n1\n", 1, "<stdin>: missing columns observation_deg, entrance_deg"),
        (
            "--geometry -",
            "H\n0.2,95,1,cd/lx/m2\n",
            1,
            "<stdin>:2: column entrance_deg: 95 is outside (-90, 90)",
        ),
        (
            "--geometry -",
            "H\nx,5,1,cd/lx/m2\n",
            1,
            "<stdin>:2: column observation_deg: \"x\" is not a number",
        ),
        ("--geometry -", "H\n0.2,5,1,lx\n", 1, "<stdin>:2: column unit: \"lx\" is not a known unit"),
        ("--geometry no.csv", "", 1, "no.csv: can't be read"),
        ("--standard -", "H\n0.2,5,250000,cd/lx/m2\n", 1, "is not plausible"),
        (
            "--standard fmvss108:dot-c9",
            "",
            1,
            "names no class of a standard; there are fmvss108:dot-c2:white",
        ),
        ("--standard fmvss109", "", 1, "there are astm-d4956, fdot-994, fmvss108"),
        ("--verdict --colour pink", "", 2, "--colour pink: no class has it; known are amber, blue"),
        ("--verdict --standard 3m-8830", "", 1, "none of these has limits"),
        ("--area-m2 0", "", 2, "--area-m2 must be above 0"),
        ("--material x", "", 1, "\"x\""),
    ];
    for (args, stdin, code, message) in cases {
        let stdin = stdin.replacen("H\n", &format!("{head}\n"), 1);
        let outcome = bench().catseye(&format!("measure m.mtlx {args}"), &stdin);
        assert_eq!((outcome.code, outcome.stdout.as_str()), (*code, ""), "{args}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{args}: {}\nwanted {message}", outcome.stderr);
        assert_eq!(outcome.stderr.lines().count(), 1, "{}", outcome.stderr);
    }
}

#[test]
fn every_class_is_listed_with_its_source() {
    let outcome = Bench::new().catseye("standards", "");
    assert_eq!(outcome.stdout, Bench::new().catseye("standards list", "").stdout);
    for id in ["fmvss108:dot-c4:red", "16cfr1512:bicycle:clear", "en1436:r5:white", "3m:8765:white"] {
        assert!(outcome.stdout.contains(&format!("  {id} ")), "{id}");
    }
    let json = Bench::new().catseye("standards list --json", "").stdout;
    let classes: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(classes.as_array().unwrap().len(), 54);
    assert_eq!(classes[0]["id"], "astm-d4956:i:white");
    assert!(!classes[0]["sources"][0].as_str().unwrap().is_empty());
    let rows = Bench::new().catseye("standards show en1436:r3 --json", "").stdout;
    let rows: serde_json::Value = serde_json::from_str(&rows).unwrap();
    assert_eq!((rows[0]["value"].as_f64(), rows[0]["unit"].as_str()), (Some(150.0), Some("mcd/lx/m2")));
}

#[test]
fn roughness_and_half_power_angle_lead_to_each_other() {
    let facts = |args: &str| -> serde_json::Value {
        let outcome = Bench::new().catseye(&format!("roughness {args} --json"), "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
        serde_json::from_str(&outcome.stdout).unwrap()
    };
    let there = facts("--half-power-deg 0.5 --ra 250");
    let roughness = there["roughness"].as_f64().unwrap();
    let back = facts(&format!("--roughness {roughness} --tint {}", there["tint"]));
    assert!((back["half_power_angle_deg"].as_f64().unwrap() - 0.5).abs() < 1e-12);
    assert!((back["peak_r_a"].as_f64().unwrap() - 250.0).abs() < 1e-9);
    assert_eq!(facts("--roughness inf")["roughness"], "inf");
    let cases = [
        ("--half-power-deg 50", 1, "is 50, outside (0, 44.2] degrees"),
        ("--half-power-deg 0", 1, "the half-power angle is 0"),
        ("--roughness 0", 1, "perfect retro-reflector"),
        ("--roughness=-1", 1, "the roughness is -1"),
        ("--half-power-deg 30 --ra 250", 1, "no lobe this wide has R_A = 250"),
        ("--roughness 1 --tint 2", 2, "--tint 2 is outside [0, 1]"),
        ("--roughness 1 --half-power-deg 1", 2, "cannot be used with"),
    ];
    for (args, code, message) in cases {
        let outcome = Bench::new().catseye(&format!("roughness {args}"), "");
        assert_eq!((outcome.code, outcome.stdout.as_str()), (code, ""), "{args}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{args}: {}", outcome.stderr);
    }
}

#[test]
fn the_instrument_measures_what_the_bsdf_says() {
    let bench = Bench::new();
    // A lobe with a half-power angle of 1.35 degrees: apertures of 0.1 degrees blur it by less than 0.3 %.
    bench.write("m.mtlx", &document("0.02"));
    let run = |args: &str| {
        let table = "observation_deg,entrance_deg,rotation_deg,unit\n\
                     0.2,-4,0,cd/lx/m2\n0.33,30,90,cd/lx/m2\n1,40,0,1/sr\n2,-4,0,mcd/lx/m2\n";
        let outcome = bench.catseye(&format!("measure m.mtlx --geometry - {args}"), table);
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
        outcome.stdout
    };
    let closed = column(&run(""), "model");
    let text = run("--instrument --samples 16384");
    let (traced, errors) = (column(&text, "model"), column(&text, "standard_error"));
    for ((traced, closed), error) in traced.iter().zip(closed).zip(errors) {
        assert!((traced / closed - 1.0).abs() < 0.01, "{traced} {closed}");
        assert!(error > 0.0 && error < 3e-3 * traced, "{error} {traced}");
    }
    let rows: serde_json::Value = serde_json::from_str(&run("--instrument --samples 64 --json")).unwrap();
    assert!(rows[2]["model"].is_f64() && rows[2]["standard_error"].is_f64(), "{rows}");
}

#[test]
fn the_instrument_says_what_it_can_not_measure() {
    let run =
        |args: &str, stdin: &str| bench().catseye(&format!("measure m.mtlx --instrument {args}"), stdin);
    let integral = run("--geometry -", "observation_deg,entrance_deg,quantity,unit\n1,5,Q_d,mcd/lx/m2\n");
    assert!(
        integral.code == 1 && integral.stderr.contains("<stdin>:2: Q_d is an integral"),
        "{}",
        integral.stderr
    );
    let whole = run("--geometry -", "observation_deg,entrance_deg,unit\n1,5,cd/lx\n");
    assert!(whole.code == 1 && whole.stderr.contains("--area-m2"), "{}", whole.stderr);
    assert_eq!(run("--samples 0", "").code, 2);
    assert_eq!(run("--verdict", "").code, 2);
}

#[test]
fn open_material_files_are_written_and_read_back() {
    let bench = bench();
    let args = "openmaterial m.mtlx -o out.xomp --tint 905=0.3 --tint 1550=0.1";
    let outcome = bench.catseye(args, "");
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    assert_eq!(bench.files(), ["m.mtlx", "out.xomp", "out_brdf.xompt"]);
    let document = |name: &str| -> serde_json::Value {
        serde_json::from_str(&std::fs::read_to_string(bench.path(name)).unwrap()).unwrap()
    };
    let properties = &document("out.xomp")["materialProperties"];
    let data = &properties["retroreflectivityData"];
    let measured = column(&measured("--geometry -", "observation_deg,entrance_deg\n0.2,-4\n"), "model");
    let written = data["coefficientOfRetroreflection"].as_f64().unwrap();
    assert!((written / measured[0] - 1.0).abs() < 1e-12, "{written} {measured:?}");
    assert!(data["sources"].as_str().unwrap().contains("0.2 deg observation and -4 deg entrance"));
    assert_eq!(properties["brdfUris"], serde_json::json!(["out_brdf.xompt"]));
    let wavelengths = &document("out_brdf.xompt")["brdf"]["wavelengths"];
    assert_eq!(wavelengths, &serde_json::json!([5.55e-7, 9.05e-7, 1.55e-6]));

    let fitted = bench.catseye("fit out.xomp -o back.mtlx", "");
    assert_eq!(fitted.code, 0, "{}{}", fitted.stdout, fitted.stderr);
    let one = "observation_deg,entrance_deg\n0.2,-4\n";
    let back = column(&bench.catseye("measure back.mtlx --geometry -", one).stdout, "model");
    assert!((back[0] / written - 1.0).abs() < 0.01, "{back:?} {written}");
}

#[test]
fn bad_wishes_for_open_material_leave_no_file() {
    for (args, problem) in [
        ("-o out.json", "must end in .xomp"),
        ("-o out.xomp --tint 905", "905=0.3"),
        ("-o out.xomp --tint 905=0.1 --tint 905=0.2", "twice"),
        ("-o out.xomp --tint 905=-1", "must be 0 or above"),
        ("-o out.xomp --observation-deg 0", "must be above 0"),
        ("-o out.xomp --entrance-deg 95", "above the surface"),
    ] {
        let bench = bench();
        let outcome = bench.catseye(&format!("openmaterial m.mtlx {args}"), "");
        assert!(outcome.code > 0 && outcome.stderr.contains(problem), "{args}: {}", outcome.stderr);
        assert_eq!(bench.files(), ["m.mtlx"], "{args}");
    }
}
