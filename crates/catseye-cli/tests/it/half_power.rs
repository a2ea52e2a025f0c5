//! `catseye roughness` converts half-power angle and roughness into each other, and R_A and tint.

use crate::run::Bench;

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
