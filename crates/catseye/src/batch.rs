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

use crate::{Component, Lobe, LobeVisitor, Real, Vec3};

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

/// The common length of all slices.
///
/// # Panics
/// If two of them differ.
fn common_length<const N: usize>(lengths: [usize; N]) -> usize {
    assert!(lengths.iter().all(|&n| n == lengths[0]), "the slices of a batch differ in length: {lengths:?}");
    lengths[0]
}

/// The direction at index k.
#[inline(always)]
fn vector<T: Real>([x, y, z]: Slices<'_, T>, k: usize) -> Vec3<T> {
    Vec3::new(x[k], y[k], z[k])
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
    #[inline(always)]
    fn visit<L: Lobe<T> + Copy>(self, lobe: L) {
        let Self(_, wo, wi, [r, g, b]) = self;
        let n = common_length([
            r.len(),
            g.len(),
            b.len(),
            common_length(wo.map(<[T]>::len)),
            common_length(wi.map(<[T]>::len)),
        ]);
        for k in 0..n {
            [r[k], g[k], b[k]] = lobe.eval(vector(wo, k), vector(wi, k));
        }
    }
}

impl<S: Simd, T: Real> LobeVisitor<T> for Pdf<'_, S, T> {
    #[inline(always)]
    fn visit<L: Lobe<T> + Copy>(self, lobe: L) {
        let Self(_, wo, wi, pdf) = self;
        let n =
            common_length([pdf.len(), common_length(wo.map(<[T]>::len)), common_length(wi.map(<[T]>::len))]);
        for (k, pdf) in pdf[..n].iter_mut().enumerate() {
            *pdf = lobe.pdf(vector(wo, k), vector(wi, k));
        }
    }
}

impl<S: Simd, T: Real> LobeVisitor<T> for EvalPdf<'_, S, T> {
    #[inline(always)]
    fn visit<L: Lobe<T> + Copy>(self, lobe: L) {
        let Self(_, wo, wi, [r, g, b], pdf) = self;
        let n = common_length([
            pdf.len(),
            common_length([r.len(), g.len(), b.len()]),
            common_length(wo.map(<[T]>::len)),
            common_length(wi.map(<[T]>::len)),
        ]);
        for k in 0..n {
            ([r[k], g[k], b[k]], pdf[k]) = lobe.eval_pdf(vector(wo, k), vector(wi, k));
        }
    }
}

impl<S: Simd, T: Real> LobeVisitor<T> for Draw<'_, S, T> {
    #[inline(always)]
    fn visit<L: Lobe<T> + Copy>(self, lobe: L) {
        let Self(_, wo, [u1, u2, u3], out) = self;
        let ([x, y, z], [r, g, b], pdf, component) = (out.wi, out.weight, out.pdf, out.component);
        let n = common_length([
            common_length(wo.map(<[T]>::len)),
            common_length([u1.len(), u2.len(), u3.len()]),
            common_length([x.len(), y.len(), z.len()]),
            common_length([r.len(), g.len(), b.len()]),
            pdf.len(),
            component.len(),
        ]);
        for k in 0..n {
            let (wi, weight, density, drawn) = match lobe.sample(vector(wo, k), [u1[k], u2[k], u3[k]]) {
                Some(s) => (s.wi, s.weight, s.pdf, s.component),
                None => (Vec3::default(), [T::ZERO; 3], T::ZERO, Component::Single),
            };
            [x[k], y[k], z[k]] = wi.into();
            [r[k], g[k], b[k]] = weight;
            pdf[k] = density;
            component[k] = drawn;
        }
    }
}
