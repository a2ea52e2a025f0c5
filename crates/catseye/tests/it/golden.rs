//! The published vectors in `conformance/`: the reference implementation's answers, and the project's own.

use std::collections::HashMap;

use catseye::albedo::exact;
use catseye::{Component, Lobe as _, Params, Reciprocal, Vec3};

/// The rows of a file, by column.
fn rows(name: &str) -> Vec<HashMap<String, String>> {
    let path = format!("{}/../../conformance/{name}", env!("CARGO_MANIFEST_DIR"));
    let mut reader = csv::Reader::from_path(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    reader.deserialize().map(|row| row.unwrap_or_else(|error| panic!("{path}: {error}"))).collect()
}

fn number(row: &HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("column {column}: {:?}", row[column]))
}

fn vector(row: &HashMap<String, String>, name: &str) -> Vec3<f64> {
    Vec3::new(
        number(row, &format!("{name}_x")),
        number(row, &format!("{name}_y")),
        number(row, &format!("{name}_z")),
    )
}

fn colour(row: &HashMap<String, String>, name: &str) -> [f64; 3] {
    ["r", "g", "b"].map(|c| number(row, &format!("{name}_{c}")))
}

fn roughness(row: &HashMap<String, String>) -> [f64; 2] {
    [number(row, "roughness_u"), number(row, "roughness_v")]
}

fn assert_close(found: f64, expected: f64, relative: f64, row: &HashMap<String, String>) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} for {expected} in {row:?}");
}

#[test]
fn reference_eval() {
    let rows = rows("reference_eval.csv");
    assert_eq!(rows.len(), 1500);
    for row in &rows {
        let [u, v] = roughness(row);
        let lobe = Reciprocal::new(&Params::anisotropic(u, v)).unwrap();
        let (f, pdf) = lobe.eval_pdf(vector(row, "wo"), vector(row, "wi"));
        assert_close(f[0], number(row, "f"), 1e-9, row);
        assert_close(pdf, number(row, "pdf"), 1e-9, row);
    }
}

#[test]
fn reference_albedo() {
    let rows = rows("reference_albedo.csv");
    assert_eq!(rows.len(), 120);
    for row in &rows {
        let ([u, v], expected) = (roughness(row), number(row, "albedo_single"));
        let exact = exact::directional([u, v], vector(row, "wo"));
        // The reference's own numbers carry the error of their quadrature, up to 8e-6.
        assert!((exact - expected).abs() < 1e-5, "{exact} for {expected} in {row:?}");
        let fast = Reciprocal::new(&Params::anisotropic(u, v)).unwrap().albedo(vector(row, "wo"))[0];
        let bound = if u == v { 1e-4 } else { 1e-3 };
        assert!((fast - expected).abs() < bound, "{fast} for {expected} in {row:?}");
    }
}

#[test]
fn reference_albedo_table() {
    let rows = rows("reference_albedo_table.csv");
    assert_eq!(rows.len(), 4032);
    for row in &rows {
        let (r, expected) = (number(row, "roughness"), number(row, "albedo_single"));
        // The last column of the table stands for the horizon itself, where the albedo has a limit.
        let cos = number(row, "theta_deg").to_radians().cos().max(2e-9);
        let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
        let fast = Reciprocal::new(&Params::isotropic(r)).unwrap().albedo(wo)[0];
        // The fit's bound and the 2e-5 that the table is good to.
        assert!((fast - expected).abs() < 1.2e-4, "{fast} for {expected} in {row:?}");
    }
}

#[test]
fn eval() {
    let rows = rows("eval.csv");
    assert_eq!(rows.len(), 400);
    for row in &rows {
        let [u, v] = roughness(row);
        let params = Params::anisotropic(u, v)
            .with_tint(colour(row, "tint"))
            .with_multiscatter_tint(colour(row, "multiscatter_tint"));
        let (wo, wi) = (vector(row, "wo"), vector(row, "wi"));
        let f = Reciprocal::new(&params).unwrap().eval(wo, wi);
        // f_ms is a product of two losses over a third: each is off by at most the fit's bound.
        let loss = |w| 1.0 - exact::directional([u, v], w);
        let average = 1.0 - exact::average([u, v]);
        let slack = 1e-3 * (loss(wo) + loss(wi)) / (std::f64::consts::PI * average) + 1e-6;
        for (c, expected) in colour(row, "f").into_iter().enumerate() {
            assert!((f[c] - expected).abs() <= slack + 1e-9 * expected, "{} for {expected} in {row:?}", f[c]);
        }
    }
}

#[test]
fn sample() {
    let rows = rows("sample.csv");
    assert!(rows.len() > 390);
    let mut compensated = 0;
    for row in &rows {
        let [u, v] = roughness(row);
        let params = Params::anisotropic(u, v).with_multiscatter_tint(colour(row, "multiscatter_tint"));
        let numbers = [number(row, "u1"), number(row, "u2"), number(row, "u3")];
        let s = Reciprocal::new(&params).unwrap().sample(vector(row, "wo"), numbers).unwrap();
        let expected = vector(row, "wi");
        for (found, expected) in <[f64; 3]>::from(s.wi).into_iter().zip(<[f64; 3]>::from(expected)) {
            assert!((found - expected).abs() < 1e-9, "{s:?} in {row:?}");
        }
        assert_close(s.pdf, number(row, "pdf"), 1e-7, row);
        s.weight
            .into_iter()
            .zip(colour(row, "weight"))
            .for_each(|(found, expected)| assert_close(found, expected, 1e-7, row));
        assert_eq!(s.component.name(), row["lobe"]);
        compensated += usize::from(s.component == Component::Multiple);
    }
    assert!(compensated > 40, "{compensated}");
}

#[test]
fn albedo() {
    let rows = rows("albedo.csv");
    assert_eq!(rows.len(), 300);
    for row in &rows {
        let ([u, v], wo) = (roughness(row), vector(row, "wo"));
        assert!((exact::directional([u, v], wo) - number(row, "albedo_single")).abs() < 1e-9);
        assert!((exact::average([u, v]) - number(row, "albedo_average")).abs() < 1e-9);
        let fast = Reciprocal::new(&Params::anisotropic(u, v)).unwrap().albedo(wo)[0];
        assert!((fast - number(row, "albedo_single")).abs() < 1e-3, "{fast} in {row:?}");
    }
}
