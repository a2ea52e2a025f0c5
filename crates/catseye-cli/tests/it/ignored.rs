//! Nothing that was given is ignored in silence: it is an error, or a warning says so.

use crate::run::{Bench, column};

const ROW: &str = "roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z\n0.15,0,0,1,0,0,1\n";

/// Standard output, and the warnings of a run that succeeds.
fn warned(args: &str, stdin: &str) -> (String, String) {
    let outcome = Bench::with_materials().catseye(args, stdin);
    assert_eq!(outcome.code, 0, "{args}: {}", outcome.stderr);
    (outcome.stdout, outcome.stderr)
}

#[test]
fn a_compensation_that_a_model_does_not_have() {
    for model in ["back-vector", "edwards"] {
        let args =
            format!("eval --model {model} --roughness 1 --multiscatter-tint 1,1,1 --wo 0,0,1 --wi 0,0,1");
        let expected = format!(
            "catseye: warning: command line: the model {model} has no compensation: multiscatter_tint is ignored\n"
        );
        assert_eq!(warned(&args, "").1, expected);
    }
    assert_eq!(warned("eval --roughness 1 --multiscatter-tint 1,1,1 --wo 0,0,1 --wi 0,0,1", "").1, "");
}

#[test]
fn a_column_that_is_all_but_an_input() {
    let table = |name: &str| ROW.replacen("wo_x", &format!("{name},wo_x"), 1).replacen("0,0,1", "1,0,0,1", 1);
    for (name, meant) in
        [("rougness_v", "roughness_v"), ("Tint_R_", "tint_r"), ("multiscatter_tint", "multiscatter_tint_r")]
    {
        let (text, warning) = warned("eval", &table(name));
        let expected =
            format!("catseye: warning: <stdin>:1: column {name:?} has no meaning; did you mean {meant}?\n");
        assert_eq!(warning, expected);
        assert!(text.contains(name), "it is carried through");
    }
    for name in ["note", "id", "u1", "t", "albedo_r", "weight_r"] {
        assert_eq!(warned("eval", &table(name)).1, "", "{name}");
    }
}

#[test]
fn capitals_in_a_header_mean_the_same() {
    let head = ROW.lines().next().unwrap();
    let loud = warned("eval", &ROW.replace(head, &head.to_uppercase())).0;
    assert_eq!(column(&loud, "f_r"), column(&warned("eval", ROW).0, "f_r"));
    let geometry =
        warned("measure materials/sheeting.mtlx --geometry -", "Observation_deg,ENTRANCE_DEG\n0.2,5\n").0;
    assert!(geometry.starts_with("observation_deg,entrance_deg,model\n0.2,5,"), "{geometry}");
}

#[test]
fn the_length_of_a_direction() {
    let f = |table: &str| column(&warned("eval", table).0, "f_r")[0];
    let long = f(&ROW.replace("0,0,1,0,0,1", "0,0,1.0009,0,0,0.9992"));
    assert!((long / f(ROW) - 1.0).abs() < 1e-12, "{long}");
}

#[test]
fn a_texture_under_a_photometer() {
    let bench = Bench::new();
    let document = r#"<materialx version="1.39" colorspace="lin_rec709">
      <checkerboard name="c" type="color3"><input name="color1" type="color3" value="0.1, 0.1, 0.1" /></checkerboard>
      <retro_reflective_bsdf name="b" type="BSDF">
        <input name="roughness_u" type="float" value="0.01" /><input name="tint" type="color3" nodename="c" />
      </retro_reflective_bsdf>
      <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b" /></surface>
      <surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s" /></surfacematerial>
    </materialx>"#;
    bench.write("m.mtlx", document);
    let expected = "catseye: warning: the material \"m\" varies over the surface: it is measured at the texture \
                    coordinates 0, 0\n";
    for args in ["measure m.mtlx", "plot ra m.mtlx", "export openmaterial m.mtlx -o m.xomp"] {
        let outcome = bench.catseye(args, "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, expected), "{args}");
        assert_eq!(bench.catseye(&format!("{args} --quiet"), "").stderr, "", "{args}");
    }
    let fitted = Bench::with_materials().catseye("measure materials/sheeting.mtlx", "");
    assert_eq!(fitted.stderr, "", "what varies with the direction only is the same everywhere");
}

#[test]
fn a_file_of_two_meanings_or_the_wrong_kind() {
    let bench = Bench::new();
    bench.write("s.csv", "observation_deg,entrance_deg,value\n0.2,5,250\n0.5,5,95\n");
    for (args, message) in [
        ("fit s.csv -o a.mtlx --report a.mtlx", "a.mtlx: the name must end in .html"),
        ("fit s.csv -o - --report -", "--output and --report are the same file"),
        ("fit s.csv -o x.csv", "x.csv: the name must end in .mtlx"),
        ("plot lobe -o x.png --format svg", "x.png: the name is not that of a file in the format svg"),
        ("render --format exr", "catseye.png: the name is not that of a file in the format exr"),
    ] {
        let outcome = bench.catseye(args, "");
        assert_eq!((outcome.code, outcome.stderr), (2, format!("catseye: {message}\n")), "{args}");
    }
    assert_eq!(bench.files(), ["s.csv"]);
}
