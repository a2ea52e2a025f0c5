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
    let ours = Path::new(env!("CARGO_MANIFEST_DIR")).join("../catseye-materialx/libraries");
    let bench = Bench::new();
    for _ in 0..2 {
        let outcome = bench.catseye("materialx export new/libraries", "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    }
    let exported = bench.path("new/libraries");
    assert_eq!(files(&exported), files(&ours), "list every file in data_library.rs of catseye-materialx");
    for path in files(&ours) {
        assert_eq!(
            fs::read(exported.join(&path)).unwrap(),
            fs::read(ours.join(&path)).unwrap(),
            "{}",
            path.display()
        );
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
