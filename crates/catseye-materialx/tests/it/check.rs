//! Promise: `check` names every problem of a document in one go, and nothing that is none.

use catseye_materialx::{Document, Library, check, check_bytes};

use crate::support::document;

const FAULTY: &str = r#"<materialx version="1.39">
<hair_bsdf name="hair" type="BSDF" />
<oren_nayar_diffuse_bsdf name="d" type="BSDF">
  <input name="colour" type="color3" value="1, 1, 1" />
  <input name="roughness" type="float" value="2" />
  <input name="color" type="color3" nodename="nowhere" />
</oren_nayar_diffuse_bsdf>
<image name="i" type="color3">
  <input name="file" type="filename" value="missing.png" />
  <input name="texcoord" type="color3" value="1, 1, 1" />
</image>
<add name="a" type="color3"><input name="in1" type="color3" nodename="b" /></add>
<add name="b" type="color3"><input name="in1" type="color3" nodename="a" /></add>
<mix name="m" type="BSDF"><input name="fg" type="BSDF" nodename="a" /></mix>
<add name="m" type="float" />
<xi:include xmlns:xi="http://www.w3.org/2001/XInclude" href="nowhere.mtlx" />
<nodegraph name="g"><sin name="s" type="float"><input name="in" type="float" interfacename="gone" /></sin>
<output name="out" type="float" nodename="t" /></nodegraph>
<look name="l"><materialassign name="x" material="none" geom="/" /></look>
<retro_reflective_bsdf name="r" type="BSDF"><input name="roughness_u" type="float" value="-3" />
<input name="roughness_v" type="float" value="-1" /><input name="tint" type="color3" value="0, 2, 0" /></retro_reflective_bsdf>
<nodegraph name="h"><input name="rough" type="float" value="3" />
<oren_nayar_diffuse_bsdf name="o" type="BSDF"><input name="roughness" type="float" interfacename="rough" /></oren_nayar_diffuse_bsdf>
<retro_sheeting_surface name="s" type="surfaceshader"><input name="coat" type="float" interfacename="rough" /></retro_sheeting_surface></nodegraph>
<nodedef name="ND_n" node="n"><input name="x" type="float" value="5" uimax="4" /><output name="out" type="BSDF" /></nodedef>
</materialx>"#;

#[test]
fn all_problems_at_once() {
    let problems = check_bytes(FAULTY.as_bytes(), "f.mtlx", &Library::default());
    let lines: Vec<String> = problems.iter().map(ToString::to_string).collect();
    let expected = [
        ("f.mtlx:2:1: ", "unknown node category"),
        ("f.mtlx:4:3: ", "no such input"),
        ("f.mtlx:5:3: ", "roughness is 2, outside [0, 1]"),
        ("f.mtlx:6:3: ", "is connected to nodename=\"nowhere\""),
        ("f.mtlx:9:3: ", "there is no file \"missing.png\""),
        ("f.mtlx:10:3: ", "is of type \"color3\"; vector2 is expected"),
        ("f.mtlx:12:1: ", "feeds itself through \"a\", \"b\""),
        ("f.mtlx:14:27: ", "is of type \"color3\" by its connection; BSDF is expected"),
        ("f.mtlx:15:1: ", "the name is already taken in line 14"),
        ("f.mtlx:16:1: ", "there is no file \"nowhere.mtlx\""),
        ("f.mtlx:17:48: ", "interfacename=\"gone\", which doesn't exist"),
        ("f.mtlx:18:1: ", "nodename=\"t\", which doesn't exist"),
        ("f.mtlx:19:16: ", "material=\"none\", which doesn't exist"),
        ("f.mtlx:20:45: ", "roughness_u is -3, outside [0, inf]"),
        ("f.mtlx:21:53: ", "tint[1] is 2, outside [0, 1]"),
        ("f.mtlx:22:21: ", "roughness is 3, outside [0, 1]"),
        ("f.mtlx:22:21: ", "\"coat\" is 3, outside [0] to [1]"),
        ("f.mtlx:25:31: ", "\"x\" is 5, outside [...] to [4]"),
    ];
    for (place, message) in expected {
        let found = lines.iter().any(|line| line.starts_with(place) && line.contains(message));
        assert!(found, "{place}{message} is not among\n{}", lines.join("\n"));
    }
    assert_eq!(lines.len(), expected.len(), "{}", lines.join("\n"));
}

/// Found by fuzzing: only reading the material told.
#[test]
fn graphs_of_the_documents_own_definitions_are_checked_where_they_are_used() {
    let text = r#"<materialx version="1.39">
<nodedef name="ND_mine" node="mine"><output name="out" type="surfaceshader" /></nodedef>
<nodegraph name="NG_mine" nodedef="ND_mine"><unheard_of name="u" type="surfaceshader" />
<output name="out" type="surfaceshader" nodename="u" /></nodegraph>
<mine name="a" type="surfaceshader" />
<mine name="b" type="surfaceshader" />
</materialx>"#;
    let problems = check_bytes(text.as_bytes(), "f.mtlx", &Library::default());
    let lines: Vec<String> = problems.iter().map(ToString::to_string).collect();
    assert_eq!(lines.len(), 1, "{}", lines.join("\n"));
    assert!(
        lines[0].starts_with("f.mtlx:3:45: ") && lines[0].contains("unknown node category"),
        "{}",
        lines[0]
    );
}

#[test]
fn our_own_materials_are_without_problems() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../materials");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "mtlx") {
            let problems = check(&path, &Library::default());
            assert!(problems.is_empty(), "{problems:?}");
        }
    }
}

/// Reading a material and checking its document refuse the same words and integers, with the same text.
#[test]
fn unknown_words_are_refused_by_check_and_by_reading() {
    let cases = [
        ("swizzle", "color3", r#"<input name="channels" type="string" value="rgq" />"#, "channels"),
        ("swizzle", "color3", r#"<input name="channels" type="string" value="rgba" />"#, "channels"),
        ("worleynoise2d", "vector3", r#"<input name="style" type="integer" value="2" />"#, "style"),
        ("image", "color3", r#"<input name="uaddressmode" type="string" value="bogus" />"#, "uaddressmode"),
        ("image", "color3", r#"<input name="filtertype" type="string" value="bogus" />"#, "filtertype"),
        (
            "tiledimage",
            "color3",
            r#"<input name="frameendaction" type="string" value="x" />"#,
            "frameendaction",
        ),
        (
            "place2d",
            "vector2",
            r#"<input name="operationorder" type="integer" value="7" />"#,
            "operationorder",
        ),
        ("normal", "vector3", r#"<input name="space" type="string" value="bogus" />"#, "space"),
        ("tangent", "vector3", r#"<input name="space" type="string" value="bogus" />"#, "space"),
        ("position", "vector3", r#"<input name="space" type="string" value="bogus" />"#, "space"),
        ("viewdirection", "vector3", r#"<input name="space" type="string" value="bogus" />"#, "space"),
        ("extract", "float", r#"<input name="index" type="integer" value="4" />"#, "index"),
        ("fractal2d", "vector3", r#"<input name="octaves" type="integer" value="99" />"#, "octaves"),
        (
            "dielectric_bsdf",
            "BSDF",
            r#"<input name="scatter_mode" type="string" value="X" />"#,
            "scatter_mode",
        ),
    ];
    for (category, ty, input, name) in cases {
        let node = format!(r#"<{category} name="p" type="{ty}">{input}</{category}>"#);
        let nodes = match ty {
            "BSDF" => node.replace("\"p\"", "\"bsdf\""),
            "color3" => format!(
                r#"<oren_nayar_diffuse_bsdf name="bsdf" type="BSDF"><input name="color" type="color3" nodename="p" /></oren_nayar_diffuse_bsdf>{node}"#
            ),
            _ => format!(
                r#"<oren_nayar_diffuse_bsdf name="bsdf" type="BSDF"><input name="color" type="color3" nodename="c" /></oren_nayar_diffuse_bsdf>
                <convert name="c" type="color3"><input name="in" type="{ty}" nodename="p" /></convert>{node}"#
            ),
        };
        let text = document(&nodes);
        let problems = check_bytes(text.as_bytes(), "m.mtlx", &Library::default());
        let read = Document::parse(&text, "m.mtlx").unwrap().material(None).expect_err(&text);
        let found: Vec<String> = problems.iter().map(ToString::to_string).collect();
        assert_eq!(found, [read.to_string()], "{category}");
        assert!(found[0].contains(&format!("input \"{name}\": {name} is ")), "{}", found[0]);
    }
}
