//! The CSV contract that tests, bindings and other people's checks rely on.

use catseye::{AnyLobe, Lobe as _, Model, Params, Vec3};

use crate::run::{Bench, cells, column, output};

const EVAL: &str = "roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z\n0.3,0.6,0,0.8,0.8,0,0.6\n";
const SAMPLE: &str = "roughness_u,wo_x,wo_y,wo_z,u1,u2,u3\n0.3,0.6,0,0.8,0.1,0.2,0.3\n";

fn lobe(params: Params<f64>) -> AnyLobe<f64> {
    AnyLobe::new(Model::Reciprocal, &params).unwrap()
}

#[test]
fn verbs_add_their_columns_after_the_inputs() {
    let added = |args, table: &str| {
        let input = table.lines().next().unwrap().to_owned() + ",";
        output(args, table).lines().next().unwrap().strip_prefix(&input).unwrap().to_owned()
    };
    assert_eq!(added("eval", EVAL), "f_r,f_g,f_b,pdf");
    assert_eq!(added("sample", SAMPLE), "wi_x,wi_y,wi_z,weight_r,weight_g,weight_b,pdf,lobe");
    assert_eq!(added("albedo", SAMPLE), "albedo_r,albedo_g,albedo_b");
}

#[test]
fn eval_prints_the_librarys_numbers_to_the_last_bit() {
    let text = output("eval", EVAL);
    let (wo, wi) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.8, 0.0, 0.6));
    let (f, pdf) = lobe(Params::isotropic(0.3)).eval_pdf(wo, wi);
    assert_eq!([column(&text, "f_r"), column(&text, "pdf")], [vec![f[0]], vec![pdf]]);
}

#[test]
fn f32_prints_the_digits_of_f32() {
    let text = output("eval --precision f32", EVAL);
    let lobe = AnyLobe::<f32>::new(Model::Reciprocal, &Params::isotropic(0.3)).unwrap();
    let f = lobe.eval(Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.8, 0.0, 0.6));
    assert_eq!(cells(&text)[1][7], format!("{:?}", f[0]));
}

#[test]
fn sample_prints_what_eval_confirms() {
    let table = "roughness_u,roughness_v,multiscatter_tint_g,wo_x,wo_y,wo_z,u1,u2,u3\n\
                 0.3,0.6,1,0.6,0,0.8,0.1,0.2,0.3\n0.3,0.6,1,0,0.6,0.8,0.7,0.999,0.9\n";
    let sampled = output("sample", table);
    let checked = output("eval", &sampled);
    for (a, b) in column(&sampled, "pdf").into_iter().zip(column(&checked, "pdf")) {
        assert!((a - b).abs() <= 1e-12 * b, "the density of the same direction: {a}, {b}");
    }
    let (pdf, cos) = (column(&sampled, "pdf"), column(&sampled, "wi_z"));
    for channel in ["r", "g", "b"] {
        let f = column(&checked, &format!("f_{channel}"));
        let weight = column(&sampled, &format!("weight_{channel}"));
        for row in 0..f.len() {
            let (a, b) = (weight[row] * pdf[row], f[row] * cos[row]);
            assert!(
                (a - b).abs() <= 1e-12 * b,
                "weight * pdf = f cos: {a}, {b}, channel {channel}, row {row}"
            );
        }
    }
}

#[test]
fn columns_may_stand_in_any_order() {
    let ordered = output("eval", EVAL);
    let turned = output("eval", "wi_z,wi_y,wi_x,wo_z,wo_y,wo_x,roughness_u\n0.6,0,0.8,0.8,0,0.6,0.3\n");
    assert_eq!(column(&ordered, "f_g"), column(&turned, "f_g"));
}

#[test]
fn unknown_columns_are_carried_through_unchanged() {
    let table = "note,roughness_u,\"a, b\",wo_x,wo_y,wo_z\n 1.50 ,1,\"say \"\"x\"\", ok\",0,0,1\n";
    let expected = "note,roughness_u,\"a, b\",wo_x,wo_y,wo_z,albedo_r,albedo_g,albedo_b\n \
                    1.50 ,1,\"say \"\"x\"\", ok\",0,0,1,0.35532333";
    assert!(output("albedo", table).starts_with(expected), "{}", output("albedo", table));
}

#[test]
fn an_added_column_replaces_one_of_its_name() {
    let table = "pdf,roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z\nold,0.3,0,0,1,0,0,1\n";
    let text = output("eval", table);
    assert_eq!(cells(&text)[0].join(","), "roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z,f_r,f_g,f_b,pdf");
    assert!(!text.contains("old"), "{text}");
}

#[test]
fn missing_and_empty_inputs_have_their_defaults() {
    let long = "roughness_u,roughness_v,tint_r,tint_g,tint_b,multiscatter_tint_r,multiscatter_tint_g,\
                multiscatter_tint_b,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z\n";
    let explicit = output("eval", &format!("{long}0.3,0.3,1,1,1,0,0,0,0.6,0,0.8,0.8,0,0.6\n"));
    let empty = output("eval", &format!("{long}0.3,, ,,,,,,0.6,0,0.8,0.8,0,0.6\n"));
    for name in ["f_r", "f_g", "f_b", "pdf"] {
        assert_eq!(column(&explicit, name), column(&output("eval", EVAL), name), "missing {name}");
        assert_eq!(column(&explicit, name), column(&empty, name), "empty {name}");
    }
}

#[test]
fn tints_act_on_their_channels() {
    let table = "roughness_u,tint_r,tint_b,multiscatter_tint_g,wo_x,wo_y,wo_z\n1,0.5,0,1,0,0,1\n";
    let text = output("albedo", table);
    let rho = 0.355_323_334_386_87;
    for (name, expected) in [("albedo_r", 0.5 * rho), ("albedo_g", 1.0), ("albedo_b", 0.0)] {
        let [value] = column(&text, name)[..] else { panic!("one row") };
        assert!((value - expected).abs() < 1e-9, "{name}: {value}, expected {expected}");
    }
}

#[test]
fn infinite_roughness_is_legal() {
    let text =
        output("eval", "roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z\ninf,0,0,1,0,0,1\nInf,0,0,1,0,0,1\n");
    let expected = 0.25 / std::f64::consts::PI;
    for f in column(&text, "f_r") {
        assert!((f - expected).abs() < 1e-15, "{f}, expected {expected}");
    }
}

#[test]
fn zero_roughness_is_a_dirac_lobe_and_the_horizon_a_border() {
    let text =
        output("sample", "roughness_u,wo_x,wo_y,wo_z,u1,u2,u3\n0,0.6,0,0.8,0,0,0\n1,0.6,0,-0.8,0,0,0\n");
    assert!(text.contains(",0.6,0.0,0.8,1.0,1.0,1.0,1.0,dirac\n"), "{text}");
    assert!(text.ends_with(",0.0,0.0,0.0,0.0,0.0,0.0,0.0,none\n"), "{text}");
}

#[test]
fn a_uniform_number_just_below_one_stays_below_in_f32() {
    let table = "roughness_u,wo_x,wo_y,wo_z,u1,u2,u3\n1,0,0,1,0.9999999999,0.9999999999,0.9999999999\n";
    let text = output("sample --precision f32", table);
    assert!(column(&text, "wi_z").iter().all(|z| z.is_finite() && *z >= 0.0), "{text}");
}

#[test]
fn line_ends_marks_and_empty_lines_don_t_matter() {
    let expected = output("eval", EVAL);
    assert_eq!(output("eval", &EVAL.replace('\n', "\r\n")), expected, "CRLF");
    assert_eq!(output("eval", &format!("\u{feff}{EVAL}")), expected, "byte order mark");
    assert_eq!(output("eval", EVAL.trim_end()), expected, "no end of line");
    assert_eq!(output("eval", &EVAL.replace('\n', "\n\n")), expected, "empty lines");
    assert_eq!(output("eval", &EVAL.replace(',', " , ")).replace(' ', ""), expected, "spaces");
}

#[test]
fn a_header_alone_gives_a_header() {
    let header = EVAL.lines().next().unwrap();
    assert_eq!(output("eval", header), format!("{header},f_r,f_g,f_b,pdf\n"));
    assert_eq!(output("eval --json", header), "[\n]\n");
}

#[test]
fn a_file_answers_as_standard_input_does() {
    let bench = Bench::new();
    bench.write("in.csv", EVAL);
    let direct = bench.catseye("eval in.csv", "");
    assert_eq!(direct.stdout, output("eval", EVAL));
    let filed = bench.catseye("eval in.csv -o out.csv", "");
    assert_eq!((filed.code, filed.stdout.as_str()), (0, ""));
    assert_eq!(std::fs::read_to_string(bench.path("out.csv")).unwrap(), direct.stdout);
    assert_eq!(bench.files(), ["in.csv", "out.csv"]);
}

#[test]
fn options_make_a_table_of_one_row() {
    let text = output("eval --roughness 0.3 --wo 0.6,0,0.8 --wi 0.8,0,0.6", "");
    assert_eq!(column(&text, "pdf"), column(&output("eval", EVAL), "pdf"));
    let text = output("sample --roughness 0.3,0.1 --wo=-0.6,0,0.8 --u 0.1,0.2,0.3 --tint 1,0,0", "");
    assert_eq!(column(&text, "weight_g"), [0.0]);
}

#[test]
fn json_holds_the_same_values() {
    let table = "name,roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z\n\"a \"\"b\"\"\",inf,0.6,0,0.8,0.8,0,0.6\n7,.3,0,0,1,0,0,1\n";
    let csv = output("eval", table);
    let rows: serde_json::Value = serde_json::from_str(&output("eval --json", table)).unwrap();
    assert_eq!(rows[0]["name"], "a \"b\"", "carried text");
    assert_eq!(rows[1]["name"], "7", "carried text that looks like a number");
    assert_eq!(rows[0]["roughness_u"], "inf", "JSON has no infinity");
    assert_eq!(rows[1]["roughness_u"], 0.3, "an input");
    // The first row has a comma and quotes only in its name, which is not looked at.
    assert!(csv.contains(&format!(",{}\n", rows[1]["pdf"])), "{csv} {rows}");
}

#[test]
fn row_order_survives_many_rows() {
    let mut table = String::from("id,roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z\n");
    for id in 0..40_000 {
        table.push_str(&format!("{id},0.{},0.6,0,0.8,0.8,0,0.6\n", id % 7 + 1));
    }
    let text = output("eval", &table);
    let ids: Vec<f64> = (0..40_000).map(f64::from).collect();
    assert_eq!(column(&text, "id"), ids);
    let f = column(&text, "f_r");
    assert!((0..40_000 - 7).all(|i| f[i] == f[i + 7]), "equal rows have equal answers");
}
