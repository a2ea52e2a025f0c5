//! Promise: no document, however hostile, panics, overflows the stack, or takes more than bounded time and
//! memory.

use std::time::{Duration, Instant};

use catseye_materialx::{Closure, Document, Error, Material};
use proptest::{
    prelude::*,
    test_runner::{FileFailurePersistence, RngSeed},
};

use crate::support::{document, single};

/// Each of the worst documents takes well below a second; the rest is room for a loaded machine.
const MOST_TIME: Duration = Duration::from_secs(10);

fn read(bytes: &[u8]) -> Result<Vec<Material>, Error> {
    let start = Instant::now();
    let materials = Document::from_bytes(bytes, "hostile.mtlx").and_then(|document| document.materials());
    let time = start.elapsed();
    assert!(time < MOST_TIME, "{} bytes took {time:?}", bytes.len());
    materials
}

fn assert_refused(text: &str, expected: &str) {
    let message = read(text.as_bytes()).expect_err(expected).to_string();
    assert!(message.ends_with(expected), "{message}\nlacks {expected}");
    assert!(message.len() < 400 && !message.contains(char::is_control), "{message}");
}

fn repeated(count: usize, part: impl FnMut(usize) -> String) -> String {
    (0..count).map(part).collect()
}

#[test]
fn entities_are_refused_before_they_are_expanded() {
    let levels = repeated(10, |i| format!("<!ENTITY e{}  \"{}\">", i + 1, format!("&e{i};").repeat(10)));
    let bomb = format!("<!DOCTYPE m [<!ENTITY e0 \"ha\">{levels}]>\n<materialx version=\"&e10;\"/>");
    assert_refused(&bomb, ":1:1: document type declarations are refused; remove <!DOCTYPE ...>");
    let file = "<?xml version=\"1.0\"?>\n<!DOCTYPE m [<!ENTITY x SYSTEM \"/etc/passwd\">]><materialx version=\"&x;\"/>";
    assert_refused(file, ":2:1: document type declarations are refused; remove <!DOCTYPE ...>");
}

/// Found by fuzzing.
#[test]
fn names_of_the_document_in_messages_are_printable_and_short() {
    let long = format!("\u{7f}{}", "n".repeat(4_000));
    let inputs = repeated(100, |i| format!("<input name='{i}{long}' type='{long}'/>"));
    let text = |output: &str, input: &str| {
        format!(
            "<materialx version='1.39'><nodedef name='ND' node='mine'><output name='out' type='{output}'/>\
             <input name='known' type='{long}'/>{inputs}</nodedef>\
             <mine name='a' type='surfaceshader'><input name='{input}' type='float' value='1'/></mine>\
             <surfacematerial name='m' type='material'><input name='surfaceshader' type='surfaceshader' nodename='a'/>\
             </surfacematerial></materialx>"
        )
    };
    for (output, input, expected) in [
        ("surfaceshader", "other", "no such input; mine has known, 0\\u{7f}nnn"),
        ("surfaceshader", "known", "is of type \"float\"; \\u{7f}nnn"),
        (&long, "known", "is of type \"surfaceshader\"; \\u{7f}nnn"),
    ] {
        let message = read(text(output, input).as_bytes()).expect_err(expected).to_string();
        assert!(message.contains(expected), "{message}");
        assert!(message.len() < 2000 && !message.contains(char::is_control), "{message}");
    }
}

#[test]
fn nesting_is_bounded() {
    for count in [33, 10_000, 200_000] {
        let text = format!("{}{}", "<materialx>".repeat(count), "</materialx>".repeat(count));
        assert_refused(
            &text,
            "more than 32 levels of elements inside elements; simplify or split the document",
        );
    }
    let text = "<a>".repeat(5_000_000);
    assert_refused(&text, "more than 500000 XML nodes; simplify or split the document");
}

#[test]
fn what_the_parser_needs_quadratic_time_for_is_refused() {
    let attributes = repeated(1_000_000, |i| format!(" a{i}=''"));
    let limit = "more than 256 quotes before the next <; simplify or split the document";
    assert_refused(&format!("<materialx{attributes}/>"), limit);
    let namespaces = repeated(65_000, |i| format!("<a xmlns:n{i}='{i}'>"));
    let limit = "more than 64 namespace declarations; simplify or split the document";
    assert_refused(&namespaces, limit);
}

#[test]
fn the_worst_that_the_limits_let_through_is_quick() {
    let attributes = repeated(127, |i| format!(" a{i:x}=''"));
    let elements = format!("<a{attributes}/>").repeat(18_000);
    let text = document(&format!("<add name=\"bsdf\" type=\"BSDF\"/>{elements}"));
    assert!(text.len() < 16 << 20);
    read(text.as_bytes()).unwrap();

    let materials = repeated(60_000, |i| {
        format!(
            "<surfacematerial name=\"m{i}\" type=\"material\"><input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"s\"/></surfacematerial>"
        )
    });
    let text = document(&format!("<add name=\"bsdf\" type=\"BSDF\"/>{materials}"));
    assert_eq!(read(text.as_bytes()).unwrap().len(), 60_001);
}

/// Each material has a program of its own: 10,000 instructions a time, 2,000 times, were a gigabyte.
#[test]
fn programs_of_many_materials_are_bounded() {
    let input = |i: usize| match i {
        0 => String::new(),
        i => format!("<input name='position' type='vector3' nodename='n{}'/>", i - 1),
    };
    let octaves = "<input name='octaves' type='integer' value='16'/>";
    let nodes =
        repeated(150, |i| format!("<fractal3d name='n{i}' type='vector3'>{}{octaves}</fractal3d>", input(i)));
    let bsdf = "<oren_nayar_diffuse_bsdf name='bsdf' type='BSDF'><input name='normal' type='vector3' nodename='n149'/>\
                </oren_nayar_diffuse_bsdf>";
    let materials = repeated(2_000, |i| {
        format!(
            "<surfacematerial name='m{i}' type='material'><input name='surfaceshader' type='surfaceshader' nodename='s'/></surfacematerial>"
        )
    });
    let limit =
        "more than 1048576 pattern instructions of all materials together; simplify or split the document";
    assert_refused(&document(&format!("{nodes}{bsdf}{materials}")), limit);
    let outputs = repeated(2_000, |i| format!("<output name='o{i}' type='vector3' nodename='n149'/>"));
    let document = Document::parse(&document(&format!("{nodes}{bsdf}{outputs}")), "hostile.mtlx").unwrap();
    let message = document.outputs().unwrap_err().to_string();
    assert!(message.ends_with(limit), "{message}");
}

#[test]
fn long_attributes_are_refused_except_documentation() {
    let long = "x".repeat(5000);
    read(single("add", "").replace("<add", &format!("<add doc=\"{long}\"")).as_bytes()).unwrap();
    let limit = ":2:1: more than 4096 bytes in an attribute; simplify or split the document";
    assert_refused(&single("add", "").replace("<add", &format!("<add uiname=\"{long}\"")), limit);
}

/// `add` nodes `bsdf`, `n1`, `n2`, ... with every one feeding the one before.
fn chain(length: usize, inputs: &[&str]) -> String {
    let name = |i: usize| if i == 0 { "bsdf".to_owned() } else { format!("n{i}") };
    let input =
        |input: &str, i| format!("<input name=\"{input}\" type=\"BSDF\" nodename=\"{}\"/>", name(i + 1));
    let nodes = repeated(length - 1, |i| {
        let inputs: String = inputs.iter().map(|name| input(name, i)).collect();
        format!("<add name=\"{}\" type=\"BSDF\">{inputs}</add>\n", name(i))
    });
    document(&format!("{nodes}<add name=\"{}\" type=\"BSDF\"/>", name(length - 1)))
}

#[test]
fn chains_are_bounded() {
    let [material] = read(chain(64, &["in1"]).as_bytes()).unwrap().try_into().unwrap();
    assert_eq!(depth(&material.surface.bsdf), 64);
    let limit = "more than 64 BSDF nodes in a chain; simplify or split the document";
    assert_refused(&chain(65, &["in1"]), &format!("add \"n64\": {limit}"));
    assert_refused(&chain(50_000, &["in1"]), &format!("add \"n64\": {limit}"));
}

#[test]
fn few_nodes_that_make_exponentially_many_closures_are_refused() {
    assert_eq!(read(chain(16, &["in1", "in2"]).as_bytes()).unwrap().len(), 1);
    let limit = "more than 65536 closures in all materials together; simplify or split the document";
    assert_refused(&chain(60, &["in1", "in2"]), limit);
}

fn depth(closure: &Closure) -> usize {
    let children: &[&Closure] = match closure {
        Closure::Mix { foreground, background, .. } => &[foreground, background],
        Closure::Layer { top, base } => &[top, base],
        Closure::Add { a, b } => &[a, b],
        Closure::Multiply { closure, .. } => &[closure],
        Closure::None => return 0,
        _ => &[],
    };
    1 + children.iter().map(|child| depth(child)).max().unwrap_or(0)
}

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 512,
        rng_seed: RngSeed::Fixed(0x0ca7_5e7e),
        failure_persistence: Some(Box::new(FileFailurePersistence::Off)),
        ..ProptestConfig::default()
    }
}

const SHEETING: &str = include_str!("../../../../materials/sheeting.mtlx");
const TAPE: &str = include_str!("../../../../materials/anisotropic_tape.mtlx");

/// Pieces that a parser may stumble over.
const PIECES: &[&str] = &[
    "",
    "\0",
    "<",
    ">",
    "/>",
    "\"",
    "'",
    "&",
    "&amp;",
    "&#0;",
    "&#x10ffff;",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?",
    "<!DOCTYPE",
    "xmlns=\"\"",
    "xml:",
    "\u{feff}",
    "\u{1f9ff}",
    "nan",
    "-inf",
    "1e39",
    "1e-46",
    ",",
    " , ",
    "-",
    "=",
    "nodename",
    "nodegraph",
    "output",
    "value",
    "type",
    "name",
    "BSDF",
    "color3",
    "srgb_texture",
    "materialx",
];

fn mutated() -> impl Strategy<Value = Vec<u8>> {
    let edit = (any::<prop::sample::Index>(), 0_usize..40, prop::sample::select(PIECES));
    let edits = prop::collection::vec(edit, 1..8);
    (prop::sample::select(&[SHEETING, TAPE][..]), edits).prop_map(|(text, edits)| {
        let mut bytes = text.as_bytes().to_vec();
        for (at, length, piece) in edits {
            let start = at.index(bytes.len());
            let end = (start + length).min(bytes.len());
            bytes.splice(start..end, piece.bytes());
        }
        bytes
    })
}

/// Four nodes that combine each other or a leaf: trees, shared nodes, cycles, dangling and mistyped
/// connections.
fn any_graph() -> impl Strategy<Value = String> {
    const NODES: &[(&str, [&str; 2])] = &[
        ("mix", ["fg", "bg"]),
        ("layer", ["top", "base"]),
        ("add", ["in1", "in2"]),
        ("multiply", ["in1", "in1"]),
        ("surface", ["bsdf", "edf"]),
    ];
    const TARGETS: &[&str] = &["leaf", "leaf", "leaf", "n1", "n2", "n3", "bsdf", "s", "nowhere", ""];
    const LEAVES: &[&str] = &["retro_reflective_bsdf", "oren_nayar_diffuse_bsdf", "dielectric_bsdf", "image"];
    let targets = prop::array::uniform2(prop::sample::select(TARGETS));
    let nodes = prop::array::uniform4((prop::sample::select(NODES), targets));
    (nodes, prop::sample::select(LEAVES)).prop_map(|(nodes, leaf)| {
        let nodes: String = (0..).zip(nodes).map(|(i, node)| combining(i, node)).collect();
        document(&format!("{nodes}<{leaf} name=\"leaf\" type=\"BSDF\"/>"))
    })
}

fn combining(i: usize, ((category, inputs), targets): ((&str, [&str; 2]), [&str; 2])) -> String {
    let input =
        |i: usize| format!("<input name=\"{}\" type=\"BSDF\" nodename=\"{}\"/>", inputs[i], targets[i]);
    // A node with the same input twice is an error; most have it once.
    let second = if inputs[0] == inputs[1] && targets[0] != targets[1] { String::new() } else { input(1) };
    let name = if i == 0 { "bsdf".to_owned() } else { format!("n{i}") };
    format!("<{category} name=\"{name}\" type=\"BSDF\">{}{second}</{category}>\n", input(0))
}

/// Whatever was read keeps what closures promise; whatever was not gives one line.
fn check(bytes: &[u8]) -> Result<(), TestCaseError> {
    match read(bytes) {
        Ok(materials) => {
            prop_assert!(!materials.is_empty());
            for material in materials {
                prop_assert!(depth(&material.surface.bsdf) <= 64);
                prop_assert!((0.0..=1.0).contains(&material.surface.opacity));
                check_ranges(&material.surface.bsdf)?;
            }
        }
        Err(error) => {
            let message = error.to_string();
            prop_assert!(
                message.starts_with("hostile.mtlx:") && !message.contains(char::is_control),
                "{message:?}"
            );
            prop_assert!(message.len() < 1000, "{message:?}");
        }
    }
    Ok(())
}

fn check_ranges(closure: &Closure) -> Result<(), TestCaseError> {
    match closure {
        Closure::RetroReflective { params, .. } => prop_assert!(params.validate().is_ok()),
        Closure::OrenNayarDiffuse { color, .. } => {
            prop_assert!(color.iter().all(|channel| (0.0..=1.0).contains(channel)));
        }
        Closure::Mix { foreground, background, amount } => {
            prop_assert!((0.0..=1.0).contains(amount));
            check_ranges(foreground)?;
            check_ranges(background)?;
        }
        _ => {}
    }
    Ok(())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..2000)) {
        check(&bytes)?;
    }

    #[test]
    fn mutated_documents(bytes in mutated()) {
        check(&bytes)?;
    }

    #[test]
    fn any_graphs(text in any_graph()) {
        check(text.as_bytes())?;
    }

    #[test]
    fn any_values(value in "[-+]?[0-9.]{1,4}(e-?[0-9]{1,2})?|[-+.,0-9einfaN ]{0,20}|[0-9.]{1,3}(, [01.]{1,3}){2}") {
        let input = |name, ty| format!("<input name=\"{name}\" type=\"{ty}\" value=\"{value}\"/>");
        check(single("retro_reflective_bsdf", &input("roughness_u", "float")).as_bytes())?;
        check(single("retro_reflective_bsdf", &input("tangent_u", "vector3")).as_bytes())?;
        check(single("oren_nayar_diffuse_bsdf", &input("color", "color3")).as_bytes())?;
    }
}

#[test]
fn interfaces_that_feed_themselves_are_refused() {
    let own = r#"<nodegraph name="g"><input name="x" type="BSDF" nodegraph="g" output="o" />
        <output name="o" type="BSDF" interfacename="x" /></nodegraph>
        <add name="bsdf" type="BSDF"><input name="in1" type="BSDF" nodegraph="g" output="o" /></add>"#;
    let message = read(document(own).as_bytes()).unwrap_err().to_string();
    assert!(message.contains("feeds itself"), "{message}");
    let inside = r#"<nodegraph name="g"><add name="a" type="color3"><input name="in1" type="color3" nodegraph="g" output="o" /></add>
        <output name="o" type="color3" nodename="a" /></nodegraph>
        <oren_nayar_diffuse_bsdf name="bsdf" type="BSDF"><input name="color" type="color3" nodegraph="g" output="o" /></oren_nayar_diffuse_bsdf>"#;
    assert!(read(document(inside).as_bytes()).is_err());
}

#[test]
fn definitions_that_use_each_other_twice_are_bounded() {
    let level = |i: usize| {
        format!(
            r#"<nodedef name="ND_l{i}" node="l{i}"><input name="x" type="color3" value="1, 1, 1" /><output name="out" type="color3" /></nodedef>
            <nodegraph name="NG_l{i}" nodedef="ND_l{i}">
              <l{next} name="a" type="color3"><input name="x" type="color3" interfacename="x" /></l{next}>
              <l{next} name="b" type="color3"><input name="x" type="color3" interfacename="x" /></l{next}>
              <add name="s" type="color3"><input name="in1" type="color3" nodename="a" /><input name="in2" type="color3" nodename="b" /></add>
              <output name="out" type="color3" nodename="s" /></nodegraph>"#,
            next = i + 1
        )
    };
    let text = document(&format!(
        r#"{}<oren_nayar_diffuse_bsdf name="bsdf" type="BSDF"><input name="color" type="color3" nodename="top" /></oren_nayar_diffuse_bsdf>
        <l0 name="top" type="color3" />"#,
        repeated(40, level)
    ));
    let message = read(text.as_bytes()).unwrap_err().to_string();
    assert!(message.contains("more than"), "{message}");
}

#[test]
fn long_chains_of_patterns_are_refused() {
    let nodes = repeated(20_000, |i| {
        format!(
            "<sin name=\"n{i}\" type=\"float\"><input name=\"in\" type=\"float\" nodename=\"n{}\"/></sin>\n",
            i + 1
        )
    });
    let text = document(&format!(
        "{nodes}<oren_nayar_diffuse_bsdf name=\"bsdf\" type=\"BSDF\"><input name=\"roughness\" type=\"float\" nodename=\"n0\"/></oren_nayar_diffuse_bsdf>"
    ));
    assert_refused(&text, "more than 200 pattern nodes in a chain; simplify or split the document");
    let problems = catseye_materialx::check_bytes(
        text.as_bytes(),
        "hostile.mtlx",
        &catseye_materialx::Library::default(),
    );
    assert_eq!(problems.findings.len(), 2, "the last node dangles: {problems:?}");
}

#[test]
fn pictures_of_absurd_size_are_refused_without_being_decoded() {
    let folder = tempfile::tempdir().unwrap();
    // The head of a PNG that claims 2^31 - 1 pixels a side, and of one of 65,536 a side.
    for side in [u32::MAX >> 1, 1 << 16] {
        let mut head = vec![0x89, b'P', b'N', b'G', 13, 10, 26, 10, 0, 0, 0, 13];
        let chunk: Vec<u8> =
            [b"IHDR".as_slice(), &side.to_be_bytes(), &side.to_be_bytes(), &[8, 6, 0, 0, 0]].concat();
        head.extend_from_slice(&chunk);
        head.extend_from_slice(&crc(&chunk).to_be_bytes());
        head.extend_from_slice(&[0, 0, 0, 0]);
        head.extend_from_slice(b"IDAT");
        head.extend_from_slice(&crc(b"IDAT").to_be_bytes());
        std::fs::write(folder.path().join("huge.png"), head).unwrap();
        let nodes = r#"<oren_nayar_diffuse_bsdf name="bsdf" type="BSDF"><input name="color" type="color3" nodename="p" /></oren_nayar_diffuse_bsdf>
            <image name="p" type="color3"><input name="file" type="filename" value="huge.png" /></image>"#;
        let path = folder.path().join("m.mtlx");
        std::fs::write(&path, document(nodes)).unwrap();
        let start = Instant::now();
        let message =
            Document::load(&path).and_then(|document| document.materials()).unwrap_err().to_string();
        assert!(message.contains("the picture \"huge.png\" can't be read"), "{message}");
        assert!(start.elapsed() < MOST_TIME);
        let problems = catseye_materialx::check(&path, &catseye_materialx::Library::default());
        assert!(
            problems.has_errors() && problems.findings[0].to_string().contains("huge.png"),
            "{problems:?}"
        );
    }
}

/// CRC-32 as PNG has it.
fn crc(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(u32::MAX, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), step))
}
