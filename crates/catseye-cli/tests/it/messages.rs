//! A message speaks of the option or file that is meant, in its unit, once, and names the way out.

use std::fs;

use crate::run::Bench;

const SHEET: &str = "observation_deg,entrance_deg,value\n0.2,5,250\n0.5,5,95\n";

/// A folder with a table, a folder, a document without looks, and files that are not what their names say.
fn bench() -> Bench {
    let bench = Bench::with_materials();
    bench.write("sheet.csv", SHEET);
    bench.write("garbage.xomp", "{");
    bench.write("garbage.dat", "no numbers");
    fs::create_dir(bench.path("d")).unwrap();
    bench
}

/// Asserts the whole of what a command says on standard error, behind `catseye: `.
fn says(bench: &Bench, args: &str, code: i32, message: &str) {
    let outcome = bench.catseye(args, "");
    assert_eq!(outcome.stderr.trim_end(), format!("catseye: {message}"), "{args}");
    assert_eq!((outcome.code, outcome.stdout.as_str()), (code, ""), "{args}");
}

#[test]
fn numbers_are_those_of_the_options() {
    let bench = bench();
    says(
        &bench,
        "render --size 16384x9000 --spp 4 -o x.png",
        2,
        "--size 16384x9000: a picture of 4 samples per pixel or more, which is made from one of twice the size, has at \
         most 8192 columns and rows: take --spp 1 to 3",
    );
    says(&bench, "fit sheet.csv --tolerance 1000", 1, "the tolerance is 1000: it must be in (0, 100] %");
    for args in ["fit sheet.csv --half-power-deg 90", "roughness --half-power-deg 90"] {
        says(&bench, args, 1, "the half-power angle is 90, outside (0, 44.2] degrees");
    }
    says(
        &bench,
        "fit sheet.csv --aperture-deg 60",
        1,
        "the source's aperture is 60, outside [0, 20] degrees",
    );
    let many: String = (0..20).map(|i| format!("0.2,{i},{}\n", 250 - i)).collect();
    bench.write("many.csv", &format!("observation_deg,entrance_deg,value\n{many}"));
    says(
        &bench,
        "plot ra --roughness 0.01 --standard many.csv",
        2,
        "many.csv has values at 20 entrance angles; choose 1 to 8 of them with --entrance",
    );
}

#[test]
fn the_samples_that_are_taken_are_the_samples_that_are_printed() {
    let bench = bench();
    for (args, spp) in
        [("--spp 3 -o a.png", 3), ("--spp 5 -o a.png", 8), ("--spp 8 -o a.png", 8), ("--spp 5 -o a.exr", 8)]
    {
        let outcome = bench.catseye(&format!("render --size 16x9 {args} --json"), "");
        let facts: serde_json::Value = serde_json::from_str(&outcome.stdout).unwrap();
        assert_eq!(facts["spp"], spp, "{args}");
    }
}

#[test]
fn a_path_is_looked_for_as_a_file() {
    let bench = bench();
    for name in ["missing.mtlx", "no/such", "sheet.txt"] {
        for verb in ["fit", "standards show", "plot ra --roughness 0.1 --standard"] {
            let message = format!(
                "{name}: no such file, and no class of a standard, which `catseye standards list` lists"
            );
            says(&bench, &format!("{verb} {name}"), 1, &message);
        }
    }
    says(&bench, "fit d", 1, "d: is a folder; a table or a class of a standard is needed");
    let message =
        "materials/sheeting.mtlx: is a material; fit makes one from values, measure takes values from it";
    says(&bench, "fit materials/sheeting.mtlx", 1, message);
    let outcome = bench.shell("cat sheet.csv | catseye fit /dev/stdin");
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "a pipe is read");
}

#[test]
fn a_name_of_several_classes_is_answered_with_them() {
    let outcome = bench().catseye("fit astm-d4956", "");
    for part in ["astm-d4956:i", "astm-d4956:iii", "`catseye standards list`"] {
        assert!(outcome.stderr.contains(part), "{part}: {}", outcome.stderr);
    }
}

#[test]
fn a_negative_number_is_a_value() {
    let bench = bench();
    for args in [
        "render --size -5x5",
        "render --spp -1",
        "fit sheet.csv --tolerance -1",
        "eval --roughness -1 --wo 0,0,1 --wi 0,0,1",
        "plot lobe --roughness -1",
        "plot lobe --roughness 1,-1",
        "plot albedo --roughness -1",
        "plot lobe --theta -30",
        "furnace --roughness -1",
        "roughness --roughness 1 --ra 1 --at-deg -1",
        "fit sheet.csv --half-power-deg -1",
        "measure materials/sheeting.mtlx --area-m2 -1",
    ] {
        let outcome = bench.catseye(args, "");
        assert!(outcome.code > 0 && outcome.stderr.contains('-'), "{args}: {}", outcome.stderr);
        assert!(!outcome.stderr.contains("unexpected argument"), "{args}: {}", outcome.stderr);
        assert!(!outcome.stderr.contains("-- -"), "{args}: {}", outcome.stderr);
    }
}

#[test]
fn a_cause_is_named_once() {
    let bench = bench();
    for args in [
        "fit none.csv",
        "fit garbage.xomp",
        "fit garbage.dat",
        "fit none.binary",
        "measure materials/sheeting.mtlx --geometry none.csv",
        "eval none.csv",
        "render none.mtlx",
        &format!("plot lobe -o {}.svg", "x".repeat(300)),
        "render --size 8x8 --spp 1 -o none/x.png",
    ] {
        let message = bench.catseye(args, "").stderr;
        let causes: Vec<&str> = message.trim_end().split(": ").collect();
        for (i, cause) in causes.iter().enumerate() {
            assert!(!causes[..i].contains(cause), "{args}: {message}");
        }
        assert_eq!(message.matches("(os error").count().max(1), 1, "{args}: {message}");
    }
}

#[test]
fn standard_output_is_named_where_it_is_full() {
    let bench = bench();
    for command in [
        "eval --roughness 1 --wo 0,0,1 --wi 0,0,1",
        "roughness --roughness 1",
        "measure materials/sheeting.mtlx",
        "standards",
        "plot lobe -o -",
    ] {
        let outcome = bench.shell(&format!("catseye {command} > /dev/full"));
        assert_eq!(outcome.code, 1, "{command}");
        let start = "catseye: <stdout>: can't be written: No space left on device";
        assert!(outcome.stderr.starts_with(start), "{command}: {}", outcome.stderr);
    }
}

#[test]
fn words_fit_what_they_are_about() {
    let bench = bench();
    let outcome = bench.catseye("export openmaterial materials/sheeting.mtlx -o o.xomp", "");
    assert!(outcome.stdout.ends_with("; the BRDF at 1 wavelength\n"), "{}", outcome.stdout);
    for tint in ["nan=0.2", "905=nan", "905=2", "0=1"] {
        let outcome = bench
            .catseye(&format!("export openmaterial materials/sheeting.mtlx -o o.xomp --tint {tint}"), "");
        assert!(outcome.code == 2 && outcome.stderr.contains("--tint"), "{tint}: {}", outcome.stderr);
    }
    let looks = "materials/sheeting.mtlx: no look \"nope\"; it has no looks";
    says(&bench, "render materials/sheeting.mtlx --look nope", 1, looks);
    let narrow = "roughness 0.00001 is a perfect retro-reflector in the model reciprocal: it sends all light back in one \
                  direction and has no curve";
    says(&bench, "plot lobe --roughness 1e-5 --model reciprocal", 1, narrow);
    let outcome = bench.catseye("roughness --half-power-deg 1e-30", "");
    assert!(
        outcome.code == 1 && outcome.stderr.contains("is a perfect retro-reflector"),
        "{}",
        outcome.stderr
    );
}

#[test]
fn thousands_of_threads_are_refused() {
    let outcome = bench().catseye("render --threads 10000", "");
    assert!(outcome.code == 2 && outcome.stderr.contains("10000 is not in 1..=256"), "{}", outcome.stderr);
}
