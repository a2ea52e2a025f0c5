//! The diagrams of `catseye plot` and `catseye furnace`.

pub(crate) mod albedo;
pub(crate) mod axes;
mod canvas;
pub(crate) mod chart;
pub(crate) mod curves;
pub(crate) mod drive;
pub(crate) mod figure;
pub(crate) mod furnace;
pub(crate) mod lobe;
pub(crate) mod optics;
mod polar;
pub(crate) mod ra;
pub(crate) mod residuals;
pub(crate) mod sheet;
pub(crate) mod spheres;
