//! The virtual retroreflectometer reads what the BSDF says.
//!
//! Tolerances are 1 %, the promise; the readings scatter by a third of that at most.

use std::f64::consts::{PI, TAU};

use catseye::{AnyLobe, Lobe as _, Model, Params, Vec3};
use catseye_materialx::{Closure, Document, Material};
use catseye_render::{Estimate, Retroreflectometer};

use crate::common::{diffuse, retro};

/// Apertures of 0.01 degrees and a specimen to match: the instrument's ideal.
const SMALL: Retroreflectometer = Retroreflectometer {
    distance_m: 15.0,
    specimen_side_m: 0.01,
    source_aperture_m: 0.0026,
    receiver_aperture_m: 0.0026,
};
/// Observation, entrance and rotation angles in degrees.
const GEOMETRIES: [[f64; 3]; 8] = [
    [0.2, -4.0, 0.0],
    [0.2, 30.0, 0.0],
    [0.33, 40.0, 90.0],
    [0.5, -4.0, 90.0],
    [0.5, 30.0, 45.0],
    [1.0, 40.0, 0.0],
    [2.0, -4.0, 90.0],
    [2.0, 40.0, 0.0],
];

/// Receiver and source for coplanar geometry: a turn of the specimen by epsilon is one of the instrument by
/// -epsilon.
fn directions([alpha, beta, epsilon]: [f64; 3]) -> [Vec3<f64>; 2] {
    [beta + alpha, beta].map(|angle| Vec3::from_angles(angle.to_radians(), -epsilon.to_radians()))
}

/// A BSDF written down by hand.
type Bsdf = Box<dyn Fn(Vec3<f64>, Vec3<f64>) -> f64 + Sync>;

struct Case {
    name: &'static str,
    material: Material,
    bsdf: Bsdf,
}

fn lobe(params: Params<f32>) -> AnyLobe<f64> {
    let double = Params::anisotropic(params.roughness()[0].into(), params.roughness()[1].into())
        .with_tint(params.tint.map(f64::from));
    AnyLobe::new(Model::Reciprocal, &double).expect("legal parameters")
}

fn case(
    name: &'static str,
    closure: Closure,
    bsdf: impl Fn(Vec3<f64>, Vec3<f64>) -> f64 + Sync + 'static,
) -> Case {
    Case { name, material: Material::of(closure), bsdf: Box::new(bsdf) }
}

/// A lobe whose tint is the cube of the viewer's cosine.
const VIEW_DEPENDENT: &str = r#"<materialx version="1.39">
  <viewdirection name="view" type="vector3" />
  <normal name="up" type="vector3" />
  <dotproduct name="cosine" type="float">
    <input name="in1" type="vector3" nodename="view" />
    <input name="in2" type="vector3" nodename="up" />
  </dotproduct>
  <absval name="facing" type="float"><input name="in" type="float" nodename="cosine" /></absval>
  <power name="cube" type="float">
    <input name="in1" type="float" nodename="facing" />
    <input name="in2" type="float" value="3" />
  </power>
  <convert name="tint" type="color3"><input name="in" type="float" nodename="cube" /></convert>
  <retro_reflective_bsdf name="beads" type="BSDF">
    <input name="roughness_u" type="float" value="0.02" />
    <input name="tint" type="color3" nodename="tint" />
  </retro_reflective_bsdf>
  <uniform_edf name="glow" type="EDF"><input name="color" type="color3" value="3, 2, 1" /></uniform_edf>
  <surface name="surface" type="surfaceshader">
    <input name="bsdf" type="BSDF" nodename="beads" />
    <input name="edf" type="EDF" nodename="glow" />
  </surface>
  <surfacematerial name="m" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="surface" />
  </surfacematerial>
</materialx>"#;

fn cases() -> Vec<Case> {
    let narrow = Params::isotropic(0.008).with_tint([0.06; 3]);
    let wide = Params::isotropic(0.02).with_tint([0.03; 3]);
    let tape = Params::anisotropic(0.01, 0.04).with_tint([0.2; 3]);
    let (n, w, t, v) = (lobe(narrow), lobe(wide), lobe(tape), lobe(Params::isotropic(0.02)));
    let sum = Closure::Add {
        a: Box::new(Closure::Add { a: Box::new(retro(narrow)), b: Box::new(retro(wide)) }),
        b: Box::new(diffuse(0.4, 0.0)),
    };
    let view_dependent =
        Document::parse(VIEW_DEPENDENT, "view.mtlx").and_then(|document| document.material(None));
    vec![
        case("narrow lobe", retro(narrow), move |wo, wi| n.eval(wo, wi)[1]),
        case("two lobes and a diffuse base", sum, move |wo, wi| {
            n.eval(wo, wi)[1] + w.eval(wo, wi)[1] + 0.4 / PI
        }),
        case("anisotropic lobe", retro(tape), move |wo, wi| t.eval(wo, wi)[1]),
        Case {
            name: "tint that depends on the viewer",
            material: view_dependent.expect("a legal document"),
            bsdf: Box::new(move |wo, wi| v.eval(wo, wi)[1] * wo.z.powi(3)),
        },
    ]
}

fn read(instrument: &Retroreflectometer, case: &Case, geometry: [f64; 3]) -> Estimate {
    let reading = instrument.measure(&case.material, Model::Reciprocal, directions(geometry), 1 << 16, 1);
    reading.expect("a legal measurement").r_a([0.0, 1.0, 0.0])
}

/// Promise: within 1 %, and the stated standard error is that small.
fn assert_reads(instrument: &Retroreflectometer, case: &Case, geometry: [f64; 3], expected: f64) {
    let Estimate { value, standard_error } = read(instrument, case, geometry);
    let what = format!("{}, {geometry:?}: {value} +- {standard_error}, {expected}", case.name);
    assert!((value / expected - 1.0).abs() < 0.01, "{what}");
    assert!(standard_error < 3e-3 * expected, "{what}");
}

#[test]
fn small_apertures_read_the_closed_form() {
    for case in cases() {
        for geometry in GEOMETRIES {
            let [wo, wi] = directions(geometry);
            assert_reads(&SMALL, &case, geometry, (case.bsdf)(wo, wi) * wo.z * wi.z);
        }
    }
}

/// Points of a disk that weigh alike: rings of equal area.
fn disk(radius: f64) -> impl Iterator<Item = [f64; 2]> + Clone {
    const RINGS: u32 = 6;
    const POINTS: u32 = 16;
    (0..RINGS * POINTS).map(move |i| {
        let r = radius * ((f64::from(i / POINTS) + 0.5) / f64::from(RINGS)).sqrt();
        let (sin, cos) = (TAU * (f64::from(i % POINTS) + 0.5) / f64::from(POINTS)).sin_cos();
        [r * cos, r * sin]
    })
}

/// The mean of R_A over both apertures, in the most plain way.
fn mean_over_apertures(case: &Case, geometry: [f64; 3], radius: f64) -> f64 {
    let [wo, wi] = directions(geometry);
    let moved = |w: Vec3<f64>, [x, y]: [f64; 2]| {
        let across = Vec3::new(w.y, -w.x, 0.0).normalized();
        let up = Vec3::new(-w.z * across.y, w.z * across.x, w.x * across.y - w.y * across.x);
        Vec3::new(w.x + across.x * x + up.x * y, w.y + across.y * x + up.y * y, w.z + up.z * y).normalized()
    };
    let (mut sum, mut count) = (0.0, 0.0);
    for at_receiver in disk(radius) {
        for at_source in disk(radius) {
            let (wo, wi) = (moved(wo, at_receiver), moved(wi, at_source));
            sum += (case.bsdf)(wo, wi) * wo.z * wi.z;
            count += 1.0;
        }
    }
    sum / count
}

#[test]
fn wide_apertures_read_the_mean_over_both() {
    // 0.4 degrees: a third of the widest, more than the narrowest lobe's half width.
    let radius = 0.2_f64.to_radians();
    let aperture = (2.0 * 15.0 * radius) as f32;
    let wide = Retroreflectometer { source_aperture_m: aperture, receiver_aperture_m: aperture, ..SMALL };
    for case in cases() {
        for geometry in [[0.5, -4.0, 0.0], [0.5, 30.0, 90.0], [1.0, 40.0, 0.0]] {
            assert_reads(&wide, &case, geometry, mean_over_apertures(&case, geometry, radius));
        }
    }
}

#[test]
fn the_standard_instrument_is_near_the_ideal_one() {
    // A specimen of 20 cm and apertures of 0.1 degrees: what is measured in practice.
    for case in cases() {
        for geometry in [[0.2, -4.0, 0.0], [0.5, 30.0, 0.0]] {
            let expected = mean_over_apertures(&case, geometry, 0.05_f64.to_radians());
            assert_reads(&Retroreflectometer::default(), &case, geometry, expected);
        }
    }
}

#[test]
fn any_number_of_threads_reads_the_same_bits() {
    let case = &cases()[1];
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| read(&SMALL, case, GEOMETRIES[0]))
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn the_standard_error_is_what_other_seeds_scatter() {
    let case = &cases()[1];
    let readings: Vec<Estimate> = (0..24)
        .map(|seed| {
            let directions = directions(GEOMETRIES[4]);
            let reading = SMALL.measure(&case.material, Model::Reciprocal, directions, 1 << 10, seed);
            reading.expect("a legal measurement").r_a([0.0, 1.0, 0.0])
        })
        .collect();
    let mean = |of: &dyn Fn(&Estimate) -> f64| readings.iter().map(of).sum::<f64>() / readings.len() as f64;
    let value = mean(&|r| r.value);
    let scatter = mean(&|r| (r.value - value).powi(2)).sqrt();
    let stated = mean(&|r| r.standard_error);
    // 24 readings know their scatter to 15 %; three times that.
    assert!((scatter / stated - 1.0).abs() < 0.45, "{scatter} {stated}");
}

#[test]
fn readings_weigh_the_channels_and_r_l_divides_by_the_viewing_cosine() {
    let closure = retro(Params::isotropic(0.02).with_tint([0.1, 0.2, 0.4]));
    let material = Material::of(closure);
    let directions = directions([0.5, 30.0, 0.0]);
    let reading = SMALL.measure(&material, Model::Reciprocal, directions, 1 << 10, 0).expect("legal");
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let [r, g, b] = unit.map(|weights| reading.r_a(weights).value);
    assert!((b / r - 4.0).abs() < 1e-5 && (g / r - 2.0).abs() < 1e-5, "{r} {g} {b}");
    let weights = [0.25, 0.65, 0.1];
    let sum = 0.25 * r + 0.65 * g + 0.1 * b;
    assert!((reading.r_a(weights).value / sum - 1.0).abs() < 1e-9);
    assert!((reading.r_l(weights).value * 30.5_f64.to_radians().cos() / sum - 1.0).abs() < 1e-9);
}

#[test]
fn bad_instruments_and_directions_are_errors_that_say_so() {
    let material = Material::default();
    let [wo, wi] = directions([0.2, 5.0, 0.0]);
    let measure = |instrument: Retroreflectometer, directions, samples| {
        instrument
            .measure(&material, Model::Reciprocal, directions, samples, 0)
            .map(|_| ())
            .map_err(|e| e.to_string())
    };
    for (name, instrument) in [
        ("distance_m", Retroreflectometer { distance_m: 0.0, ..SMALL }),
        ("specimen_side_m", Retroreflectometer { specimen_side_m: f32::NAN, ..SMALL }),
        ("source_aperture_m", Retroreflectometer { source_aperture_m: -1.0, ..SMALL }),
        ("receiver_aperture_m", Retroreflectometer { receiver_aperture_m: f32::INFINITY, ..SMALL }),
    ] {
        let message = measure(instrument, [wo, wi], 32).expect_err(name);
        assert!(message.contains(name), "{message}");
    }
    let message = measure(SMALL, [Vec3::new(f64::NAN, 0.0, 1.0), wi], 32).expect_err("a NaN");
    assert!(message.contains("wo is NaN"), "{message}");
    assert!(measure(SMALL, [wo, wi], 0).is_err());
    let below = Vec3::new(0.6, 0.0, -0.8);
    assert!(measure(SMALL, [below, wi], 32).is_ok());
}
