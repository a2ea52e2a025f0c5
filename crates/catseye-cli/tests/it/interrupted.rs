//! An interrupted command leaves no temporary file, keeps what was there before, and says so.

use std::fs;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::run::Bench;

/// Longer than any machine needs until the command has begun to write.
const PATIENCE: Duration = Duration::from_secs(60);

#[test]
fn files_are_as_they_were() {
    for (signal, precious) in [("INT", true), ("TERM", false)] {
        let bench = Bench::new();
        let header = "roughness_u,wo_x,wo_y,wo_z\n";
        // In double precision each of these rows takes a good part of a millisecond.
        bench.write("in.csv", &(header.to_owned() + &"1,0,0,1\n".repeat(2_000_000)));
        if precious {
            bench.write("out.csv", "precious");
        }
        let before = bench.files();
        let mut command = Command::new(env!("CARGO_BIN_EXE_catseye"));
        command.args(["albedo", "in.csv", "-o", "out.csv"]).current_dir(bench.path("."));
        let child =
            command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let started = Instant::now();
        while bench.files() == before {
            assert!(started.elapsed() < PATIENCE, "a temporary file appears");
            sleep(Duration::from_millis(10));
        }
        let killed = Command::new("kill").args([format!("-{signal}"), child.id().to_string()]).status();
        assert!(killed.unwrap().success());
        let output = child.wait_with_output().unwrap();
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(130), "{message}");
        assert_eq!(bench.files(), before, "no temporary file is left");
        let state = if precious { "is as it was before" } else { "was not written" };
        assert!(message.ends_with(&format!("out.csv {state}\n")), "{message}");
        if precious {
            assert_eq!(fs::read_to_string(bench.path("out.csv")).unwrap(), "precious");
        }
    }
}
