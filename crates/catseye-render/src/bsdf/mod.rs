//! What surfaces do to light: a MaterialX closure tree made ready for sampling.

mod albedo_table;
mod cloth;
mod dielectric;
mod diffuse;
mod fresnel;
mod ggx;
mod lobe;
mod metal;
mod shading;
mod table;
mod tree;

pub use shading::{BsdfSample, Shading};
pub use tree::Bsdf;
