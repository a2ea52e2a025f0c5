//! `catseye fit`: what it writes is what it says, and the materials of the repository are what it wrote.

use std::fs;
use std::path::{Path, PathBuf};

use catseye::Vec3;
use catseye_photometry::{EntranceLaw, Geometry, Goniometer, Quantity, RetroLobe, Sheeting};
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

/// A tape under a rough coat.
fn coated_tape() -> Sheeting {
    let entrance = Some(EntranceLaw::power(3.0));
    let lobes = vec![RetroLobe { strength: 0.1, roughness: [0.05; 2], entrance }];
    Sheeting { lobes, diffuse: 0.2, coat_ior: Some(1.5), coat_roughness: 0.08, ..Sheeting::default() }
}

/// A file of its BRDF in ALTA's format, with the receiver's cosine in the values: a grid of 3 degrees.
fn alta(tape: &Sheeting, header: &str) -> String {
    let prepared = tape.prepare().unwrap();
    let mut text = format!("#DIM 3 1\n#PARAM_IN ISOTROPIC_TL_TV_PROJ_DPHI\n{header}");
    for light in [15.0_f64, 30.0, 60.0].map(f64::to_radians) {
        for (i, j) in (-25..=25).flat_map(|i| (-25..=25).map(move |j| (i, j))) {
            let [x, y] = [i, j].map(|k| f64::from(3 * k).to_radians());
            let (wo, wi) = (Vec3::from_angles(x.hypot(y), y.atan2(x)), Vec3::from_angles(light, 0.0));
            if wo.z > 0.2 {
                text += &format!(
                    "{light:.17} {x:.17} {y:.17} {:.17e}\n",
                    wo.z * prepared.eval_with_surface(wo, wi)
                );
            }
        }
    }
    text
}

/// The regions have names and numbers in text, JSON and report, and the material has its base and its coat.
#[test]
fn a_measured_brdf_is_fitted_in_all_its_parts() {
    let bench = Bench::new();
    bench.write("tape.dat", &alta(&coated_tape(), "#PARAM_OUT INV_STERADIAN_COSINE_FACTOR\n"));
    let fit = bench.catseye("fit tape.dat --lobes 1 -o tape.mtlx --report tape.html", "");
    assert_eq!((fit.code, fit.stderr.as_str()), (0, ""), "{}", fit.stdout);
    let page = fs::read_to_string(bench.path("tape.html")).unwrap();
    for region in [
        "within 20 deg of the incident",
        "within 20 deg of the mirror",
        "elsewhere, to 80 deg",
        "the whole file",
    ] {
        assert!(
            fit.stdout.contains(&format!("\n{region}")) && page.contains(region),
            "{region}: {}",
            fit.stdout
        );
    }
    let told = bench.catseye("fit tape.dat --lobes 1 --json", "");
    let told: Value = serde_json::from_str(&told.stdout).unwrap();
    let regions = told["regions"].as_array().unwrap();
    assert_eq!(regions.len(), 4);
    let whole = regions[3]["samples"].as_u64().unwrap();
    assert!(regions[..3].iter().map(|region| region["samples"].as_u64().unwrap()).sum::<u64>() <= whole);
    assert!(regions.iter().all(|region| region["log_rmse"].as_f64().unwrap() < 0.02), "{told}");
    assert!((told["coat_ior"].as_f64().unwrap() - 1.5).abs() < 0.02, "{told}");
    assert!((told["coat_roughness"].as_f64().unwrap() / 0.08 - 1.0).abs() < 0.02, "{told}");
    assert_eq!((&told["accepted"], &told["log_rmse"]), (&true.into(), &regions[0]["log_rmse"]));

    // Around the incident direction, around the mirror one (entrance 30, receiver 30 beyond the normal), and
    // elsewhere.
    let geometry = "observation_deg,entrance_deg,rotation_deg\n0.5,30,0\n5,30,0\n60,30,0\n66,30,0\n45,60,0\n";
    bench.write("g.csv", geometry);
    let found = bench.catseye("measure tape.mtlx --geometry g.csv", "");
    assert_eq!((found.code, found.stderr.as_str()), (0, ""));
    let (tape, mut reader) = (coated_tape(), csv::Reader::from_reader(found.stdout.as_bytes()));
    let prepared = tape.prepare().unwrap();
    for record in reader.records().map(Result::unwrap) {
        let number = |i: usize| record[i].parse::<f64>().unwrap();
        let geometry = Geometry::from(Goniometer::from_degrees(number(0), number(1), 0.0, number(2)));
        let f = prepared.eval_with_surface(geometry.wo, geometry.wi);
        let r_a = Quantity::RetroReflectionCoefficient.of_brdf(f, &geometry).unwrap();
        let measured = number(record.len() - 1);
        // The fit, and that a rough coat lets a little less through than the smooth one of the fit.
        assert!((measured / r_a - 1.0).abs() < 0.03, "{record:?}: {r_a}");
    }
}

#[test]
fn a_brdf_that_is_none_is_refused_in_one_line_that_says_why() {
    let good = alta(&coated_tape(), "#PARAM_OUT INV_STERADIAN_COSINE_FACTOR\n");
    let header = "#DIM 3 1\n#PARAM_IN ISOTROPIC_TL_TV_PROJ_DPHI\n#PARAM_OUT INV_STERADIAN\n";
    let every = |value: &str| {
        let rows = (0..400)
            .map(|i| format!("0.5 {} {} {value}\n", 0.05 * f64::from(i % 20), 0.05 * f64::from(i / 20)));
        format!("{header}{}", rows.collect::<String>())
    };
    let silent = alta(&coated_tape(), "");
    let wrong = alta(&Sheeting::default(), header);
    let merl = |plane: usize, value: f64| {
        let sizes = [90_i32, 90, 180].into_iter().flat_map(i32::to_le_bytes);
        sizes.chain(std::iter::repeat_n(value.to_le_bytes(), 3 * plane).flatten()).collect::<Vec<u8>>()
    };
    let cases: [(&str, Vec<u8>, &str); 16] = [
        (
            "t.dat",
            good.as_bytes()[..good.len() / 2].to_vec(),
            "numbers where #DIM says 4; is the file cut off?",
        ),
        ("t.dat", silent.into_bytes(), "as they were read; --cosine reads them so"),
        ("t.dat", every("NaN").into_bytes(), "400 are negative, not finite or above"),
        ("t.dat", every("inf").into_bytes(), "400 are negative, not finite or above"),
        ("t.dat", every("1e999").into_bytes(), "400 are negative, not finite or above"),
        ("t.dat", every("-1").into_bytes(), "400 are negative, not finite or above"),
        ("t.dat", every("0").into_bytes(), "no value is within 30 deg of the retro direction"),
        ("t.dat", every("0.1").into_bytes(), "no lobe stands out"),
        ("t.dat", every("1e300").into_bytes(), "400 are negative, not finite or above"),
        ("t.dat", wrong.into_bytes(), "no value is within 30 deg of the retro direction"),
        ("t.dat", b"#DIM 3 99999999999999999999\n".to_vec(), "#DIM needs two numbers"),
        ("t.dat", [header.as_bytes(), &vec![b'1'; 1 << 20]].concat(), "has 1 numbers where #DIM says 4"),
        ("t.dat", vec![0; 1000], "MERL's files have 90 x 90 x 180"),
        ("t.binary", merl(90 * 90 * 180, f64::NAN), "has no usable samples"),
        ("t.binary", merl(1000, 0.1), "is it cut off?"),
        ("t.binary", Vec::new(), "has no usable samples"),
    ];
    for (name, bytes, expected) in cases {
        let bench = Bench::new();
        fs::write(bench.path(name), &bytes).unwrap();
        let fit = bench.catseye(&format!("fit {name} -o t.mtlx"), "");
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]).into_owned();
        assert_eq!(
            (fit.code, fit.stderr.lines().count()),
            (1, 1),
            "{expected}: {start}: {}{}",
            fit.stdout,
            fit.stderr
        );
        assert!(fit.stderr.contains(name) && fit.stderr.contains(expected), "{expected}: {}", fit.stderr);
        assert_eq!(bench.files(), [name], "{expected}");
    }
}

/// The report of a fit that is run in a folder of its own with `table.csv`.
fn report(table: &str, options: &str) -> String {
    let bench = Bench::new();
    bench.write("table.csv", table);
    let fit =
        bench.shell(&format!("SOURCE_DATE_EPOCH=1700000000 catseye fit table.csv --report r.html {options}"));
    assert!(fit.stderr.is_empty() || fit.code == 1, "{options}: {}", fit.stderr);
    let page = fs::read_to_string(bench.path("r.html")).unwrap();
    for foreign in ["src=", "href=\"http", "<script", "@import", "NaN", "url("] {
        assert!(!page.contains(foreign), "{options}: {foreign}: the page needs nothing else");
    }
    page
}

#[test]
fn the_report_says_what_a_client_asks() {
    let header = "observation_deg,entrance_deg,value,unit,uncertainty,instrument,illuminant,source,\
                  source_aperture_deg,receiver_aperture_deg";
    let rows = ["0.2,5,250", "0.5,5,95", "0.2,30,150", "0.5,30,60"];
    let rows = rows.map(|row| format!("{row},cd/lx/m2,3%,Gonio 7,A,lab,0.1,0.05\n")).concat();
    let measured = format!("{header}\n{rows}");
    let page = report(&measured, "--colour yellow --name 'Lot 4' -o s.mtlx");
    assert_eq!(
        page.matches("<svg").count(),
        3,
        "over the observation and the entrance angle, and what is left"
    );
    let bench = Bench::new();
    bench.write("table.csv", &measured);
    let digest = bench.shell("sha256sum table.csv | cut -d' ' -f1").stdout;
    for part in [
        "<h1>Lot 4</h1>",
        "<b>Accepted</b>",
        "2023-11-14 22:13:20 UTC",
        concat!("catseye ", env!("CARGO_PKG_VERSION")),
        "catseye fit table.csv --report r.html --colour yellow --name 'Lot 4' -o s.mtlx",
        digest.trim(),
        "Gonio 7",
        "<td>A</td>",
        "<td>lab</td>",
        "source 0.1\u{b0}, receiver 0.05\u{b0}",
        "<td>s.mtlx</td>",
        "4 values of R_A, observation 0.2 to 0.5 deg, entrance 5 to 30 deg",
        "Bars: one standard deviation of the value",
        "black by day",
        "ASTM D4956 Type III yellow",
        "Not judged: luminance factor, colour, rotation",
        "lobe 1 roughness",
        "back-vector",
        "@media print",
    ] {
        assert!(page.contains(part), "{part}");
    }
    let order = ["<h1>", "<b>Accepted", "Please note", "<svg", "<h2>Standards", "<h2>Values", "<h2>Models"];
    let places: Vec<_> = order.iter().map(|part| page.find(part).unwrap()).collect();
    assert!(places.is_sorted(), "the answer comes first, the models last: {places:?}");
    assert!(
        page.contains("\u{25cf} value") && !page.contains("typical"),
        "nobody said that values are typical"
    );
}

#[test]
fn a_report_can_be_made_again_byte_by_byte() {
    assert_eq!(report(SHEET, ""), report(SHEET, ""));
    let bench = Bench::new();
    bench.write("table.csv", SHEET);
    for date in ["yesterday", "-1", "99999999999999"] {
        let fit = bench.shell(&format!("SOURCE_DATE_EPOCH={date} catseye fit table.csv --report r.html"));
        assert_eq!(fit.code, 2, "{date}");
        assert!(fit.stderr.contains("it must be seconds since 1970"), "{}", fit.stderr);
    }
    assert_eq!(bench.files(), ["table.csv"]);
}

/// What a table says is text, never markup; a report without a word of what it is of has the file's name.
#[test]
fn names_in_a_report_are_text() {
    let rows = [("0.2", "5", 380), ("0.2", "30", 215), ("0.5", "5", 135), ("0.5", "30", 75)];
    let table = |class: &str| {
        let row = |(observation, entrance, value): &(&str, &str, i32)| {
            format!("{observation},{entrance},{value},cd/lx/m2,{class},{class},{class},{class}\n")
        };
        let rows: String = rows.iter().map(row).collect();
        format!("observation_deg,entrance_deg,value,unit,class,source,instrument,illuminant\n{rows}")
    };
    let page = report(&table("</h1><script>alert(1)</script>&<b>\"\"x"), "--name '<i>\"&amp;</title>'");
    assert!(page.contains("&lt;/h1&gt;&lt;script&gt;alert(1)&lt;/script&gt;&amp;&lt;b&gt;"), "{page:.900}");
    assert!(page.contains("<h1>&lt;i&gt;&quot;&amp;amp;&lt;/title&gt;</h1>"), "{page:.900}");
    assert!(!page.contains("<b>x") && !page.contains("<i>"));
    assert!(report(&table(""), "").contains("<h1>table.csv</h1>"));
    assert!(report(&table("  "), "").contains("<h1>table.csv</h1>"));
}

#[test]
fn a_report_replaces_a_file_whole_or_not_at_all() {
    let bench = Bench::new();
    bench.write("table.csv", SHEET);
    bench.write("r.html", &"old ".repeat(100_000));
    let fit = bench.catseye("fit table.csv --report r.html", "");
    assert_eq!((fit.code, fit.stderr.as_str()), (0, ""));
    let page = fs::read_to_string(bench.path("r.html")).unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>\n") && !page.contains("old old"));
    bench.write("bad.csv", "observation_deg,entrance_deg,value\n0.2,5,x\n");
    assert_eq!(bench.catseye("fit bad.csv --report r.html", "").code, 1);
    assert_eq!(fs::read_to_string(bench.path("r.html")).unwrap(), page);
    let standard = bench.catseye("fit table.csv --report -", "");
    assert!(standard.stdout.starts_with("<!DOCTYPE html>") && standard.stderr.contains("accepted: worst"));
}

/// 12.7 MB once: a mark of two polygons for each of them.
#[test]
fn two_thousand_rows_make_less_than_a_megabyte() {
    let mut table = "observation_deg,entrance_deg,value,unit\n".to_owned();
    for (i, j) in (0..50).flat_map(|i| (0..40).map(move |j| (i, j))) {
        let [observation, entrance] = [0.1 + 0.04 * f64::from(i), -50.0 + 2.5 * f64::from(j)];
        let noise = 1.0 + 0.03 * (f64::from(37 * i + 101 * j) * 0.7).sin();
        let value =
            300.0 * 0.5_f64.powf((observation / 0.8).powi(2)) * entrance.to_radians().cos().powi(3) * noise;
        table += &format!("{observation:.2},{entrance},{value:.4},cd/lx/m2\n");
    }
    let page = report(&table, "--lobes 1 --entrance power");
    println!("{} bytes", page.len());
    assert!(page.len() < 1_000_000, "{}", page.len());
    assert!(page.contains("of 2000 values are drawn") && page.contains("The 40 of 2000 values that"));
}

#[test]
fn the_report_of_a_brdf_has_its_curves() {
    let bench = Bench::new();
    bench.write("tape.dat", &alta(&coated_tape(), "#PARAM_OUT INV_STERADIAN_COSINE_FACTOR\n"));
    let fit = bench.catseye("fit tape.dat --lobes 1 --report tape.html", "");
    let page = fs::read_to_string(bench.path("tape.html")).unwrap();
    assert_eq!(
        page.matches("<svg").count(),
        3,
        "near the lamp, the whole plane, and what is left: {}",
        fit.stdout
    );
    assert!(page.contains("<title>BRDF of tape.dat</title>") && page.contains("angle from the lamp, away"));
    // A grid of 3 degrees to 75: within 20 degrees of lamps at 15, 30 and 60 are 13, 13 and 12 of it.
    let near = page.split("Dots: ").nth(1).unwrap().split(' ').next().unwrap().parse::<usize>().unwrap();
    assert_eq!(near, 38, "marks near the lamp");
}

#[test]
fn what_is_printed_says_what_was_fitted() {
    let bench = Bench::new();
    bench.write("sheet.csv", SHEET);
    let fit = bench.catseye("fit sheet.csv", "");
    let expected = "fitted to 5 values of R_A and Y, observation 0.2 to 0.5 deg, entrance 5 to 30 deg\n";
    assert!(fit.stdout.contains(expected), "{}", fit.stdout);
    let refused = bench.catseye("fit sheet.csv --lobes 1 --tolerance 0.1 --report r.html", "");
    assert_eq!(refused.code, 1);
    assert!(refused.stdout.contains("not accepted: worst of 5 values"), "{}", refused.stdout);
    let page = fs::read_to_string(bench.path("r.html")).unwrap();
    assert!(page.contains("<b>Not accepted</b>") && !page.contains("<b>Accepted</b>"));
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

/// A table of one lobe: half power at 0.4 degrees, cos^2, at so many entrance angles; `cell` adds to a row.
fn one_lobe(header: &str, cell: impl Fn(usize, f64) -> String) -> String {
    let mut sheet = format!("observation_deg,entrance_deg,value{header}\n");
    let mut row = 0;
    for observation in [0.1, 0.2, 0.33, 0.5] {
        for entrance in [-4.0_f64, 15.0, 30.0] {
            let fall = entrance.to_radians().cos().powi(2);
            let value = 300.0 * fall * 0.5_f64.powf((observation / 0.4_f64).powi(2));
            sheet += &format!("{observation},{entrance},{}\n", cell(row, value));
            row += 1;
        }
    }
    sheet
}

#[test]
fn what_a_table_says_of_its_values_is_used_or_refused() {
    let plain = one_lobe("", |_, value| value.to_string());
    let slip = one_lobe("", |row, value| if row == 5 { 10.0 * value } else { value }.to_string());
    let mixed =
        one_lobe(",uncertainty", |row, value| format!("{value},{}", if row == 3 { "" } else { "2%" }));
    let several =
        one_lobe(",wavelength_nm", |row, value| format!("{value},{}", if row == 3 { "905" } else { "" }));
    let minutes = "obs,ent,value\n12,-4,380\n12,30,215\n30,-4,135\n30,30,75\n";
    let cases: &[(&str, &str, i32, &str)] = &[
        (
            &plain,
            "--at-least",
            2,
            "--at-least: no row of t.csv is a minimum; write `minimum` in a column `limit`",
        ),
        (&mixed, "", 1, "t.csv:5: column uncertainty: is empty, other rows have one"),
        (&several, "", 1, "t.csv:5: is of 905 nm, the first row of white light; keep the rows of one"),
        (&plain, "--tolerance 5 --tolerance-rms 5", 2, "cannot be used with"),
        (&slip, "--lobes 1 --entrance power", 1, "t.csv: no acceptable fit"),
        (minutes, "", 1, "t.csv: no"),
    ];
    for (text, options, code, message) in cases {
        let bench = Bench::new();
        bench.write("t.csv", text);
        let fit = bench.catseye(&format!("fit t.csv {options}"), "");
        assert_eq!(fit.code, *code, "{options}: {}{}", fit.stdout, fit.stderr);
        assert!(fit.stderr.contains(message), "{options}: {}\nwanted {message}", fit.stderr);
    }
    let bench = Bench::new();
    bench.write("slip.csv", &slip);
    bench.write("minutes.csv", minutes);
    let fit = bench.catseye("fit slip.csv --lobes 1 --entrance power", "");
    assert!(
        fit.stdout.contains("slip.csv:7: 1892") && fit.stdout.contains("is 9.99 times"),
        "{}",
        fit.stdout
    );
    let fit = bench.catseye("fit minutes.csv", "");
    assert!(fit.stdout.contains("are they minutes of arc?"), "{}", fit.stdout);
}

#[test]
fn standard_deviations_come_from_the_table_or_are_not_known() {
    let bench = Bench::new();
    bench.write("stated.csv", &one_lobe(",uncertainty", |_, value| format!("{value},2%")));
    bench.write("limits.csv", &one_lobe(",limit", |_, value| format!("{value},minimum")));
    let told = |command: &str| -> Value {
        let fit = bench.catseye(&format!("{command} --lobes 1 --entrance power --json"), "");
        assert_eq!((fit.code, fit.stderr.as_str()), (0, ""), "{command}");
        serde_json::from_str(&fit.stdout).unwrap()
    };
    let strength = |told: &Value| {
        let number = &told["numbers"][0];
        [&number["low"], &number["high"]].map(Value::as_f64)
    };
    let [Some(low), Some(high)] = strength(&told("fit stated.csv")) else { panic!() };
    // 2 % over the square root of twelve rows and more, as three numbers share them.
    assert!((1.012..1.03).contains(&(high / low)), "{low} to {high}");
    assert_eq!(strength(&told("fit stated.csv")), strength(&told("fit stated.csv --tolerance 12")));
    assert_eq!(strength(&told("fit limits.csv --at-least --tolerance 30")), [None, None]);
}
