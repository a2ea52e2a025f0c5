//! Directional and average albedo of single scattering.

pub mod exact;
pub(crate) mod gauss;
