//! Promise: the node definition, Rust's defaults and the documentation's table say the same, and the
//! generated files are fresh.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::fs;
use std::path::{Path, PathBuf};

use catseye::Params;
use roxmltree::Document;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Name, type and default of every input of a definition; a default that is a geometric property is given by
/// its name.
fn ports(nodedef: &str) -> Vec<[String; 3]> {
    let path = root().join("crates/catseye-materialx/libraries/catseye/catseye_defs.mtlx");
    let text = fs::read_to_string(path).unwrap();
    let document = Document::parse(&text).unwrap();
    let definition = document.descendants().find(|node| node.attribute("name") == Some(nodedef)).unwrap();
    let inputs = definition.children().filter(|node| node.has_tag_name("input"));
    inputs
        .map(|input| {
            let default = input.attribute("value").or(input.attribute("defaultgeomprop")).unwrap();
            [input.attribute("name").unwrap(), input.attribute("type").unwrap(), default].map(str::to_owned)
        })
        .collect()
}

#[test]
fn defaults_are_those_of_params() {
    let Params { roughness_u, roughness_v, tint, multiscatter_tint, .. } = Params::<f64>::default();
    assert_eq!(roughness_v, None, "the library writes this as a negative value");
    let float = |x: f64| format!("{x:?}");
    let color = |[r, g, b]: [f64; 3]| format!("{r:?}, {g:?}, {b:?}");
    let expected = [
        ["weight", "float", "1.0"].map(str::to_owned),
        ["roughness_u".into(), "float".into(), float(roughness_u)],
        ["roughness_v", "float", "-1.0"].map(str::to_owned),
        ["tint".into(), "color3".into(), color(tint)],
        ["multiscatter_tint".into(), "color3".into(), color(multiscatter_tint)],
        ["normal", "vector3", "Nworld"].map(str::to_owned),
        ["tangent_u", "vector3", "Tworld"].map(str::to_owned),
    ];
    assert_eq!(ports("ND_retro_reflective_bsdf"), expected);
}

/// Rows `| `name` | description | type | default | ...` below the heading of a node.
fn documented(node: &str) -> Vec<[String; 3]> {
    let text = fs::read_to_string(root().join("docs/specification.md")).unwrap();
    let section = text.split(&format!("### `{node}`")).nth(1).unwrap();
    let section = section.split("\n### ").next().unwrap();
    let rows = section.lines().filter_map(|line| line.strip_prefix("|`"));
    rows.map(|row| {
        let cells: Vec<&str> = row.split('|').map(|cell| cell.trim().trim_matches('`')).collect();
        [cells[0], cells[2], cells[3]].map(|cell| cell.trim_matches('_').to_owned())
    })
    .collect()
}

#[test]
fn the_specification_has_the_same_ports() {
    for node in ["retro_reflective_bsdf", "retro_sheeting_surface"] {
        let documented: Vec<_> = documented(node).into_iter().filter(|[name, ..]| name != "out").collect();
        assert_eq!(documented, ports(&format!("ND_{node}")), "{node}");
    }
}
