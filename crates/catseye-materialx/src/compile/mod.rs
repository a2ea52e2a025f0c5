//! From nodes to closures and the programs that fill them.

mod bsdf;
mod emission;
mod input;
pub(crate) mod pattern;
pub(crate) mod slot;
pub(crate) mod surface;
