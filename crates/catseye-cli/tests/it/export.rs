//! `catseye export` writes what other programs read, says how far it is off, and refuses what they can't
//! have.

use crate::run::{Bench, column};

/// A material of the nodes below, whose output is `out`.
fn material(nodes: &str, surface: &str) -> String {
    format!(
        r#"<materialx version="1.39" colorspace="lin_rec709">
          <retro_reflective_bsdf name="beads" type="BSDF">
            <input name="roughness_u" type="float" value="0.006" />
            <input name="tint" type="color3" value="0.06, 0.05, 0.02" />
          </retro_reflective_bsdf>
          {nodes}
          <surface name="skin" type="surfaceshader">
            <input name="bsdf" type="BSDF" nodename="out" />
            {surface}
          </surface>
          <surfacematerial name="m" type="material">
            <input name="surfaceshader" type="surfaceshader" nodename="skin" />
          </surfacematerial>
        </materialx>"#
    )
}

/// The sum of the beads and another BSDF.
fn beside(node: &str) -> String {
    format!(
        r#"{node}
        <add name="out" type="BSDF">
          <input name="in1" type="BSDF" nodename="beads" /><input name="in2" type="BSDF" nodename="other" />
        </add>"#
    )
}

#[test]
fn a_table_of_a_material_is_fitted_as_that_material() {
    let bench = Bench::with_materials();
    let name = "materials/tape_fmvss108_c2_white.mtlx";
    let outcome = bench.catseye(&format!("export csv {name} -o t.csv"), "");
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    let written = std::fs::read_to_string(bench.path("t.csv")).unwrap();
    let measured = column(&bench.catseye(&format!("measure {name}"), "").stdout, "model");
    assert_eq!(column(&written, "value"), measured, "the same angles and values as measure's");
    let angles = "--observations 0.2,1 --entrances -4,10,60";
    let chosen = bench.catseye(&format!("export csv {name} {angles} -o -"), "").stdout;
    assert_eq!(column(&chosen, "entrance_deg"), [-4.0, 10.0, 60.0, -4.0, 10.0, 60.0]);
    bench.write("few.csv", &chosen);
    let again = bench.catseye("export csv few.csv --observations 0.2,1 --entrances -4,10,60 -o - --json", "");
    let facts: serde_json::Value = serde_json::from_str(&again.stderr).unwrap();
    let worst = facts["deviations"][0]["worst"].as_f64().unwrap();
    assert_eq!(facts["deviations"][0]["against"], "table");
    let errors =
        column(&again.stdout, "value").into_iter().zip(column(&chosen, "value")).map(|(a, b)| a / b - 1.0);
    let greatest =
        errors.fold(0.0, |worst: f64, error| if error.abs() > worst.abs() { error } else { worst });
    assert!((worst - greatest).abs() < 1e-9 && worst.abs() < 0.05, "{worst} {greatest}");
}

#[test]
fn a_wide_lobe_is_shown_whole() {
    let bench = Bench::with_materials();
    let wide = bench.catseye("export csv materials/retro_roughness_015.mtlx -o -", "").stdout;
    let (angles, values) = (column(&wide, "observation_deg"), column(&wide, "value"));
    assert!(angles[0] > 1.0 && values[values.len() - 5] < 0.05 * values[0], "{wide}");
}

#[test]
fn parts_that_radiance_has_no_room_for_are_named() {
    let bench = Bench::with_materials();
    let input = |name: &str, kind: &str, value: &str| {
        format!(r#"<input name="{name}" type="{kind}" value="{value}" />"#)
    };
    let out = |extra: &str| {
        format!(
            r#"<retro_reflective_bsdf name="out" type="BSDF">{}{extra}</retro_reflective_bsdf>"#,
            input("roughness_u", "float", "0.006")
        )
    };
    // A clear coat is carried; a coloured one is not.
    let coat = r#"<dielectric_bsdf name="coat" type="BSDF">
          <input name="tint" type="color3" value="1, 0, 0" />
        </dielectric_bsdf>
        <layer name="out" type="BSDF">
          <input name="top" type="BSDF" nodename="coat" /><input name="base" type="BSDF" nodename="beads" />
        </layer>"#;
    let varying = format!(
        r#"<facingratio name="f" type="float" />
        <smoothstep name="v" type="float"><input name="in" type="float" nodename="f" /></smoothstep>{}"#,
        out(r#"<input name="weight" type="float" nodename="v" />"#)
    );
    let wide = out(&input("multiscatter_tint", "color3", "1, 1, 1")).replace("0.006", "0.2");
    let checks = r#"<checkerboard name="v" type="color3" />
        <retro_reflective_bsdf name="out" type="BSDF"><input name="roughness_u" type="float" value="0.006" />
        <input name="tint" type="color3" nodename="v" /></retro_reflective_bsdf>"#;
    for (nodes, surface, part) in [
        (coat.to_owned(), String::new(), "has a coat"),
        (beside(r#"<conductor_bsdf name="other" type="BSDF" />"#), String::new(), "has a conductor_bsdf"),
        (beside(r#"<sheen_bsdf name="other" type="BSDF" />"#), String::new(), "has a sheen_bsdf"),
        (out(""), input("opacity", "float", "0.5"), "has an opacity below 1"),
        (out(&input("roughness_v", "float", "0.01")), String::new(), "has two roughnesses"),
        (wide, String::new(), "multiscatter_tint"),
        (varying, String::new(), "depends on the viewer's direction"),
        (checks.to_owned(), String::new(), "varies over the surface"),
    ] {
        bench.write("m.mtlx", &material(&nodes, &surface));
        let outcome = bench.catseye("export radiance m.mtlx -o m.rad", "");
        assert_eq!((outcome.code, outcome.stderr.lines().count()), (1, 1), "{part}: {}", outcome.stderr);
        assert!(outcome.stderr.starts_with("catseye: m.mtlx: "), "{part}: {}", outcome.stderr);
        assert!(
            outcome.stderr.contains(part) && outcome.stderr.contains("export"),
            "{part}: {}",
            outcome.stderr
        );
        assert_eq!(bench.files(), ["m.mtlx", "materials"], "{part}");
    }
}

#[test]
fn wrong_wishes_are_refused_in_a_line() {
    let bench = Bench::with_materials();
    for (args, code, problem) in [
        (
            "radiance materials/matte_white.mtlx -o m.rad",
            1,
            "no retro-reflective lobe; there is nothing to export",
        ),
        ("radiance materials/sheeting.mtlx -o m.cal", 2, "m.cal: the name must end in .rad"),
        ("radiance materials/sheeting.mtlx -o -", 2, "the name must end in .rad"),
        ("csv materials/sheeting.mtlx -o m.txt", 2, "the name must end in .csv"),
        (
            "openmaterial materials/sheeting.mtlx -o m.xomp --entrances 5",
            2,
            "no options of the target openmaterial",
        ),
        ("csv materials/sheeting.mtlx -o m.csv --tint 905=0.3", 2, "options of the target openmaterial only"),
        ("csv materials/sheeting.mtlx -o m.csv --entrances 95", 1, "entrance_deg"),
        ("csv nothing.mtlx -o m.csv", 1, "nothing.mtlx"),
        ("csv materials/sheeting.mtlx --luminance-factor 0.3 -o m.csv", 2, "options of tables"),
        ("csv astm-d4956:iii -o m.csv", 1, "say which one"),
    ] {
        let outcome = bench.catseye(&format!("export {args}"), "");
        assert_eq!(outcome.code, code, "{args}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(problem), "{args}: {}", outcome.stderr);
        assert_eq!(bench.files(), ["materials"], "{args}");
    }
    let unknown = bench.catseye("export unity materials/sheeting.mtlx -o m.mat", "");
    assert_eq!(unknown.code, 2);
    for target in ["csv", "radiance", "openmaterial"] {
        assert!(unknown.stderr.contains(target), "{}", unknown.stderr);
    }
}

/// A lobe narrower than three.js renders is given the least roughness that it does, and the error that goes
/// with it.
#[test]
fn what_an_engine_can_t_reach_is_in_its_error() {
    let bench = Bench::new();
    bench.write(
        "m.mtlx",
        &material("", "").replace("nodename=\"out\"", "nodename=\"beads\"").replace("0.006", "0.002"),
    );
    let worst = |target: &str, file: &str| {
        let outcome = bench.catseye(&format!("export {target} m.mtlx --entrances -4,5 -o {file} --json"), "");
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
        let facts: serde_json::Value = serde_json::from_str(&outcome.stdout).unwrap();
        let number = |value: &serde_json::Value| value.as_f64().unwrap();
        (number(&facts["parameters"]["roughness"]), number(&facts["deviations"][0]["worst"]).abs())
    };
    let ((free, near), (least, far)) = (worst("gltf", "m.gltf"), worst("three", "m.js"));
    assert!(free < 0.045 && near < 0.3, "{free} {near}");
    assert!((least - 0.045).abs() < 1e-9 && far > near, "{least} {far} {near}");
    // The closed form: strength / (4 pi alpha^2) head on.
    let strength = |text: &str| {
        text.split("specularIntensity: ").nth(1).unwrap().split(',').next().unwrap().parse::<f64>()
    };
    let strength = strength(&std::fs::read_to_string(bench.path("m.js")).unwrap()).unwrap();
    assert!(strength > 0.0 && strength <= 1.0, "{strength}");
}

#[test]
fn a_lobe_of_two_widths_is_refused_where_there_is_one() {
    let bench = Bench::with_materials();
    let files = [("gltf", "m.gltf"), ("three", "m.js"), ("openpbr", "m.mtlx"), ("radiance", "m.rad")];
    for (target, file) in files {
        let outcome =
            bench.catseye(&format!("export {target} materials/anisotropic_tape.mtlx -o {file}"), "");
        assert_eq!((outcome.code, outcome.stderr.lines().count()), (1, 1), "{target}: {}", outcome.stderr);
        assert!(outcome.stderr.contains("export it to csv"), "{target}: {}", outcome.stderr);
    }
    let csv = bench.catseye("export csv materials/anisotropic_tape.mtlx -o t.csv", "");
    assert!(
        csv.code == 0 && csv.stderr.contains("warning") && csv.stderr.contains("rotation"),
        "{}",
        csv.stderr
    );
}

/// One coefficient has no width: that of the material that is assumed for it is exported.
#[test]
fn a_table_without_a_width_is_exported_as_what_was_fitted() {
    let bench = Bench::with_materials();
    assert_eq!(bench.catseye("export openmaterial materials/vest_iso20471.mtlx -o v.xomp", "").code, 0);
    let outcome = bench.catseye("export gltf v.xomp -o v.gltf", "");
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("against the table: worst"), "{}", outcome.stdout);
}

/// A coat, a rough base and the compensation of a narrow lobe are in Radiance's material, or in what is said
/// of it.
#[test]
fn radiance_is_told_of_the_whole_sheeting() {
    let bench = Bench::with_materials();
    for (name, notes) in [("sheeting", 1), ("retro_sheeting", 2), ("tape_fmvss108_c2_white", 0)] {
        let outcome = bench.catseye(&format!("export radiance materials/{name}.mtlx -o m.rad --json"), "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{name}");
        let facts: serde_json::Value = serde_json::from_str(&outcome.stdout).unwrap();
        assert_eq!(facts["parameters"]["left_out"].as_array().unwrap().len(), notes, "{name}: {facts}");
        let text = std::fs::read_to_string(bench.path("m.rad")).unwrap();
        assert_eq!(text.contains("brightfunc"), notes > 0, "{text}");
        for entry in facts["deviations"].as_array().unwrap() {
            assert!(entry["worst"].as_f64().unwrap().abs() < 2e-3, "{name}: {entry}");
        }
    }
    for target in ["gltf", "three", "openpbr", "materialx-back-vector"] {
        let outcome = bench.catseye(&format!("export {target} materials/sheeting.mtlx -o -"), "");
        assert_eq!((outcome.code, outcome.stderr.contains("has a coat")), (1, true), "{}", outcome.stderr);
    }
}
