//! Computed coefficients: a table that the other verbs read as it is, and what is refused.

use crate::run::{Bench, column, output};

#[test]
fn fit_and_plot_read_the_table_without_editing() {
    let bench = Bench::new();
    // Enclosed beads are those that a sum of lobes follows.
    let fitted =
        bench.shell("catseye optics bead --mount enclosed | catseye -q fit - --tolerance 25 -o film.mtlx");
    assert_eq!(fitted.code, 0, "{}", fitted.stderr);
    let plotted = bench.shell("catseye optics cube | catseye plot ra film.mtlx --standard - -o film.svg");
    assert_eq!((plotted.code, plotted.stderr.as_str()), (0, ""));
    let measured =
        bench.shell("catseye optics bead --mount enclosed | catseye measure film.mtlx --geometry -");
    assert_eq!((measured.code, measured.stderr.as_str()), (0, ""));
    for (value, model) in column(&measured.stdout, "value").iter().zip(column(&measured.stdout, "model")) {
        assert!((value / model).ln().abs() < 0.25_f64.ln_1p(), "{value} {model}");
    }
}

#[test]
fn beads_and_cubes_have_their_coefficients() {
    let bead = output("optics bead --observation 0.2 --entrance 0", "");
    assert!((column(&bead, "value")[0] / 531.6 - 1.0).abs() < 1e-3, "{bead}");
    // One mirrored cube on its axis, nearly: (4/9) A T^2 / lambda^2, of which 0.9 are reflected at each face.
    let exact = "optics cube --single --azimuth-deg 0 --error-sd-arcmin 0 --index 1.5 --metal 0.9 --fill 1 \
                 --wavelength-nm 550 --observation 0.0001 --entrance 0";
    let mirror = output(exact, "");
    assert!((column(&mirror, "value")[0] / (26384.43 * 0.9_f64.powi(3)) - 1.0).abs() < 1e-4, "{mirror}");
    assert_eq!(column(&mirror, "wavelength_nm"), [550.0]);
    let turned = output("optics cube --rotation 0,30 --observation 0.2,0.5 --entrance 5,30", "");
    assert_eq!(column(&turned, "rotation_deg"), [0.0, 0.0, 0.0, 0.0, 30.0, 30.0, 30.0, 30.0]);
}

#[test]
fn json_has_what_the_table_has() {
    let table = output("optics bead --entrance 5", "");
    let rows: serde_json::Value =
        serde_json::from_str(&output("optics bead --entrance 5 --json", "")).unwrap();
    let values: Vec<f64> =
        rows.as_array().unwrap().iter().map(|row| row["value"].as_f64().unwrap()).collect();
    assert_eq!(values, column(&table, "value"));
    let bench = Bench::new();
    let written = bench.catseye("optics bead --entrance 5 -o bead.csv", "");
    assert_eq!((written.code, written.stdout.as_str()), (0, "wrote bead.csv (8 values)\n"));
    assert_eq!(std::fs::read_to_string(bench.path("bead.csv")).unwrap(), table);
}

#[test]
fn what_no_instrument_reads_is_left_out() {
    // Towards azimuth 180 nothing comes back beyond asin(n / sqrt 3), 60 degrees.
    let cubes = "optics cube --index 1.5 --single --azimuth-deg 0 --error-sd-arcmin 0 --observation 0.2";
    let some = Bench::new().catseye(&format!("{cubes} --entrance 5,70"), "");
    let warning =
        "catseye: warning: 1 of 2 values are left out: they are 0 or beyond what instruments read\n";
    assert_eq!((some.code, some.stderr.as_str()), (0, warning));
    assert_eq!(column(&some.stdout, "entrance_deg"), [5.0]);
    let none = Bench::new().catseye(&format!("{cubes} --entrance 70"), "");
    assert_eq!(none.code, 1);
    assert!(
        none.stderr.ends_with("is one that an instrument would read, 1e-6 to 50000 cd/lx/m2\n"),
        "{}",
        none.stderr
    );
}

#[test]
fn bad_numbers_are_one_line_each() {
    for (args, message) in [
        ("bead --index 1", "the bead's index is 1, outside (1, 3]"),
        ("bead --index nan", "the bead's index is NaN, outside (1, 3]"),
        ("bead --diameter-um 0", "the diameter is 0, outside [5, 1000] um"),
        ("bead --diameter-um -60", "the diameter is -60, outside [5, 1000] um"),
        ("bead --wavelength-nm 55", "the wavelength is 55, outside [300, 2000] nm"),
        ("bead --observation 0", "the observation angle is 0, outside (0, 20] degrees"),
        ("bead --observation 25", "the observation angle is 25, outside (0, 20] degrees"),
        ("bead --entrance 89", "the entrance angle is 89, outside [-85, 85] degrees"),
        ("bead --entrance -80 --observation 10", "the viewing angle is 90, outside [0, 85] degrees"),
        ("bead --mount enclosed --index 1.4", "the bead's index is 1.4, outside (that of the medium, 3]"),
        ("bead --mount enclosed --spacing 9", "the spacing is 9, outside [1, 4] bead radii"),
        ("cube --leg-um 1e6", "the leg is 1000000, outside [10, 10000] um"),
        ("cube --errors-arcmin 0,0,90", "a dihedral error is 90, outside [-60, 60] arc minutes"),
        ("cube --metal 0", "the reflectance is 0, outside (0, 1]"),
        ("cube --rotation 400", "the rotation angle is 400, outside [-360, 360] degrees"),
    ] {
        let outcome = Bench::new().catseye(&format!("optics {args}"), "");
        assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{args}");
        assert_eq!(outcome.stderr, format!("catseye: {message}\n"), "{args}");
    }
    let pair = Bench::new().catseye("optics cube --errors-arcmin 1,2", "");
    assert_eq!(pair.code, 2);
    assert!(pair.stderr.contains("one number or three are needed: 4, or 4,-2,0"), "{}", pair.stderr);
}
