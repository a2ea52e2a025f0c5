//! Photometry of retro-reflectors: from the coefficients on data sheets to the catseye BSDF, and back.
//!
//! # Conventions
//! - Angles are degrees where a name ends in `_deg`, radians elsewhere. Directions are those of [`catseye`]: unit vectors
//!   in the local frame, pointing away from the surface. `wo` points to the receiver, `wi` to the source.
//! - Everything is `f64`: a goniometer's angles are tenths of a degree, whose cosines differ from 1 in the sixth digit.

mod entrance;
pub mod fit;
mod sheeting;

pub use entrance::{EntranceFactor, Knee, LEAST_COSINE};
pub use sheeting::{EntranceForm, Prepared, RetroLobe, Sheeting};
