//! Promise: what is written for ASAM `OpenMATERIAL` 3D is what its schemas (version 1.0.0) demand, and means
//! the material.

use std::f64::consts::{FRAC_PI_2, TAU};

use catseye::{Lobe as _, Params, Reciprocal, Vec3};
use catseye_photometry::openmaterial::{Assumption, Band, BrdfTable, Metadata, OpenMaterial, write_material};
use catseye_photometry::{Geometry, Quantity};
use serde_json::Value;

fn lobe() -> Reciprocal<f64> {
    Reciprocal::new(&Params::isotropic(0.006).with_tint([0.06; 3])).unwrap()
}

fn metadata() -> Metadata {
    Metadata { description: "A test's own.".to_owned(), ..Metadata::named("White \"sheeting\"") }
}

/// The demands of the schemas on `metadata`, by hand: no copy of them is kept here.
fn assert_metadata(document: &Value, more: &[&str]) {
    let metadata = &document["metadata"];
    let strings = ["name", "uuid", "materialVersion", "openMaterial3dVersion", "license"];
    for key in strings.iter().chain(more) {
        assert!(metadata[key].is_string(), "{key}: {metadata}");
    }
    for key in ["copyrights", "authors"] {
        let list = metadata[key].as_array().unwrap();
        assert!(!list.is_empty() && list.iter().all(Value::is_string), "{key}");
    }
    for key in ["materialVersion", "openMaterial3dVersion"] {
        let version = metadata[key].as_str().unwrap();
        assert!(
            version.split('.').count() == 3 && version.split('.').all(|part| part.parse::<u32>().is_ok())
        );
    }
    let uuid = metadata["uuid"].as_str().unwrap();
    let groups: Vec<usize> = uuid.split('-').map(str::len).collect();
    assert!(groups == [8, 4, 4, 4, 12] && uuid.chars().all(|c| c == '-' || c.is_ascii_hexdigit()), "{uuid}");
    assert!(
        uuid[14..].starts_with('8') && "89ab".contains(&uuid[19..20]),
        "version 8, variant of RFC 9562: {uuid}"
    );
}

#[test]
fn a_material_file_holds_the_coefficient_and_is_read_back() {
    let text = write_material(&metadata(), 251.5, "simulated, 0.2 deg", Some("white_brdf.xompt")).unwrap();
    let document: Value = serde_json::from_str(&text).unwrap();
    assert_metadata(&document, &[]);
    let properties = &document["materialProperties"];
    assert_eq!(properties["retroreflectivityData"]["coefficientOfRetroreflection"], 251.5);
    assert_eq!(properties["brdfUris"], serde_json::json!(["white_brdf.xompt"]));
    let read = OpenMaterial::parse(&text, "white.xomp").unwrap();
    let expected = OpenMaterial {
        name: "White \"sheeting\"".to_owned(),
        coefficient: 251.5,
        sources: "simulated, 0.2 deg".to_owned(),
    };
    assert_eq!(read, expected);

    let table = read.table(&Assumption::default()).unwrap();
    let [row] = table.rows() else { panic!("one row: {table:?}") };
    assert_eq!((row.observation_deg, row.entrance_deg, row.value), (0.2, -4.0, Some(251.5)));
    assert_eq!(
        (row.quantity, row.class.as_str()),
        (Quantity::RetroReflectionCoefficient, "White \"sheeting\"")
    );
    assert!(Assumption::default().sentence().contains("0.2 deg observation and -4 deg entrance"));
}

#[test]
fn the_assumed_lobe_is_that_of_common_sheeting() {
    let assumption = Assumption::default();
    let roughness = assumption.roughness().unwrap();
    let angle = catseye_photometry::half_power::half_power_angle(roughness).unwrap().to_degrees();
    assert!((angle - assumption.half_power_deg).abs() < 1e-9);
    // Lobes that fit ASTM D4956 Types I to III have roughness 0.0056 to 0.0062.
    assert!((0.0056..0.0062).contains(&roughness), "{roughness}");
}

#[test]
fn a_table_has_sorted_rows_within_the_schema_that_are_the_brdf() {
    let bands = vec![
        Band { wavelength_nm: 1550.0, tint: 0.1 },
        Band::VISIBLE,
        Band { wavelength_nm: 905.0, tint: 0.3 },
    ];
    let table = BrdfTable { bands, receiver_solid_angle: Some(2.4e-6) };
    let brdf = |geometry: &Geometry| lobe().eval(geometry.wo, geometry.wi)[1];
    let text = table.write(&metadata(), "computed", brdf).unwrap();
    let document: Value = serde_json::from_str(&text).unwrap();
    assert_metadata(&document, &["sources"]);
    let content = &document["brdf"];
    let wavelengths: Vec<f64> =
        content["wavelengths"].as_array().unwrap().iter().map(|w| w.as_f64().unwrap()).collect();
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
    assert!(wavelengths.iter().zip([5.55e-7, 9.05e-7, 1.55e-6]).all(|(a, b)| near(*a, b)), "{wavelengths:?}");
    let angles = content["receiverSolidAngles"].as_array().unwrap();
    assert!(angles.len() == 3 && angles.iter().all(|entry| entry["solidAngle"] == 2.4e-6));

    let row = |row: &Value| -> [f64; 5] {
        let numbers: Vec<f64> = row.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
        numbers.try_into().unwrap()
    };
    let rows: Vec<[f64; 5]> = content["lookupTable"].as_array().unwrap().iter().map(row).collect();
    assert!(rows.windows(2).all(|pair| pair[0][..4] < pair[1][..4]), "sorted by the columns, none twice");
    // The schema cuts pi / 2 and 2 pi off after six decimals.
    let [max_zenith, max_azimuth] = [FRAC_PI_2, TAU].map(|angle| (angle * 1e6).floor() / 1e6);
    let mut peak: f64 = 0.0;
    for &[wavelength, incident, exit, azimuth, value] in &rows {
        assert!((0.0..=max_zenith).contains(&incident) && (0.0..=max_zenith).contains(&exit));
        assert!((0.0..=max_azimuth).contains(&azimuth) && value >= 0.0);
        let tint = [1.0, 0.3, 0.1][wavelengths.iter().position(|w| *w == wavelength).unwrap()];
        let geometry =
            Geometry { wo: Vec3::from_angles(exit, azimuth), wi: Vec3::from_angles(incident, 0.0) };
        let expected = tint * brdf(&geometry);
        // Numbers are printed with the digits that give the same value back.
        assert!(
            (value - expected).abs() <= 1e-9 * expected,
            "{incident} {exit} {azimuth}: {value} {expected}"
        );
        peak = peak.max(value);
    }
    // The peak itself is in the table: tint (n + 1) / (4 pi) at incidence 0.
    let zero = Geometry { wo: Vec3::from_angles(0.0, 0.0), wi: Vec3::from_angles(0.0, 0.0) };
    assert!(peak >= brdf(&zero), "{peak}");
    assert!(rows.len() < 60_000 && text.len() < 5 << 20, "{} rows, {} bytes", rows.len(), text.len());
}

#[test]
fn the_same_material_makes_the_same_file() {
    let write = || write_material(&metadata(), 1.0, "", None).unwrap();
    assert_eq!(write(), write());
    let other = write_material(&Metadata::named("other"), 1.0, "", None).unwrap();
    assert_ne!(write().split("uuid").nth(1), other.split("uuid").nth(1));
}

#[test]
fn bad_files_and_numbers_are_refused_by_name() {
    let data = |value: &str| {
        format!(
            r#"{{"materialProperties": {{"retroreflectivityData": {{"coefficientOfRetroreflection": {value}}}}}}}"#
        )
    };
    for (text, problem) in [
        ("", "is not a .xomp file"),
        ("[]", "has no number at materialProperties.retroreflectivityData"),
        (&data("\"250\""), "has no number"),
        (&data("null"), "has no number"),
        (&data("0"), "is 0; it must be above 0"),
        (&data("-3"), "is -3"),
        (&data("5001"), "at most 5000"),
        (&data("1e999"), "is not a .xomp file"),
    ] {
        let message = OpenMaterial::parse(text, "bad.xomp").unwrap_err().to_string();
        assert!(message.starts_with("bad.xomp: ") && message.contains(problem), "{text}: {message}");
    }
    for coefficient in [-1.0, f64::NAN, 6000.0] {
        assert!(write_material(&metadata(), coefficient, "", None).is_err());
    }
    assert!(write_material(&metadata(), 1.0, "", Some("table.json")).is_err());

    let refused = |bands: Vec<Band>, receiver_solid_angle| {
        BrdfTable { bands, receiver_solid_angle }.write(&metadata(), "", |_| 1.0).unwrap_err().to_string()
    };
    let band = |wavelength_nm, tint| Band { wavelength_nm, tint };
    assert!(refused(vec![], None).contains("a wavelength"));
    assert!(refused(vec![band(0.5, 1.0)], None).contains("0.5 nm"));
    assert!(refused(vec![band(905.0, f64::NAN)], None).contains("NaN at 905"));
    assert!(refused(vec![band(905.0, 0.1), band(905.0, 0.2)], None).contains("twice"));
    assert!(refused(vec![Band::VISIBLE], Some(0.0)).contains("solid angle"));
}
