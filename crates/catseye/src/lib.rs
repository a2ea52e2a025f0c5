//! The retro-reflective BSDF.
#![cfg_attr(not(feature = "std"), no_std)]

pub mod albedo;
mod disk;
mod lobe;
mod model;
mod params;
mod real;
mod reciprocal;
mod vec3;

pub use disk::{DIRAC_ROUGHNESS, width};
pub use lobe::{Lobe, LobeKind, Sample};
pub use model::{AnyLobe, Model};
pub use params::{ParamError, Params};
pub use real::Real;
pub use reciprocal::Reciprocal;
pub use vec3::Vec3;
