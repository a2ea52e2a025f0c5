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
    bench.write("good.mtlx", "<materialx version=\"1.39\" />");
    let outcome = bench.catseye("materialx check bad.mtlx good.mtlx missing.mtlx", "");
    assert_eq!(outcome.code, 1);
    let lines: Vec<&str> = outcome.stdout.lines().collect();
    assert!(lines[0].starts_with("bad.mtlx:2:27: add \"a\", input \"in1\": "), "{lines:?}");
    assert!(lines[1].starts_with("bad.mtlx:3:31: image \"i\", input \"file\": "), "{lines:?}");
    assert_eq!(lines[2], "good.mtlx: no problems");
    assert!(lines[3].starts_with("missing.mtlx: can't be read: "), "{lines:?}");
    assert_eq!(outcome.stderr, "catseye: 3 problems in 3 files\n");
}

#[test]
fn a_search_path_that_is_not_there_is_named() {
    let outcome = Bench::new().catseye("materialx check --materialx-path nowhere x.mtlx", "");
    assert_eq!((outcome.code, outcome.stdout.as_str()), (1, ""));
    assert!(outcome.stderr.starts_with("catseye: nowhere: can't be read: "), "{}", outcome.stderr);
}
