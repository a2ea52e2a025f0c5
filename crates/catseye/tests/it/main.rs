//! Tests of the public interface: one file for each promise.

mod albedo;
#[cfg(feature = "simd")]
mod batch;
mod chi2;
mod common;
mod furnace;
mod golden;
mod limits;
mod precision;
mod properties;
mod reciprocity;
