//! Promise: patterns compute what MaterialX says they do, and constants are folded away.

use std::{fs::File, path::Path, sync::Arc};

use catseye::Params;
use catseye_materialx::{Closure, Document, Library, Material, SearchPath, ShadingPoint};

use crate::support::{document, single};

fn parse(text: &str) -> Material {
    Document::parse(text, "test.mtlx")
        .and_then(|document| document.material(None))
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// A material whose diffuse colour is the node `p`.
fn colored(nodes: &str) -> Material {
    parse(&document(&format!(
        r#"<oren_nayar_diffuse_bsdf name="bsdf" type="BSDF"><input name="color" type="color3" nodename="p" /></oren_nayar_diffuse_bsdf>
{nodes}"#
    )))
}

fn color_of(bsdf: &Closure) -> [f32; 3] {
    match bsdf {
        Closure::OrenNayarDiffuse { color, .. } => *color,
        other => panic!("{other:?}"),
    }
}

/// The colour at texture coordinates (0.25, 0.5), position (1, 2, 3).
fn color(nodes: &str) -> [f32; 3] {
    let material = colored(nodes);
    let point = ShadingPoint {
        texcoord: [0.25, 0.5],
        position: [1.0, 2.0, 3.0],
        position_object: [1.0, 2.0, 3.0],
        ..ShadingPoint::default()
    };
    color_of(&material.at(&point).bsdf)
}

fn assert_near(actual: [f32; 3], expected: [f32; 3], case: &str) {
    for (a, e) in actual.into_iter().zip(expected) {
        assert!((a - e).abs() < 1e-5, "{case}: {actual:?}, {expected:?} expected");
    }
}

/// Name, type and value of an input; `@n` is a connection to the node `n`.
type Input = (&'static str, &'static str, &'static str);

/// One node `p` of type color3 with these inputs.
fn one(category: &str, inputs: &[Input]) -> String {
    let inputs: String = inputs
        .iter()
        .map(|(name, ty, value)| {
            let attribute = if value.starts_with('@') { "nodename" } else { "value" };
            format!(r#"<input name="{name}" type="{ty}" {attribute}="{}" />"#, value.trim_start_matches('@'))
        })
        .collect();
    format!(
        r#"<{category} name="p" type="color3">{inputs}</{category}>
        <texcoord name="uv" type="vector2" />
        <extract name="u" type="float"><input name="in" type="vector2" nodename="uv" /><input name="index" type="integer" value="0" /></extract>
        <convert name="uuu" type="color3"><input name="in" type="float" nodename="u" /></convert>"#
    )
}

#[test]
fn nodes_compute_what_they_are_named_for() {
    let c = "color3";
    let f = "float";
    let cases: &[(&str, &[Input], [f32; 3])] = &[
        ("constant", &[("value", c, "0.1, 0.2, 0.3")], [0.1, 0.2, 0.3]),
        ("add", &[("in1", c, "@uuu"), ("in2", f, "0.5")], [0.75; 3]),
        ("subtract", &[("in1", c, "1, 0.9, 0.8"), ("in2", c, "@uuu")], [0.75, 0.65, 0.55]),
        ("multiply", &[("in1", c, "@uuu"), ("in2", c, "1, 2, 3")], [0.25, 0.5, 0.75]),
        ("divide", &[("in1", c, "@uuu"), ("in2", f, "0.5")], [0.5; 3]),
        ("divide", &[("in1", c, "@uuu"), ("in2", f, "0")], [0.0; 3]),
        ("modulo", &[("in1", c, "0.7, 0.5, 0.3"), ("in2", c, "@uuu")], [0.2, 0.0, 0.05]),
        ("power", &[("in1", c, "@uuu"), ("in2", f, "0.5")], [0.5; 3]),
        ("min", &[("in1", c, "@uuu"), ("in2", c, "0.1, 0.3, 1")], [0.1, 0.25, 0.25]),
        ("max", &[("in1", c, "@uuu"), ("in2", f, "0.3")], [0.3; 3]),
        ("invert", &[("in", c, "@uuu")], [0.75; 3]),
        ("mix", &[("fg", c, "1, 1, 1"), ("bg", c, "0, 0, 0.5"), ("mix", f, "@u")], [0.25, 0.25, 0.625]),
        ("clamp", &[("in", c, "@uuu"), ("low", f, "0.3")], [0.3; 3]),
        ("smoothstep", &[("in", c, "@uuu"), ("high", f, "0.5")], [0.5; 3]),
        ("remap", &[("in", c, "@uuu"), ("outlow", f, "0.5"), ("outhigh", f, "1")], [0.625; 3]),
        ("contrast", &[("in", c, "@uuu"), ("amount", f, "0.5")], [0.375; 3]),
        (
            "ifgreater",
            &[("value1", f, "@u"), ("value2", f, "0.2"), ("in1", c, "1, 0, 0"), ("in2", c, "0, 1, 0")],
            [1.0, 0.0, 0.0],
        ),
        ("ramplr", &[("valuel", c, "0, 0, 0"), ("valuer", c, "1, 1, 0")], [0.25, 0.25, 0.0]),
        ("ramptb", &[("valuet", c, "1, 1, 1"), ("valueb", c, "0, 0, 0")], [0.5; 3]),
        (
            "ramp4",
            &[
                ("valuetl", c, "1, 0, 0"),
                ("valuetr", c, "0, 1, 0"),
                ("valuebl", c, "0, 0, 1"),
                ("valuebr", c, "0, 0, 0"),
            ],
            [0.375, 0.125, 0.375],
        ),
        ("splitlr", &[("valuel", c, "1, 0, 0"), ("valuer", c, "0, 1, 0")], [1.0, 0.0, 0.0]),
        ("hsvtorgb", &[("in", c, "0.333333333, 1, 1")], [0.0, 1.0, 0.0]),
        ("saturate", &[("in", c, "1, 0, 0"), ("amount", f, "0")], [0.272_228_7; 3]),
        ("switch", &[("in1", c, "1, 0, 0"), ("in2", c, "0, 1, 0"), ("which", f, "1")], [0.0, 1.0, 0.0]),
        ("range", &[("in", c, "@uuu"), ("inhigh", f, "0.5"), ("gamma", f, "2")], [0.5_f32.sqrt(); 3]),
        ("screen", &[("fg", c, "@uuu"), ("bg", c, "0.5, 0.5, 0.5")], [0.625; 3]),
        // Decided by the background.
        ("overlay", &[("fg", c, "@uuu"), ("bg", c, "0.5, 0.75, 0.25")], [0.25, 0.625, 0.125]),
        // 0 where there is no quotient, whatever the share.
        ("burn", &[("fg", c, "0, 0.5, 1"), ("bg", c, "0.5, 0.5, 0.5"), ("mix", f, "0.5")], [0.0, 0.25, 0.5]),
        ("dodge", &[("fg", c, "1, 0.5, 0"), ("bg", c, "0.2, 0.2, 0.2"), ("mix", f, "0.5")], [0.0, 0.3, 0.2]),
        // The first colour on odd cells.
        (
            "checkerboard",
            &[("color1", c, "1, 0, 0"), ("color2", c, "0, 1, 0"), ("uvtiling", "vector2", "4, 4")],
            [1.0, 0.0, 0.0],
        ),
        ("switch", &[("in1", c, "1, 0, 0"), ("in2", c, "0, 1, 0"), ("which", f, "-1")], [1.0, 0.0, 0.0]),
    ];
    for (category, inputs, expected) in cases {
        assert_near(color(&one(category, inputs)), *expected, category);
    }
}

#[test]
fn vectors_turn_and_combine() {
    let nodes = r#"<combine3 name="p" type="color3">
          <input name="in1" type="float" nodename="d" /><input name="in2" type="float" nodename="x" />
          <input name="in3" type="float" nodename="parts" output="outy" /></combine3>
        <dotproduct name="d" type="float"><input name="in1" type="vector3" value="0.1, 0.1, 0.1" />
          <input name="in2" type="vector3" nodename="at" /></dotproduct>
        <position name="at" type="vector3" />
        <rotate2d name="r" type="vector2"><input name="in" type="vector2" value="1, 0" /><input name="amount" type="float" value="-90" /></rotate2d>
        <extract name="x" type="float"><input name="in" type="vector2" nodename="r" /><input name="index" type="integer" value="1" /></extract>
        <separate3 name="parts" type="multioutput"><input name="in" type="vector3" nodename="n" /></separate3>
        <crossproduct name="n" type="vector3"><input name="in1" type="vector3" value="0, 0, 1" /><input name="in2" type="vector3" value="1, 0, 0" /></crossproduct>"#;
    assert_near(color(nodes), [0.6, 1.0, 1.0], "combine3");
}

/// What a node's float or vector3 is, each with a name: defaults, and what differs by type.
#[test]
fn values_of_other_types() {
    let cases = [
        // 1 - 2 (n . i) n with n = z is i itself.
        ("vector3", r#"<reflect name="q" type="vector3" />"#, [1.0, 0.0, 0.0]),
        ("vector3", r#"<transformnormal name="q" type="vector3" />"#, [0.0, 0.0, 1.0]),
        // A vector without a direction is none of a map's: the surface's own.
        (
            "vector3",
            r#"<normalmap name="q" type="vector3"><input name="in" type="vector3" value="0, 0, 0" /></normalmap>"#,
            [0.0, 0.0, 1.0],
        ),
        (
            "vector3",
            r#"<transformmatrix name="q" type="vector3"><input name="in" type="vector3" value="0.1, 0.2, 0.3" />
            <input name="mat" type="matrix44" value="1,0,0,0, 0,1,0,0, 0,0,1,0, 0.5,0.25,0.125,1" /></transformmatrix>"#,
            [0.6, 0.45, 0.425],
        ),
        // The comparison itself.
        ("boolean", r#"<ifgreater name="q" type="boolean" />"#, [1.0; 3]),
        // No geometry has properties.
        (
            "float",
            r#"<geompropvalue name="q" type="float"><input name="geomprop" type="string" value="height" /><input name="default" type="float" value="0.4" /></geompropvalue>"#,
            [0.4; 3],
        ),
        // The definition that a node names counts more than its category.
        (
            "float",
            r#"<ifgreater name="q" type="float" nodedef="ND_ifgreatereq_float"><input name="value2" type="float" value="1" /><input name="in1" type="float" value="0.75" /></ifgreater>"#,
            [0.75; 3],
        ),
        // A float is scaled by 4096 before it is hashed: cell 1024.
        (
            "float",
            r#"<absval name="q" type="float"><input name="in" type="float" nodename="d" /></absval>
            <subtract name="d" type="float"><input name="in1" type="float" nodename="r" /><input name="in2" type="float" nodename="c" /></subtract>
            <randomfloat name="r" type="float"><input name="in" type="float" value="0.25" /><input name="seed" type="integer" value="3" /></randomfloat>
            <cellnoise2d name="c" type="float"><input name="texcoord" type="vector2" value="1024, 3" /></cellnoise2d>"#,
            [0.0; 3],
        ),
        (
            "float",
            r#"<extract name="q" type="float"><input name="in" type="vector4" nodename="four" /><input name="index" type="integer" value="3" /></extract>
            <convert name="four" type="vector4"><input name="in" type="vector2" value="0.5, 0.5" /></convert>"#,
            [1.0; 3],
        ),
    ];
    for (ty, nodes, expected) in cases {
        let convert = format!(
            r#"<convert name="p" type="color3"><input name="in" type="{ty}" nodename="q" /></convert>{nodes}"#
        );
        assert_near(color(&convert), expected, nodes);
    }
}

#[test]
fn a_normal_map_turns_the_lobe_and_the_neutral_one_keeps_it() {
    for (value, expected) in [("0.5, 0.5, 1", [0.0, 0.0, 1.0]), ("1, 0.5, 0.5", [1.0, 0.0, 0.0])] {
        let map = format!(
            r#"<normalmap name="n" type="vector3"><input name="in" type="vector3" value="{value}" /></normalmap></materialx>"#
        );
        let input = r#"<input name="normal" type="vector3" nodename="n" />"#;
        let text = single("dielectric_bsdf", input).replace("</materialx>", &map);
        let Closure::Oriented { normal: Some(normal), .. } = parse(&text).surface.bsdf else { panic!() };
        assert_near(normal, expected, value);
    }
}

#[test]
fn what_does_not_vary_is_a_constant_and_out_of_range_results_are_clamped() {
    let material = colored(&one("multiply", &[("in1", "color3", "4, 0.5, -1"), ("in2", "float", "0.5")]));
    assert!(material.patterns.is_none());
    assert_eq!(color_of(&material.surface.bsdf), [1.0, 0.25, 0.0]);
    assert!(colored(&one("multiply", &[("in1", "color3", "@uuu")])).patterns.is_some());
}

#[test]
fn interfaces_of_nested_nodegraphs() {
    let nodes = r#"<nodegraph name="outer"><input name="tone" type="color3" value="0.2, 0.4, 0.6" />
          <nodegraph name="inner"><input name="half" type="color3" interfacename="tone" />
            <multiply name="m" type="color3"><input name="in1" type="color3" interfacename="half" /><input name="in2" type="float" value="0.5" /></multiply>
            <output name="out" type="color3" nodename="m" /></nodegraph>
          <add name="a" type="color3"><input name="in1" type="color3" nodegraph="inner" output="out" /><input name="in2" type="color3" interfacename="tone" /></add>
          <output name="out" type="color3" nodename="a" /></nodegraph>
        <oren_nayar_diffuse_bsdf name="bsdf" type="BSDF"><input name="color" type="color3" nodegraph="outer" output="out" /></oren_nayar_diffuse_bsdf>"#;
    assert_near(color_of(&parse(&document(nodes)).surface.bsdf), [0.3, 0.6, 0.9], "nested");
}

#[test]
fn a_document_can_define_nodes_of_its_own() {
    let nodes = r#"<nodedef name="ND_tinted" node="tinted"><input name="tint" type="color3" value="0.5, 0.5, 0.5" />
          <input name="strength" type="float" value="0.5" /><output name="out" type="BSDF" /></nodedef>
        <nodegraph name="NG_tinted" nodedef="ND_tinted">
          <multiply name="c" type="color3"><input name="in1" type="color3" interfacename="tint" /><input name="in2" type="float" interfacename="strength" /></multiply>
          <oren_nayar_diffuse_bsdf name="d" type="BSDF"><input name="color" type="color3" nodename="c" /></oren_nayar_diffuse_bsdf>
          <output name="out" type="BSDF" nodename="d" /></nodegraph>
        <tinted name="bsdf" type="BSDF"><input name="tint" type="color3" value="1, 0.5, 0" /></tinted>"#;
    assert_near(color_of(&parse(&document(nodes)).surface.bsdf), [0.5, 0.25, 0.0], "tinted");
}

#[test]
fn emission_opacity_and_looks() {
    let text = r#"<materialx version="1.39">
        <uniform_edf name="e" type="EDF"><input name="color" type="color3" value="2, 4, 6" /></uniform_edf>
        <multiply name="half" type="EDF"><input name="in1" type="EDF" nodename="e" /><input name="in2" type="float" value="0.5" /></multiply>
        <surface name="s" type="surfaceshader"><input name="edf" type="EDF" nodename="half" /><input name="opacity" type="float" nodename="o" /></surface>
        <constant name="o" type="float"><input name="value" type="float" value="0.25" /></constant>
        <surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s" /></surfacematerial>
        <look name="l"><materialassign name="a" material="m" geom="/car, /bike/*" /></look></materialx>"#;
    let document = Document::parse(text, "test.mtlx").unwrap();
    let material = document.material(None).unwrap();
    assert_eq!((material.surface.emission, material.surface.opacity), ([1.0, 2.0, 3.0], 0.25));
    let looks = document.looks().unwrap();
    assert_eq!(looks[0].material("/bike/wheel/rim"), Some("m"));
    assert_eq!(looks[0].material("/boat"), None);
}

/// A picture of one colour.
fn write_png(path: &Path, color: [u8; 3]) {
    let mut encoder = png::Encoder::new(File::create(path).expect("a new file"), 4, 4);
    encoder.set_color(png::ColorType::Rgb);
    let mut header = encoder.write_header().expect("a head");
    header.write_image_data(&color.repeat(16)).expect("pixels");
}

#[test]
fn pictures_are_looked_up_in_their_colour_space() {
    let folder = tempfile::tempdir().unwrap();
    write_png(&folder.path().join("flat.png"), [255, 188, 0]);
    let nodes = r#"<oren_nayar_diffuse_bsdf name="bsdf" type="BSDF"><input name="color" type="color3" nodename="p" /></oren_nayar_diffuse_bsdf>
        <image name="p" type="color3" fileprefix="./"><input name="file" type="filename" value="flat.png" colorspace="srgb_texture" /></image>"#;
    let path = folder.path().join("m.mtlx");
    std::fs::write(&path, document(nodes)).unwrap();
    let material = Document::load(&path).unwrap().material(None).unwrap();
    let here = material.patterns.unwrap().at(&ShadingPoint::default());
    let green = ((188.0_f32 / 255.0 + 0.055) / 1.055).powf(2.4);
    assert_near(color_of(&here.bsdf), [1.0, green, 0.0], "flat.png");
}

/// Retro-reflection of `retro_sheeting_surface`, the direction of its longer axis, and the base.
fn below_the_coat(bsdf: Closure) -> (Params<f32>, [f32; 3], [f32; 3]) {
    let Closure::Layer { base, .. } = bsdf else { panic!("{bsdf:?}") };
    let Closure::Add { a, b } = *base else { panic!("{base:?}") };
    let Closure::Oriented { closure, tangent: Some(axis), .. } = *a else { panic!("{a:?}") };
    let Closure::RetroReflective { params, .. } = *closure else { panic!("{closure:?}") };
    (params, axis, color_of(&b))
}

#[test]
fn retro_sheeting_surface_needs_no_search_path_and_takes_pictures() {
    let folder = tempfile::tempdir().unwrap();
    write_png(&folder.path().join("half.png"), [255, 128, 0]);
    let text = r#"<materialx version="1.39">
        <image name="c" type="color3"><input name="file" type="filename" value="half.png" /></image>
        <extract name="green" type="float"><input name="in" type="color3" nodename="c" /><input name="index" type="integer" value="1" /></extract>
        <retro_sheeting_surface name="s" type="surfaceshader"><input name="base_color" type="color3" nodename="c" />
          <input name="retro_color" type="color3" value="1, 0.5, 0.25" /><input name="retro_strength" type="float" nodename="green" />
          <input name="half_power_angle" type="float" value="2" /></retro_sheeting_surface>
        <surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s" /></surfacematerial></materialx>"#;
    let path = folder.path().join("m.mtlx");
    std::fs::write(&path, text).unwrap();
    let patterns = Document::load(&path).unwrap().material(None).unwrap().patterns.unwrap();
    let strength = 128.0_f32 / 255.0;
    let roughness = 2.0_f32.to_radians() / (2.0 * 2.0_f32.ln()).sqrt();
    // At 60 degrees the cosine's third power over the cosine, and twice the width.
    for (view, falloff, wider) in [([0.0, 0.0, -1.0], 1.0, 1.0), ([0.75_f32.sqrt(), 0.0, -0.5], 0.25, 2.0)] {
        let point = ShadingPoint { view, ..ShadingPoint::default() };
        let (params, _, base) = below_the_coat(patterns.at(&point).bsdf);
        let share = [1.0, 0.5, 0.25].map(|color| color * strength * falloff);
        assert_near(params.tint, share, "tint");
        assert_near(params.multiscatter_tint, share, "multiscatter_tint");
        assert_near(base, [1.0 - share[0], strength * (1.0 - share[1]), 0.0], "base");
        assert!((params.roughness_u / (wider * roughness) - 1.0).abs() < 3e-6, "{params:?}");
        assert!((params.roughness_v.unwrap() / roughness - 1.0).abs() < 3e-6, "{params:?}");
    }
}

/// The exponent of a narrow lobe at a disk offset, but for a factor.
fn exponent(params: &Params<f32>, axis: [f32; 3], [x, y]: [f32; 2]) -> f32 {
    let along = (x * axis[0] + y * axis[1]) / params.roughness_u;
    let across = (y * axis[0] - x * axis[1]) / params.roughness_v.unwrap_or(params.roughness_u);
    along * along + across * across
}

#[test]
fn both_half_power_angles_of_retro_sheeting_surface_hold_at_every_entrance_angle_and_azimuth() {
    // A tangent neither of unit length nor in the tangent plane.
    let text = r#"<materialx version="1.39"><constant name="t" type="vector3"><input name="value" type="vector3" value="0, 3, 1" /></constant>
        <retro_sheeting_surface name="s" type="surfaceshader"><input name="half_power_angle" type="float" value="0.3" />
        <input name="half_power_angle_across" type="float" value="0.9" /><input name="tangent" type="vector3" nodename="t" /></retro_sheeting_surface>
        <surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s" /></surfacematerial></materialx>"#;
    let material = Document::parse(text, "m.mtlx").unwrap().material(None).unwrap();
    let patterns = material.patterns.unwrap();
    let [along, across] = [0.3_f32, 0.9].map(|angle| angle * 0.014823438);
    for entrance in [0.0_f32, 30.0, 60.0, 80.0] {
        for azimuth in (0..360).step_by(25).map(|degrees| (degrees as f32).to_radians()) {
            let (sin, cosine) = entrance.to_radians().sin_cos();
            let (e_y, e_x) = azimuth.sin_cos();
            let point = ShadingPoint { view: [-sin * e_x, -sin * e_y, -cosine], ..ShadingPoint::default() };
            let (params, axis, _) = below_the_coat(patterns.at(&point).bsdf);
            // Light beside the viewer by an angle, in the frame that tipping the normal onto the view makes
            // of tangent (y) and bitangent (-x). The disk offset is half of it, along the view's projection
            // half of it over the cosine (theory.md, section 10).
            for turn in (0..180).step_by(20).map(|degrees| (degrees as f32).to_radians()) {
                let (x, y) = (-turn.sin(), turn.cos());
                let stretch = (x * e_x + y * e_y) * (1.0 / cosine - 1.0);
                let found = exponent(&params, axis, [x + stretch * e_x, y + stretch * e_y]);
                let expected = (turn.cos() / along).powi(2) + (turn.sin() / across).powi(2);
                assert!(
                    (found / expected - 1.0).abs() < 1e-3,
                    "{entrance} {azimuth} {turn}: {found} {expected}"
                );
            }
        }
    }
}

#[test]
fn includes_stay_under_the_search_path() {
    let folder = tempfile::tempdir().unwrap();
    let (inside, outside) = (folder.path().join("a/b"), folder.path().join("shared"));
    for folder in [&inside, &outside] {
        std::fs::create_dir_all(folder).unwrap();
    }
    let included = r#"<materialx version="1.39"><dielectric_bsdf name="bsdf" type="BSDF" /></materialx>"#;
    std::fs::write(inside.join("here.mtlx"), included).unwrap();
    std::fs::write(outside.join("there.mtlx"), included).unwrap();
    let main = |href: &str| {
        let include = format!("<xi:include xmlns:xi=\"http://www.w3.org/2001/XInclude\" href=\"{href}\" />");
        let path = inside.join("main.mtlx");
        std::fs::write(&path, document(&include)).unwrap();
        path
    };
    assert!(Document::load(main("here.mtlx")).unwrap().material(None).is_ok());
    for href in ["../../shared/there.mtlx", outside.join("there.mtlx").to_str().unwrap()] {
        let message = Document::load(main(href)).unwrap_err().to_string();
        assert!(message.contains("is outside the document's folder"), "{message}");
    }
    let library = Arc::new(Library::load(SearchPath::new([outside.clone()])).unwrap());
    assert!(Document::load_with(main("there.mtlx"), &library).unwrap().material(None).is_ok());
    let message = Document::load(main("main.mtlx")).unwrap_err().to_string();
    assert!(message.contains("feeds itself through \"main.mtlx\""), "{message}");
}
