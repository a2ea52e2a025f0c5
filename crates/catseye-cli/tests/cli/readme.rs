//! The README's examples of the command run and print what it shows.

use std::os::unix::fs::symlink;
use std::path::Path;

use crate::run::Bench;

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

/// A line without the time that rendering took.
fn timeless(line: &str) -> &str {
    if line.ends_with(" s)") { line.rsplit_once(',').unwrap().0 } else { line }
}

/// Equal texts; numbers up to the rounding that another machine's mathematical functions may do.
fn alike(shown: &str, printed: &str) -> bool {
    let words = |text: &str| -> Vec<String> {
        text.lines().map(timeless).flat_map(|line| line.split([',', ':', ' ', '}'])).map(str::to_owned).collect()
    };
    let same = |(a, b): (&String, &String)| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= 1e-9 * a.abs(),
        _ => a == b,
    };
    let (a, b) = (words(shown), words(printed));
    a.len() == b.len() && a.iter().zip(&b).all(same)
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
        assert!(alike(shown, &outcome.stdout), "{commands}{}", outcome.stdout);
    }
}
