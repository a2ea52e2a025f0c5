//! Samples follow the density that `pdf` states: Pearson's chi-square test, all lobes, with Sidak's
//! correction.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use crate::common::{ROUGHNESS, Random, directions, to_f32};
use catseye::{AnyLobe, Lobe as _, Model, Params, Vec3, width};
use statrs::distribution::{ChiSquared, ContinuousCDF as _};

/// Probability of a false alarm in the whole file.
const SIGNIFICANCE: f64 = 0.01;
const SAMPLES: usize = 200_000;
const RADIAL: usize = 11;
const AROUND: usize = 14;
/// Most subdivisions of a cell when the density is integrated over it.
const DEPTH: u32 = 10;

/// Polar grid around the retro direction, finest where the lobe lives.
struct Grid {
    axes: [Vec3<f64>; 3],
    /// Half-angle sines at which half of the rings lie inside.
    scale: f64,
}

impl Grid {
    fn new(pole: Vec3<f64>, scale: f64) -> Self {
        let other = if pole.z < 0.9 { Vec3::new(0.0, 0.0, 1.0) } else { Vec3::new(1.0, 0.0, 0.0) };
        let x = other.cross(pole).normalized();
        Self { axes: [x, pole.cross(x), pole], scale }
    }

    /// Sine of half the angle from the pole at the ring parameter in `[0, 1]`, and its derivative.
    fn half_sine(&self, ring: f64) -> (f64, f64) {
        let bottom = 1.0 - ring * (1.0 - self.scale);
        (self.scale * ring / bottom, self.scale / (bottom * bottom))
    }

    fn direction(&self, ring: f64, turn: f64) -> Vec3<f64> {
        let (h, _) = self.half_sine(ring);
        let s = 2.0 * h * (1.0 - h * h).max(0.0).sqrt();
        let (sin, cos) = (TAU * turn).sin_cos();
        let [x, y, z] = self.axes;
        x * (s * cos) + y * (s * sin) + z * (1.0 - 2.0 * h * h)
    }

    fn cell(&self, w: Vec3<f64>) -> usize {
        let [x, y, pole] = self.axes;
        let difference = w - pole;
        let h = 0.5 * difference.dot(difference).sqrt();
        let ring = h / (self.scale + h * (1.0 - self.scale));
        let turn = (w.dot(y).atan2(w.dot(x)) / TAU).rem_euclid(1.0);
        let index = |t: f64, n: usize| ((t * n as f64) as usize).min(n - 1);
        index(ring, RADIAL) * AROUND + index(turn, AROUND)
    }

    /// The integral of a density over solid angle in a rectangle of the grid, by adaptive Gauss quadrature.
    fn integrate(&self, f: &dyn Fn(Vec3<f64>) -> f64, low: [f64; 2], high: [f64; 2], depth: u32) -> f64 {
        let whole = self.gauss(f, low, high);
        let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
        let corners = [
            (low, middle),
            ([middle[0], low[1]], [high[0], middle[1]]),
            ([low[0], middle[1]], [middle[0], high[1]]),
            (middle, high),
        ];
        let parts: f64 = corners.iter().map(|&(a, b)| self.gauss(f, a, b)).sum();
        // The first levels are always taken: a narrow ridge can slip between the nodes of a whole cell.
        if depth == 0 || depth < DEPTH - 3 && (whole - parts).abs() < 1e-8 {
            return parts;
        }
        corners.iter().map(|&(a, b)| self.integrate(f, a, b, depth - 1)).sum()
    }

    fn gauss(&self, f: &dyn Fn(Vec3<f64>) -> f64, low: [f64; 2], high: [f64; 2]) -> f64 {
        const NODES: [(f64, f64); 3] =
            [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
        let [range_r, range_t] = [high[0] - low[0], high[1] - low[1]];
        let mut sum = 0.0;
        for (r, weight_r) in NODES {
            let ring = low[0] + range_r * r;
            let (h, slope) = self.half_sine(ring);
            // d omega = 2 pi sin(g) dg dt = 8 pi h dh dt with h = sin(g/2)
            let area = 4.0 * TAU * h * slope * range_r * range_t;
            for (t, weight_t) in NODES {
                sum += weight_r * weight_t * area * f(self.direction(ring, low[1] + range_t * t));
            }
        }
        sum
    }
}

/// p-value of the test; a table of both histograms goes to `target/evidence` where it is below the limit.
fn p_value(
    name: &str,
    grid: &Grid,
    pdf: &dyn Fn(Vec3<f64>) -> f64,
    samples: &[Vec3<f64>],
    limit: f64,
) -> f64 {
    let mut observed = vec![0.0; RADIAL * AROUND];
    samples.iter().for_each(|&w| observed[grid.cell(w)] += 1.0);
    let mut expected = Vec::new();
    for ring in 0..RADIAL {
        for turn in 0..AROUND {
            let low = [ring as f64 / RADIAL as f64, turn as f64 / AROUND as f64];
            let high = [(ring + 1) as f64 / RADIAL as f64, (turn + 1) as f64 / AROUND as f64];
            expected.push(SAMPLES as f64 * grid.integrate(pdf, low, high, DEPTH));
        }
    }
    let mass = expected.iter().sum::<f64>() / SAMPLES as f64;
    let lost = (SAMPLES - samples.len()) as f64;
    let (mut pooled_observed, mut pooled_expected) = (lost, SAMPLES as f64 * (1.0 - mass));
    if lost == 0.0 {
        // The density of the compensated lobe integrates to 1 as nearly as the albedo's fit is exact.
        assert!((mass - 1.0).abs() < 1.2e-3, "{name}: the density integrates to {mass}");
        expected.iter_mut().for_each(|x| *x /= mass);
        pooled_expected = 0.0;
    }
    let (mut statistic, mut freedom) = (0.0, -1.0);
    let mut table = String::from("observed,expected\n");
    for (&observed, &expected) in observed.iter().zip(&expected) {
        writeln!(table, "{observed},{expected}").expect("a String can be written to");
        if expected < 10.0 {
            pooled_observed += observed;
            pooled_expected += expected;
        } else {
            statistic += (observed - expected).powi(2) / expected;
            freedom += 1.0;
        }
    }
    // What fell below the horizon and the cells with low expectation make one more cell.
    if pooled_expected > 10.0 {
        statistic += (pooled_observed - pooled_expected).powi(2) / pooled_expected;
        freedom += 1.0;
    } else {
        assert!(
            pooled_observed < 40.0,
            "{name}: {pooled_observed} samples where {pooled_expected} are expected"
        );
    }
    let p = ChiSquared::new(freedom).expect("there are cells").sf(statistic);
    if p < limit {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../target/evidence");
        std::fs::create_dir_all(folder).expect("target can be written to");
        std::fs::write(format!("{folder}/chi2_{name}.csv"), table).expect("target can be written to");
    }
    p
}

fn check(model: Model, cases: &[([f64; 2], f64, f64)], single_precision: bool) {
    let directions = directions();
    let limit = 1.0 - (1.0 - SIGNIFICANCE / 5.0).powf(1.0 / (cases.len() * directions.len()) as f64);
    let mut random = Random(7);
    let mut failures = Vec::new();
    for &([roughness_u, roughness_v], tint, multiscatter_tint) in cases {
        let params = Params::anisotropic(roughness_u, roughness_v)
            .with_tint([tint; 3])
            .with_multiscatter_tint([multiscatter_tint; 3]);
        let lobe = AnyLobe::<f64>::new(model, &params).expect("legal parameters");
        let params = Params::anisotropic(roughness_u as f32, roughness_v as f32)
            .with_tint([tint as f32; 3])
            .with_multiscatter_tint([multiscatter_tint as f32; 3]);
        let lobe_f32 = AnyLobe::<f32>::new(model, &params).expect("legal parameters");
        for &wo in &directions {
            let draw = |_| {
                if single_precision {
                    let u = [random.uniform_f32(), random.uniform_f32(), random.uniform_f32()];
                    let wi = lobe_f32.sample(to_f32(wo), u)?.wi;
                    return Some(Vec3::new(f64::from(wi.x), f64::from(wi.y), f64::from(wi.z)));
                }
                Some(lobe.sample(wo, random.triple())?.wi)
            };
            let samples: Vec<Vec3<f64>> = (0..SAMPLES).filter_map(draw).collect();
            let scale = (width(roughness_u.max(1e-4)) * width(roughness_v.max(1e-4))).sqrt();
            let name = format!(
                "{}_{roughness_u}_{roughness_v}_{tint}_{multiscatter_tint}_{:.3}",
                model.name(),
                wo.z
            );
            let p = p_value(&name, &Grid::new(wo, scale), &|w| lobe.pdf(wo, w), &samples, limit);
            if p < limit {
                failures.push(format!("{name}: p = {p:.1e}"));
            }
        }
    }
    assert!(failures.is_empty(), "below {limit:.1e}: {failures:#?}");
}

fn all_roughness(tint: f64, multiscatter_tint: f64) -> Vec<([f64; 2], f64, f64)> {
    ROUGHNESS.into_iter().map(|r| (r, tint, multiscatter_tint)).collect()
}

#[test]
fn reciprocal_single() {
    check(Model::Reciprocal, &all_roughness(1.0, 0.0), false);
}

#[test]
fn reciprocal_compensated() {
    check(Model::Reciprocal, &all_roughness(1.0, 1.0), false);
}

#[test]
fn reciprocal_tinted() {
    let mut cases = Vec::new();
    for r in [[0.3, 0.3], [1.0, 0.05], [2.0, 2.0]] {
        cases.extend([(r, 0.8, 0.2), (r, 0.1, 0.9), (r, 0.0, 1.0), (r, 0.0, 0.0)]);
    }
    check(Model::Reciprocal, &cases, false);
}

#[test]
fn reciprocal_single_precision() {
    let cases =
        [([0.3, 0.3], 1.0, 1.0), ([1.0, 0.05], 1.0, 1.0), ([5.0, 5.0], 1.0, 0.5), ([0.05, 0.05], 1.0, 1.0)];
    check(Model::Reciprocal, &cases, true);
}

#[test]
fn edwards_and_back_vector() {
    check(Model::Edwards, &all_roughness(1.0, 0.0), false);
    let cases = [[0.05, 0.05], [0.3, 0.3], [1.0, 1.0], [0.5, 0.1], [0.02, 0.3]].map(|r| (r, 1.0, 0.0));
    check(Model::BackVector, &cases, false);
}
