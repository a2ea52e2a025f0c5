//! Promise: `check` names every problem of a document in one go, and nothing that is none.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use catseye_materialx::{Document, Error, Finding, Library, Report, Severity, check, check_bytes};

use crate::support::{document, single};

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
    let report = check_bytes(FAULTY.as_bytes(), "f.mtlx", &Library::default());
    let lines: Vec<String> = report.findings.iter().map(ToString::to_string).collect();
    let expected = [
        ("f.mtlx: warning: ", "has no <surfacematerial>"),
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
        ("f.mtlx:22:21: warning: ", "\"coat\" is 3, outside the usual [0] to [1]"),
        ("f.mtlx:25:31: warning: ", "\"x\" is 5, outside the usual [...] to [4]"),
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
    let report = check_bytes(text.as_bytes(), "f.mtlx", &Library::default());
    let lines: Vec<String> = report.findings.iter().map(ToString::to_string).collect();
    assert_eq!(lines.len(), 2, "{}", lines.join("\n"));
    assert!(
        lines[1].starts_with("f.mtlx:3:45: ") && lines[1].contains("unknown node category"),
        "{}",
        lines[1]
    );
}

#[test]
fn our_own_materials_are_without_problems() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../materials");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "mtlx") {
            let report = check(&path, &Library::default());
            assert!(report.findings.is_empty(), "{report:?}");
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
        let report = check_bytes(text.as_bytes(), "m.mtlx", &Library::default());
        let read = Document::parse(&text, "m.mtlx").unwrap().material(None).expect_err(&text);
        let found: Vec<String> = report.findings.iter().map(ToString::to_string).collect();
        assert_eq!(found, [read.to_string()], "{category}");
        assert!(found[0].contains(&format!("input \"{name}\": {name} is ")), "{}", found[0]);
    }
}

/// Whether everything that `render` may be asked for is read.
fn is_read(document: Result<Document, Error>) -> Result<(), String> {
    let text = |error: Error| error.to_string();
    let document = document.map_err(text)?;
    document.looks().map_err(text)?;
    for name in document.material_names() {
        document.material(Some(&name)).map_err(text)?;
    }
    document.materials().map(|_| ()).map_err(text)
}

fn assert_agree(name: &str, report: &Report, read: &Result<(), String>) {
    // Without a material the nodes are judged, which reading does not.
    const NO_MATERIAL: &str = "has no <surfacematerial>; add one and connect its surfaceshader";
    if read.as_ref().is_err_and(|message| message.ends_with(NO_MATERIAL)) {
        let is_told =
            |finding: &Finding| finding.message == NO_MATERIAL && finding.severity == Severity::Warning;
        assert!(report.findings.iter().any(is_told), "{name}: {report:#?}");
        return;
    }
    assert_eq!(report.has_errors(), read.is_err(), "{name}: {read:?}, but\n{report:#?}");
    if let Err(message) = read {
        let told = report.findings.iter().any(|finding| finding.to_string() == *message);
        // A cycle is told from where it is first seen.
        assert!(told || message.contains("feeds itself"), "{name}: {message} is not among\n{report:#?}");
    }
}

fn documents(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{error}")).flatten() {
        let path = entry.path();
        if path.is_dir() && path.file_name().is_some_and(|name| name != "target" && name != ".git") {
            documents(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "mtlx") {
            found.push(path);
        }
    }
}

#[test]
fn check_and_reading_give_the_same_verdict_on_every_document() {
    let mut found = Vec::new();
    documents(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")), &mut found);
    assert!(found.len() > 20);
    let library = Arc::default();
    for path in found {
        let report = check(&path, &library);
        assert_agree(&path.to_string_lossy(), &report, &is_read(Document::load_with(&path, &library)));
    }
}

/// What `check` missed and `render` refused, or the other way round.
#[test]
fn check_and_reading_give_the_same_verdict_where_they_did_not() {
    let add = |i: usize, last: usize| {
        let input = |name| format!("<input name=\"{name}\" type=\"BSDF\" nodename=\"a{}\" />", i + 1);
        let inputs = if i < last { input("in1") + &input("in2") } else { String::new() };
        format!("<add name=\"a{i}\" type=\"BSDF\">{inputs}</add>")
    };
    let bomb: String = (0..60).map(|i| add(i, 59)).collect();
    let top = "<add name=\"bsdf\" type=\"BSDF\"><input name=\"in1\" type=\"BSDF\" nodename=\"a0\" /></add>";
    let sine = |i| {
        let (name, ty) = (format!("s{i}"), "type=\"float\"");
        format!("<sin name=\"{name}\" {ty}><input name=\"in\" {ty} nodename=\"s{}\" /></sin>", i + 1)
    };
    let chain: String = (0..300).map(sine).collect();
    let rough = "<oren_nayar_diffuse_bsdf name=\"bsdf\" type=\"BSDF\">\
                 <input name=\"roughness\" type=\"float\" nodename=\"s0\" /></oren_nayar_diffuse_bsdf>";
    let own = |inner: &str| {
        format!(
            "<nodedef name=\"ND_n\" node=\"n\"><output name=\"out\" type=\"BSDF\" /></nodedef>\
             <nodegraph name=\"NG_n\" nodedef=\"ND_n\"><{inner} name=\"i\" type=\"BSDF\" />\
             <output name=\"out\" type=\"BSDF\" nodename=\"i\" /></nodegraph>\
             <nodedef name=\"ND_o\" node=\"o\"><output name=\"out\" type=\"BSDF\" /></nodedef>\
             <nodegraph name=\"NG_o\" nodedef=\"ND_o\"><n name=\"i\" type=\"BSDF\" />\
             <output name=\"out\" type=\"BSDF\" nodename=\"i\" /></nodegraph><n name=\"bsdf\" type=\"BSDF\" />"
        )
    };
    let cases = [
        ("warning", "<materialx version=\"1.39\" />".to_owned(), "has no <surfacematerial>"),
        (
            "warning",
            "<materialx version=\"1.39\"><add name=\"a\" type=\"BSDF\" /></materialx>".to_owned(),
            "has no",
        ),
        (
            "",
            "<materialx version=\"1.39\"><unheard_of name=\"u\" type=\"float\" /></materialx>".to_owned(),
            "unknown node",
        ),
        (
            "",
            "<materialx version=\"1.39\"><surfacematerial name=\"m\" type=\"material\" /></materialx>"
                .to_owned(),
            "has no surfaceshader",
        ),
        ("", document(&(bomb + top)), "more than 65536 closures"),
        (
            "",
            document(&format!("{rough}{chain}<constant name=\"s300\" type=\"float\" />")),
            "more than 200 pattern nodes in a chain",
        ),
        ("", document(&own("n")), "n \"i\": feeds itself through \"n\""),
        ("", document(&own("o")), "n \"i\": feeds itself through \"o\", \"n\""),
        (
            "warning",
            document("<add name=\"bsdf\" type=\"BSDF\" /><unheard_of name=\"u\" type=\"float\" />"),
            "unknown node",
        ),
        (
            "warning",
            single(
                "retro_reflective_bsdf",
                "<input name=\"tangent_u\" type=\"vector3\" value=\"0, 1, 0\" />",
            ),
            "MaterialX ignores a value here; connect a node, as in constant",
        ),
        (
            "warning",
            single("dielectric_bsdf", "<input name=\"normal\" type=\"vector3\" value=\"0, 0, 0\" />"),
            "MaterialX ignores a value here",
        ),
        (
            "warning",
            document(
                "<retro_reflective_bsdf name=\"r\" type=\"BSDF\" /><layer name=\"bsdf\" type=\"BSDF\">\
                 <input name=\"top\" type=\"BSDF\" nodename=\"r\" /></layer>",
            ),
            "use mix or add",
        ),
    ];
    for (kind, text, expected) in cases {
        let report = check_bytes(text.as_bytes(), "m.mtlx", &Library::default());
        assert_agree(expected, &report, &is_read(Document::parse(&text, "m.mtlx")));
        let lines: Vec<String> = report.findings.iter().map(ToString::to_string).collect();
        let told = lines.iter().any(|line| line.contains(expected) && line.contains(kind));
        assert!(told && report.has_errors() == kind.is_empty(), "{expected}: {lines:?}");
    }
}

#[test]
fn pictures_that_are_cut_off_are_found() {
    let folder = tempfile::tempdir().unwrap();
    let pictures = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/pictures"));
    for name in ["rgb8.png", "rgb.jpg", "rgba_float.exr", "rgb8_lzw.tif"] {
        let bytes = std::fs::read(pictures.join(name)).unwrap();
        std::fs::write(folder.path().join(name), &bytes[..bytes.len() / 2]).unwrap();
        let image = format!(
            "<image name=\"p\" type=\"color3\"><input name=\"file\" type=\"filename\" value=\"{name}\" /></image>"
        );
        let path = folder.path().join("m.mtlx");
        let lobe = "<oren_nayar_diffuse_bsdf name=\"bsdf\" type=\"BSDF\">\
                    <input name=\"color\" type=\"color3\" nodename=\"p\" /></oren_nayar_diffuse_bsdf>";
        std::fs::write(&path, document(&format!("{lobe}{image}"))).unwrap();
        let report = check(&path, &Library::default());
        assert!(report.has_errors(), "{name}");
        assert_agree(name, &report, &is_read(Document::load(&path)));
    }
}

#[test]
fn what_is_not_listed_is_counted() {
    let twice: String = (0..1000).map(|_| "<add name=\"bsdf\" type=\"BSDF\" />").collect();
    let report = check_bytes(document(&twice).as_bytes(), "m.mtlx", &Library::default());
    assert_eq!((report.findings.len(), report.more), (50, 949));
}
