//! The examples of the README and of the guides run and print what they show.

use std::os::unix::fs::symlink;
use std::path::Path;

use crate::run::{Bench, alike, alike_within};

/// The text blocks of a document, each with the commands before it.
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

/// The photometry guide, from the data sheet to the rendered sign: its steps build on each other.
#[test]
fn the_photometry_guide_leads_from_a_data_sheet_to_a_sign() {
    /// A fit's last printed digit may depend on the mathematical library: four are printed.
    const PRINTED: f64 = 2e-3;
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let guide = std::fs::read_to_string(root.join("docs/photometry.md")).unwrap();
    let steps: Vec<&str> =
        guide.split("```sh\n").skip(1).map(|part| part.split_once("```").unwrap().0).collect();
    let shown = examples(&guide);
    assert_eq!((steps.len(), shown.len()), (5, 4), "five steps, of which the first prints nothing");
    let bench = Bench::new();
    for commands in steps {
        let outcome = bench.shell(&commands.replace("target/release/catseye", "catseye"));
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{commands}");
        let shown = shown.iter().find(|(of, _)| *of == commands).map_or("", |(_, shown)| shown);
        let (shown, printed) = (timeless(shown), timeless(&outcome.stdout));
        assert!(alike_within(&shown, &printed, PRINTED), "{commands}{printed}");
    }
    let left = ["night.png", "sheet.csv", "sign.html", "sign.mtlx", "sign.png", "sign_ra.png"];
    assert_eq!(bench.files(), left);
}
