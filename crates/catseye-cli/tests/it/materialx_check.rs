//! `materialx check` prints every problem with its place and fails.

use crate::run::Bench;

#[test]
fn every_problem_is_a_line_and_the_exit_code_is_1() {
    let bench = Bench::new();
    bench.write(
        "bad.mtlx",
        "<materialx version=\"1.39\">\n<add name=\"a\" type=\"BSDF\"><input name=\"in1\" type=\"BSDF\" nodename=\"gone\" /></add>\n\
         <image name=\"i\" type=\"color3\"><input name=\"file\" type=\"filename\" value=\"none.png\" /></image>\n</materialx>",
    );
    bench.write("good.mtlx", GOOD);
    let outcome = bench.catseye("materialx check bad.mtlx good.mtlx missing.mtlx", "");
    assert_eq!(outcome.code, 1);
    let lines: Vec<&str> = outcome.stdout.lines().collect();
    assert_eq!(
        lines[0],
        "bad.mtlx: warning: has no <surfacematerial>; add one and connect its surfaceshader"
    );
    assert!(lines[1].starts_with("bad.mtlx:2:27: add \"a\", input \"in1\": "), "{lines:?}");
    assert!(lines[2].starts_with("bad.mtlx:3:31: image \"i\", input \"file\": "), "{lines:?}");
    assert_eq!(lines[3], "good.mtlx: no problems");
    assert!(lines[4].starts_with("missing.mtlx: can't be read: "), "{lines:?}");
    assert_eq!(outcome.stderr, "catseye: 3 errors in 3 files\n");
}

const GOOD: &str = "<materialx version=\"1.39\"><add name=\"a\" type=\"BSDF\" />\
    <surface name=\"s\" type=\"surfaceshader\"><input name=\"bsdf\" type=\"BSDF\" nodename=\"a\" /></surface>\
    <surfacematerial name=\"m\" type=\"material\"><input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"s\" />\
    </surfacematerial></materialx>";

#[test]
fn findings_are_json_too_and_warnings_are_no_failure() {
    let bench = Bench::new();
    bench.write(
        "good.mtlx",
        &GOOD.replace("</materialx>", "\n <unheard_of name=\"u\" type=\"float\" /></materialx>"),
    );
    let outcome = bench.catseye("materialx check --json good.mtlx", "");
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    let found: serde_json::Value = serde_json::from_str(&outcome.stdout).unwrap();
    let message =
        "unknown node category; `--materialx-path` or MATERIALX_SEARCH_PATH adds libraries that define nodes";
    let expected = serde_json::json!([{
        "file": "good.mtlx", "line": 2, "column": 2, "severity": "warning", "element": "unheard_of \"u\"", "message": message,
    }]);
    assert_eq!(found, expected);
    let text = bench.catseye("materialx check good.mtlx", "");
    assert_eq!(text.stdout, format!("good.mtlx:2:2: warning: unheard_of \"u\": {message}\n"));
}

#[test]
fn what_is_not_printed_is_counted() {
    let bench = Bench::new();
    let twice = "\n<add name=\"x\" type=\"BSDF\" />".repeat(1000);
    bench.write("twice.mtlx", &GOOD.replace("</materialx>", &format!("{twice}</materialx>")));
    let outcome = bench.catseye("materialx check twice.mtlx", "");
    assert_eq!(outcome.stdout.lines().last(), Some("twice.mtlx: and at least 949 more"));
    assert_eq!((outcome.code, outcome.stderr.as_str()), (1, "catseye: 999 errors\n"));
}

#[test]
fn a_search_path_that_is_not_there_is_named() {
    let outcome = Bench::new().catseye("materialx check --materialx-path nowhere x.mtlx", "");
    assert_eq!((outcome.code, outcome.stdout.as_str()), (1, ""));
    assert!(outcome.stderr.starts_with("catseye: nowhere: can't be read: "), "{}", outcome.stderr);
}
