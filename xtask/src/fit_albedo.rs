//! Fits the tables of `catseye::albedo::Fit` to the exact albedo.
//!
//! One weighted linear least-squares problem per table: the unknowns are the Chebyshev coefficients of the
//! polynomials' coefficients, the rows are exact losses on a grid of widths, ratios and directions. A few
//! rounds of re-weighting by the residuals bring it near the smallest maximum error (Lawson's algorithm).

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write as _;

use anyhow::{Context as _, Result};
use catseye::albedo::exact::Quadrature;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// The middle of e's range, subtracted from it so that `f32` suffices for the coefficients.
const CENTRE: f64 = 0.6;

/// The generated file, from the workspace's root.
pub(crate) const OUTPUT: &str = "crates/catseye/src/albedo/tables.rs";

/// Grid of the least-squares rows: widths, ratios (below 1, which marks the isotropic rows), polar angles,
/// azimuths, and polar angles of the isotropic rows.
const GRID: [usize; 5] = [22, 20, 14, 12, 20];

/// Shape of one table.
struct Shape {
    name: &'static str,
    doc: &'static str,
    /// Degrees of P0, P1, ... in e.
    degrees: &'static [usize],
    /// Number of Chebyshev polynomials in the width and in the ratio.
    terms: [usize; 2],
    kappa: f64,
    /// Weight of the isotropic rows: how much smaller their error is to be.
    isotropic_weight: f64,
    rounds: usize,
}

const SHAPES: [Shape; 2] = [
    Shape {
        name: "FAST",
        doc: "for `FastFit`",
        degrees: &[8, 5, 3, 2],
        terms: [12, 8],
        kappa: 0.25,
        isotropic_weight: 11.0,
        rounds: 8,
    },
    Shape {
        name: "COMPACT",
        doc: "for `CompactFit`",
        degrees: &[4, 2, 0],
        terms: [5, 5],
        kappa: 0.4,
        isotropic_weight: 3.0,
        rounds: 25,
    },
];

/// Exact losses at one pair of widths, or at one isotropic width.
struct Block {
    m: f64,
    k: f64,
    weight: f64,
    /// `[x, y, loss]` per direction.
    rows: Vec<[f64; 3]>,
}

/// Chebyshev nodes on `(0, 1]`, the last of them 1.
fn nodes(n: usize) -> impl Iterator<Item = f64> {
    (0..n).map(move |i| 0.5 - 0.5 * (PI * (i as f64 + 0.5) / (n as f64 - 0.5)).cos())
}

/// Chebyshev polynomials at `2 x - 1`.
fn chebyshev(n: usize, x: f64) -> Vec<f64> {
    let angle = (2.0 * x - 1.0).clamp(-1.0, 1.0).acos();
    (0..n).map(|i| (i as f64 * angle).cos()).collect()
}

/// Exact losses on the whole grid: the anisotropic blocks, then the isotropic ones.
fn blocks() -> Vec<Block> {
    let [widths, ratios, polar, azimuths, isotropic] = GRID;
    let mut pairs: Vec<(f64, f64)> =
        nodes(widths).flat_map(|m| nodes(ratios).map(move |k| (m, k.min(0.999)))).collect();
    pairs.extend(nodes(widths).map(|m| (m, 1.0)));
    let rule = Quadrature::new();
    let loss = |m: f64, k: f64, s: f64, phi: f64| {
        let [x, y] = [s * phi.cos(), s * phi.sin()];
        [x, y, rule.loss([m, m * k], [x, y])]
    };
    let block = |&(m, k): &(f64, f64)| {
        let rows = if k == 1.0 {
            nodes(isotropic).map(|s| loss(m, k, s, 0.0)).collect()
        } else {
            nodes(polar)
                .flat_map(|s| nodes(azimuths).map(move |p| (s, p)))
                .map(|(s, p)| loss(m, k, s, FRAC_PI_2 * p))
                .collect()
        };
        Block { m, k, weight: 1.0, rows }
    };
    pairs.par_iter().map(block).collect()
}

impl Shape {
    /// The basis functions at one direction, times m.
    fn basis(&self, m: f64, k: f64, [x, y, _]: [f64; 3]) -> Vec<f64> {
        let e = (x * x + k * k * y * y + self.kappa * m * m * (1.0 + k * k)).sqrt() - CENTRE;
        let w = (1.0 - k * k) * y * y;
        let mut out = Vec::new();
        for (i, &degree) in self.degrees.iter().enumerate() {
            out.extend((0..=degree).map(|j| m * w.powi(i as i32) * e.powi(j as i32)));
        }
        out
    }

    fn coefficients(&self) -> usize {
        self.degrees.iter().map(|d| d + 1).sum()
    }

    /// The table `[a][b][coefficient]`, flattened.
    fn solve(&self, blocks: &[Block]) -> Result<Vec<f64>> {
        let mut weights: Vec<Vec<f64>> = blocks
            .iter()
            .map(|b| vec![b.weight * if b.k == 1.0 { self.isotropic_weight } else { 1.0 }; b.rows.len()])
            .collect();
        let bases: Vec<Vec<Vec<f64>>> =
            blocks.iter().map(|b| b.rows.iter().map(|&row| self.basis(b.m, b.k, row)).collect()).collect();
        let mut best = (f64::INFINITY, Vec::new());
        for _ in 0..self.rounds {
            let table = self.least_squares(blocks, &bases, &weights)?;
            let residuals = self.residuals(blocks, &bases, &table);
            let worst = residuals.iter().flatten().fold(0.0, |a: f64, &b| a.max(b));
            if worst < best.0 {
                best = (worst, table);
            }
            let mut sum = 0.0;
            for (weights, residuals) in weights.iter_mut().zip(&residuals) {
                for (weight, residual) in weights.iter_mut().zip(residuals) {
                    *weight *= 0.4 + residual / worst;
                    sum += *weight;
                }
            }
            let mean = sum / weights.iter().map(Vec::len).sum::<usize>() as f64;
            weights.iter_mut().flatten().for_each(|w| *w /= mean);
        }
        Ok(best.1)
    }

    /// The Chebyshev factors `T_a(m) T_b(k)` of a block.
    fn factors(&self, block: &Block) -> Vec<f64> {
        let [n_m, n_k] = self.terms;
        let t_k = chebyshev(n_k, block.k);
        chebyshev(n_m, block.m).iter().flat_map(|a| t_k.iter().map(move |b| a * b)).collect()
    }

    fn least_squares(
        &self,
        blocks: &[Block],
        bases: &[Vec<Vec<f64>>],
        weights: &[Vec<f64>],
    ) -> Result<Vec<f64>> {
        let n_c = self.coefficients();
        let size = self.terms[0] * self.terms[1] * n_c;
        // The normal matrix is a sum over the blocks of (t_m t_m^T) x (t_k t_k^T) x (basis^T W^2 basis). The
        // inner products are summed over the blocks of equal width first.
        let [n_m, n_k] = self.terms;
        let inner = n_k * n_c;
        let mut widths: Vec<f64> = blocks.iter().map(|b| b.m).collect();
        widths.sort_by(f64::total_cmp);
        widths.dedup();
        let per_width: Vec<(Vec<f64>, DMatrix<f64>, DVector<f64>)> = widths
            .into_par_iter()
            .map(|m| {
                let mut gram = DMatrix::zeros(inner, inner);
                let mut right = DVector::zeros(inner);
                for ((block, bases), weights) in
                    blocks.iter().zip(bases).zip(weights).filter(|((b, _), _)| b.m == m)
                {
                    let t_k = DVector::from_vec(chebyshev(n_k, block.k));
                    let mut block_gram = DMatrix::zeros(n_c, n_c);
                    let mut block_right = DVector::zeros(n_c);
                    for ((basis, row), weight) in bases.iter().zip(&block.rows).zip(weights) {
                        let basis = DVector::from_column_slice(basis);
                        block_gram.ger(weight * weight, &basis, &basis, 1.0);
                        block_right.axpy(weight * weight * row[2], &basis, 1.0);
                    }
                    gram += (&t_k * t_k.transpose()).kronecker(&block_gram);
                    right += t_k.kronecker(&block_right);
                }
                (chebyshev(n_m, m), gram, right)
            })
            .collect();
        let mut normal = DMatrix::zeros(size, size);
        let mut right = DVector::zeros(size);
        for (t_m, gram, inner_right) in &per_width {
            for (i, a) in t_m.iter().enumerate() {
                right.rows_mut(i * inner, inner).axpy(*a, inner_right, 1.0);
                for (j, b) in t_m.iter().enumerate() {
                    normal
                        .view_mut((i * inner, j * inner), (inner, inner))
                        .zip_apply(gram, |sum, g| *sum += a * b * g);
                }
            }
        }
        // A little ridge keeps the coefficients small, so that single precision suffices for them.
        let ridge = 1e-13 * normal.trace() / size as f64;
        for i in 0..size {
            normal[(i, i)] += ridge;
        }
        let solution = normal.cholesky().context("the normal matrix is not positive definite")?.solve(&right);
        Ok(solution.as_slice().to_vec())
    }

    /// Absolute errors, those of the isotropic rows scaled by their weight.
    fn residuals(&self, blocks: &[Block], bases: &[Vec<Vec<f64>>], table: &[f64]) -> Vec<Vec<f64>> {
        let n_c = self.coefficients();
        let one = |(block, bases): (&Block, &Vec<Vec<f64>>)| {
            let mut collapsed = vec![0.0; n_c];
            for (factor, row) in self.factors(block).iter().zip(table.chunks(n_c)) {
                collapsed.iter_mut().zip(row).for_each(|(sum, x)| *sum += factor * x);
            }
            let scale = if block.k == 1.0 { self.isotropic_weight } else { 1.0 };
            let error = |(basis, row): (&Vec<f64>, &[f64; 3])| {
                let fit: f64 = basis.iter().zip(&collapsed).map(|(a, b)| a * b).sum();
                scale * (fit - row[2]).abs()
            };
            bases.iter().zip(&block.rows).map(error).collect()
        };
        blocks.iter().zip(bases).map(one).collect()
    }

    fn write(&self, table: &[f64], out: &mut String) -> Result<()> {
        let (n_c, [n_m, n_k]) = (self.coefficients(), self.terms);
        writeln!(out, "\n/// Factor of the rounding in `e^2`, {}.", self.doc)?;
        writeln!(out, "pub(super) const {}_KAPPA: f32 = {:?};", self.name, self.kappa)?;
        writeln!(
            out,
            "\n/// Coefficients by Chebyshev order in the width, in the ratio, and by power, {}.",
            self.doc
        )?;
        writeln!(out, "#[rustfmt::skip]")?;
        writeln!(out, "pub(super) static {}: [[[f32; {n_c}]; {n_k}]; {n_m}] = [", self.name)?;
        for rows in table.chunks(n_c * n_k) {
            writeln!(out, "    [")?;
            for row in rows.chunks(n_c) {
                let numbers: Vec<String> =
                    row.iter().map(|x| format!("{:?}", (x * 1e6).round() as f32 / 1e6)).collect();
                writeln!(out, "        [{}],", numbers.join(", "))?;
            }
            writeln!(out, "    ],")?;
        }
        writeln!(out, "];")?;
        Ok(())
    }
}

/// The text of the generated file.
pub(crate) fn generate() -> Result<String> {
    let mut out = String::from("// Generated by `cargo xtask fit-albedo`; do not edit.\n");
    out.push_str("//! Tables of the albedo fits. What they mean is told in `fit.rs`.\n");
    writeln!(
        out,
        "\n/// The middle of e's range, subtracted from it so that `f32` suffices for the coefficients."
    )?;
    writeln!(out, "pub(super) const CENTRE: f64 = {CENTRE:?};")?;
    let blocks = blocks();
    for shape in &SHAPES {
        shape.write(&shape.solve(&blocks)?, &mut out)?;
    }
    Ok(out)
}
