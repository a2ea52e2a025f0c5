//! `catseye furnace`: the proposal's furnace figure, and its numbers.

use std::fmt::Write as _;
use std::path::PathBuf;

use anyhow::bail;
use catseye::{AnyLobe, Lobe as _, Model, Params, Vec3};
use catseye_render::{Image, furnace};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::failure::Usage;
use crate::help;
use crate::options::{ModelArg, Roughness};
use crate::output::{Output, must_end_in};
use crate::plot::furnace::{Scattering, Sphere, figure};
use crate::plot::sheet::Sheet;
use crate::progress::Progress;

/// The proposal's columns.
const ROUGHNESSES: [f64; 10] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];
/// Samples of each number for each sample of a pixel.
const SAMPLES: u32 = 4096;
/// Side of a sphere's picture in pixels, and how many samples of a pixel it takes for one that is asked for.
const TILE: usize = 320;
const OVERSAMPLED: u32 = 8;

/// Reproduce the proposal's furnace figure, as a picture and as numbers
///
/// Spheres in an environment of the same radiance everywhere: one that loses no energy can't be seen, one
/// that loses some is darker. Left halves show single scattering (`multiscatter_tint` 0), right halves
/// multiple scattering (`multiscatter_tint` 1). The numbers are the share of light that comes back at normal
/// incidence and from the whole sphere, measured by sampling the lobe; beside each stands the exact value.
/// The models without compensation have single scattering only.
#[derive(Debug, clap::Args)]
#[command(after_help = help::FURNACE)]
pub(crate) struct Args {
    /// Picture to write, .png; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "furnace.png")]
    output: PathBuf,
    /// Roughness of each sphere, 1 to 10 of them [default: 0 0.1 0.2 ... 0.9]
    #[arg(long, value_name = "U[,V]", num_args = 1..)]
    roughness: Vec<Roughness>,
    /// Samples of eight pixels; each number takes 4096 times as many
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=4096))]
    spp: u32,
    /// Which lobe
    #[arg(long, value_enum, default_value_t)]
    model: ModelArg,
    /// Print the numbers as JSON
    #[arg(long)]
    json: bool,
}

/// A measured number and what it must be.
#[derive(Clone, Copy, Debug)]
struct Check {
    measured: f64,
    expected: f64,
}

/// One sphere of the figure.
#[derive(Debug)]
struct Cell {
    params: Params<f64>,
    scattering: Scattering,
    normal: Check,
    sphere: Check,
    image: Image,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        must_end_in(&self.output, "png")?;
        let output = Output::new(&self.output)?;
        let cells = self.measure()?;
        let figure = self.figure(&cells);
        output.write(&figure.png()?)?;
        let facts = json!({ "output": output.name(), "model": self.model.0.name(), "rows": rows(&cells) });
        output.messages().print(self.json, &facts, &format!("{}\nwrote {}", table(&cells), output.name()))
    }

    fn measure(&self) -> anyhow::Result<Vec<Cell>> {
        // The other models have no compensation: their second row would be the first again.
        let rows =
            if self.model.0 == Model::Reciprocal { &Scattering::ALL[..] } else { &[Scattering::Single] };
        let roughnesses = self.roughnesses()?;
        let progress = Progress::new("spheres", (rows.len() * roughnesses.len()) as u64);
        let mut cells = Vec::new();
        for &scattering in rows {
            for &roughness in &roughnesses {
                cells.push(self.cell(roughness, scattering)?);
                progress.set(cells.len() as u64);
            }
        }
        Ok(cells)
    }

    /// The roughness of each column.
    fn roughnesses(&self) -> anyhow::Result<Vec<[f64; 2]>> {
        match self.roughness.len() {
            0 => Ok(ROUGHNESSES.map(|roughness| [roughness; 2]).to_vec()),
            1..=10 => Ok(self.roughness.iter().map(|roughness| roughness.0).collect()),
            _ => bail!(Usage("--roughness takes 1 to 10 values here".to_owned())),
        }
    }

    fn cell(&self, [u, v]: [f64; 2], scattering: Scattering) -> anyhow::Result<Cell> {
        let share = if scattering == Scattering::Multiple { 1.0 } else { 0.0 };
        let params = Params::anisotropic(u, v).with_multiscatter_tint([share; 3]);
        let model = self.model.0;
        let normal = Vec3::new(0.0, 0.0, 1.0);
        let samples = self.spp * SAMPLES;
        let lobe = AnyLobe::new(model, &params)?;
        Ok(Cell {
            params,
            scattering,
            normal: Check {
                measured: mean_weight(&lobe, samples, |_| normal),
                expected: model.exact_albedo(&params, normal)?[0],
            },
            sphere: Check {
                measured: mean_weight(&lobe, samples, disk_direction),
                expected: model.exact_average_albedo(&params)?[0],
            },
            image: furnace::sphere(
                AnyLobe::new(model, &params.map(|x| x as f32))?,
                TILE,
                self.spp.div_ceil(OVERSAMPLED),
            )?,
        })
    }

    fn figure(&self, cells: &[Cell]) -> Sheet {
        let sphere = |cell: &Cell| Sphere {
            roughness: cell.params.roughness(),
            scattering: cell.scattering,
            measured: cell.sphere.measured,
            expected: cell.sphere.expected,
            image: cell.image.clone(),
        };
        let columns = cells.iter().filter(|cell| cell.scattering == Scattering::Single).count();
        let pair = |i| cells.iter().skip(i).step_by(columns).map(sphere).collect();
        figure(self.model.0, &(0..columns).map(pair).collect::<Vec<_>>())
    }
}

/// The mean weight of a lobe's samples: a Monte Carlo estimate of its albedo in the directions that two of
/// the uniform numbers make.
fn mean_weight(lobe: &AnyLobe<f64>, samples: u32, direction: impl Fn([f64; 2]) -> Vec3<f64> + Sync) -> f64 {
    let weight = |i| {
        let [a, b, u @ ..] = evenly_spread(i);
        lobe.sample(direction([a, b]), u).map_or(0.0, |sample| sample.weight[0])
    };
    // Sums of fixed parts, added in order: the same for any number of threads.
    let parts: Vec<f64> = (0..SAMPLES)
        .into_par_iter()
        .map(|part| (part..samples).step_by(SAMPLES as usize).map(weight).sum())
        .collect();
    parts.iter().sum::<f64>() / f64::from(samples)
}

/// Where the viewer is, seen from the point of a sphere that an evenly chosen point of its disk shows.
fn disk_direction([a, b]: [f64; 2]) -> Vec3<f64> {
    let sin_theta = a.sqrt();
    Vec3::from_angles(sin_theta.asin(), b * std::f64::consts::TAU)
}

/// The i-th point of a sequence that fills the unit cube evenly.
///
/// Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018: multiples of the powers of 1/g
/// modulo 1, where g is the real root of x^6 = x + 1.
fn evenly_spread(i: u32) -> [f64; 5] {
    const G: f64 = 1.134_724_138_401_519_5;
    [1, 2, 3, 4, 5].map(|power| (0.5 + f64::from(i) * G.powi(-power)).fract())
}

fn rows(cells: &[Cell]) -> Vec<Value> {
    let check = |check: Check| json!({ "measured": check.measured, "expected": check.expected });
    // JSON has no infinity.
    let number = |x: f64| if x.is_finite() { json!(x) } else { json!(x.to_string()) };
    let row = |cell: &Cell| {
        let [roughness_u, roughness_v] = cell.params.roughness();
        json!({
            "scattering": cell.scattering.name(),
            "roughness_u": number(roughness_u),
            "roughness_v": number(roughness_v),
            "normal": check(cell.normal),
            "sphere": check(cell.sphere),
        })
    };
    cells.iter().map(row).collect()
}

/// The numbers for people: one block for each row of the figure.
fn table(cells: &[Cell]) -> String {
    let mut text = String::new();
    let mut worst: f64 = 0.0;
    for row in cells.chunk_by(|a, b| a.scattering == b.scattering) {
        // Writing to a string can't fail.
        let name = row[0].scattering.name();
        writeln!(text, "{name} scattering").ok();
        writeln!(text, "                 normal incidence      whole sphere").ok();
        writeln!(text, "     roughness   measured  expected    measured  expected").ok();
        for cell in row {
            let [u, v] = cell.params.roughness();
            let roughness = if u == v { u.to_string() } else { format!("{u}, {v}") };
            let Cell { normal, sphere, .. } = cell;
            let [a, b] = [normal, sphere].map(|c| format!("{:8.5}  {:8.5}", c.measured, c.expected));
            writeln!(text, "{roughness:>14}   {a}    {b}").ok();
            worst =
                [normal, sphere].map(|c| (c.measured - c.expected).abs()).into_iter().fold(worst, f64::max);
        }
        writeln!(text).ok();
    }
    write!(text, "largest difference {worst:.1e}").ok();
    text
}
