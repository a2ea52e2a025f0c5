//! `catseye fit`: what it writes is what it says, and the materials of the repository are what it wrote.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::run::Bench;

const SHEET: &str = "observation_deg,entrance_deg,value,unit,quantity\n\
                     0.2,5,250,cd/lx/m2,\n0.5,5,95,cd/lx/m2,\n0.2,30,150,cd/lx/m2,\n0.5,30,60,cd/lx/m2,\n\
                     45,45,0.3,1,Y\n";

/// The column `model` of what `measure` prints, and the column `value`.
fn measured(csv: &str) -> Vec<(f64, f64)> {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let header = reader.headers().unwrap().clone();
    let column = |name: &str| header.iter().position(|field| field == name).unwrap();
    let (value, model) = (column("value"), column("model"));
    let number = |record: &csv::StringRecord, i: usize| record[i].parse().unwrap();
    reader
        .records()
        .map(|record| {
            let record = record.unwrap();
            (number(&record, value), number(&record, model))
        })
        .collect()
}

/// A fit's material, measured, has the values that the fit says: both models, with and without a coat.
#[test]
fn a_written_material_has_the_values_that_the_fit_says() {
    for options in ["", "--coat", "--model back-vector", "--lobes 2 --entrance bend", "--colour yellow"] {
        let bench = Bench::new();
        bench.write("sheet.csv", SHEET);
        let fit = bench.catseye(&format!("fit sheet.csv {options} -o sheet.mtlx --json"), "");
        assert_eq!((fit.code, fit.stderr.as_str()), (0, ""), "{options}");
        let told: Value = serde_json::from_str(&fit.stdout).unwrap();
        let found = bench.catseye("measure sheet.mtlx --geometry sheet.csv", "");
        assert_eq!((found.code, found.stderr.as_str()), (0, ""), "{options}");
        for (row, (value, model)) in told["rows"].as_array().unwrap().iter().zip(measured(&found.stdout)) {
            let said = row["model"].as_f64().unwrap();
            assert!((value / row["value"].as_f64().unwrap() - 1.0).abs() < 1e-12);
            // Six digits in the document, single precision in the renderer, whose coat has a tabulated
            // albedo.
            assert!((model / said - 1.0).abs() < 3e-3, "{options}: {row} but measured {model}");
        }
        let check = bench.catseye("materialx check sheet.mtlx", "");
        assert_eq!(check.code, 0, "{}", check.stdout);
    }
}

#[test]
fn the_report_is_a_page_of_its_own() {
    let bench = Bench::new();
    bench.write("sheet.csv", SHEET);
    let fit = bench.catseye("fit sheet.csv --report sheet.html", "");
    assert_eq!((fit.code, fit.stderr.as_str()), (0, ""));
    let page = fs::read_to_string(bench.path("sheet.html")).unwrap();
    assert_eq!(page.matches("<svg").count(), 2, "both models are drawn");
    for part in ["<h2>Numbers</h2>", "<h2>Values</h2>", "back-vector", "accepted"] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("src=") && !page.contains("href=\"http"), "nothing is fetched");
}

/// `ISO 20471` can't be met, and the fit says which rows say so.
#[test]
fn without_an_acceptable_fit_nothing_is_written_and_the_reason_is_told() {
    let bench = Bench::new();
    let fit = bench.catseye("fit iso20471 -o vest.mtlx --report vest.html", "");
    assert_eq!(fit.code, 1);
    assert!(fit.stderr.contains("no acceptable fit") && fit.stdout.contains("no sum of lobes comes closer"));
    assert_eq!(bench.files(), ["vest.html"]);
    let accepted = bench.catseye("fit iso20471 --tolerance 25 -o vest.mtlx", "");
    assert_eq!(accepted.code, 0, "{}", accepted.stderr);
}

/// A lobe of two roughnesses narrows in the plane of incidence: beyond the rows it is gone, though every row
/// is met.
#[test]
fn a_material_that_is_none_between_the_rows_is_not_written() {
    let bench = Bench::new();
    let mut sheet = "observation_deg,entrance_deg,rotation_deg,value,unit\n".to_owned();
    for (rotation, half_power) in [(0, 0.4), (90, 0.8)] {
        for (observation, entrance) in
            [(0.2, 4.0_f64), (0.5, 4.0), (1.0, 4.0), (0.2, 30.0), (0.5, 30.0), (1.0, 30.0)]
        {
            let cos = entrance.to_radians().cos();
            let value = 300.0 * cos * cos * 0.5_f64.powf((observation / (half_power * cos)).powi(2));
            sheet += &format!("{observation},{entrance},{rotation},{value},cd/lx/m2\n");
        }
    }
    bench.write("turned.csv", &sheet);
    let fit = bench.catseye("fit turned.csv --lobes 1 -o turned.mtlx", "");
    assert_eq!(fit.code, 1, "{}", fit.stdout);
    assert!(fit.stderr.contains("turned.csv: not written: at observation"), "{}", fit.stderr);
    assert!(
        fit.stderr.contains("which no sheeting does") && fit.stdout.contains("not accepted"),
        "{}",
        fit.stderr
    );
    assert_eq!(bench.files(), ["turned.csv"]);
}

#[test]
fn a_bad_table_is_refused_with_its_place_and_nothing_is_written() {
    let header = "observation_deg,entrance_deg,value,unit\n";
    let cases = [
        ("", "t.csv: is empty", 1),
        ("observation_deg,entrance_deg,value,unit\n", "no rows", 1),
        ("observation_deg,value,unit\n0.2,250,cd/lx/m2\n", "entrance_deg", 1),
        ("0.2,5,-250,cd/lx/m2\n0.5,5,95,cd/lx/m2\n", "t.csv:2: column value", 1),
        ("0.2,5,nan,cd/lx/m2\n0.5,5,95,cd/lx/m2\n", "t.csv:2: column value", 1),
        ("0.2,5,250,furlong\n0.5,5,95,cd/lx/m2\n", "t.csv:2: column unit", 1),
        ("0.2,5,250,mcd/lx/m2\n0.5,5,95,mcd/lx/m2\n", "", 1),
        ("0.2,5,250000,cd/lx/m2\n0.5,5,95000,cd/lx/m2\n", "t.csv:2: column value", 1),
        ("0,5,250,cd/lx/m2\n0.5,5,95,cd/lx/m2\n", "t.csv:2: column observation_deg", 1),
        ("0.2,95,250,cd/lx/m2\n0.5,5,95,cd/lx/m2\n", "t.csv:2: column entrance_deg", 1),
        ("0.2,5,250,cd/lx/m2\n", "the width of a lobe can't be determined", 1),
        ("0.2,5,250,cd/lx/m2\n0.2,5,150,cd/lx/m2\n0.5,5,90,cd/lx/m2\n", "t.csv:3: says R_A = 150", 1),
        ("0.2,5,250,mcd/lx\n0.5,5,95,mcd/lx\n", "needs its area|area", 1),
    ];
    for (rows, expected, code) in cases {
        let bench = Bench::new();
        let text = if rows.is_empty() || rows.starts_with("obs") {
            rows.to_owned()
        } else {
            format!("{header}{rows}")
        };
        bench.write("t.csv", &text);
        let fit = bench.catseye("fit t.csv -o t.mtlx", "");
        assert_eq!(fit.code, code, "{rows}: {}{}", fit.stdout, fit.stderr);
        assert!(expected.split('|').any(|part| fit.stderr.contains(part)), "{rows}: {}", fit.stderr);
        assert_eq!(fit.stderr.lines().count(), 1, "{}", fit.stderr);
        assert_eq!(bench.files(), ["t.csv"], "{rows}");
    }
}

#[test]
fn wrong_options_and_unknown_names_are_told_from_bad_data() {
    let bench = Bench::new();
    bench.write("sheet.csv", SHEET);
    let cases = [
        ("fit sheet.csv --lobes 4", 2, "1, 2, 3 or auto"),
        ("fit sheet.csv --luminance-factor=-1", 2, "(0, 2]"),
        ("fit sheet.csv --area-m2 0", 2, "above 0"),
        ("fit sheet.csv --colour ultraviolet", 2, "is no colour"),
        ("fit sheet.csv --tolerance 1000", 1, "catseye: the tolerance is 1000: it must be in (0, 100] %"),
        ("fit sheet.csv --coat 0.5", 1, "index of refraction"),
        ("fit sheet.csv --aperture-deg 99", 1, "aperture"),
        ("fit sheet.csv --only purple", 1, "no row is of"),
        ("fit missing.csv", 1, "missing.csv: can't be read"),
        ("fit no-such-standard", 1, "no-such-standard"),
        ("fit astm-d4956", 1, "astm-d4956"),
        ("fit sheet.csv -o no/such/folder.mtlx", 1, "can't be written"),
    ];
    for (command, code, expected) in cases {
        let fit = bench.catseye(command, "");
        assert_eq!(fit.code, code, "{command}: {}", fit.stderr);
        assert!(fit.stderr.contains(expected), "{command}: {}", fit.stderr);
    }
}

#[test]
fn a_file_of_several_materials_is_fitted_one_at_a_time() {
    let bench = Bench::new();
    let rows = "class,colour,observation_deg,entrance_deg,value,unit\n\
                A,white,0.2,5,250,cd/lx/m2\nA,white,0.5,5,95,cd/lx/m2\n\
                A,red,0.2,5,50,cd/lx/m2\nA,red,0.5,5,15,cd/lx/m2\n";
    bench.write("two.csv", rows);
    let both = bench.catseye("fit two.csv", "");
    assert!(both.code == 1 && both.stderr.contains("A red; A white"), "{}", both.stderr);
    let red = bench.catseye("fit two.csv --only red -o red.mtlx", "");
    assert_eq!((red.code, red.stderr.as_str()), (0, ""));
    assert!(
        fs::read_to_string(bench.path("red.mtlx"))
            .unwrap()
            .contains("Fitted to A red by catseye fit two.csv --only red")
    );
}

/// The fitted materials: path, and the command that their `doc` names.
fn fitted_materials() -> Vec<(PathBuf, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../materials");
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let Ok(text) = fs::read_to_string(&path) else { continue };
        let command = text.split_once(" by catseye fit ").and_then(|(_, rest)| rest.split_once(": "));
        if let Some((command, _)) = command {
            found.push((path, format!("fit {command}")));
        }
    }
    found.sort();
    found
}

/// Each fitted material of the repository is what its command writes, as far as a photometer can tell.
#[test]
fn the_fitted_materials_are_what_their_commands_write() {
    let materials = fitted_materials();
    assert!(materials.len() >= 12, "{}", materials.len());
    for (path, command) in materials {
        let bench = Bench::new();
        let fit = bench.shell(&format!("catseye {command} -o again.mtlx"));
        assert_eq!(fit.code, 0, "{command}: {}", fit.stderr);
        let standard = command.split_whitespace().nth(1).unwrap();
        let values = |material: &str| {
            let run = bench.shell(&format!("catseye measure '{material}' --standard {standard}"));
            assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{material}");
            measured(&run.stdout)
        };
        let (kept, again) = (values(&path.display().to_string()), values("again.mtlx"));
        for ((value, kept), (_, again)) in kept.iter().zip(&again) {
            // Other mathematical libraries may lead the fit to another material that is as good.
            assert!((kept / again - 1.0).abs() < 0.02, "{command}: {kept} and {again} for {value}");
        }
    }
}
