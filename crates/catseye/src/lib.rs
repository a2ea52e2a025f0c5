//! The retro-reflective BSDF.
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
pub use lobe::{Lobe, LobeKind, LobeVisitor, Sample};
pub use model::{AnyLobe, Model};
pub use params::{ParamError, Params};
pub use real::Real;
pub use reciprocal::Reciprocal;
pub use vec3::Vec3;
