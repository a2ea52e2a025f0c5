//! `catseye drive`: the same in closed form and by rendering; every fault in a line.

use serde_json::Value;

use crate::run::{Bench, column};

/// An LM-63 file of Type A whose intensity depends on both angles.
const LAMP: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 3 3 2 0 0 0\n1 1 50\n-10 0 10\n-20 0 20\n\
                    9000 500 100\n20000 3000 200\n12000 1000 300\n";

#[test]
fn the_closed_form_and_the_rendered_scene_agree() {
    let bench = Bench::with_materials();
    bench.write("lamp.ies", LAMP);
    // The tape with lobes as narrow as sheeting's, so that half a degree matters.
    let tape = std::fs::read_to_string(bench.path("materials/anisotropic_tape.mtlx")).unwrap();
    let narrow = tape.replace("\"0.03\"", "\"0.005\"").replace("\"0.3\"", "\"0.02\"");
    assert_ne!(narrow, tape);
    bench.write("materials/narrow_tape.mtlx", &narrow);
    let scenes = [
        ("", "sheeting"),
        ("--sign overhead --vehicle truck --lamp 10000", "tape_fmvss108_c2_white"),
        ("--curve-m -600 --lamp lamp.ies --yaw-deg 10", "plate_fr_white"),
        ("--dip-m 2000 --tilt-deg 5 --vehicle van", "sheeting_astm_type_iii_white"),
        ("--turn-deg 40 --eye-left-m 1 --lamp-spacing-m 0 --windscreen 0.7", "narrow_tape"),
        ("--turn-deg -40 --lamp lamp.ies --aim-up-deg -0.5", "narrow_tape"),
    ];
    for (scene, material) in scenes {
        let args = format!("drive materials/{material}.mtlx --distance-m 200,100,50 --render --json {scene}");
        let outcome = bench.catseye(&args, "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
        let rows: Vec<Value> = serde_json::from_str(&outcome.stdout).unwrap();
        assert_eq!(rows.len(), 6);
        for row in rows {
            let [closed, rendered] =
                ["sign_luminance_cd_m2", "rendered_cd_m2"].map(|name| row[name].as_f64().unwrap());
            assert!(closed > 0.0 && (rendered / closed - 1.0).abs() < 0.02, "{args}: {closed} {rendered}");
        }
    }
    // Behind a crest both are dark.
    let args = "drive materials/sheeting.mtlx --crest-m 300 --distance-m 100 --render --json";
    let rows: Vec<Value> = serde_json::from_str(&bench.catseye(args, "").stdout).unwrap();
    assert!(rows[0]["sign_luminance_cd_m2"] == 0.0 && rows[0]["rendered_cd_m2"] == 0.0, "{}", rows[0]);
    // Turned the other way it is another sign, so the sense of the rotation was tested, too.
    let turned = |turn| {
        let eye = "--eye-left-m 1 --lamp-spacing-m 0";
        let args = format!("drive materials/narrow_tape.mtlx {eye} --distance-m 100 --csv --turn-deg {turn}");
        column(&bench.catseye(&args, "").stdout, "sign_luminance_cd_m2")[0]
    };
    assert!((turned(40) / turned(-40) - 1.0).abs() > 0.1, "{} {}", turned(40), turned(-40));
}

#[test]
fn a_table_is_read_at_the_angles_of_the_lamps() {
    let bench = Bench::new();
    bench.write("t.csv", "observation_deg,entrance_deg,value\n0.1,0,400\n1,0,40\n0.1,30,100\n1,30,10\n");
    let text = bench.catseye("drive t.csv --distance-m 150,60,20 --lamp 1000 --csv", "").stdout;
    let [alpha, beta, nu, lux] =
        ["observation_deg", "entrance_deg", "viewing_deg", "illuminance_lx"].map(|name| column(&text, name));
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 6);
    for (i, row) in rows.iter().enumerate() {
        let (r_a, luminance) = (row[16], row[18]);
        if alpha[i] > 1.0 {
            assert_eq!((r_a, luminance, row[19], row[17]), ("", "", "", "observation"), "{row:?}");
            continue;
        }
        let [r_a, luminance] = [r_a, luminance].map(|cell| cell.parse::<f64>().unwrap());
        // log10 R_A falls by 1 in 0.9 degrees of observation, ln by ln 4 in 30 degrees of entrance.
        let expected = 400.0 * 10.0_f64.powf((0.1 - alpha[i]) / 0.9) * 4.0_f64.powf(-beta[i] / 30.0);
        assert!((r_a / expected - 1.0).abs() < 1e-9, "{r_a} {expected}");
        let expected = r_a * lux[i] / nu[i].to_radians().cos();
        assert!((luminance / expected - 1.0).abs() < 1e-9, "{luminance} {expected}");
    }
    assert!(alpha.iter().any(|&angle| angle > 1.0) && alpha.iter().any(|&angle| angle < 1.0));
    let text = bench.catseye("drive t.csv --distance-m 400,20 --required 0.01", "").stdout;
    assert!(
        text.contains("* angles below the table's least, observation 0.1 and entrance 0: R_A is held"),
        "{text}"
    );
    assert!(text.contains("- angles beyond the table's greatest, observation 1 and entrance 30"), "{text}");
    assert!(text.contains("at least 0.01 cd/m2 at 400 m\n"), "{text}");
}

#[test]
fn several_subjects_are_plotted() {
    let bench = Bench::with_materials();
    for file in ["a.svg", "a.png"] {
        let subjects = "materials/sheeting.mtlx astm-d4956:iii:white fmvss108:dot-c2:white";
        let outcome = bench.catseye(&format!("drive {subjects} --required 2.4 --plot {file}"), "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{file}");
    }
    let text = std::fs::read_to_string(bench.path("a.svg")).unwrap();
    assert!(!text.contains("NaN") && !text.contains("inf"), "no undefined coordinate");
    for word in ["required: 2.4", "astm-d4956:iii:white", "sheeting.mtlx", "distance in m"] {
        assert!(text.contains(word), "{word}");
    }
}

#[test]
fn every_fault_is_said_in_a_line() {
    let bench = Bench::with_materials();
    bench.write("lamp.ies", LAMP);
    bench.write("cut.ies", &LAMP[..LAMP.len() - 20]);
    bench.write("c.ies", &LAMP.replace("3 3 3 2", "3 3 1 2"));
    bench.write("cut.ldt", "maker\n1\n");
    bench.write("two.csv", "observation_deg,entrance_deg,value,class\n0.2,4,100,A\n0.5,4,50,B\n");
    bench.write("y.csv", "observation_deg,entrance_deg,value,unit\n45,0,0.5,1\n");
    let sheet = "materials/sheeting.mtlx";
    let cases = [
        (format!("{sheet} --distance-m 0"), 1, "--distance-m: the distance is 0, outside (0, 100000] m"),
        (format!("{sheet} --distance-m -50"), 1, "--distance-m: the distance is -50, outside (0, 100000] m"),
        (
            format!("{sheet} --distance-m 50 --yaw-deg -90"),
            1,
            "--distance-m: at a distance of 50 m the sign shows its back or its edge to the left headlamp: turn it \
             to the traffic",
        ),
        (
            format!("{sheet} --distance-m 100 --curve-m 50"),
            1,
            "--distance-m: the road's turn before the sign is 114.592, outside (-90, 90) degrees",
        ),
        (format!("{sheet} --lamp-height-m 0"), 1, "the headlamps' height is 0, outside [0.05, 10] m"),
        (
            format!("{sheet} --lamp lamp.ies --distance-m 10"),
            1,
            "where the lamp's file has no intensity: take a lamp that was measured there, or another distance",
        ),
        (format!("{sheet} --lamp cut.ies"), 1, "cut.ies:8: the file ends here; an intensity is expected"),
        (
            format!("{sheet} --lamp cut.ldt"),
            1,
            "cut.ldt:2: the file ends here; the symmetry (line 3) is expected",
        ),
        (format!("{sheet} --lamp c.ies"), 1, "from straight down (`down`), with --lamp-axis"),
        (format!("{sheet} --lamp none.ies"), 1, "none.ies: can't be read"),
        (format!("{sheet} --lamp -5"), 2, "--lamp -5: must be above 0"),
        (format!("{sheet} --lamp-factor 0"), 2, "--lamp-factor 0: must be above 0"),
        (format!("{sheet} --required 0"), 2, "--required must be above 0"),
        (format!("{sheet} --plot x.jpg"), 2, "x.jpg: the name must end in .svg or .png"),
        (format!("{sheet} --plot x.svg --distance-m 50"), 2, "--plot needs two distances or more"),
        (
            "two.csv".to_owned(),
            1,
            "two.csv: has values of several classes, \"A\" and \"B\"; keep the rows of one",
        ),
        ("y.csv".to_owned(), 1, "y.csv: has no values that are R_A"),
        ("fmvss108".to_owned(), 1, "names several classes of standards"),
    ];
    for (args, code, message) in cases {
        let outcome = bench.catseye(&format!("drive {args}"), "");
        assert_eq!((outcome.code, outcome.stdout.as_str()), (code, ""), "{args}: {}", outcome.stderr);
        assert_eq!(outcome.stderr.lines().count(), 1, "{args}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{args}: {}", outcome.stderr);
    }
    let outcome = bench.catseye("drive materials/matte_white.mtlx --distance-m 50", "");
    assert_eq!((outcome.code, outcome.stderr.lines().count()), (0, 1), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("has no retro-reflective lobe"), "{}", outcome.stderr);
}
