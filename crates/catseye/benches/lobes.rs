//! The lobes' time in units of one scalar `f32::powf` call: the table of `docs/performance.md`.
//!
//! `cargo bench -p catseye [-- WORDS]` runs the cases whose names contain every word. In each round `powf` is
//! timed over the same rows right before the case, and the table has the medians of the rounds' ratios: what
//! else the machine does slows both alike. Where Valgrind is installed it counts instructions as well; it has
//! no AVX-512, so that the batch's counts are those of its AVX2 form.

use std::env;
use std::hint::black_box;
use std::ops::Range;
use std::process::Command;
use std::time::Instant;

use catseye::batch::{self, SampleSlices};
use catseye::{Component, Lobe as _, Params, Reciprocal, Vec3};

/// Rows that come round again, so that the branch predictor learns them. Not a multiple of 1024: columns that
/// lie a multiple of 4096 bytes apart make loads wait for stores.
const REPEATED: usize = 1040;

/// Rows that are as good as new each time: too many for the branch predictor.
const FRESH: usize = 262_144;

/// Rows of a short batch.
const SHORT: usize = 256;

/// Rows of one timing: enough to be read off the clock, too few to be interrupted often.
const TIMED: usize = 16 * REPEATED;

/// Rounds of a case.
const ROUNDS: usize = 301;

/// Set in the child processes whose instructions are counted: the number of passes and the case.
const COUNT: &str = "CATSEYE_BENCH_COUNT";

/// Directions, uniform numbers and results, as arrays of vectors and as structures of arrays.
struct Data {
    pairs: Vec<(Vec3<f32>, Vec3<f32>, [f32; 3])>,
    columns: [Vec<f32>; 9],
    out: [Vec<f32>; 7],
    components: Vec<Component>,
    /// The rows that a pass over single directions takes.
    window: Range<usize>,
}

impl Data {
    fn new(n: usize) -> Self {
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 40) as f32) / (1_u32 << 24) as f32
        };
        let mut columns: [Vec<f32>; 9] = Default::default();
        let mut pairs = Vec::new();
        for _ in 0..n {
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
        let (out, components) = ([(); 7].map(|()| vec![0.0; n]), vec![Component::Single; n]);
        Self { pairs, columns, out, components, window: 0..n.min(TIMED) }
    }

    /// Moves the window on to rows that were not used for a while.
    fn advance(&mut self) {
        let start = if self.window.end + TIMED > self.pairs.len() { 0 } else { self.window.end };
        self.window = start..start + self.window.len();
    }

    fn pairs(&self) -> &[(Vec3<f32>, Vec3<f32>, [f32; 3])] {
        &self.pairs[self.window.clone()]
    }
}

/// A case, the rows that it is timed with, and what it does with all of them.
struct Case {
    name: String,
    rows: &'static [usize],
    body: Box<dyn FnMut(&mut Data)>,
}

impl Case {
    fn new(name: String, rows: &'static [usize], body: impl FnMut(&mut Data) + 'static) -> Self {
        Self { name, rows, body: Box::new(body) }
    }
}

fn cases() -> Vec<Case> {
    let forms = [
        ("isotropic", Params::isotropic(0.3)),
        ("anisotropic", Params::anisotropic(0.3, 0.1)),
        ("isotropic compensated", Params::isotropic(0.3).with_multiscatter_tint([1.0; 3])),
        ("anisotropic compensated", Params::anisotropic(0.3, 0.1).with_multiscatter_tint([1.0; 3])),
    ];
    let mut cases = vec![Case::new("powf".to_owned(), &[REPEATED, FRESH], powf)];
    for (form, params) in forms {
        let lobe = Reciprocal::<f32>::new(&params).expect("legal parameters");
        let mut add = |verb, rows, body: fn(&Reciprocal<f32>, &mut Data)| {
            cases.push(Case::new(format!("{verb}, {form}"), rows, move |data| body(&lobe, data)));
        };
        add("eval+pdf", &[REPEATED, FRESH], eval_pdf);
        add("sample", &[REPEATED, FRESH], sample);
        add("batch eval+pdf", &[REPEATED], batch_eval_pdf);
        add("short batch eval+pdf", &[SHORT], batch_eval_pdf);
        add("batch sample", &[REPEATED], batch_sample);
    }
    for (form, params) in &forms[2..] {
        let params = *params;
        cases.push(Case::new(format!("construct, {form}"), &[REPEATED], move |data| {
            construct(&params, data.window.len());
        }));
    }
    cases
}

fn powf(data: &mut Data) {
    let mut sum = 0.0;
    for (_, _, [base, exponent, _]) in black_box(data.pairs()) {
        sum += base.powf(*exponent * 20.0);
    }
    black_box(sum);
}

fn eval_pdf(lobe: &Reciprocal<f32>, data: &mut Data) {
    let mut sum = 0.0;
    for (wo, wi, _) in black_box(data.pairs()) {
        let ([r, g, b], pdf) = black_box(lobe).eval_pdf(*wo, *wi);
        sum += (r + g) + (b + pdf);
    }
    black_box(sum);
}

fn sample(lobe: &Reciprocal<f32>, data: &mut Data) {
    let mut sum = 0.0;
    for (wo, _, u) in black_box(data.pairs()) {
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

fn construct(params: &Params<f32>, rows: usize) {
    for _ in 0..rows {
        black_box(Reciprocal::new(black_box(params))).expect("legal parameters");
    }
}

/// Nanoseconds per row.
fn time(body: &mut dyn FnMut(&mut Data), data: &mut Data) -> f64 {
    let passes = TIMED / data.window.len();
    let start = Instant::now();
    (0..passes).for_each(|_| body(data));
    start.elapsed().as_secs_f64() * 1e9 / (passes * data.window.len()) as f64
}

/// Medians over the rounds: the case in units of powf, and in nanoseconds.
fn measure(case: &mut Case, rows: usize, rounds: usize) -> [f64; 2] {
    let mut data = Data::new(rows);
    let mut round = |_| {
        let unit = time(&mut powf, &mut data);
        let own = time(&mut case.body, &mut data);
        data.advance();
        [own / unit, own]
    };
    let results: Vec<_> = (0..rounds).map(&mut round).collect();
    [0, 1].map(|i| {
        let mut column: Vec<f64> = results.iter().map(|result| result[i]).collect();
        column.sort_by(f64::total_cmp);
        column[column.len() / 2]
    })
}

/// Instructions per row, from the difference of two runs under Valgrind; `None` without Valgrind.
fn instructions(case: &str, rows: usize) -> Option<f64> {
    let run = |passes: u32| -> Option<f64> {
        let output = Command::new("valgrind")
            .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
            .arg(env::current_exe().ok()?)
            .env(COUNT, format!("{passes} {case}"))
            .output()
            .ok()?;
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        text.lines().find_map(|line| line.split("Collected : ").nth(1)?.trim().parse().ok())
    };
    Some((run(5)? - run(1)?) / (4 * rows) as f64)
}

/// The child process: passes of one case over repeated rows.
fn count(request: &str) {
    let (passes, name) = request.split_once(' ').expect("set by `instructions`");
    let mut case = cases().into_iter().find(|case| case.name == name).expect("set by `instructions`");
    let mut data = Data::new(case.rows[0]);
    (0..passes.parse().expect("set by `instructions`")).for_each(|_: u32| (case.body)(&mut data));
}

fn main() {
    if let Ok(request) = env::var(COUNT) {
        return count(&request);
    }
    // `cargo test --benches` only checks that the cases run.
    let timed = env::args().any(|arg| arg == "--bench");
    let words: Vec<String> = env::args().skip(1).filter(|arg| !arg.starts_with('-')).collect();
    println!("Per row; the batch with {}.\n", batch::instruction_set());
    println!("| case | powf, repeated rows | powf, fresh rows | ns | instructions |\n|---|---|---|---|---|");
    for mut case in cases() {
        if !words.iter().all(|word| case.name.contains(word)) {
            continue;
        }
        let rows = case.rows;
        let rounds = if timed { ROUNDS } else { 1 };
        let [ratio, ns] = measure(&mut case, rows[0], rounds);
        let fresh = rows.get(1).map(|&rows| measure(&mut case, rows, rounds)[0]);
        let fresh = fresh.map_or(String::new(), |ratio| format!("{ratio:.2}"));
        let count = if timed { instructions(&case.name, rows[0]) } else { None };
        let count = count.map_or(String::new(), |count| format!("{count:.0}"));
        println!("| {} | {ratio:.2} | {fresh} | {ns:.2} | {count} |", case.name);
    }
}
