//! `catseye lidar`: the reflectance of a matte surface that returns as much.

use std::f64::consts::PI;

use serde_json::Value;

use crate::run::{Bench, column};

#[test]
fn reflectance_is_pi_r_a_over_both_cosines() {
    let bench = Bench::with_materials();
    let text =
        bench.catseye("lidar materials/sheeting.mtlx --observation-deg 0.2 --tint 905=0.5 --csv", "").stdout;
    bench.write(
        "g.csv",
        "observation_deg,entrance_deg\n0.2,0\n0.2,10\n0.2,20\n0.2,30\n0.2,40\n0.2,50\n0.2,60\n",
    );
    let measured = bench.catseye("measure materials/sheeting.mtlx --geometry g.csv", "").stdout;
    let [beta, nu, r_a, reflectance] =
        ["entrance_deg", "viewing_deg", "r_a", "reflectance"].map(|name| column(&text, name));
    for (i, visible) in column(&measured, "model").into_iter().enumerate() {
        assert!((r_a[i] / (0.5 * visible) - 1.0).abs() < 1e-9, "{} {visible}", r_a[i]);
        let cosines = beta[i].to_radians().cos() * nu[i].to_radians().cos();
        assert!((reflectance[i] / (PI * r_a[i] / cosines) - 1.0).abs() < 1e-9);
    }
    // The luminance factor, which measure computes without R_A, is the same number.
    let geometries = std::fs::read_to_string(bench.path("g.csv")).unwrap();
    let geometries: String = geometries
        .lines()
        .map(|row| format!("{row},{}\n", if row.starts_with('o') { "quantity" } else { "Y" }))
        .collect();
    bench.write("y.csv", &geometries);
    for material in ["sheeting", "matte_white"] {
        let args = format!("--quiet lidar materials/{material}.mtlx --observation-deg 0.2 --csv");
        let values = column(&bench.catseye(&args, "").stdout, "reflectance");
        let measured =
            bench.catseye(&format!("measure materials/{material}.mtlx --geometry y.csv"), "").stdout;
        for (value, expected) in values.into_iter().zip(column(&measured, "model")) {
            assert!((value / expected - 1.0).abs() < 1e-9, "{material}: {value} {expected}");
        }
    }
}

/// `R_A` 250 at 0.2 degree is 785 times a white Lambertian: the number that simulators' users ask for.
#[test]
fn a_table_s_value_becomes_a_laser_retro() {
    let bench = Bench::new();
    bench.write("t.csv", "observation_deg,entrance_deg,value\n0.2,0,250\n1,0,10\n");
    let spacing = 1000.0 * 20.0 * 0.2_f64.to_radians().tan();
    let args = format!("lidar t.csv --spacing-mm {spacing} --distance-m 20 --tint 905=1 --entrance-deg 0");
    let sdf = bench.catseye(&format!("{args} --sdf --white 100"), "");
    assert_eq!((sdf.code, sdf.stderr.as_str()), (0, ""));
    let expected = "<!-- t.csv: 785.4 times a perfect white surface at observation 0.2 deg, entrance 0 deg, 905 nm, \
                    1 of visible light -->\n<laser_retro>78540.";
    assert!(sdf.stdout.starts_with(expected), "{}", sdf.stdout);
    let rows: Vec<Value> =
        serde_json::from_str(&bench.catseye(&format!("{args} --json"), "").stdout).unwrap();
    assert_eq!(rows[0]["wavelength_nm"], 905.0);
    assert!((rows[0]["reflectance"].as_f64().unwrap() / 785.4 - 1.0).abs() < 1e-4);
    let text = bench.catseye("lidar t.csv --observation-deg 0.5 --entrance-deg 0,30 --tint 905=1", "").stdout;
    assert!(text.contains("- angles beyond the table's greatest"), "{text}");
}

#[test]
fn every_fault_is_said_in_a_line() {
    let bench = Bench::with_materials();
    bench.write("t.csv", "observation_deg,entrance_deg,value\n0.2,0,250\n1,0,10\n");
    let sheet = "materials/sheeting.mtlx";
    let cases = [
        (format!("{sheet} --observation-deg 95"), 2, "--observation-deg 95: must be in [0, 90)"),
        (format!("{sheet} --spacing-mm 50 --distance-m 0"), 2, "--distance-m 0: must be above 0"),
        (
            format!("{sheet} --observation-deg 1 --entrance-deg 90"),
            2,
            "--entrance-deg 90: emitter and receiver",
        ),
        (format!("{sheet} --observation-deg 1 --sdf"), 2, "--sdf has room for one number"),
        (
            format!("{sheet} --observation-deg 1 --entrance-deg 0 --sdf --white 0 --tint 905=1"),
            2,
            "--white 0: must be above 0",
        ),
        (
            "t.csv --observation-deg 2 --entrance-deg 0 --sdf --tint 905=1".to_owned(),
            1,
            "t.csv: the angles are beyond the table's greatest, where R_A is not known",
        ),
    ];
    for (args, code, message) in cases {
        let outcome = bench.catseye(&format!("--quiet lidar {args}"), "");
        assert_eq!((outcome.code, outcome.stdout.as_str()), (code, ""), "{args}: {}", outcome.stderr);
        assert_eq!(outcome.stderr.lines().count(), 1, "{args}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{args}: {}", outcome.stderr);
    }
    for tint in ["5=0.5", "905=2", "1e9=0.5", "blue"] {
        let outcome = bench.catseye(&format!("lidar {sheet} --observation-deg 1 --tint {tint}"), "");
        assert!(outcome.code == 2 && outcome.stderr.contains("--tint"), "{tint}: {}", outcome.stderr);
    }
    let outcome = bench.catseye(&format!("lidar {sheet} --observation-deg 1"), "");
    assert!(
        outcome.code == 0 && outcome.stderr.contains("state it with --tint 905=FACTOR"),
        "{}",
        outcome.stderr
    );
}
