//! The diagrams of `catseye plot` and `catseye furnace`.

pub(crate) mod albedo;
mod axes;
pub(crate) mod furnace;
pub(crate) mod lobe;
mod polar;
