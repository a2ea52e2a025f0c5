//! The completions and the manual name every verb and every option.

use crate::help::verbs;
use crate::run::output;

#[test]
fn completions_name_every_verb_and_option() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = output(&format!("completions {shell}"), "");
        for verb in verbs() {
            let name = verb.rsplit(' ').next().unwrap();
            assert!(script.contains(name), "{shell}: {verb}");
        }
        assert!(script.contains("roughness") && script.contains("multiscatter-tint"), "{shell}");
    }
}

#[test]
fn a_shell_reads_its_completions() {
    let bench = crate::run::Bench::new();
    let run = bench.shell("catseye completions bash > c.bash && bash -c '. ./c.bash && complete -p catseye'");
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(run.stdout.contains("catseye"), "{}", run.stdout);
}

#[test]
fn every_verb_has_a_page_with_its_options() {
    for verb in verbs() {
        let page = output(&format!("man {verb}"), "");
        let title = format!("catseye-{}", verb.replace(' ', "-"));
        assert!(page.contains(&title.replace('-', "\\-")), "{verb}: {page:.300}");
        let help = output(&format!("{verb} --help"), "");
        let options = help.lines().filter_map(|line| line.trim_start().split_once("--"));
        for (before, option) in options.filter(|(before, _)| before.is_empty() || before.ends_with(", ")) {
            let name = option.split([' ', '=', '[']).next().unwrap();
            assert!(
                page.contains(&format!("\\-\\-{}", name.replace('-', "\\-"))),
                "{verb}: {before}--{name}"
            );
        }
    }
    let page = output("man", "");
    assert!(page.contains(".TH catseye 1"), "{page:.200}");
}
