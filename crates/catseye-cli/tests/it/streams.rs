//! `-o -` puts a file on standard output and every word about it on standard error; files keep their
//! permissions.

use std::fs;
use std::os::unix::fs::PermissionsExt as _;

use crate::run::Bench;

#[test]
fn every_kind_of_file_goes_through_a_pipe() {
    let bench = Bench::with_materials();
    for (command, file, begins, says) in [
        ("render --size 32x18 --spp 1", "png", "\u{89}PNG", "wrote <stdout> (32 x 18, 1 samples per pixel"),
        ("render --size 32x18 --spp 1 --format exr", "exr", "v/1\u{1}", "wrote <stdout> (32 x 18"),
        ("furnace --spp 1 --roughness 0.5", "png", "\u{89}PNG", "largest difference"),
        ("plot lobe", "svg", "<svg", "wrote <stdout> (916 x 369)"),
        ("plot albedo --format png", "png", "\u{89}PNG", "wrote <stdout> (1920 x 1280)"),
        ("fit astm-d4956:iii:green", "mtlx", "<?xml", "accepted: worst of 5 values"),
        ("measure materials/sheeting.mtlx", "csv", "observation_deg,", ""),
        ("eval --roughness 1 --wo 0,0,1 --wi 0,0,1", "csv", "roughness_u,", ""),
    ] {
        let outcome = bench.shell(&format!("catseye {command} -o - > out.{file}"));
        assert_eq!(outcome.code, 0, "{command}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(says), "{command}: {}", outcome.stderr);
        let bytes = fs::read(bench.path(&format!("out.{file}"))).unwrap();
        let start: String = bytes.iter().take(20).map(|b| char::from(*b)).collect();
        assert!(start.starts_with(begins), "{command}: {start:?}");
        assert!(!bench.path("-").exists());
    }
    let check = bench.shell("catseye materialx check out.mtlx");
    assert_eq!(check.code, 0, "{}", check.stdout);
}

#[test]
fn a_file_that_is_replaced_keeps_its_permissions() {
    let bench = Bench::new();
    for (mode, name) in [(0o600, "a.csv"), (0o664, "b.csv"), (0o755, "c.csv")] {
        bench.write(name, "old");
        fs::set_permissions(bench.path(name), fs::Permissions::from_mode(mode)).unwrap();
        let outcome = bench.catseye(&format!("albedo --roughness 1 --wo 0,0,1 -o {name}"), "");
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
        assert_eq!(fs::metadata(bench.path(name)).unwrap().permissions().mode() & 0o777, mode);
        assert!(fs::read_to_string(bench.path(name)).unwrap().contains("albedo_r"));
    }
}

#[test]
fn quiet_leaves_results_and_errors() {
    let bench = Bench::with_materials();
    for (args, stdout) in [
        ("render --size 8x8 --spp 1 -q", ""),
        ("-q plot lobe", ""),
        ("materialx export nodes --quiet", ""),
        ("roughness --roughness 1 --tint 0.5 -q | head -n 1", "roughness         1\n"),
    ] {
        let outcome = bench.shell(&format!("catseye {args}"));
        assert_eq!(
            (outcome.code, outcome.stdout.as_str(), outcome.stderr.as_str()),
            (0, stdout, ""),
            "{args}"
        );
    }
    assert_eq!(bench.catseye("-q render none.mtlx", "").stderr.lines().count(), 1);
}

#[test]
fn an_export_to_a_full_disk_leaves_nothing_half() {
    let bench = Bench::new();
    bench.catseye("materialx export nodes", "");
    let before = fs::read(bench.path("nodes/libraries/catseye/catseye_defs.mtlx")).unwrap();
    // A limit of two blocks on the size of every file stands for the full disk.
    let outcome = bench.shell("trap '' XFSZ; ulimit -f 2; catseye materialx export nodes");
    assert_eq!(outcome.code, 1, "{}", outcome.stdout);
    assert!(outcome.stderr.contains("can't be written"), "{}", outcome.stderr);
    assert_eq!(fs::read(bench.path("nodes/libraries/catseye/catseye_defs.mtlx")).unwrap(), before);
    let mut left: Vec<_> =
        fs::read_dir(bench.path("nodes")).unwrap().map(|e| e.unwrap().file_name()).collect();
    left.sort();
    assert_eq!(left, ["libraries", "resources"], "no temporary files");
}
