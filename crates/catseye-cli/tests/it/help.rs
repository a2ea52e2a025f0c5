//! Every verb explains itself, and its examples run and print what they show.

use crate::run::{Bench, alike, output};

/// Every verb, and every verb of a verb, as the command lists them itself.
pub(crate) fn verbs() -> Vec<String> {
    fn below(verb: &str) -> Vec<String> {
        let help = output(&format!("{verb} --help"), "");
        let Some((_, listed)) = help.split_once("Commands:\n") else { return vec![verb.to_owned()] };
        let names = listed.lines().take_while(|line| !line.is_empty());
        // Further lines of a description are indented more.
        let names = names.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
        let names = names.filter(|name| !name.is_empty() && *name != "help");
        let own = (!verb.is_empty()).then(|| verb.to_owned());
        own.into_iter().chain(names.flat_map(|name| below(format!("{verb} {name}").trim()))).collect()
    }
    let verbs = below("");
    assert!(verbs.len() >= 19 && verbs.contains(&"plot lobe".to_owned()), "{verbs:?}");
    verbs
}

#[test]
fn every_verb_has_help_with_an_example() {
    for verb in verbs() {
        for flag in ["--help", "-h"] {
            let text = output(&format!("{verb} {flag}"), "");
            assert!(
                text.contains("Usage: catseye") && text.contains("Example:\n  $ "),
                "{verb} {flag}: {text}"
            );
        }
    }
    assert!(output("--version", "").starts_with("catseye "));
    assert!(output("--help", "").contains("Exit codes: 0 done, 1 failed, 2 used wrongly"));
}

#[test]
fn every_example_prints_what_it_shows() {
    for verb in verbs() {
        let text = output(&format!("{verb} --help"), "");
        let (_, examples) = text.split_once("Example:\n").unwrap();
        // Later examples may need what earlier ones wrote.
        let bench = Bench::with_materials();
        for example in examples.split("$ ").skip(1) {
            let mut lines = example.lines().map(str::trim);
            let command = lines.next().unwrap();
            // A whole picture takes a minute.
            if command.starts_with("catseye render materials/") {
                continue;
            }
            let outcome = bench.shell(command);
            assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{command}");
            // Output with timings or of many lines is not shown.
            let expected: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
            if expected.is_empty() {
                continue;
            }
            let printed: Vec<&str> = outcome.stdout.lines().map(str::trim).collect();
            assert!(alike(&expected.join("\n"), &printed.join("\n")), "{command}\n{}", outcome.stdout);
        }
    }
}
