//! Promise: whatever is wrong, one line names the file, the place, the element, the value and the way out.

use catseye_materialx::{Document, Error};

use crate::support::{document, single};

fn error(text: &str) -> Error {
    Document::parse(text, "m.mtlx").and_then(|document| document.material(None)).expect_err(text)
}

fn assert_messages(cases: &[(&str, String, &str)]) {
    for (name, text, expected) in cases {
        let message = error(text).to_string();
        assert_eq!(message, format!("m.mtlx{expected}"), "{name}: {text}");
        assert!(!message.contains('\n'), "{name}: {message}");
    }
}

#[test]
fn files() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let message = |name: &str| {
        let message = Document::load(path(name)).unwrap_err().to_string();
        message.replace(folder.path().to_str().unwrap(), "")
    };
    std::fs::write(path("latin1.mtlx"), b"<materialx\n doc='\xfcber'/>").unwrap();
    std::fs::write(path("empty.mtlx"), "").unwrap();
    std::fs::write(path("huge.mtlx"), vec![b' '; (16 << 20) + 1]).unwrap();
    std::fs::create_dir(path("folder.mtlx")).unwrap();
    let cases = [
        ("missing.mtlx", "can't be read: No such file or directory (os error 2)"),
        ("folder.mtlx", "is a folder; name one .mtlx file"),
        ("huge.mtlx", "is larger than 16777216 bytes; split the document"),
    ];
    for (name, expected) in cases.iter().filter(|_| cfg!(unix)) {
        assert_eq!(message(name), format!("/{name}: {expected}"));
    }
    assert_eq!(message("latin1.mtlx"), "/latin1.mtlx:2:7: is not UTF-8 from here on; save the file as UTF-8");
    assert_eq!(
        message("empty.mtlx"),
        "/empty.mtlx:1:1: malformed XML: the document does not have a root node"
    );
}

#[test]
fn xml() {
    assert_messages(&[
        (
            "unclosed",
            "<materialx version=\"1.39\">\n<add>".into(),
            ":2:6: malformed XML: the root node was opened but never closed",
        ),
        (
            "crossed",
            "<materialx version=\"1.39\"><a><b></a></b></materialx>".into(),
            ":1:33: malformed XML: expected 'b' tag, not 'a'",
        ),
        ("not XML", "{\"json\": 1}".into(), ":1:1: malformed XML: unknown token"),
        (
            "twice the same attribute",
            "<materialx version='1.39' version='1.39'/>".into(),
            ":1:27: malformed XML: attribute 'version' is already defined",
        ),
        (
            "another vocabulary",
            "<html/>".into(),
            ":1:1: html: the root element is not <materialx>; this is no MaterialX document",
        ),
        ("no version", "<materialx/>".into(), ":1:1: materialx: has no version=\"...\"; add it"),
        (
            "old version",
            "<materialx version=\"1.36\"/>".into(),
            ":1:1: materialx: version \"1.36\" is not supported; upgrade it with MaterialX's mxformat.py --upgrade",
        ),
        (
            "new version",
            "<materialx version=\"1.40\"/>".into(),
            ":1:1: materialx: version \"1.40\" is not supported; versions 1.38 and 1.39 are",
        ),
    ]);
}

#[test]
fn materials() {
    let two =
        document("").replace("</materialx>", "<surfacematerial name=\"n\" type=\"material\" /></materialx>");
    let named = |text: &str, name| {
        Document::parse(text, "m.mtlx")
            .and_then(|document| document.material(Some(name)))
            .unwrap_err()
            .to_string()
    };
    assert_messages(&[
        (
            "none",
            "<materialx version=\"1.39\"/>".into(),
            ": has no <surfacematerial>; add one and connect its surfaceshader",
        ),
        ("several", two.clone(), ": has several materials; choose one of \"m\", \"n\""),
    ]);
    assert_eq!(named(&two, "x"), "m.mtlx: has no material \"x\"; it has \"m\", \"n\"");
    assert_eq!(
        named(&two, "n"),
        "m.mtlx:5:1: surfacematerial \"n\": has no surfaceshader; connect a surface node"
    );
    let none =
        Document::parse("<materialx version=\"1.38\"/>", "m.mtlx").and_then(|document| document.materials());
    assert!(matches!(none, Err(Error::NoMaterial { .. })));
}

#[test]
fn nodes() {
    assert_messages(&[
        (
            "unknown category",
            document("<hair_bsdf name=\"bsdf\" type=\"BSDF\" />"),
            ":2:1: hair_bsdf \"bsdf\": unknown node category; `--materialx-path` or \
             MATERIALX_SEARCH_PATH adds libraries that define nodes",
        ),
        (
            "pattern node of another type",
            single("multiply", "<input name=\"in2\" type=\"color3\" nodename=\"texture\" />")
                .replace("</materialx>", "<image name=\"texture\" type=\"vector3\" /></materialx>"),
            ":3:1: multiply \"bsdf\", input \"in2\": is of type \"vector3\" by its connection; color3 is expected",
        ),
        (
            "node without type",
            document("<add name=\"bsdf\" />"),
            ":2:1: add \"bsdf\": has no type=\"...\"; add it",
        ),
        (
            "node of another type",
            document("<mix name=\"bsdf\" type=\"color3\" />"),
            ":3:40: surface \"s\", input \"bsdf\": is of type \"color3\" by its connection; BSDF is expected",
        ),
        (
            "same name twice",
            document("<add name=\"bsdf\" type=\"BSDF\" />\n<mix name=\"bsdf\" type=\"BSDF\" />"),
            ":3:1: mix \"bsdf\": the name is already taken in line 2; rename one of them",
        ),
        (
            "old-style parameter",
            single("add", "<parameter name=\"x\" type=\"float\" value=\"1\" />"),
            ":3:1: add \"bsdf\", parameter \"x\": an element other than <input> in a node is not supported; \
             remove it",
        ),
        (
            "include",
            document("<xi:include xmlns:xi=\"http://www.w3.org/2001/XInclude\" href=\"a.mtlx\" />"),
            ":2:1: xi:include: there is no file \"a.mtlx\"; correct the name, or add its folder with `--materialx-path`",
        ),
    ]);
}

#[test]
fn inputs() {
    assert_messages(&[
        (
            "unknown input",
            single("retro_reflective_bsdf", "<input name=\"roughness\" type=\"float\" value=\"0.1\" />"),
            ":3:1: retro_reflective_bsdf \"bsdf\", input \"roughness\": no such input; retro_reflective_bsdf has \
             weight, roughness_u, roughness_v, tint, multiscatter_tint, tangent_u, normal",
        ),
        (
            "input without name",
            single("mix", "<input type=\"float\" value=\"0.1\" />"),
            ":3:1: mix \"bsdf\", input: has no name=\"...\"; add it",
        ),
        (
            "input without type",
            single("mix", "<input name=\"mix\" value=\"0.1\" />"),
            ":3:1: mix \"bsdf\", input \"mix\": has no type=\"...\"; add it",
        ),
        (
            "input twice",
            single("mix", "<input name=\"mix\" type=\"float\" />\n<input name=\"mix\" type=\"float\" />"),
            ":4:1: mix \"bsdf\", input \"mix\": the name is already taken in line 3; rename one of them",
        ),
        (
            "wrong type",
            single("retro_reflective_bsdf", "<input name=\"tint\" type=\"float\" value=\"1\" />"),
            ":3:1: retro_reflective_bsdf \"bsdf\", input \"tint\": is of type \"float\"; color3 is expected",
        ),
        (
            "wrong type where two are right",
            single("multiply", "<input name=\"in2\" type=\"vector3\" value=\"1, 1, 1\" />"),
            ":3:1: multiply \"bsdf\", input \"in2\": is of type \"vector3\"; float or color3 is expected",
        ),
        (
            "colour space",
            single(
                "retro_reflective_bsdf",
                "<input name=\"tint\" type=\"color3\" value=\"1, 1, 1\" colorspace=\"cmyk\" />",
            ),
            ":3:1: retro_reflective_bsdf \"bsdf\", input \"tint\": colour space \"cmyk\" is not supported; \
             lin_rec709, raw, none, srgb_texture, g18_rec709, g22_rec709, rec709_display, acescg, g22_ap1, \
             lin_adobergb, adobergb, lin_displayp3, srgb_displayp3 are",
        ),
    ]);
}

#[test]
fn unsupported_inputs() {
    let case = |category: &str, input: &str| single(category, &format!("<input {input} />"));
    assert_messages(&[
        (
            "interface",
            case("mix", "name=\"mix\" type=\"float\" interfacename=\"wear\""),
            ":3:1: mix \"bsdf\", input \"mix\": is connected to interfacename=\"wear\", which doesn't exist; add it or \
             correct the name",
        ),
        (
            "back surface",
            document("<add name=\"bsdf\" type=\"BSDF\" />").replace(
                "</surfacematerial>",
                "\n<input name=\"backsurfaceshader\" type=\"surfaceshader\" nodename=\"s\" /></surfacematerial>",
            ),
            ":5:1: surfacematerial \"m\", input \"backsurfaceshader\": anything but the default, unconnected, is \
             not supported; remove the input",
        ),
    ]);
}

/// A document whose node has one input with this value, and the message about that input.
fn value_case(category: &str, name: &str, ty: &str, value: &str) -> (String, String) {
    let input = format!("<input name=\"{name}\" type=\"{ty}\" value=\"{value}\" />");
    (single(category, &input), format!("m.mtlx:3:1: {category} \"bsdf\", input \"{name}\": "))
}

#[test]
fn values() {
    const NUMBER: &str = "not a number; write one like 0.5";
    const COLOR: &str = "not a color3; write three numbers like 0.8, 0.8, 0.8";
    const LARGE: &str = "not within single precision; write a number of at most 3.4e38";
    const RETRO: &str = "retro_reflective_bsdf";
    const DIELECTRIC: &str = "dielectric_bsdf";
    let cases = [
        (RETRO, "roughness_u", "float", "rough", NUMBER),
        (RETRO, "roughness_u", "float", "nan", NUMBER),
        (RETRO, "roughness_u", "float", "1e39", LARGE),
        (RETRO, "roughness_u", "float", "1e400", LARGE),
        (RETRO, "tint", "color3", "1, 1e39, 1", LARGE),
        (RETRO, "roughness_u", "float", "0,5", NUMBER),
        (RETRO, "roughness_u", "float", "0.1, 0.2", NUMBER),
        (RETRO, "tint", "color3", "1", COLOR),
        (RETRO, "tint", "color3", "1, 1", COLOR),
        (RETRO, "tint", "color3", "1, , 1", COLOR),
        (RETRO, "tint", "color3", "1, 1, 1, 1", COLOR),
        (RETRO, "tint", "color3", "#ffffff", COLOR),
        (RETRO, "tangent_u", "vector3", "x", "not a vector3; write three numbers like 1, 0, 0"),
        (DIELECTRIC, "roughness", "vector2", "0.1", "not a vector2; write two numbers like 0.1, 0.2"),
        (DIELECTRIC, "retroreflective", "boolean", "yes", "not a boolean; write true or false"),
        ("mix", "fg", "BSDF", "white", "not possible here; connect a node with nodename=\"...\""),
    ];
    for (category, name, ty, value, expected) in cases {
        let (text, place) = value_case(category, name, ty, value);
        assert_eq!(error(&text).to_string(), format!("{place}value \"{value}\" is {expected}"));
    }
}

#[test]
fn ranges() {
    const RETRO: &str = "retro_reflective_bsdf";
    const DIELECTRIC: &str = "dielectric_bsdf";
    let cases = [
        (RETRO, "weight", "float", "1.5", "weight is 1.5, outside [0, 1]"),
        (RETRO, "roughness_u", "float", "-0.5", "roughness_u is -0.5, outside [0, inf]"),
        (RETRO, "tint", "color3", "1, 1.1, 1", "tint[1] is 1.1, outside [0, 1]"),
        (RETRO, "tint", "color3", "1, 1, inf", "tint[2] is inf, outside [0, 1]"),
        (RETRO, "multiscatter_tint", "color3", "-1, 0, 0", "multiscatter_tint[0] is -1, outside [0, 1]"),
        (
            RETRO,
            "tangent_u",
            "vector3",
            "inf, 0, 0",
            "tangent_u is inf, 0, 0, not a direction; write one like 1, 0, 0",
        ),
        ("oren_nayar_diffuse_bsdf", "color", "color3", "2, 2, 2", "color is 2, 2, 2, outside [0, 1]"),
        (DIELECTRIC, "ior", "float", "0", "ior is 0, outside (0, inf)"),
        (DIELECTRIC, "ior", "float", "inf", "ior is inf, outside (0, inf)"),
        (DIELECTRIC, "roughness", "vector2", "0.1, 2", "roughness is 0.1, 2, outside [0, 1]"),
        (DIELECTRIC, "distribution", "string", "beckmann", "distribution is \"beckmann\", not one of ggx"),
        (DIELECTRIC, "scatter_mode", "string", "r", "scatter_mode is \"r\", not one of R, T, RT"),
        ("mix", "mix", "float", "-0.1", "mix is -0.1, outside [0, 1]"),
        ("multiply", "in2", "float", "3", "in2 is 3, outside [0, 1]"),
    ];
    for (category, name, ty, value, expected) in cases {
        let (text, place) = value_case(category, name, ty, value);
        assert_eq!(error(&text).to_string(), format!("{place}{expected}"));
    }
}

#[test]
fn connections() {
    let case =
        |attributes: &str| single("add", &format!("<input name=\"in1\" type=\"BSDF\" {attributes} />"));
    let dangling = |attributes: &str| {
        format!(
            "m.mtlx:3:1: add \"bsdf\", input \"in1\": is connected to {attributes}, which doesn't exist; \
             add it or correct the name"
        )
    };
    let attributes = [
        "nodename=\"nowhere\"",
        "nodegraph=\"nowhere\" output=\"out\"",
        "output=\"nowhere\"",
        // Neither a material nor a node is an output or a nodegraph.
        "output=\"s\"",
        "nodegraph=\"bsdf\"",
    ];
    for attributes in attributes {
        assert_eq!(error(&case(attributes)).to_string(), dangling(attributes));
    }
    assert_messages(&[
        (
            "wrong type",
            case("nodename=\"s\""),
            ":3:1: add \"bsdf\", input \"in1\": is of type \"surfaceshader\" by its connection; BSDF is expected",
        ),
        (
            "cycle of one",
            case("nodename=\"bsdf\""),
            ":2:1: add \"bsdf\": feeds itself through \"bsdf\"; break the cycle",
        ),
        (
            "cycle of two",
            case("nodename=\"b\"").replace(
                "</materialx>",
                "<add name=\"b\" type=\"BSDF\"><input name=\"in2\" type=\"BSDF\" nodename=\"bsdf\" /></add></materialx>",
            ),
            ":2:1: add \"bsdf\": feeds itself through \"bsdf\", \"b\"; break the cycle",
        ),
    ]);
}

#[test]
fn hostile_text_stays_on_one_short_line() {
    let long = format!("a&#10;b{}", "x".repeat(4000));
    let input = |attributes: &str| format!("<input name=\"in1\" type=\"BSDF\" {attributes} />");
    let tag = "x".repeat(1 << 20);
    let texts = [
        single("add", &input(&format!("nodename=\"{long}\""))),
        single("add", &input(&format!("value=\"{long}\""))),
        single("add", &format!("<input name=\"{long}\" type=\"BSDF\" />")),
        single("add", "").replace("\"BSDF\"", &format!("\"{long}\"")),
        single(
            "dielectric_bsdf",
            &format!("<input name=\"distribution\" type=\"string\" value=\"{long}\" />"),
        ),
        document("").replace("1.39", &long),
        document("").replace("\"s\"", &format!("\"{long}\"")).replace("\"m\"", &format!("\"{long}\"")),
        document("").replace("surface ", &format!("{tag} ")),
        document("").replace("surface ", &format!("{tag}:a ")),
        document("").replace("name=", "name\n"),
    ];
    for text in texts {
        let message = error(&text).to_string();
        assert!(message.len() < 400 && !message.contains(char::is_control), "{message}");
    }
}

#[test]
fn an_error_gives_its_place_also_to_programs() {
    let error = error(&single("mix", "  <input name=\"mix\" type=\"float\" value=\"2\" />"));
    let place = error.place().unwrap();
    assert_eq!((&*place.file, place.line, place.column), ("m.mtlx", 3, 3));
    assert_eq!(place.element, "mix \"bsdf\", input \"mix\"");
}
