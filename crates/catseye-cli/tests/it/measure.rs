//! `catseye measure` answers each row with what the library says of the material, in the row's unit.

use std::fs;

use catseye::{Lobe as _, Params, Reciprocal};
use catseye_photometry::{Geometry, Goniometer, Quantity, RoadMarking};

use crate::run::{Bench, column};
use crate::sheeting::{bench, document, measured};

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
fn verdicts_say_where_a_class_is_missed_and_by_how_much() {
    let text = measured("--verdict", "");
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines.iter().any(|line| line.starts_with("meets ASTM D4956 Type I white")), "{text}");
    assert!(
        lines.iter().any(|line| line.starts_with("fails ISO 20471") && line.contains(" at 1.5 degree")),
        "{text}"
    );
    assert!(!text.contains("3M "), "products are no classes: {text}");
    let asked = bench().catseye("measure m.mtlx --verdict --standard 3m:dg3:white", "");
    assert!(asked.code == 1 && asked.stdout.starts_with("fails 3M DG3 white"), "{}", asked.stdout);
    let first_failed = lines.iter().position(|line| line.starts_with("fails ")).unwrap();
    assert!(lines[first_failed..].iter().all(|line| line.starts_with("fails ")), "{text}");
    let facts: serde_json::Value = serde_json::from_str(&measured("--verdict --json", "")).unwrap();
    assert_eq!(facts.as_array().unwrap().len(), lines.len());
    assert_eq!(facts[0]["text"], lines[0]);
    assert!(facts.as_array().unwrap().iter().all(|one| one["kind"] == "sheeting"), "{text}");
    assert!(facts[0]["not_judged"].as_array().unwrap().iter().any(|what| what == "colour"));
}

/// A script asks one question and reads the exit code.
#[test]
fn a_verdict_of_a_standard_is_a_gate() {
    let bench = bench();
    bench.write("own.csv", "observation_deg,entrance_deg,value,unit,limit\n0.2,5,LIMIT,cd/lx/m2,minimum\n");
    let found = column(&measured("--geometry -", "observation_deg,entrance_deg\n0.2,5\n"), "model")[0];
    // Limit over what the material has, option, exit code, and how the line begins.
    let cases = [
        (0.5, "", 0, "meets own.csv in R_A, nearest at 0.2 degree"),
        (1.00005, "", 0, "meets own.csv"),
        (1.001, "", 1, "fails own.csv at 0.2 degree"),
        (0.98, "", 0, "meets own.csv"),
        (0.98, "--guard 3%", 1, "within the guard band of own.csv in R_A, at 0.2 degree"),
        (0.98, "--guard 3 --json", 1, "[\n"),
        (0.98, "--guard 2", 0, "meets own.csv"),
        (1.02, "--guard 3%", 1, "fails own.csv"),
    ];
    for (share, options, code, start) in cases {
        let limit = format!("{:?}", share * found);
        bench.write(
            "own.csv",
            &format!("observation_deg,entrance_deg,value,unit,limit\n0.2,5,{limit},cd/lx/m2,minimum\n"),
        );
        let command = format!("measure m.mtlx --verdict --standard own.csv {options}");
        let outcome = bench.catseye(&command, "");
        assert_eq!(outcome.code, code, "{share} {options}: {}{}", outcome.stdout, outcome.stderr);
        assert!(outcome.stdout.starts_with(start), "{share} {options}: {}", outcome.stdout);
        let said = "catseye: m.mtlx: 1 of 1 classes asked for not met\n";
        assert_eq!(outcome.stderr, if code == 1 { said } else { "" });
    }
    let several = bench.catseye("measure m.mtlx --verdict --standard astm-d4956 --colour white -o v.txt", "");
    assert_eq!(several.code, 1);
    assert!(several.stderr.contains("of 3 classes asked for not met"), "{}", several.stderr);
    assert_eq!(fs::read_to_string(bench.path("v.txt")).unwrap().lines().count(), 3, "written all the same");
    for options in ["--verdict --guard=-1", "--verdict --guard nan", "--verdict --guard 101%", "--guard 3"] {
        let refused = bench.catseye(&format!("measure m.mtlx {options}"), "");
        assert_eq!((refused.code, refused.stdout.as_str()), (2, ""), "{options}");
    }
    let survey = bench.catseye("measure m.mtlx --verdict", "");
    assert_eq!(survey.code, 0, "a list of what is met and what is not asks for nothing");
}

/// `roughness --ra` makes the tint for a value; whatever the lobe's width, the class of that value is met.
#[test]
fn a_tint_that_was_made_for_a_limit_meets_it() {
    for (half_power, angle) in [("0.1", "0.2"), ("0.2", "0.2"), ("0.4", "0.2"), ("0.5", "0.33"), ("1", "1")] {
        let bench = Bench::new();
        let command = format!("roughness --half-power-deg {half_power} --ra 100 --at-deg {angle} --json");
        let lobe: serde_json::Value = serde_json::from_str(&bench.catseye(&command, "").stdout).unwrap();
        let (roughness, tint) = (&lobe["roughness"], &lobe["tint"]);
        let text =
            document(&roughness.to_string()).replace("0.06, 0.05, 0.02", &format!("{tint}, {tint}, {tint}"));
        bench.write("m.mtlx", &text);
        bench.write(
            "own.csv",
            &format!("observation_deg,entrance_deg,value,unit,limit\n{angle},0,100,cd/lx/m2,minimum\n"),
        );
        let outcome = bench.catseye("measure m.mtlx --verdict --standard own.csv", "");
        assert_eq!(outcome.code, 0, "{half_power}: {}{}", outcome.stdout, outcome.stderr);
    }
}

#[test]
fn a_material_is_judged_by_classes_of_its_kind() {
    let bench = bench();
    let kinds = |options: &str| -> Vec<String> {
        let outcome = bench.catseye(&format!("measure m.mtlx --verdict --json {options}"), "");
        let facts: serde_json::Value = serde_json::from_str(&outcome.stdout).unwrap();
        let mut kinds: Vec<String> =
            facts.as_array().unwrap().iter().map(|one| one["kind"].as_str().unwrap().to_owned()).collect();
        kinds.dedup();
        kinds
    };
    for (options, kind) in [
        ("", "sheeting"),
        ("--kind marking", "marking"),
        ("--area-m2 0.002", "reflector"),
        ("--area-m2 0.002 --kind sheeting", "sheeting"),
        ("--standard en1436", "marking"),
        ("--standard fmvss108 --area-m2 0.002", "reflector"),
        ("--standard astm-d4956 --area-m2 0.002", "sheeting"),
    ] {
        assert_eq!(kinds(options), [kind], "{options}");
    }
    let mixed = bench.catseye("measure m.mtlx --verdict --standard fmvss108", "");
    assert!(mixed.stderr.contains("classes of another kind than sheeting are left out"), "{}", mixed.stderr);
    assert!(!mixed.stdout.contains("reflex"), "{}", mixed.stdout);
    let whole = bench.catseye("measure m.mtlx --verdict --standard fmvss108:reflex", "");
    assert!(whole.code == 1 && whole.stderr.contains("R_I needs --area-m2"), "{}", whole.stderr);
    let wrong = bench.catseye("measure m.mtlx --verdict --standard en1436 --kind sheeting", "");
    assert!(wrong.code == 2 && wrong.stderr.contains("of the kind marking"), "{}", wrong.stderr);
    // What was asked for and can't be judged is not met.
    let product = bench.catseye("measure m.mtlx --verdict --standard 3m", "");
    assert_eq!(product.code, 1, "{}", product.stdout);
    assert!(product.stdout.contains("not judged: 3M"), "{}", product.stdout);
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
        ("--verdict --standard astm-d4956:iii --colour pink", "", 2, "known are"),
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

/// What is measured goes out as measured data, and comes back to the lobe that it was measured on.
#[test]
fn measured_data_are_written_as_they_are_read() {
    let bench = bench();
    let table = "obs;ent;beta_2\n0,1;-4;0\n0,2;-4;10\n0,4;-4;0\n0,2;30;0\n0,4;30;0\n0,5;20;0\n0,3;0;0\n";
    let written = bench.catseye("measure m.mtlx --geometry - --instrument --submission -o data.csv", table);
    assert_eq!((written.code, written.stderr.as_str()), (0, ""));
    let text = std::fs::read_to_string(bench.path("data.csv")).unwrap();
    let header = "observation_deg,entrance_deg,beta_2_deg,quantity,value,unit,uncertainty,\
                  source_aperture_deg,receiver_aperture_deg,limit,source";
    assert_eq!(text.lines().next(), Some(header));
    let again = bench.catseye("measure m.mtlx --geometry data.csv", "");
    assert_eq!((again.code, again.stderr.as_str()), (0, ""));
    let (value, model) = (column(&again.stdout, "value"), column(&again.stdout, "model"));
    let sigma = column(&again.stdout, "uncertainty");
    for ((value, model), sigma) in value.iter().zip(&model).zip(sigma) {
        // Four standard errors of the traced light, and what the specimen's size makes of 15 m.
        assert!((value - model).abs() < 4.0 * sigma + 0.01 * value, "{value} {model}");
    }
    let fit = bench.catseye("fit data.csv --lobes 1 --entrance none --tolerance 20 --json", "");
    let told: serde_json::Value = serde_json::from_str(&fit.stdout).unwrap();
    let roughness = told["numbers"][1]["value"].as_f64().unwrap();
    // The node's own lobe narrows where the fitted one keeps its width.
    assert!((roughness / 0.006 - 1.0).abs() < 0.1, "{told}");
    let plot = bench.catseye("plot ra m.mtlx --standard data.csv -o ra.svg", "");
    assert!(
        plot.code == 0 && plot.stderr.contains("1 values with a beta_2 or rotation angle"),
        "{}",
        plot.stderr
    );
}
