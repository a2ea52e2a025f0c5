//! Many directions at once, as structures of arrays, with the widest vector instructions of the machine.
//!
//! The loops call the same inlined, branch-poor functions as the scalar path, over blocks of a fixed length;
//! the compiler turns them into vector code once per instruction set, and the set is chosen at run time. No
//! step is reordered, so that the results are equal to the scalar ones bit for bit.
//!
//! ```
//! use catseye::{Params, Reciprocal, batch};
//!
//! let lobe = Reciprocal::<f32>::new(&Params::isotropic(0.3))?;
//! let (x, z) = ([0.0, 0.6], [1.0, 0.8]);
//! let wo = [&x[..], &[0.0; 2], &z];
//! let (mut r, mut g, mut b, mut pdf) = ([0.0; 2], [0.0; 2], [0.0; 2], [0.0; 2]);
//! batch::eval_pdf(&lobe, wo, wo, [&mut r, &mut g, &mut b], &mut pdf);
//! # Ok::<(), catseye::ParamError>(())
//! ```

use std::sync::OnceLock;

use fearless_simd::{Level, Simd, dispatch};

pub use crate::lobe::LobeVisitor;
use crate::{Component, Lobe, Real, Vec3};

/// Components of vectors or colours, each a slice over the batch.
pub type Slices<'a, T> = [&'a [T]; 3];

/// Components of vectors or colours to be written.
pub type SlicesMut<'a, T> = [&'a mut [T]; 3];

/// Where [`sample`] puts its results.
#[derive(Debug)]
pub struct SampleSlices<'a, T> {
    /// Sampled directions; 0 where there is no sample.
    pub wi: SlicesMut<'a, T>,
    /// `f cos / pdf` per channel; 0 where there is no sample.
    pub weight: SlicesMut<'a, T>,
    /// Density per steradian; 0 where there is no sample.
    pub pdf: &'a mut [T],
    /// What the directions came from.
    pub component: &'a mut [Component],
}

/// The instruction set, detected once.
fn level() -> Level {
    static LEVEL: OnceLock<Level> = OnceLock::new();
    *LEVEL.get_or_init(Level::new)
}

/// The name of the instruction set in use, for reports.
#[must_use]
pub fn instruction_set() -> String {
    format!("{:?}", level()).split('(').next().unwrap_or_default().to_owned()
}

/// Rows that are worked on together. Loops of this length leave nothing over to be done one by one, and their
/// loads and stores go through arrays of their own, so that they can't depend on each other.
const BLOCK: usize = 16;

type Block<T> = [T; BLOCK];

/// What is done with a block of rows.
trait Rows<T, const IN: usize, const OUT: usize> {
    /// The columns of results for the columns of a block that begins at the row `start`.
    fn rows(&mut self, start: usize, columns: [Block<T>; IN]) -> [Block<T>; OUT];
}

/// Works on all rows block by block. The last block is filled up with rows of 0, whose results are dropped.
///
/// # Panics
/// If the columns differ in length.
#[inline(always)]
fn run<T: Real, const IN: usize, const OUT: usize>(
    columns: [&[T]; IN],
    mut results: [&mut [T]; OUT],
    mut body: impl Rows<T, IN, OUT>,
) {
    let n = columns[0].len();
    let lengths = columns.iter().map(|c| c.len()).chain(results.iter().map(|c| c.len()));
    assert!(
        lengths.clone().all(|length| length == n),
        "the slices of a batch differ in length: {:?}",
        lengths.collect::<Vec<_>>()
    );
    let whole = n - n % BLOCK;
    let mut blocks: [&[Block<T>]; IN] = [&[]; IN];
    for i in 0..IN {
        blocks[i] = &columns[i][..whole].as_chunks().0[..whole / BLOCK];
    }
    let to = results.each_mut().map(|column| column[..whole].as_chunks_mut().0);
    for k in 0..whole / BLOCK {
        let mut rows = [[T::ZERO; BLOCK]; IN];
        for i in 0..IN {
            rows[i] = blocks[i][k];
        }
        let out = body.rows(k * BLOCK, rows);
        for i in 0..OUT {
            to[i][k] = out[i];
        }
    }
    if whole < n {
        let mut rows = [[T::ZERO; BLOCK]; IN];
        for i in 0..IN {
            rows[i][..n - whole].copy_from_slice(&columns[i][whole..]);
        }
        let out = body.rows(whole, rows);
        for i in 0..OUT {
            results[i][whole..].copy_from_slice(&out[i][..n - whole]);
        }
    }
}

/// [`Lobe::eval`] of every pair of directions.
///
/// # Panics
/// If the slices differ in length.
pub fn eval<T: Real, L: Lobe<T> + Copy>(lobe: &L, wo: Slices<'_, T>, wi: Slices<'_, T>, f: SlicesMut<'_, T>) {
    dispatch!(level(), simd => lobe.specialize(Eval(simd, wo, wi, f)));
}

/// [`Lobe::pdf`] of every pair of directions.
///
/// # Panics
/// If the slices differ in length.
pub fn pdf<T: Real, L: Lobe<T> + Copy>(lobe: &L, wo: Slices<'_, T>, wi: Slices<'_, T>, pdf: &mut [T]) {
    dispatch!(level(), simd => lobe.specialize(Pdf(simd, wo, wi, pdf)));
}

/// [`Lobe::eval_pdf`] of every pair of directions.
///
/// # Panics
/// If the slices differ in length.
pub fn eval_pdf<T: Real, L: Lobe<T> + Copy>(
    lobe: &L,
    wo: Slices<'_, T>,
    wi: Slices<'_, T>,
    f: SlicesMut<'_, T>,
    pdf: &mut [T],
) {
    dispatch!(level(), simd => lobe.specialize(EvalPdf(simd, wo, wi, f, pdf)));
}

/// [`Lobe::sample`] of every direction, with the uniform numbers `u` in `[0, 1)`.
///
/// # Panics
/// If the slices differ in length.
pub fn sample<T: Real, L: Lobe<T> + Copy>(
    lobe: &L,
    wo: Slices<'_, T>,
    u: Slices<'_, T>,
    out: SampleSlices<'_, T>,
) {
    dispatch!(level(), simd => lobe.specialize(Draw(simd, wo, u, out)));
}

// The loops. The first field only carries the instruction set that they are compiled for.
struct Eval<'a, S, T>(S, Slices<'a, T>, Slices<'a, T>, SlicesMut<'a, T>);
struct Pdf<'a, S, T>(S, Slices<'a, T>, Slices<'a, T>, &'a mut [T]);
struct EvalPdf<'a, S, T>(S, Slices<'a, T>, Slices<'a, T>, SlicesMut<'a, T>, &'a mut [T]);
struct Draw<'a, S, T>(S, Slices<'a, T>, Slices<'a, T>, SampleSlices<'a, T>);

impl<S: Simd, T: Real> LobeVisitor<T> for Eval<'_, S, T> {
    type Output = ();
    #[inline(always)]
    fn visit<L: Lobe<T> + Copy>(self, lobe: L) {
        let Self(_, [ox, oy, oz], [ix, iy, iz], f) = self;
        run([ox, oy, oz, ix, iy, iz], f, EvalRows(lobe));
    }
}

impl<S: Simd, T: Real> LobeVisitor<T> for Pdf<'_, S, T> {
    type Output = ();
    #[inline(always)]
    fn visit<L: Lobe<T> + Copy>(self, lobe: L) {
        let Self(_, [ox, oy, oz], [ix, iy, iz], pdf) = self;
        run([ox, oy, oz, ix, iy, iz], [pdf], PdfRows(lobe));
    }
}

impl<S: Simd, T: Real> LobeVisitor<T> for EvalPdf<'_, S, T> {
    type Output = ();
    #[inline(always)]
    fn visit<L: Lobe<T> + Copy>(self, lobe: L) {
        let Self(_, [ox, oy, oz], [ix, iy, iz], [r, g, b], pdf) = self;
        run([ox, oy, oz, ix, iy, iz], [r, g, b, pdf], EvalPdfRows(lobe));
    }
}

impl<S: Simd, T: Real> LobeVisitor<T> for Draw<'_, S, T> {
    type Output = ();
    #[inline(always)]
    fn visit<L: Lobe<T> + Copy>(self, lobe: L) {
        let Self(_, [ox, oy, oz], [u1, u2, u3], SampleSlices { wi, weight, pdf, component }) = self;
        assert_eq!(component.len(), pdf.len(), "the slices of a batch differ in length");
        let ([x, y, z], [r, g, b]) = (wi, weight);
        run([ox, oy, oz, u1, u2, u3], [x, y, z, r, g, b, pdf], DrawRows(lobe, component));
    }
}

// The loops over the rows of a block.
struct EvalRows<L>(L);
struct PdfRows<L>(L);
struct EvalPdfRows<L>(L);
struct DrawRows<'a, L>(L, &'a mut [Component]);

impl<T: Real, L: Lobe<T>> Rows<T, 6, 3> for EvalRows<L> {
    #[inline(always)]
    fn rows(&mut self, _: usize, [ox, oy, oz, ix, iy, iz]: [Block<T>; 6]) -> [Block<T>; 3] {
        let mut out = [[T::ZERO; BLOCK]; 3];
        for k in 0..BLOCK {
            let f = self.0.eval(Vec3::new(ox[k], oy[k], oz[k]), Vec3::new(ix[k], iy[k], iz[k]));
            [out[0][k], out[1][k], out[2][k]] = f;
        }
        out
    }
}

impl<T: Real, L: Lobe<T>> Rows<T, 6, 1> for PdfRows<L> {
    #[inline(always)]
    fn rows(&mut self, _: usize, [ox, oy, oz, ix, iy, iz]: [Block<T>; 6]) -> [Block<T>; 1] {
        let mut out = [[T::ZERO; BLOCK]; 1];
        for k in 0..BLOCK {
            out[0][k] = self.0.pdf(Vec3::new(ox[k], oy[k], oz[k]), Vec3::new(ix[k], iy[k], iz[k]));
        }
        out
    }
}

impl<T: Real, L: Lobe<T>> Rows<T, 6, 4> for EvalPdfRows<L> {
    #[inline(always)]
    fn rows(&mut self, _: usize, [ox, oy, oz, ix, iy, iz]: [Block<T>; 6]) -> [Block<T>; 4] {
        let mut out = [[T::ZERO; BLOCK]; 4];
        for k in 0..BLOCK {
            let (wo, wi) = (Vec3::new(ox[k], oy[k], oz[k]), Vec3::new(ix[k], iy[k], iz[k]));
            let ([r, g, b], pdf) = self.0.eval_pdf(wo, wi);
            [out[0][k], out[1][k], out[2][k], out[3][k]] = [r, g, b, pdf];
        }
        out
    }
}

impl<T: Real, L: Lobe<T>> Rows<T, 6, 7> for DrawRows<'_, L> {
    #[inline(always)]
    fn rows(&mut self, start: usize, [ox, oy, oz, u1, u2, u3]: [Block<T>; 6]) -> [Block<T>; 7] {
        let mut out = [[T::ZERO; BLOCK]; 7];
        let mut drawn = [Component::Single; BLOCK];
        for k in 0..BLOCK {
            let (wi, weight, pdf, component) =
                match self.0.sample(Vec3::new(ox[k], oy[k], oz[k]), [u1[k], u2[k], u3[k]]) {
                    Some(s) => (s.wi, s.weight, s.pdf, s.component),
                    None => (Vec3::default(), [T::ZERO; 3], T::ZERO, Component::Single),
                };
            [out[0][k], out[1][k], out[2][k]] = wi.into();
            [out[3][k], out[4][k], out[5][k]] = weight;
            out[6][k] = pdf;
            drawn[k] = component;
        }
        let rest = &mut self.1[start..];
        if let Some(to) = rest.first_chunk_mut() {
            *to = drawn;
        } else {
            let n = rest.len();
            rest.copy_from_slice(&drawn[..n]);
        }
        out
    }
}
