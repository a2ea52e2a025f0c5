//! Promise: a document reads as MaterialX says it means.

use std::{collections::BTreeSet, path::PathBuf};

use catseye::Params;
use catseye_materialx::{Closure, Document, Material, ScatterMode, Surface};

use crate::support::{document, single};

fn materials_folder() -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "../../materials"].iter().collect()
}

fn parse(text: &str) -> Material {
    Document::parse(text, "test.mtlx")
        .and_then(|document| document.material(None))
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn retro(params: Params<f32>) -> Closure {
    Closure::RetroReflective { weight: 1.0, params }
}

fn turned(lobe: Closure, tangent: [f32; 3]) -> Closure {
    Closure::Oriented { closure: Box::new(lobe), normal: None, tangent: Some(tangent) }
}

fn diffuse(color: [f32; 3], roughness: f32) -> Closure {
    Closure::OrenNayarDiffuse { weight: 1.0, color, roughness, energy_compensation: true }
}

fn dielectric(ior: f32, roughness: f32) -> Closure {
    let (weight, tint, scatter_mode) = (1.0, [1.0; 3], ScatterMode::Reflect);
    Closure::Dielectric { weight, tint, ior, roughness: [roughness; 2], retroreflective: false, scatter_mode }
}

fn proposal_example(roughness: f32) -> Closure {
    let tint = [0.95, 0.8, 0.45];
    retro(Params::isotropic(roughness).with_tint(tint).with_multiscatter_tint(tint))
}

fn sheeting() -> Closure {
    let beads = retro(Params::isotropic(0.006).with_tint([0.062, 0.062, 0.06]));
    let backing = diffuse([0.72, 0.72, 0.7], 0.1);
    let sheet = Closure::Add { a: Box::new(beads), b: Box::new(backing) };
    Closure::Layer { top: Box::new(dielectric(1.49, 0.02)), base: Box::new(sheet) }
}

/// What `retro_sheeting_surface` makes of the document, seen head on.
fn retro_sheeting() -> Closure {
    let share = [1.0, 0.7, 0.08].map(|color| 0.1 * color);
    let color = [0, 1, 2].map(|i| [0.75, 0.45, 0.03][i] * (1.0 - share[i]));
    let squared = (0.4_f32 * 0.014823438).powi(2);
    let params = Params::anisotropic(squared.sqrt(), squared / squared.sqrt());
    let beads = retro(params.with_tint(share).with_multiscatter_tint(share));
    let beads = turned(beads, [1.0, 0.0, 0.0]);
    let base = Closure::OrenNayarDiffuse { weight: 1.0, color, roughness: 0.0, energy_compensation: false };
    let sheet = Closure::Add { a: Box::new(beads), b: Box::new(base) };
    Closure::Layer { top: Box::new(dielectric(1.49, 0.02)), base: Box::new(sheet) }
}

fn anisotropic_tape() -> Closure {
    // Above 0.04045; `colours_are_converted_from_the_nearest_colour_space` checks the conversion by its
    // values.
    let linear_from_srgb = |x: f32| ((x + 0.055) / 1.055).powf(2.4);
    let yellow = [0.97, 0.87, 0.28].map(linear_from_srgb);
    let green = [0.87, 0.88, 0.25].map(linear_from_srgb);
    let params = Params::anisotropic(0.03, 0.3).with_tint(yellow).with_multiscatter_tint(yellow);
    let grooves = turned(retro(params), [0.0, 1.0, 0.0]);
    let woven = Closure::Mix {
        foreground: Box::new(grooves),
        background: Box::new(diffuse(green, 0.5)),
        amount: 0.33,
    };
    Closure::Multiply { closure: Box::new(woven), factor: [0.9, 0.9, 0.85] }
}

#[test]
fn every_document_of_the_materials_folder() {
    let expected = [
        ("anisotropic_tape", anisotropic_tape()),
        ("matte_white", diffuse([0.8; 3], 0.2)),
        ("retro_roughness_005", proposal_example(0.05)),
        ("retro_roughness_015", proposal_example(0.15)),
        ("retro_roughness_050", proposal_example(0.5)),
        ("retro_sheeting", retro_sheeting()),
        ("sheeting", sheeting()),
    ];
    for (name, bsdf) in expected.clone() {
        let path = materials_folder().join(format!("{name}.mtlx"));
        let material = Document::load(path).and_then(|document| document.material(None)).unwrap();
        // Of what varies over the surface this is its look head on.
        let shown = Material { patterns: None, ..material };
        assert_eq!(shown, Material { name: name.into(), ..Material::of(bsdf) });
    }
    let on_disk = std::fs::read_dir(materials_folder()).unwrap().map(|entry| entry.unwrap().path());
    let on_disk = on_disk.filter(|path| path.extension().is_some_and(|extension| extension == "mtlx"));
    // What `catseye fit` wrote is compared with its command by a test of catseye-cli; here it is read.
    let (fitted, on_disk): (Vec<_>, Vec<_>) =
        on_disk.partition(|path| std::fs::read_to_string(path).unwrap().contains("Written by catseye fit"));
    for path in fitted {
        let material = Document::load(&path).and_then(|document| document.material(None)).unwrap();
        let name = path.file_stem().unwrap().to_string_lossy();
        assert_eq!((material.name.as_str(), material.warnings), (&*name, Vec::new()));
    }
    let on_disk: BTreeSet<_> = on_disk.iter().map(|path| path.file_stem().unwrap().to_owned()).collect();
    assert_eq!(
        on_disk,
        expected.iter().map(|(name, _)| (*name).into()).collect(),
        "a document lacks its entry"
    );
}

#[test]
fn defaults_are_those_of_the_node_definitions() {
    let cases = [
        ("retro_reflective_bsdf", retro(Params::default())),
        (
            "oren_nayar_diffuse_bsdf",
            Closure::OrenNayarDiffuse {
                weight: 1.0,
                color: [0.18; 3],
                roughness: 0.0,
                energy_compensation: false,
            },
        ),
        ("dielectric_bsdf", dielectric(1.5, 0.05)),
        (
            "conductor_bsdf",
            Closure::Conductor {
                weight: 1.0,
                ior: [0.183, 0.421, 1.373],
                extinction: [3.424, 2.346, 1.770],
                roughness: [0.05; 2],
                retroreflective: false,
            },
        ),
        ("generalized_schlick_bsdf", schlick(false, ScatterMode::Reflect)),
        ("burley_diffuse_bsdf", Closure::BurleyDiffuse { weight: 1.0, color: [0.18; 3], roughness: 0.0 }),
        ("translucent_bsdf", Closure::Translucent { weight: 1.0, color: [1.0; 3] }),
        ("sheen_bsdf", Closure::Sheen { weight: 1.0, color: [1.0; 3], roughness: 0.3 }),
        (
            "mix",
            Closure::Mix {
                foreground: Box::new(Closure::None),
                background: Box::new(Closure::None),
                amount: 0.0,
            },
        ),
        ("layer", Closure::Layer { top: Box::new(Closure::None), base: Box::new(Closure::None) }),
        ("add", Closure::Add { a: Box::new(Closure::None), b: Box::new(Closure::None) }),
        ("multiply", Closure::Multiply { closure: Box::new(Closure::None), factor: [1.0; 3] }),
    ];
    for (category, expected) in cases {
        assert_eq!(parse(&single(category, "")).surface.bsdf, expected, "{category}");
    }
}

fn schlick(retroreflective: bool, scatter_mode: ScatterMode) -> Closure {
    Closure::GeneralizedSchlick {
        weight: 1.0,
        color0: [1.0; 3],
        color82: [1.0; 3],
        color90: [1.0; 3],
        exponent: 5.0,
        roughness: [0.05; 2],
        retroreflective,
        scatter_mode,
    }
}

#[test]
fn three_microfacet_lobes_can_be_retroreflective() {
    let input = r#"<input name="retroreflective" type="boolean" value="true" />"#;
    for category in ["dielectric_bsdf", "conductor_bsdf", "generalized_schlick_bsdf"] {
        let sent_back = match parse(&single(category, input)).surface.bsdf {
            Closure::Dielectric { retroreflective, .. }
            | Closure::Conductor { retroreflective, .. }
            | Closure::GeneralizedSchlick { retroreflective, .. } => retroreflective,
            other => panic!("{other:?}"),
        };
        assert!(sent_back, "{category}");
    }
}

#[test]
fn a_normal_of_its_own_orients_a_lobe() {
    let input = r#"<input name="normal" type="vector3" value="0, 2, 0" />"#;
    let expected = Closure::Oriented {
        closure: Box::new(Closure::Translucent { weight: 1.0, color: [1.0; 3] }),
        normal: Some([0.0, 1.0, 0.0]),
        tangent: None,
    };
    assert_eq!(parse(&single("translucent_bsdf", input)).surface.bsdf, expected);
}

#[test]
fn every_input_of_retro_reflective_bsdf() {
    let inputs = r#"
        <input name="weight" type="float" value="0.5" />
        <input name="roughness_u" type="float" value="0.1" />
        <input name="roughness_v" type="float" value="0.2" />
        <input name="tint" type="color3" value="0.1, 0.2, 0.3" />
        <input name="multiscatter_tint" type="color3" value="0.4,0.5,0.6" />
        <input name="tangent_u" type="vector3" value="0 3 4" />
        <input name="normal" type="vector3" />"#;
    let params =
        Params::anisotropic(0.1, 0.2).with_tint([0.1, 0.2, 0.3]).with_multiscatter_tint([0.4, 0.5, 0.6]);
    let expected = turned(Closure::RetroReflective { weight: 0.5, params }, [0.0, 0.6, 0.8]);
    assert_eq!(parse(&single("retro_reflective_bsdf", inputs)).surface.bsdf, expected);
}

#[test]
fn roughness_has_no_upper_limit_and_a_negative_second_one_means_the_first() {
    let cases = [
        ("inf", "-1", f32::INFINITY, None),
        ("+inf", "inf", f32::INFINITY, Some(f32::INFINITY)),
        ("2", "-0.001", 2.0, None),
        ("2", "0", 2.0, Some(0.0)),
        ("1e-3", "-inf", 0.001, None),
    ];
    for (u, v, roughness_u, roughness_v) in cases {
        let inputs = format!(
            r#"<input name="roughness_u" type="float" value="{u}" /><input name="roughness_v" type="float" value="{v}" />"#
        );
        let expected = retro(Params::isotropic(roughness_u).with_roughness_v(roughness_v));
        assert_eq!(parse(&single("retro_reflective_bsdf", &inputs)).surface.bsdf, expected, "{u} {v}");
    }
}

#[test]
fn every_input_of_dielectric_bsdf() {
    let modes =
        [("R", ScatterMode::Reflect), ("T", ScatterMode::Transmit), ("RT", ScatterMode::ReflectTransmit)];
    for (mode, scatter_mode) in modes {
        let inputs = format!(
            r#"<input name="weight" type="float" value="0.25" />
            <input name="tint" type="color3" value="1, 0.5, 0" />
            <input name="ior" type="float" value="1.33" />
            <input name="roughness" type="vector2" value="0.1, 0.4" />
            <input name="retroreflective" type="boolean" value="false" />
            <input name="thinfilm_thickness" type="float" value="0" />
            <input name="thinfilm_ior" type="float" value="1.3" />
            <input name="distribution" type="string" value="ggx" />
            <input name="scatter_mode" type="string" value="{mode}" />"#
        );
        let expected = Closure::Dielectric {
            weight: 0.25,
            tint: [1.0, 0.5, 0.0],
            ior: 1.33,
            roughness: [0.1, 0.4],
            retroreflective: false,
            scatter_mode,
        };
        assert_eq!(parse(&single("dielectric_bsdf", &inputs)).surface.bsdf, expected);
    }
}

#[test]
fn multiply_takes_a_float_or_a_colour() {
    for (ty, value, factor) in [("float", "0.5", [0.5; 3]), ("color3", "0.1, 0.2, 0.3", [0.1, 0.2, 0.3])] {
        let inputs = format!(r#"<input name="in2" type="{ty}" value="{value}" />"#);
        let expected = Closure::Multiply { closure: Box::new(Closure::None), factor };
        assert_eq!(parse(&single("multiply", &inputs)).surface.bsdf, expected);
    }
}

#[test]
fn colours_are_converted_from_the_nearest_colour_space() {
    // sRGB 0.5 is 0.2140411 in linear light; 0.04 is on the straight part.
    let cases = [
        ("", "", [0.5, 0.04, 1.0]),
        ("lin_rec709", "", [0.5, 0.04, 1.0]),
        ("srgb_texture", "", [0.214_041_14, 0.003_095_975, 1.0]),
        ("srgb_texture", "raw", [0.5, 0.04, 1.0]),
        ("none", "srgb_texture", [0.214_041_14, 0.003_095_975, 1.0]),
        ("unheard_of", "none", [0.5, 0.04, 1.0]),
    ];
    for (of_document, of_input, color) in cases {
        let input =
            format!(r#"<input name="color" type="color3" value="0.5, 0.04, 1" colorspace="{of_input}" />"#);
        let text = single("oren_nayar_diffuse_bsdf", &input)
            .replace("<materialx", &format!("<materialx colorspace=\"{of_document}\""));
        let Closure::OrenNayarDiffuse { color: actual, .. } = parse(&text).surface.bsdf else {
            panic!("{text}")
        };
        for (actual, expected) in actual.into_iter().zip(color) {
            assert!((actual - expected).abs() < 1e-6, "{of_document:?} {of_input:?}: {actual} {expected}");
        }
    }
}

const GRAPH: &str = r#"
    <nodegraph name="g">
      <retro_reflective_bsdf name="bsdf" type="BSDF"><input name="roughness_u" type="float" value="0.25" /></retro_reflective_bsdf>
      <add name="sum" type="BSDF"><input name="in1" type="BSDF" nodename="bsdf" /></add>
      <output name="out" type="BSDF" nodename="sum" />
    </nodegraph>"#;

#[test]
fn a_nodegraph_has_its_own_names() {
    for connection in [r#"nodegraph="g" output="out""#, r#"nodegraph="g""#] {
        let node = format!(
            r#"<add name="bsdf" type="BSDF"><input name="in2" type="BSDF" {connection} /></add>{GRAPH}"#
        );
        let inner = Closure::Add { a: Box::new(retro(Params::isotropic(0.25))), b: Box::new(Closure::None) };
        let expected = Closure::Add { a: Box::new(Closure::None), b: Box::new(inner) };
        assert_eq!(parse(&document(&node)).surface.bsdf, expected, "{connection}");
    }
}

#[test]
fn an_output_of_the_document_can_be_connected() {
    let nodes = r#"<layer name="bsdf" type="BSDF"><input name="base" type="BSDF" output="o" /></layer>
        <output name="o" type="BSDF" nodename="d" /><dielectric_bsdf name="d" type="BSDF" />"#;
    let expected = Closure::Layer { top: Box::new(Closure::None), base: Box::new(dielectric(1.5, 0.05)) };
    assert_eq!(parse(&document(nodes)).surface.bsdf, expected);
}

#[test]
fn a_connection_is_preferred_to_a_value_and_empty_counts_as_absent() {
    let nodes = r#"<add name="bsdf" type="BSDF">
          <input name="in1" type="BSDF" nodename="d" value="ignored" />
          <input name="in2" type="BSDF" nodename="" value="" />
        </add>
        <dielectric_bsdf name="d" type="BSDF"><input name="ior" type="float" value="" /></dielectric_bsdf>"#;
    let expected = Closure::Add { a: Box::new(dielectric(1.5, 0.05)), b: Box::new(Closure::None) };
    assert_eq!(parse(&document(nodes)).surface.bsdf, expected);
}

#[test]
fn a_node_may_have_several_users() {
    let nodes = r#"<add name="bsdf" type="BSDF">
          <input name="in1" type="BSDF" nodename="d" /><input name="in2" type="BSDF" nodename="d" />
        </add><dielectric_bsdf name="d" type="BSDF" />"#;
    let d = Box::new(dielectric(1.5, 0.05));
    assert_eq!(parse(&document(nodes)).surface.bsdf, Closure::Add { a: d.clone(), b: d });
}

#[test]
fn both_versions_and_the_ways_files_are_written() {
    let text = single("dielectric_bsdf", "");
    let variants = [
        text.replace("1.39", "1.38"),
        text.replace('\n', "\r\n"),
        format!("\u{feff}<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{text}"),
        text.replace("<materialx", "<materialx xmlns=\"http://example.org/materialx\""),
        text.replace("<surface ", "<x:note xmlns:x=\"http://example.org/tool\" name=\"bsdf\" /><surface "),
    ];
    for variant in variants {
        assert_eq!(parse(&variant).surface.bsdf, dielectric(1.5, 0.05), "{variant}");
    }
}

#[test]
fn materials_come_in_order_and_by_name() {
    let other = r#"<surface name="cut" type="surfaceshader"><input name="opacity" type="float" value="0.5" /></surface>
        <surfacematerial name="a" type="material"><input name="surfaceshader" type="surfaceshader" nodename="cut" /></surfacematerial>
        <dielectric_bsdf name="bsdf" type="BSDF" />"#;
    let document = Document::parse(&document(other), "test.mtlx").unwrap();
    let names: Vec<_> = document.materials().unwrap().into_iter().map(|material| material.name).collect();
    assert_eq!(names, ["a", "m"]);
    let surface = Surface { opacity: 0.5, ..Surface::default() };
    let expected = Material { name: "a".into(), surface, ..Material::default() };
    assert_eq!(document.material(Some("a")).unwrap(), expected);
    assert_eq!(document.material(Some("m")).unwrap().surface.bsdf, dielectric(1.5, 0.05));
}

#[test]
fn only_what_a_material_refers_to_is_checked() {
    let nodes = r#"<dielectric_bsdf name="bsdf" type="BSDF" />
        <hair_bsdf name="unused" type="BSDF" /><look name="l"><materialassign name="a" material="m" geom="/" /></look>"#;
    assert_eq!(parse(&document(nodes)).surface.bsdf, dielectric(1.5, 0.05));
}
