//! Bad input: one line that names the place, exit code 1 or 2, nothing half written.

use crate::run::Bench;

/// Runs on standard input; the exit code and the whole of standard error.
fn fails(args: &str, stdin: &str) -> (i32, String) {
    let outcome = Bench::new().catseye(args, stdin);
    assert_eq!(outcome.stdout, "", "nothing half written: {args}");
    assert_eq!(outcome.stderr.lines().count(), 1, "one line: {}", outcome.stderr);
    (outcome.code, outcome.stderr.trim_end().to_owned())
}

/// Evaluates a good row and then the given one.
fn bad_row(row: &str) -> String {
    let header = "roughness_u,roughness_v,tint_r,multiscatter_tint_b,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z";
    let (code, message) =
        fails("eval", &format!("{header}\n1,1,1,1,0,0,1,0,0,1\n{row}\n1,1,1,1,0,0,1,0,0,1\n"));
    assert_eq!(code, 1, "{message}");
    message
}

#[test]
fn a_bad_cell_is_named_with_line_column_and_value() {
    let expected = [
        ("nan,1,1,1,0,0,1,0,0,1", "column roughness_u: \"nan\" is not a number"),
        ("x,1,1,1,0,0,1,0,0,1", "column roughness_u: \"x\" is not a number"),
        (" ,1,1,1,0,0,1,0,0,1", "column roughness_u: is empty"),
        ("-0.5,1,1,1,0,0,1,0,0,1", "column roughness_u: -0.5 is outside [0, inf]"),
        ("1,-inf,1,1,0,0,1,0,0,1", "column roughness_v: -inf is outside [0, inf]"),
        ("1,1,1.5,1,0,0,1,0,0,1", "column tint_r: 1.5 is outside [0, 1]"),
        ("1,1,1,-1,0,0,1,0,0,1", "column multiscatter_tint_b: -1 is outside [0, 1]"),
        ("1,1,1,1,0,NaN,1,0,0,1", "column wo_y: \"NaN\" is not a number"),
        ("1,1,1,1,0,0,1,0,0,inf", "column wi_z: inf is not finite"),
        ("1,1,1,1,0,0,,0,0,1", "column wo_z: is empty"),
        ("1,1,1,1,0,0,0,0,0,1", "columns wo_x, wo_y, wo_z: the direction's length is 0, it must be 1"),
        ("1,1,1,1,0,0,1,0,3,4", "columns wi_x, wi_y, wi_z: the direction's length is 5, it must be 1"),
        ("1,1,1,1,0,0,1,0,0", "9 fields, but the header has 10"),
        ("1,1,1,1,0,0,1,0,0,1,1", "11 fields, but the header has 10"),
        ("1", "1 field, but the header has 10"),
    ];
    for (row, message) in expected {
        assert_eq!(bad_row(row), format!("catseye: <stdin>:3: {message}"), "row {row}");
    }
}

#[test]
fn uniform_numbers_lie_below_one() {
    let table = |u: &str| format!("roughness_u,wo_x,wo_y,wo_z,u1,u2,u3\n1,0,0,1,0,{u},0\n");
    for u in ["1", "-0.1", "inf"] {
        let expected = format!("catseye: <stdin>:2: column u2: {u} is outside [0, 1)");
        assert_eq!(fails("sample", &table(u)), (1, expected));
    }
}

#[test]
fn a_bad_header_is_named() {
    let cases = [
        ("", "<stdin>:1: no header line"),
        ("roughness_u,wo_x,wo_y,wi_x,wi_y,wi_z\n", "<stdin>:1: missing column wo_z"),
        (
            "roughness,wo_x,wo_y,wo_z\n",
            "<stdin>:1: missing columns roughness_u, wi_x, wi_y, wi_z; is \"roughness\" one of them?",
        ),
        ("id,roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,u1\n", "<stdin>:1: missing column wi_z"),
        ("a,roughness_u,a,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z\n", "<stdin>:1: column \"a\" appears twice"),
    ];
    for (table, message) in cases {
        assert_eq!(fails("eval", table), (1, format!("catseye: {message}")));
    }
}

#[test]
fn lines_are_counted_as_an_editor_does() {
    let header = "roughness_u,note,wo_x,wo_y,wo_z";
    let table = format!("{header}\n\n1,\"two\nlines\",0,0,1\n\nx,,0,0,1\n");
    let expected = "catseye: <stdin>:6: column roughness_u: \"x\" is not a number";
    assert_eq!(fails("albedo", &table).1, expected);
    assert_eq!(fails("albedo", &table.replace('\n', "\r\n")).1, expected);
}

#[test]
fn the_first_bad_row_is_reported_whatever_thread_meets_it() {
    let mut table = String::from("roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z\n");
    for line in 2..30_000 {
        let roughness = if line > 20_000 { "bad" } else { "1" };
        table.push_str(&format!("{roughness},0,0,1,0,0,1\n"));
    }
    let message = "catseye: <stdin>:20001: column roughness_u: \"bad\" is not a number".to_owned();
    assert_eq!(fails("eval", &table), (1, message));
}

#[test]
fn a_file_s_errors_name_the_file_and_leave_no_output() {
    let bench = Bench::new();
    bench.write("in.csv", "roughness_u,wo_x,wo_y,wo_z\n1,0,0,1\n1,0,0,nan\n");
    let outcome = bench.catseye("albedo in.csv -o out.csv", "");
    assert_eq!(
        (outcome.code, outcome.stderr.as_str()),
        (1, "catseye: in.csv:3: column wo_z: \"nan\" is not a number\n")
    );
    assert_eq!(bench.files(), ["in.csv"]);
}

#[test]
fn a_failed_run_leaves_an_older_output_alone() {
    let bench = Bench::new();
    bench.write("out.csv", "precious");
    assert_eq!(bench.catseye("albedo -o out.csv", "roughness_u\n").code, 1);
    assert_eq!(std::fs::read_to_string(bench.path("out.csv")).unwrap(), "precious");
    assert_eq!(bench.files(), ["out.csv"]);
}

#[test]
fn missing_files_and_unwritable_outputs_are_named() {
    let (code, message) = fails("eval no/such.csv", "");
    assert_eq!(code, 1);
    assert!(message.starts_with("catseye: no/such.csv: can't be read: No such file"), "{message}");
    for output in ["no/such/out.csv", "."] {
        let (code, message) = fails(&format!("albedo -o {output}"), "roughness_u,wo_x,wo_y,wo_z\n");
        assert_eq!(code, 1, "{message}");
        assert!(message.contains("can't be written: "), "{message}");
    }
}

#[test]
fn wrong_use_has_exit_code_2() {
    let cases = [
        ("eval --roughness 1 --wo 0,0,1", "catseye: a single query needs --wi (see --help)"),
        (
            "eval --roughness 1 --wo 0,1 --wi 0,0,1",
            "catseye: --wo 0,1: 3 numbers with commas between them are needed",
        ),
        ("albedo in.csv --wo 0,0,1", "catseye: give a table or the options of a single query, not both"),
        ("plot lobe -o lobe.jpg", "catseye: lobe.jpg: the name must end in .svg or .png"),
        ("plot lobe --theta 95", "catseye: --theta takes angles in [0, 90)"),
    ];
    for (args, message) in cases {
        assert_eq!(fails(args, ""), (2, message.to_owned()), "{args}");
    }
    for args in ["", "nonsense", "eval --precision f16", "plot"] {
        assert_eq!(Bench::new().catseye(args, "").code, 2, "catseye {args}");
    }
}

#[test]
fn the_gpu_backend_says_that_it_is_not_there() {
    let (code, message) = fails("eval --backend gpu", "");
    assert_eq!(code, 2);
    assert!(message.contains("the gpu backend is not part of this version"), "{message}");
}

#[test]
fn options_out_of_range_are_named_without_a_line() {
    let (code, message) = fails("albedo --roughness=-1 --wo 0,0,1", "");
    assert_eq!(code, 1);
    assert_eq!(message, "catseye: command line: column roughness_u: -1 is outside [0, inf]");
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let rows = "1,0,0,1,0,0,1\\n".repeat(100);
    let line = format!(
        "(printf 'roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z\\n'; for i in $(seq 200); do printf '{rows}'; done) > t.csv; \
         (catseye eval t.csv; echo \"code $?\" >&2) | head -1"
    );
    let outcome = Bench::new().shell(&line);
    assert_eq!(outcome.stderr, "code 0\n");
}
