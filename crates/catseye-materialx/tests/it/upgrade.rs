//! Promise: documents are read as MaterialX reads them, whatever their version, encoding and spelling.

use std::path::Path;

use catseye_materialx::{Closure, Document, Error, ShadingPoint};

use crate::support::{document, single};

fn load(name: &str) -> Document {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/upgrade");
    Document::load(Path::new(folder).join(name)).unwrap_or_else(|error| panic!("{error}"))
}

fn points() -> impl Iterator<Item = ShadingPoint> {
    (0..20_u8).map(|i| {
        let x = f32::from(i) / 7.0;
        ShadingPoint {
            texcoord: [x, 1.0 - 0.3 * x],
            position: [x - 1.0, 0.5 * x, 2.0 - x],
            position_object: [x - 1.0, 0.5 * x, 2.0 - x],
            ..ShadingPoint::default()
        }
    })
}

/// `*.1.39.mtlx` is what MaterialX 1.39.5 made of `*.1.38.mtlx`: `tests/materialx/test_upgrade.py`.
#[test]
fn patterns_of_1_38_are_those_of_materialx_upgrade() {
    let outputs = |name| load(name).outputs().unwrap_or_else(|error| panic!("{error}"));
    let (old, new) = (outputs("nodes.1.38.mtlx"), outputs("nodes.1.39.mtlx"));
    assert_eq!(old.len(), 10);
    for (old, new) in old.iter().zip(&new) {
        assert_eq!(old.name(), new.name());
        for point in points() {
            assert_eq!(old.at(&point), new.at(&point), "{} at {point:?}", old.name());
        }
    }
}

#[test]
fn closures_of_1_38_are_those_of_materialx_upgrade() {
    let materials = |name| load(name).materials().unwrap_or_else(|error| panic!("{error}"));
    let (old, new) = (materials("closures.1.38.mtlx"), materials("closures.1.39.mtlx"));
    assert_eq!(old.len(), 2);
    for (old, new) in old.iter().zip(&new) {
        assert_eq!((&old.name, &old.surface.bsdf), (&new.name, &new.surface.bsdf));
        assert_eq!(old.warnings.len(), new.warnings.len());
    }
    assert!(matches!(old[0].surface.bsdf, Closure::Mix { .. }), "{:?}", old[0].surface.bsdf);
    assert!(old[0].warnings.iter().any(|warning| warning.to_string().contains("thin films")));
}

fn material(bytes: &[u8]) -> Result<Closure, Error> {
    Ok(Document::from_bytes(bytes, "m.mtlx")?.material(None)?.surface.bsdf)
}

#[test]
fn utf_16_and_latin_1_are_read() {
    let text = single("dielectric_bsdf", "").replace("\"m\"", "\"mu\u{e9}\"");
    let utf16: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let latin = format!("<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>{text}");
    let latin: Vec<u8> = latin.chars().map(|c| c as u8).collect();
    for bytes in [[&[0xff, 0xfe][..], &utf16].concat(), latin] {
        assert!(matches!(material(&bytes), Ok(Closure::Dielectric { .. })));
        let document = Document::from_bytes(&bytes, "m.mtlx").unwrap();
        assert_eq!(document.material_names(), ["mu\u{e9}"]);
    }
}

#[test]
fn prefixes_that_nobody_declares_are_part_of_names() {
    let with = |nodes: &str| document(&format!("<dielectric_bsdf name=\"bsdf\" type=\"BSDF\" />\n{nodes}"));
    let text = with(
        "<npr:gooch name=\"g\" type=\"color3\" adsk:name=\"other\"><input name=\"x\" type=\"float\" /></npr:gooch>",
    );
    assert!(material(text.as_bytes()).is_ok());
    let used = single("oren_nayar_diffuse_bsdf", "<input name=\"color\" type=\"color3\" nodename=\"g\" />")
        .replace("</materialx>", "<npr:gooch name=\"g\" type=\"color3\" /></materialx>");
    let message = material(used.as_bytes()).unwrap_err().to_string();
    assert!(message.starts_with("m.mtlx:7:1: npr:gooch \"g\": unknown node category"), "{message}");
}

#[test]
fn colours_are_separated_by_commas_spaces_or_both() {
    for value in ["1 0.5,0.25", "1, 0.5, 0.25", " 1 0.5 0.25 ", "1,0.5,0.25,"] {
        let color = format!("<input name=\"color\" type=\"color3\" value=\"{value}\" />");
        let Ok(Closure::OrenNayarDiffuse { color, .. }) =
            material(single("oren_nayar_diffuse_bsdf", &color).as_bytes())
        else {
            panic!("{value}")
        };
        assert_eq!(color, [1.0, 0.5, 0.25]);
    }
}

#[test]
fn tiles_are_refused_by_name() {
    for token in ["<UDIM>", "&lt;UDIM&gt;", "<UVTILE>"] {
        let nodes = format!(
            "<image name=\"i\" type=\"color3\"><input name=\"file\" type=\"filename\" value=\"grid.{token}.png\" /></image>\n\
             <oren_nayar_diffuse_bsdf name=\"bsdf\" type=\"BSDF\"><input name=\"color\" type=\"color3\" nodename=\"i\" />\
             </oren_nayar_diffuse_bsdf>"
        );
        let message = material(document(&nodes).as_bytes()).unwrap_err().to_string();
        let name = token.replace("&lt;", "<").replace("&gt;", ">");
        let expected = format!(
            "m.mtlx:2:31: image \"i\", input \"file\": \"grid.{name}.png\" names the tiles of a picture, which is not \
             supported; name one of them, as in name.1001.png"
        );
        assert_eq!(message, expected);
    }
}

#[test]
fn displacement_and_films_are_left_out_with_a_warning() {
    let nodes = "<dielectric_bsdf name=\"bsdf\" type=\"BSDF\"><input name=\"thinfilm_thickness\" type=\"float\" value=\"500\" />\
                 </dielectric_bsdf>\n<displacement name=\"d\" type=\"displacementshader\" />";
    let text = document(nodes).replace(
        "</surfacematerial>",
        "<input name=\"displacementshader\" type=\"displacementshader\" nodename=\"d\" /></surfacematerial>",
    );
    let material = Document::parse(&text, "m.mtlx").and_then(|document| document.material(None)).unwrap();
    let warnings: Vec<String> = material.warnings.iter().map(ToString::to_string).collect();
    for (place, what) in
        [("m.mtlx:2:42: ", "the film is ignored"), ("m.mtlx:5:107: ", "the displacement is ignored")]
    {
        let found = warnings.iter().any(|warning| warning.starts_with(place) && warning.ends_with(what));
        assert!(found, "{what}: {warnings:?}");
    }
}

#[test]
fn a_value_without_text_is_the_default_and_a_warning() {
    let empty = "<input name=\"roughness\" type=\"float\" value=\"\" />";
    let document = Document::parse(&single("oren_nayar_diffuse_bsdf", empty), "m.mtlx").unwrap();
    let warnings: Vec<String> = document.warnings().iter().map(ToString::to_string).collect();
    let expected = "m.mtlx:3:1: oren_nayar_diffuse_bsdf \"bsdf\", input \"roughness\": value=\"\" is ignored: the default counts";
    assert_eq!(warnings, [expected]);
}
