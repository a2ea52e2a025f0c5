//! `catseye measure --instrument` agrees with the BSDF, and its rays with the quadrature over its apertures,
//! within 1 %.

use catseye::{AnyLobe, Lobe as _, Model, Params};
use catseye_materialx::{Closure, Material};
use catseye_photometry::{Apertures, Geometry, Goniometer, LUMINANCE, Quantity};
use catseye_render::Retroreflectometer;

use crate::run::{Bench, column};
use crate::sheeting::{bench, document};

/// Paths of a measurement: enough for a standard error of 0.3 %.
const SAMPLES: u32 = 1 << 16;

fn retro(params: Params<f32>) -> Closure {
    Closure::RetroReflective { weight: 1.0, params }
}

fn lobe(params: Params<f32>) -> AnyLobe<f64> {
    let [u, v] = params.roughness().map(f64::from);
    AnyLobe::new(Model::Reciprocal, &Params::anisotropic(u, v).with_tint(params.tint.map(f64::from)))
        .expect("legal parameters")
}

#[test]
fn rays_and_quadrature_agree() {
    let distance_m = 15.0;
    let closures: [Vec<Params<f32>>; 3] = [
        vec![Params::isotropic(0.006).with_tint([0.06; 3])],
        vec![Params::isotropic(0.005).with_tint([0.05; 3]), Params::isotropic(0.02).with_tint([0.1; 3])],
        vec![Params::anisotropic(0.008, 0.03).with_tint([0.2; 3])],
    ];
    for (number, lobes) in closures.into_iter().enumerate() {
        let sum = lobes.iter().map(|params| retro(*params));
        let bsdf =
            sum.reduce(|a, b| Closure::Add { a: Box::new(a), b: Box::new(b) }).expect("a lobe at least");
        let material = Material::of(bsdf);
        let lobes: Vec<AnyLobe<f64>> = lobes.into_iter().map(lobe).collect();
        // Unequal apertures, half and a quarter of a degree: the signs of both offsets matter.
        let apertures = Apertures { source: 0.5_f64.to_radians(), receiver: 0.25_f64.to_radians() };
        let instrument = Retroreflectometer {
            distance_m,
            specimen_side_m: 0.02,
            source_aperture_m: 2.0 * distance_m * (0.5 * apertures.source).tan() as f32,
            receiver_aperture_m: 2.0 * distance_m * (0.5 * apertures.receiver).tan() as f32,
        };
        for [alpha, beta, epsilon] in
            [[0.2, -4.0, 0.0], [0.33, 30.0, 90.0], [0.5, 40.0, 0.0], [1.0, -4.0, 90.0], [2.0, 30.0, 90.0]]
        {
            let geometry = Geometry::from(Goniometer::from_degrees(alpha, beta, 0.0, epsilon));
            let Geometry { wo, wi } = geometry;
            let rule = apertures.rule().expect("legal apertures");
            let expected = rule.mean(wo, wi, |wo, wi| {
                let f = lobes.iter().map(|lobe| lobe.eval(wo, wi)[1]).sum();
                let r_a = Quantity::RetroReflectionCoefficient;
                r_a.of_brdf(f, &Geometry { wo, wi }).expect("needs no integral")
            });
            if expected < 1e-3 {
                // Below what ASTM E810 measures, by a factor of 100.
                continue;
            }
            let reading = instrument.measure(&material, Model::Reciprocal, [wo, wi], SAMPLES, 0);
            let read = reading.expect("a legal measurement").r_a(LUMINANCE);
            let what = format!("material {number}, {alpha} {beta} {epsilon}: {read:?}, {expected}");
            assert!((read.value / expected - 1.0).abs() < 0.01, "{what}");
        }
    }
}

#[test]
fn the_instrument_measures_what_the_bsdf_says() {
    let bench = Bench::new();
    // A lobe with a half-power angle of 1.35 degrees: apertures of 0.1 degrees blur it by less than 0.3 %.
    bench.write("m.mtlx", &document("0.02"));
    let run = |args: &str| {
        let table = "observation_deg,entrance_deg,rotation_deg,unit\n\
                     0.2,-4,0,cd/lx/m2\n0.33,30,90,cd/lx/m2\n1,40,0,1/sr\n2,-4,0,mcd/lx/m2\n";
        let outcome = bench.catseye(&format!("measure m.mtlx --geometry - {args}"), table);
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{args}");
        outcome.stdout
    };
    let closed = column(&run(""), "model");
    let text = run("--instrument --samples 16384");
    let (traced, errors) = (column(&text, "model"), column(&text, "standard_error"));
    for ((traced, closed), error) in traced.iter().zip(closed).zip(errors) {
        assert!((traced / closed - 1.0).abs() < 0.01, "{traced} {closed}");
        assert!(error > 0.0 && error < 3e-3 * traced, "{error} {traced}");
    }
    let rows: serde_json::Value = serde_json::from_str(&run("--instrument --samples 64 --json")).unwrap();
    assert!(rows[2]["model"].is_f64() && rows[2]["standard_error"].is_f64(), "{rows}");
}

#[test]
fn the_instrument_says_what_it_can_not_measure() {
    let run =
        |args: &str, stdin: &str| bench().catseye(&format!("measure m.mtlx --instrument {args}"), stdin);
    let integral = run("--geometry -", "observation_deg,entrance_deg,quantity,unit\n1,5,Q_d,mcd/lx/m2\n");
    assert!(
        integral.code == 1 && integral.stderr.contains("<stdin>:2: Q_d is an integral"),
        "{}",
        integral.stderr
    );
    let whole = run("--geometry -", "observation_deg,entrance_deg,unit\n1,5,cd/lx\n");
    assert!(whole.code == 1 && whole.stderr.contains("--area-m2"), "{}", whole.stderr);
    assert_eq!(run("--samples 0", "").code, 2);
    assert_eq!(run("--verdict", "").code, 2);
}
