//! Many directions at once, as structures of arrays, with the widest vector instructions of the machine.
//!
//! The loops call the same inlined, branch-poor functions as the scalar path; the compiler turns them into vector code
//! once per instruction set, and the set is chosen at run time. No step is fused or reordered, so the results are
//! equal to the scalar ones bit for bit.
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

use crate::{Lobe, LobeKind, Real, Vec3};

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
    pub lobe: &'a mut [LobeKind],
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

/// The common length of all slices.
///
/// # Panics
/// If two of them differ.
fn common_length<const N: usize>(lengths: [usize; N]) -> usize {
    assert!(lengths.iter().all(|&n| n == lengths[0]), "the slices of a batch differ in length: {lengths:?}");
    lengths[0]
}

/// [`Lobe::eval`] of every pair of directions.
///
/// # Panics
/// If the slices differ in length.
pub fn eval<T: Real, L: Lobe<T> + Copy>(lobe: &L, wo: Slices<'_, T>, wi: Slices<'_, T>, f: SlicesMut<'_, T>) {
    dispatch!(level(), simd => eval_loop(simd, *lobe, wo, wi, f));
}

/// [`Lobe::pdf`] of every pair of directions.
///
/// # Panics
/// If the slices differ in length.
pub fn pdf<T: Real, L: Lobe<T> + Copy>(lobe: &L, wo: Slices<'_, T>, wi: Slices<'_, T>, pdf: &mut [T]) {
    dispatch!(level(), simd => pdf_loop(simd, *lobe, wo, wi, pdf));
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
    dispatch!(level(), simd => eval_pdf_loop(simd, *lobe, wo, wi, f, pdf));
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
    dispatch!(level(), simd => sample_loop(simd, *lobe, wo, u, out));
}

#[inline(always)]
fn eval_loop<S: Simd, T: Real, L: Lobe<T>>(
    _: S,
    lobe: L,
    [ox, oy, oz]: Slices<'_, T>,
    [ix, iy, iz]: Slices<'_, T>,
    [r, g, b]: SlicesMut<'_, T>,
) {
    let n = common_length([ox, oy, oz, ix, iy, iz].map(<[T]>::len));
    common_length([n, r.len(), g.len(), b.len()]);
    for k in 0..n {
        [r[k], g[k], b[k]] = lobe.eval(Vec3::new(ox[k], oy[k], oz[k]), Vec3::new(ix[k], iy[k], iz[k]));
    }
}

#[inline(always)]
fn pdf_loop<S: Simd, T: Real, L: Lobe<T>>(
    _: S,
    lobe: L,
    [ox, oy, oz]: Slices<'_, T>,
    [ix, iy, iz]: Slices<'_, T>,
    pdf: &mut [T],
) {
    let n = common_length([ox, oy, oz, ix, iy, iz].map(<[T]>::len));
    common_length([n, pdf.len()]);
    for k in 0..n {
        pdf[k] = lobe.pdf(Vec3::new(ox[k], oy[k], oz[k]), Vec3::new(ix[k], iy[k], iz[k]));
    }
}

#[inline(always)]
fn eval_pdf_loop<S: Simd, T: Real, L: Lobe<T>>(
    _: S,
    lobe: L,
    [ox, oy, oz]: Slices<'_, T>,
    [ix, iy, iz]: Slices<'_, T>,
    [r, g, b]: SlicesMut<'_, T>,
    pdf: &mut [T],
) {
    let n = common_length([ox, oy, oz, ix, iy, iz].map(<[T]>::len));
    common_length([n, r.len(), g.len(), b.len(), pdf.len()]);
    for k in 0..n {
        ([r[k], g[k], b[k]], pdf[k]) =
            lobe.eval_pdf(Vec3::new(ox[k], oy[k], oz[k]), Vec3::new(ix[k], iy[k], iz[k]));
    }
}

#[inline(always)]
fn sample_loop<S: Simd, T: Real, L: Lobe<T>>(
    _: S,
    lobe: L,
    [ox, oy, oz]: Slices<'_, T>,
    [u1, u2, u3]: Slices<'_, T>,
    out: SampleSlices<'_, T>,
) {
    let n = common_length([ox, oy, oz, u1, u2, u3].map(<[T]>::len));
    let ([ix, iy, iz], [r, g, b], pdf, kind) = (out.wi, out.weight, out.pdf, out.lobe);
    common_length([n, ix.len(), iy.len(), iz.len(), r.len(), g.len(), b.len(), pdf.len(), kind.len()]);
    for k in 0..n {
        let (wi, weight, density, lobe) =
            match lobe.sample(Vec3::new(ox[k], oy[k], oz[k]), [u1[k], u2[k], u3[k]]) {
                Some(s) => (s.wi, s.weight, s.pdf, s.lobe),
                None => (Vec3::default(), [T::ZERO; 3], T::ZERO, LobeKind::Single),
            };
        [ix[k], iy[k], iz[k]] = wi.into();
        [r[k], g[k], b[k]] = weight;
        pdf[k] = density;
        kind[k] = lobe;
    }
}
