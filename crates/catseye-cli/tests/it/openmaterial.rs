//! `catseye export openmaterial` writes files that `fit` reads back as the same material.

use crate::run::column;
use crate::sheeting::{bench, measured};

#[test]
fn open_material_files_are_written_and_read_back() {
    let bench = bench();
    let args = "export openmaterial m.mtlx -o out.xomp --tint 905=0.3 --tint 1550=0.1";
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
        ("-o out.xomp --tint 905=-1", "from 0 to 1"),
        ("-o out.xomp --observation-deg 0", "must be above 0"),
        ("-o out.xomp --entrance-deg 95", "above the surface"),
    ] {
        let bench = bench();
        let outcome = bench.catseye(&format!("export openmaterial m.mtlx {args}"), "");
        assert!(outcome.code > 0 && outcome.stderr.contains(problem), "{args}: {}", outcome.stderr);
        assert_eq!(bench.files(), ["m.mtlx"], "{args}");
    }
}
