//! Who may use whom: the table in ARCHITECTURE.md, and what Cargo says.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

type Uses = BTreeMap<String, BTreeSet<String>>;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// The packages of the workspace as Cargo describes them.
fn packages() -> Vec<Value> {
    let mut command = Command::new(env!("CARGO"));
    command.args(["metadata", "--no-deps", "--offline", "--format-version", "1"]).current_dir(root());
    let metadata: Value = serde_json::from_slice(&command.output().unwrap().stdout).unwrap();
    metadata["packages"].as_array().unwrap().clone()
}

fn dependencies(package: &Value) -> impl Iterator<Item = &Value> {
    package["dependencies"].as_array().unwrap().iter()
}

fn name(value: &Value) -> String {
    value["name"].as_str().unwrap().to_owned()
}

/// What each crate uses of the workspace, also in its tests.
fn actual(packages: &[Value]) -> Uses {
    let members: BTreeSet<String> = packages.iter().map(name).collect();
    packages
        .iter()
        .map(|p| (name(p), dependencies(p).map(name).filter(|n| members.contains(n)).collect()))
        .collect()
}

/// The rows ``| `crate` | `crate`, `crate` |`` below "May use" in ARCHITECTURE.md.
fn allowed() -> Uses {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let rows = text.lines().skip_while(|line| !line.contains("| may use |")).skip(2);
    let names = |cell: &str| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>();
    rows.take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells: Vec<&str> = line.split('|').collect();
            (names(cells[1]).remove(0), names(cells[2]).into_iter().collect())
        })
        .collect()
}

#[test]
fn crates_use_what_the_architecture_allows() {
    let (actual, allowed) = (actual(&packages()), allowed());
    assert!(
        actual.keys().eq(allowed.keys()),
        "ARCHITECTURE.md lists {:?}, there are {:?}",
        allowed.keys(),
        actual.keys()
    );
    for (name, uses) in &actual {
        let forbidden: Vec<_> = uses.difference(&allowed[name]).collect();
        assert!(forbidden.is_empty(), "{name} uses {forbidden:?}; ARCHITECTURE.md does not allow it");
    }
}

#[test]
fn the_bsdf_needs_no_other_crate() {
    let packages = packages();
    let bsdf = packages.iter().find(|p| p["name"] == "catseye").unwrap();
    let required: Vec<_> =
        dependencies(bsdf).filter(|d| d["kind"].is_null() && d["optional"] == false).collect();
    assert!(required.is_empty(), "catseye depends on {required:?}");
}

#[test]
fn a_crate_lies_in_the_folder_of_its_name() {
    for package in packages() {
        let manifest = package["manifest_path"].as_str().unwrap().to_owned();
        let folder = Path::new(&manifest).parent().unwrap();
        assert_eq!(folder.file_name().unwrap().to_str().unwrap(), name(&package));
    }
}
