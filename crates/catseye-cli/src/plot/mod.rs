//! The diagrams of `catseye plot`.

pub(crate) mod albedo;
mod axes;
pub(crate) mod lobe;
mod polar;
