//! The retro-reflective BSDF of the MaterialX proposal: evaluated, sampled and integrated exactly, and fast.
//!
//! Retro-reflective materials send light back to where it came from: road signs, high-visibility clothing,
//! number plates. [`Reciprocal`] is the lobe of MaterialX's `retro_reflective_bsdf` proposal, the
//! halfway-vector disk of Edwards et al. 2006 made reciprocal, with anisotropic roughness and
//! multiple-scattering compensation. [`Edwards`] and [`BackVector`] are the lobes it is compared with. All of
//! them share the interface [`Lobe`].
//!
//! ```
//! use catseye::{Lobe, Params, Reciprocal, Vec3};
//!
//! let params = Params::anisotropic(0.3, 0.1).with_tint([0.9, 0.8, 0.1]).with_multiscatter_tint([1.0; 3]);
//! let lobe = Reciprocal::<f32>::new(&params)?;
//! let wo = Vec3::from_angles(0.5, 0.0);
//!
//! let (f, pdf) = lobe.eval_pdf(wo, Vec3::from_angles(0.6, 0.1));
//! let sample = lobe.sample(wo, [0.3, 0.7, 0.5]).expect("wo is above the horizon");
//! let red = sample.weight[0]; // f cos / pdf
//! # assert!(f[0] > f[2] && pdf > 0.0 && red > 0.0);
//! # Ok::<(), catseye::ParamError>(())
//! ```
//!
//! # Conventions
//!
//! - Directions are unit vectors in the local frame: z is the shading normal, x is `tangent_u`. `wo` points
//!   to where the path came from, `wi` is the sampled or light direction; both point away from the surface.
//!   In GLSL they are MaterialX's V and L.
//! - The lobes reflect only. A direction with z at or below 0 is below the horizon: the BSDF, the density and
//!   the albedo are 0 there, and `sample` gives `None`. For a two-sided surface flip the frame first.
//! - `eval` gives f in 1/sr, the cosine not included; `pdf` is per steradian; a sample's weight is `f cos /
//!   pdf`.
//! - Roughness is the proposal's, in `[0, inf]`, not a microfacet alpha; infinity itself is legal. Where both
//!   roughnesses are below [`DIRAC_ROUGHNESS`] the lobe is a Dirac distribution; a single one below it is
//!   raised to it.
//! - A Dirac distribution is met by `sample` only, which marks it as [`Component::Dirac`] with a density of
//!   1; `eval` and `pdf` are 0.
//! - Parameters are validated once, by the constructors. After that no function panics or returns NaN for
//!   unit vectors, whatever the parameters.
//! - Every type is generic over [`Real`]: `f32` is what renderers run, `f64` the oracle. Both are one text.
//!
//! The mathematics is derived in `docs/theory.md`, section by section as the comments cite it. `conformance/`
//! holds vectors that implementations in other languages can be checked against.
//!
//! # Features
//!
//! `std` (default) and `simd` (default, needs `std`: the `batch` module). Without `std`, enable `libm`.
//! `fused` rounds once where it multiplies and adds, on targets that have an instruction for it
//! (`RUSTFLAGS="-C target-cpu=x86-64-v3"`): faster and as exact, but its last digits are those of such builds
//! only.
#![cfg_attr(not(feature = "std"), no_std)]

pub mod albedo;
mod back_vector;
#[cfg(feature = "simd")]
pub mod batch;
mod compensation;
mod disk;
mod edwards;
mod f32_math;
mod lobe;
mod model;
mod params;
mod real;
mod reciprocal;
mod vec3;

pub use back_vector::BackVector;
pub use disk::{DIRAC_ROUGHNESS, width};
pub use edwards::Edwards;
pub use lobe::{Component, Lobe, Sample};
pub use model::{AnyLobe, Model};
pub use params::{ParamError, Params};
pub use real::Real;
pub use reciprocal::Reciprocal;
pub use vec3::Vec3;
