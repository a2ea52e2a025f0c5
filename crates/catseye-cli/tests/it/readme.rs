//! The examples of the README and of the guides in docs/ run and print what they show.

use std::os::unix::fs::symlink;
use std::path::Path;

use crate::run::{Bench, alike_within};

/// How far printed numbers may be from those that are shown: another machine's mathematical library rounds
/// otherwise.
const ROUNDING: f64 = 1e-9;
/// The same behind a fit, which passes a difference in the last digit on.
const FITTED: f64 = 2e-3;

/// The commands of a document, block by block, with the output that is shown below each.
fn steps(text: &str) -> Vec<(&str, &str)> {
    let step = |part| {
        let (commands, rest) = str::split_once(part, "```").unwrap();
        let shown = rest.strip_prefix("\n```text\n").and_then(|shown| shown.split_once("```"));
        (commands, shown.map_or("", |(shown, _)| shown))
    };
    text.split("```sh\n").skip(1).map(step).collect()
}

/// The text without the time that rendering took.
fn timeless(text: &str) -> String {
    let without = |line: &str| match line.rsplit_once(", ") {
        Some((rest, time)) if time.ends_with(" s)") => format!("{rest}\n"),
        _ => format!("{line}\n"),
    };
    text.lines().map(without).collect()
}

/// Runs a document's commands one after the other in one folder, and gives the names of the files that they
/// leave.
///
/// Commands for cargo are left to cargo. Where nothing is shown, anything may be printed.
fn run(document: &str, share: f64) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap();
    let text = std::fs::read_to_string(root.join(document)).unwrap();
    let bench = Bench::new();
    symlink(root.join("materials"), bench.path("materials")).unwrap();
    let ours: Vec<_> =
        steps(&text).into_iter().filter(|(commands, _)| !commands.contains("cargo ")).collect();
    assert!(!ours.is_empty(), "{document} has examples");
    for (commands, shown) in ours {
        let outcome = bench.shell(&commands.replace("target/release/catseye", "catseye"));
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{document}: {commands}");
        let (shown, printed) = (timeless(shown), timeless(&outcome.stdout));
        assert!(shown.is_empty() || alike_within(&shown, &printed, share), "{document}: {commands}{printed}");
    }
    bench.files()
}

#[test]
fn the_readme() {
    run("README.md", FITTED);
}

#[test]
fn the_guide_to_the_command() {
    run("docs/command.md", ROUNDING);
}

#[test]
fn the_notes_on_optics() {
    run("docs/optics.md", ROUNDING);
}

/// From the data sheet to the rendered sign: the steps build on each other.
#[test]
fn the_guide_to_photometry() {
    let left = ["materials", "night.png", "sheet.csv", "sign.html", "sign.mtlx", "sign.png", "sign_ra.png"];
    assert_eq!(run("docs/photometry.md", FITTED), left);
}

/// What every target prints, and its files.
#[test]
fn the_guide_to_export() {
    let left = run("docs/export.md", FITTED);
    assert!(
        ["vest.rad", "vest.cal", "vest.csv", "vest.xomp"]
            .iter()
            .all(|file| left.contains(&(*file).to_owned()))
    );
}

#[test]
fn the_guide_to_signs_and_lidars() {
    assert_eq!(run("docs/drive.md", ROUNDING), ["drive.png", "lamp.ies", "materials"]);
}

#[test]
fn the_guide_to_long_renders() {
    assert_eq!(run("docs/farm.md", ROUNDING), ["a.exr", "b.exr", "c.exr", "materials", "night.png"]);
}
