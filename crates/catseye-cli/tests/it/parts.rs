//! Long renders: parts that merge to the bytes of the picture, checkpoints that survive, time that is kept.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::run::Bench;

const SIZE: &str = "--size 48x27";
/// Longer than any machine needs until the first checkpoint.
const PATIENCE: Duration = Duration::from_secs(60);

fn done(bench: &Bench, args: &str) -> String {
    let outcome = bench.catseye(args, "");
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
    outcome.stdout
}

#[test]
fn merged_parts_are_the_picture() {
    let bench = Bench::new();
    done(&bench, &format!("render {SIZE} --spp 12 -o whole.png"));
    done(&bench, &format!("render {SIZE} --spp 12 -o whole.exr"));
    let said = done(&bench, &format!("render {SIZE} --samples 0..4 -o a.exr"));
    assert!(said.starts_with("wrote a.exr (samples 0..4 of the pixels 0,0,48,27, "), "{said}");
    done(&bench, &format!("render {SIZE} --samples 4..12 --region 0,0,48,13 -o b.exr --threads 1"));
    done(&bench, &format!("render {SIZE} --samples 4..12 --region 0,13,48,27 -o c.exr"));
    let said = done(&bench, "merge c.exr a.exr b.exr --expect 0..12 -o merged.png");
    assert_eq!(said, "wrote merged.png (samples 0..12 from 3 parts)\n");
    let read = |name: &str| fs::read(bench.path(name)).unwrap();
    assert!(read("merged.png") == read("whole.png"));
    // The EXR says which command made it, so that its pixels are compared as PNGs of one exposure.
    done(&bench, "merge a.exr b.exr c.exr -o merged.exr");
    done(&bench, "merge a.exr b.exr c.exr --exposure 1 -o brighter.png");
    assert!(read("brighter.png") != read("whole.png"));
}

#[test]
fn what_does_not_fit_together_is_one_line() {
    let bench = Bench::new();
    for (name, args) in [
        ("a.exr", "--samples 0..4"),
        ("b.exr", "--samples 4..8"),
        ("left.exr", "--samples 4..8 --region 0,0,20,27"),
        ("seed.exr", "--samples 4..8 --seed 3"),
        ("lamp.exr", "--samples 4..8 --lamp-deg 2"),
        ("picture.exr", "--spp 4"),
    ] {
        done(&bench, &format!("render {SIZE} {args} -o {name}"));
    }
    let bytes = fs::read(bench.path("b.exr")).unwrap();
    fs::write(bench.path("cut.exr"), &bytes[..bytes.len() / 2]).unwrap();
    let before = bench.files();
    for (parts, message) in [
        ("a.exr", "no part has the samples 4..8 of the pixel in column 0 and row 0: render them"),
        ("a.exr left.exr", "no part has the samples 4..8 of the pixel in column 20 and row 0: render them"),
        (
            "a.exr b.exr left.exr",
            "b.exr and left.exr both have the samples 4..8 of some pixels: leave one out",
        ),
        ("a.exr a.exr", "a.exr and a.exr both have the samples 0..4"),
        ("a.exr seed.exr", "a.exr and seed.exr are parts of different pictures: seeds: 0 and 3"),
        ("a.exr lamp.exr", "a.exr and lamp.exr are parts of different pictures: scenes, materials, lamps"),
        ("a.exr picture.exr", "picture.exr: it is a finished picture"),
        ("a.exr cut.exr", "cut.exr: it "),
        ("a.exr none.exr", "none.exr: can't be read: "),
    ] {
        let outcome = bench.catseye(&format!("merge {parts} --expect 0..8 -o out.png"), "");
        assert_eq!((outcome.code, outcome.stdout.as_str()), (1, ""), "{parts}");
        assert!(outcome.stderr.starts_with(&format!("catseye: {message}")), "{parts}: {}", outcome.stderr);
        assert_eq!(outcome.stderr.lines().count(), 1, "{}", outcome.stderr);
    }
    let beyond = bench.catseye("merge a.exr b.exr --expect 0..4 -o out.png", "");
    assert!(beyond.stderr.contains("b.exr: it has the samples 4..8, beyond the 0..4"), "{}", beyond.stderr);
    for wrong in [
        "render --samples 0..4 -o a.png",
        "render --samples 0..3 -o x.exr",
        "render --samples 4..4 -o x.exr",
        "render --samples 0..4 --spp 4 -o x.exr",
        "render --samples 0..4 --exposure auto -o x.exr",
        "render --size 20x20 --region 0,0,21,20 -o x.exr",
        "render --region 5,5,5,9 -o x.exr",
        "render --time -1 -o x.png",
        "render --progress openjd -o -",
        "merge -o x.png",
    ] {
        let outcome = bench.catseye(wrong, "");
        assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{wrong}: {}", outcome.stderr);
    }
    assert_eq!(bench.files(), before);
}

/// A render that would take minutes.
fn endless(bench: &Bench, args: &str) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_catseye"));
    command.args(format!("render {SIZE} --spp 400000 {args} -o out.png").split_whitespace());
    command.current_dir(bench.path(".")).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

fn wait_for(bench: &Bench, name: &str) {
    let started = Instant::now();
    while !bench.path(name).exists() {
        assert!(started.elapsed() < PATIENCE, "{name} appears");
        sleep(Duration::from_millis(10));
    }
}

/// The samples that a resumed run of no samples more would say that it has.
fn samples(bench: &Bench, checkpoint: &str) -> u32 {
    let outcome = bench.catseye(&format!("render {SIZE} --spp 4 --resume {checkpoint} -o x.png"), "");
    let text =
        outcome.stderr.split("samples 0..").nth(1).and_then(|rest| rest.split(',').next()).unwrap_or("4");
    text.parse().unwrap()
}

#[test]
fn a_killed_render_goes_on_to_the_same_bytes() {
    for signal in ["KILL", "INT", "TERM"] {
        let bench = Bench::new();
        let mut child = endless(&bench, "--checkpoint c.exr --checkpoint-every 0");
        wait_for(&bench, "c.exr");
        let busy = bench.catseye(&format!("render {SIZE} --resume c.exr -o b.png"), "");
        assert!(busy.stderr.starts_with("catseye: c.exr: another run is writing it"), "{}", busy.stderr);
        let killed = Command::new("kill").args([format!("-{signal}"), child.id().to_string()]).status();
        assert!(killed.unwrap().success());
        if signal == "KILL" {
            child.wait().unwrap();
        } else {
            let output = child.wait_with_output().unwrap();
            let message = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(130), "{message}");
            assert!(message.starts_with("catseye: interrupted; c.exr has the samples 0.."), "{message}");
            assert_eq!(bench.files(), ["c.exr"]);
        }
        let again = bench.catseye(&format!("render {SIZE} --checkpoint c.exr -o x.png"), "");
        assert!(again.stderr.contains("c.exr: it is there already; go on from it with --resume c.exr"));
        let other = bench.catseye(&format!("render {SIZE} --resume c.exr --lamp-deg 3 -o x.png"), "");
        assert!(other.stderr.starts_with("catseye: c.exr: it is another picture: "), "{}", other.stderr);

        let spp = samples(&bench, "c.exr") + 8;
        done(&bench, &format!("render {SIZE} --spp {spp} --resume c.exr -o resumed.png"));
        done(&bench, &format!("render {SIZE} --spp {spp} -o whole.png"));
        let read = |name: &str| fs::read(bench.path(name)).unwrap();
        assert!(read("resumed.png") == read("whole.png"), "{signal}");
    }
}

#[test]
fn a_limit_of_time_is_kept() {
    let bench = Bench::new();
    let started = Instant::now();
    let said = done(&bench, &format!("render {SIZE} --time 1 --json -o a.png"));
    // One sample more than fits, and starting the program.
    assert!(started.elapsed() < Duration::from_secs(10), "{:?}", started.elapsed());
    let facts: serde_json::Value = serde_json::from_str(&said).unwrap();
    let spp = facts["spp"].as_u64().unwrap();
    assert!(spp >= 4, "{spp}");
    done(&bench, &format!("render {SIZE} --spp {spp} -o b.png"));
    assert!(fs::read(bench.path("a.png")).unwrap() == fs::read(bench.path("b.png")).unwrap());
}

#[test]
fn progress_is_told_to_open_job_description() {
    let bench = Bench::new();
    let said = done(&bench, &format!("render {SIZE} --spp 8 --progress openjd -o a.png"));
    let told: Vec<f32> =
        said.lines().filter_map(|line| line.strip_prefix("openjd_progress: ")?.parse().ok()).collect();
    assert_eq!(told.iter().copied().fold(0.0, f32::max), 100.0, "{said}");
    assert!(told.len() > 2);
}
