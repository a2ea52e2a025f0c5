//! `catseye roughness` converts half-power angle and roughness into each other, and R_A and tint; what
//! `catseye measure` finds of `retro_sheeting_surface` is what its inputs say.

use crate::run::{Bench, column};

#[test]
fn roughness_and_half_power_angle_lead_to_each_other() {
    let facts = |args: &str| -> serde_json::Value {
        let outcome = Bench::new().catseye(&format!("roughness {args} --json"), "");
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
        serde_json::from_str(&outcome.stdout).unwrap()
    };
    let there = facts("--half-power-deg 0.5 --ra 250");
    let roughness = there["roughness"].as_f64().unwrap();
    let back = facts(&format!("--roughness {roughness} --tint {}", there["tint"]));
    assert!((back["half_power_angle_deg"].as_f64().unwrap() - 0.5).abs() < 1e-12);
    assert!((back["peak_r_a"].as_f64().unwrap() - 250.0).abs() < 1e-9);
    assert_eq!(facts("--roughness inf")["roughness"], "inf");
    let cases = [
        ("--half-power-deg 50", 1, "is 50, outside (0, 44.2] degrees"),
        ("--half-power-deg 0", 1, "the half-power angle is 0"),
        ("--roughness 0", 1, "perfect retro-reflector"),
        ("--roughness=-1", 1, "the roughness is -1"),
        ("--half-power-deg 30 --ra 250", 1, "no lobe this wide has R_A = 250"),
        ("--roughness 1 --tint 2", 2, "--tint 2 is outside [0, 1]"),
        ("--roughness 1 --half-power-deg 1", 2, "cannot be used with"),
    ];
    for (args, code, message) in cases {
        let outcome = Bench::new().catseye(&format!("roughness {args}"), "");
        assert_eq!((outcome.code, outcome.stdout.as_str()), (code, ""), "{args}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{args}: {}", outcome.stderr);
    }
}

/// R_A of `retro_sheeting_surface` without base and coat, with these inputs, in the rows' order.
fn sheeting_surface(inputs: &[(&str, f64)], rows: &str) -> Vec<f64> {
    let inputs: String = inputs
        .iter()
        .map(|(name, value)| format!(r#"<input name="{name}" type="float" value="{value}" />"#))
        .collect();
    let bench = Bench::new();
    bench.write(
        "m.mtlx",
        &format!(
            r#"<materialx version="1.39"><retro_sheeting_surface name="s" type="surfaceshader">{inputs}
            <input name="coat" type="float" value="0" /><input name="base_color" type="color3" value="0, 0, 0" />
            </retro_sheeting_surface><surfacematerial name="m" type="material">
            <input name="surfaceshader" type="surfaceshader" nodename="s" /></surfacematerial></materialx>"#
        ),
    );
    let rows = format!("observation_deg,entrance_deg,rotation_deg\n{rows}");
    let outcome = bench.catseye("measure m.mtlx --geometry -", &rows);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    column(&outcome.stdout, "model")
}

/// How far a half-power angle measured at an entrance and a rotation angle is from `expected`, as a ratio.
fn half_power_error(inputs: &[(&str, f64)], entrance: f64, rotation: f64, expected: f64) -> f64 {
    // Near half power the lobe is a Gaussian: log2 of the rest grows as the square of the angle.
    let values =
        sheeting_surface(inputs, &format!("0,{entrance},{rotation}\n{expected},{entrance},{rotation}\n"));
    (values[0] / values[1]).log2().powf(-0.5) - 1.0
}

#[test]
fn an_artists_half_power_angle_holds_at_every_entrance_angle() {
    for half_power in [0.1, 0.4] {
        for entrance in [0.0, 30.0, 60.0] {
            let error = half_power_error(&[("half_power_angle", half_power)], entrance, 0.0, half_power);
            assert!(error.abs() < 0.01, "{half_power} at {entrance}: {error}");
        }
        // On the other side of the lamp the fall-off adds to what reciprocity takes: docs/specification.md.
        let error = half_power_error(&[("half_power_angle", half_power)], -60.0, 0.0, half_power);
        assert!(error.abs() < 0.085 * half_power, "{half_power}: {error}");
    }
    let both = [("half_power_angle", 0.2), ("half_power_angle_across", 0.4)];
    for entrance in [0.0, 30.0, 60.0] {
        for (rotation, expected) in [(0.0, 0.2), (90.0, 0.4), (180.0, 0.2)] {
            let error = half_power_error(&both, entrance, rotation, expected);
            assert!(error.abs() < 0.01, "{rotation} at {entrance}: {error}");
        }
    }
}

#[test]
fn beside_the_lamp_an_artists_sheeting_follows_the_entrance_law() {
    let entrance = [0.0_f64, 10.0, 30.0, 45.0, 60.0, 75.0];
    let rows: String = entrance.iter().map(|beta| format!("0,{beta},0\n")).collect();
    for (falloff, bend, sharpness) in
        [(3.0, 45.0, 2.0), (0.0, 45.0, 2.0), (2.5, 35.0, 10.0), (6.0, 60.0, 1.0)]
    {
        let inputs =
            [("entrance_falloff", falloff), ("entrance_bend", bend), ("entrance_bend_sharpness", sharpness)];
        let found = sheeting_surface(&inputs, &rows);
        for (beta, value) in entrance.iter().zip(&found) {
            let ratio = beta.to_radians().tan() / bend.to_radians().tan();
            let law = (1.0 + ratio.powf(sharpness)).powf(-falloff / sharpness);
            // Renderers' single precision.
            assert!((value / found[0] / law - 1.0).abs() < 1e-3, "{inputs:?} {beta}: {value} {law}");
        }
    }
}
