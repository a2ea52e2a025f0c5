//! Promise: the outputs of a document are what they are connected to, whatever its range, at each point.

use catseye_materialx::{Document, ShadingPoint, pattern_categories};

const NODES: &str = r#"
<texcoord name="uv" type="vector2" />
<multiply name="scaled" type="vector2"><input name="in1" type="vector2" nodename="uv" /><input name="in2" type="float" value="-3" /></multiply>
<separate2 name="parts" type="multioutput"><input name="in" type="vector2" nodename="scaled" /></separate2>
<oren_nayar_diffuse_bsdf name="bsdf" type="BSDF" />"#;

fn document(outputs: &str) -> Document {
    let text = format!(r#"<materialx version="1.39">{NODES}{outputs}</materialx>"#);
    Document::parse(&text, "test.mtlx").unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn an_output_is_a_pattern_of_its_own() {
    let outputs = document(
        r#"<output name="both" type="vector2" nodename="scaled" />
<output name="second" type="float" nodename="parts" output="outy" />"#,
    );
    let outputs = outputs.outputs().unwrap();
    let point = ShadingPoint { texcoord: [0.5, 2.0], ..ShadingPoint::default() };
    let found: Vec<_> = outputs.iter().map(|output| (output.name(), output.at(&point))).collect();
    assert_eq!(found, [("both", [-1.5, -6.0, 0.0, 0.0]), ("second", [-6.0, 0.0, 0.0, 0.0])]);
}

#[test]
fn an_output_without_numbers_is_refused() {
    for (output, message) in [
        (r#"<output name="o" type="float" nodename="nothing" />"#, "nothing"),
        (r#"<output name="o" type="float" />"#, "nodename"),
        (r#"<output name="o" type="BSDF" nodename="bsdf" />"#, "one to four numbers"),
        (r#"<output name="o" type="color3" nodename="uv" />"#, "color3"),
    ] {
        let error = document(output).outputs().unwrap_err().to_string();
        assert!(error.starts_with("test.mtlx:5:52: output \"o\"") && error.contains(message), "{error}");
    }
}

#[test]
fn categories_are_named_once() {
    let mut categories: Vec<_> = pattern_categories().collect();
    let count = categories.len();
    categories.sort_unstable();
    categories.dedup();
    assert_eq!(categories.len(), count);
    assert!(count >= 110, "{count}");
}
