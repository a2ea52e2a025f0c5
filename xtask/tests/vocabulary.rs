//! One name for one thing in all languages: the table in docs/theory.md, section 12, and the sources.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

const PREFIX: &str = "mx_retro_reflective_";
const LIBRARY: &str = "crates/catseye-materialx/libraries/catseye";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// All files below a folder whose names end so.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    paths
        .flat_map(|path| if path.is_dir() { files(&path, ending) } else { vec![path] })
        .filter(|path| path.to_str().unwrap().ends_with(ending))
        .collect()
}

fn text(folder: &str, ending: &str) -> String {
    let files = files(&root().join(folder), ending);
    assert!(!files.is_empty(), "{folder} has no {ending}");
    files.iter().map(|file| fs::read_to_string(file).unwrap()).collect()
}

/// The functions of the library that a shading language's sources define, without the prefix.
fn shading(language: &str, ending: &str) -> BTreeSet<String> {
    let text = text(&format!("{LIBRARY}/{language}"), ending);
    let definition = |line: &str| {
        let (kind, rest) = line.split_once(' ')?;
        let name = rest.strip_prefix(PREFIX)?.split_once('(')?.0;
        (!kind.starts_with("//") && kind != "return").then(|| name.to_owned())
    };
    text.lines().filter_map(definition).collect()
}

/// The functions of the BSDF.
fn rust() -> BTreeSet<String> {
    let text = text("crates/catseye/src", ".rs");
    let name = |part: &str| part.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap().to_owned();
    text.split("fn ").skip(1).map(name).collect()
}

#[test]
fn names_agree_in_all_languages() {
    let theory = fs::read_to_string(root().join("docs/theory.md")).unwrap();
    let section = theory.split("\n## ").find(|section| section.starts_with("12.")).unwrap();
    let rows: Vec<Vec<&str>> = section
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    let languages = [rust(), shading("genglsl", ".glsl"), shading("genosl", ".osl")];
    for row in &rows {
        let name = row[0].trim_matches('`');
        for (language, column) in languages.iter().zip(&row[2..]) {
            assert_eq!(language.contains(name), *column == "x", "{name}: {row:?}");
        }
    }
    let told: BTreeSet<_> = rows.iter().map(|row| row[0].trim_matches('`').to_owned()).collect();
    for language in &languages[1..] {
        let untold: Vec<_> = language.difference(&told).collect();
        assert!(untold.is_empty(), "not in the table of docs/theory.md, section 12: {untold:?}");
    }
}
