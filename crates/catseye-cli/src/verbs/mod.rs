//! One file for each verb.

pub(crate) mod albedo;
pub(crate) mod completions;
pub(crate) mod drive;
pub(crate) mod eval;
pub(crate) mod export;
pub(crate) mod fit;
pub(crate) mod furnace;
pub(crate) mod lidar;
pub(crate) mod man;
pub(crate) mod materialx;
pub(crate) mod measure;
pub(crate) mod merge;
pub(crate) mod optics;
pub(crate) mod plot;
pub(crate) mod render;
pub(crate) mod roughness;
pub(crate) mod sample;
pub(crate) mod standards;
