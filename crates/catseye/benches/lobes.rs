//! The price of the lobes in units of one scalar `f32::powf` call, measured in the same run: what a renderer pays for
//! exactness, and whether the batch interface is worth calling.
//!
//! `cargo bench -p catseye` times every case with Criterion, then counts its instructions under Valgrind where that is
//! installed, and prints one table. Valgrind has no AVX-512, so the batch's counts are those of its AVX2 form.

use std::env;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use catseye::batch::{self, SampleSlices};
use catseye::{Component, Lobe as _, Params, Reciprocal, Vec3};
use criterion::Criterion;

/// Elements per iteration: all arrays together fit the first-level cache twice over at most.
const N: usize = 1024;

/// Set in the child processes whose instructions are counted: the case and the number of iterations.
const COUNT: &str = "CATSEYE_BENCH_COUNT";

/// Directions, uniform numbers and results, as arrays of vectors and as structures of arrays.
struct Data {
    pairs: Vec<(Vec3<f32>, Vec3<f32>, [f32; 3])>,
    columns: [Vec<f32>; 9],
    out: [Vec<f32>; 7],
    components: Vec<Component>,
}

impl Data {
    fn new() -> Self {
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 40) as f32) / (1_u32 << 24) as f32
        };
        let mut columns: [Vec<f32>; 9] = Default::default();
        let mut pairs = Vec::new();
        for _ in 0..N {
            let [wo, wi] = [(); 2].map(|()| {
                let z = 1.0 - uniform();
                let (sin, cos) = (std::f32::consts::TAU * uniform()).sin_cos();
                let s = (1.0 - z * z).sqrt();
                Vec3::new(s * cos, s * sin, z)
            });
            let u = [uniform(), uniform(), uniform()];
            let row = [wo.x, wo.y, wo.z, wi.x, wi.y, wi.z, u[0], u[1], u[2]];
            columns.iter_mut().zip(row).for_each(|(column, x)| column.push(x));
            pairs.push((wo, wi, u));
        }
        Self { pairs, columns, out: [(); 7].map(|()| vec![0.0; N]), components: vec![Component::Single; N] }
    }
}

type Case = (String, Box<dyn FnMut(&mut Data)>);

fn cases() -> Vec<Case> {
    let forms = [
        ("isotropic", Params::isotropic(0.3)),
        ("anisotropic", Params::anisotropic(0.3, 0.1)),
        ("isotropic compensated", Params::isotropic(0.3).with_multiscatter_tint([1.0; 3])),
        ("anisotropic compensated", Params::anisotropic(0.3, 0.1).with_multiscatter_tint([1.0; 3])),
    ];
    let mut cases: Vec<Case> = vec![("powf".into(), Box::new(powf))];
    for (form, params) in forms {
        let lobe = Reciprocal::<f32>::new(&params).expect("legal parameters");
        cases.push((format!("eval+pdf, {form}"), Box::new(move |data| eval_pdf(&lobe, data))));
        cases.push((format!("sample, {form}"), Box::new(move |data| sample(&lobe, data))));
        cases.push((format!("batch eval+pdf, {form}"), Box::new(move |data| batch_eval_pdf(&lobe, data))));
        cases.push((format!("batch sample, {form}"), Box::new(move |data| batch_sample(&lobe, data))));
    }
    for (form, params) in &forms[..2] {
        let params = *params;
        cases.push((format!("construct, {form}"), Box::new(move |_| construct(&params))));
    }
    cases
}

fn powf(data: &mut Data) {
    let mut sum = 0.0;
    for (base, exponent) in black_box(&data.columns[6]).iter().zip(black_box(&data.columns[7])) {
        sum += base.powf(*exponent * 20.0);
    }
    black_box(sum);
}

fn eval_pdf(lobe: &Reciprocal<f32>, data: &mut Data) {
    let mut sum = 0.0;
    for (wo, wi, _) in black_box(&data.pairs) {
        let ([r, g, b], pdf) = black_box(lobe).eval_pdf(*wo, *wi);
        sum += (r + g) + (b + pdf);
    }
    black_box(sum);
}

fn sample(lobe: &Reciprocal<f32>, data: &mut Data) {
    let mut sum = 0.0;
    for (wo, _, u) in black_box(&data.pairs) {
        if let Some(s) = black_box(lobe).sample(*wo, *u) {
            let [r, g, b] = s.weight;
            sum += ((s.wi.x + s.wi.y) + (s.wi.z + s.pdf)) + ((r + g) + b);
        }
    }
    black_box(sum);
}

fn batch_eval_pdf(lobe: &Reciprocal<f32>, data: &mut Data) {
    let [ox, oy, oz, ix, iy, iz, ..] = &data.columns;
    let [r, g, b, pdf, ..] = &mut data.out;
    batch::eval_pdf(black_box(lobe), [ox, oy, oz], [ix, iy, iz], [r, g, b], pdf);
}

fn batch_sample(lobe: &Reciprocal<f32>, data: &mut Data) {
    let [x, y, z, _, _, _, u1, u2, u3] = &data.columns;
    let [wx, wy, wz, r, g, b, pdf] = &mut data.out;
    let out = SampleSlices { wi: [wx, wy, wz], weight: [r, g, b], pdf, component: &mut data.components };
    batch::sample(black_box(lobe), [x, y, z], [u1, u2, u3], out);
}

fn construct(params: &Params<f32>) {
    for _ in 0..N {
        black_box(Reciprocal::new(black_box(params))).expect("legal parameters");
    }
}

/// Instructions per element, from the difference of two runs under Valgrind; `None` without Valgrind.
fn instructions(case: &str) -> Option<f64> {
    let run = |iterations: u32| -> Option<f64> {
        let output = Command::new("valgrind")
            .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
            .arg(env::current_exe().ok()?)
            .env(COUNT, format!("{iterations} {case}"))
            .output()
            .ok()?;
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        text.lines().find_map(|line| line.split("Collected : ").nth(1)?.trim().parse().ok())
    };
    Some((run(5)? - run(1)?) / (4 * N) as f64)
}

/// Median nanoseconds per element that Criterion wrote.
fn nanoseconds(folder: &Path, case: &str) -> Option<f64> {
    let file = folder.join(case.replace(['+', ',', ' '], "_")).join("new/estimates.json");
    let estimates: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(file).ok()?).ok()?;
    Some(estimates["median"]["point_estimate"].as_f64()? / N as f64)
}

fn report(folder: &Path) {
    let powf = nanoseconds(folder, "powf");
    println!("\nPer element, {} for the batch:\n", batch::instruction_set());
    println!("{:42} {:>8} {:>8} {:>13}", "case", "ns", "powf", "instructions");
    for (name, _) in cases() {
        let ns = nanoseconds(folder, &name);
        let cell = |x: Option<f64>| x.map_or("-".into(), |x| format!("{x:.2}"));
        let ratio = ns.zip(powf).map(|(ns, powf)| ns / powf);
        let count = instructions(&name).map_or("-".into(), |x| format!("{x:.0}"));
        println!("{name:42} {:>8} {:>8} {count:>13}", cell(ns), cell(ratio));
    }
}

fn main() {
    if let Ok(request) = env::var(COUNT) {
        let (iterations, case) = request.split_once(' ').expect("set by `instructions`");
        let mut data = Data::new();
        let (_, mut body) =
            cases().into_iter().find(|(name, _)| name == case).expect("set by `instructions`");
        (0..iterations.parse().expect("set by `instructions`")).for_each(|_: u32| body(&mut data));
        return;
    }
    let folder = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../target/criterion"));
    let mut criterion = Criterion::default()
        .output_directory(&folder)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .configure_from_args();
    for (name, mut body) in cases() {
        let mut data = Data::new();
        criterion.bench_function(&name.replace(['+', ',', ' '], "_"), |b| b.iter(|| body(&mut data)));
    }
    criterion.final_summary();
    // `cargo test --benches` only checks that the cases run.
    if env::args().any(|arg| arg == "--bench") {
        report(&folder);
    }
}
