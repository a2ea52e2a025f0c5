//! However long a table is, its answers take the same memory.

use std::fmt::Write as _;

use crate::run::Bench;

/// Kibibytes of address space that a table of any length must do with: the program, its threads and two
/// batches.
const ROOM: u32 = 300_000;

#[test]
fn a_table_of_a_hundred_megabytes() {
    let bench = Bench::new();
    let mut table = String::from("id,roughness_u,wo_x,wo_y,wo_z,wi_x,wi_y,wi_z,note\n");
    let note = "x".repeat(200);
    for id in 0..400_000 {
        writeln!(table, "{id},0.{},0.6,0,0.8,0.8,0,0.6,{note}", id % 7 + 1).unwrap();
    }
    bench.write("in.csv", &table);
    let run = bench.shell(&format!("ulimit -v {ROOM}; RAYON_NUM_THREADS=2 catseye eval in.csv -o out.csv"));
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let out = std::fs::read_to_string(bench.path("out.csv")).unwrap();
    assert_eq!(out.lines().count(), 400_001);
    let ids = out.lines().skip(1).map(|line| line.split(',').next().unwrap());
    assert!(ids.enumerate().all(|(i, id)| id == i.to_string()), "in the order of the table");
    let piped =
        bench.shell(&format!("ulimit -v {ROOM}; RAYON_NUM_THREADS=2 catseye eval < in.csv | cmp - out.csv"));
    assert_eq!((piped.code, piped.stderr.as_str()), (0, ""));
}
