//! What surfaces do to light: a MaterialX closure tree made ready for sampling.

mod albedo;
mod dielectric;
mod diffuse;
mod fresnel;
mod ggx;
mod lobe;
mod microfacet;
mod oren_nayar;
mod shading;
mod tree;

pub(crate) use dielectric::Albedo;
pub use shading::{BsdfSample, Shading};
pub use tree::Bsdf;
