//! The exported library is the repository's, file by file.

use std::fs;
use std::path::{Path, PathBuf};

use crate::run::Bench;

/// Every file under a folder, relative to it, sorted.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() { open.push(path) } else { found.push(path) }
        }
    }
    let mut relative: Vec<_> =
        found.iter().map(|path| path.strip_prefix(folder).unwrap().to_path_buf()).collect();
    relative.sort();
    relative
}

#[test]
fn the_exported_library_is_the_repositorys() {
    let ours = Path::new(env!("CARGO_MANIFEST_DIR")).join("../catseye-materialx");
    let bench = Bench::new();
    for _ in 0..2 {
        let outcome = bench.catseye("materialx export new/nodes", "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    }
    let exported = bench.path("new/nodes");
    for folder in ["libraries", "resources"] {
        let mut wanted = files(&ours.join(folder));
        if folder == "libraries" {
            wanted.push(PathBuf::from("catseye/web/catseye.mjs"));
            wanted.sort();
        }
        let found = files(&exported.join(folder));
        assert_eq!(found, wanted, "list every file in data_library.rs of catseye-materialx");
    }
    for path in files(&exported).iter().filter(|path| !path.ends_with("catseye.mjs")) {
        assert_eq!(
            fs::read_to_string(exported.join(path)).unwrap(),
            fs::read_to_string(ours.join(path)).unwrap(),
            "{}",
            path.display()
        );
    }
}

#[test]
fn the_library_is_licensed_file_by_file() {
    let bench = Bench::new();
    bench.catseye("materialx export .", "");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for path in files(&bench.path("libraries")).iter().chain(&files(&bench.path("resources"))) {
        let name = path.file_name().unwrap().to_str().unwrap();
        let file = ["libraries", "resources"].map(|folder| bench.path(folder).join(path));
        let text = fs::read_to_string(file.iter().find(|file| file.exists()).unwrap()).unwrap();
        if name.starts_with("LICENSE") {
            assert_eq!(text, fs::read_to_string(root.join(name)).unwrap(), "{name}");
        } else if name != "README.md" {
            let head: Vec<_> = text.lines().take(5).collect();
            assert!(head.iter().any(|line| line.contains("SPDX-License-Identifier")), "{}", path.display());
        }
    }
}

#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let bench = Bench::new();
    bench.write("file", "");
    let outcome = bench.catseye("materialx export file", "");
    assert_eq!(outcome.code, 1);
    assert!(outcome.stderr.contains("file: the folder can't be made"), "{}", outcome.stderr);
}
