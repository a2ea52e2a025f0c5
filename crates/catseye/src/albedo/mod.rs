//! Directional and average albedo of single scattering, in three forms.
//!
//! | form | what it is | error, isotropic / anisotropic | where it is used |
//! |---|---|---|---|
//! | [`exact`] | quadrature in double precision | 1e-9 | the oracle: golden vectors, fits, tests |
//! | [`FastFit`] | polynomial with 22 coefficients, from a table of 2112 numbers | 1e-4 / 1e-3 | eval and
//! sample |
//! | [`CompactFit`] | the same polynomial with 9 coefficients, from 225 numbers | 2e-3 / 5e-3 | shading
//! languages without textures |
//!
//! The bounds hold over all directions and all roughness pairs in `[0, inf]^2`; the test `albedo` measures
//! them.

pub mod exact;
mod fit;
mod gauss;
mod tables;

pub(crate) use fit::Ray;
pub(crate) use gauss::Gauss;

pub use fit::{CompactFit, FastFit, Fit};
