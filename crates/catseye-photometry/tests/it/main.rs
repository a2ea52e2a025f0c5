//! The promises of catseye-photometry, one file each.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod aperture;
mod brdf;
mod colour;
mod coverage;
mod drive;
mod fit;
mod geometry;
mod half_power;
mod integral;
mod lamp;
mod openmaterial;
mod optics;
mod quantity;
mod sheeting;
mod significant;
mod sloppy;
mod standards;
mod table;
mod unit;
mod verdict;
