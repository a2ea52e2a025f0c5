//! The README's examples of the command run and print what it shows.

use std::os::unix::fs::symlink;
use std::path::Path;

use crate::run::{Bench, alike};

/// The text blocks of the README, each with the commands before it.
fn examples(readme: &str) -> Vec<(&str, &str)> {
    let blocks = readme.split("```text\n").skip(1).zip(readme.split("```text\n"));
    blocks
        .map(|(after, before)| {
            let (shown, _) = after.split_once("```").unwrap();
            let (_, commands) = before.rsplit_once("```sh\n").unwrap();
            (commands.strip_suffix("```\n").unwrap(), shown)
        })
        .collect()
}

/// The text without the time that rendering took.
fn timeless(text: &str) -> String {
    let without = |line: &str| match line.rsplit_once(", ") {
        Some((rest, time)) if time.ends_with(" s)") => format!("{rest}\n"),
        _ => format!("{line}\n"),
    };
    text.lines().map(without).collect()
}

#[test]
fn every_example_of_the_readme_prints_what_it_shows() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap();
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let examples = examples(&readme);
    assert!(examples.len() >= 6, "the README shows {} examples", examples.len());
    for (commands, shown) in examples {
        let bench = Bench::new();
        symlink(root.join("materials"), bench.path("materials")).unwrap();
        let outcome = bench.shell(&commands.replace("target/release/catseye", "catseye"));
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{commands}");
        assert!(alike(&timeless(shown), &timeless(&outcome.stdout)), "{commands}{}", outcome.stdout);
    }
}
