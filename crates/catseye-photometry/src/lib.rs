//! Photometry of retro-reflectors: from the coefficients on data sheets to the catseye BSDF, and back.
//!
//! ```
//! use catseye::{Lobe, Params, Reciprocal};
//! use catseye_photometry::{Geometry, Goniometer, Quantity};
//!
//! let sheeting = Reciprocal::<f64>::new(&Params::isotropic(0.0057).with_tint([0.063; 3]))?;
//! let geometry = Geometry::from(Goniometer::from_degrees(0.2, -4.0, 0.0, 0.0));
//! let f = sheeting.eval(geometry.wo, geometry.wi)[1];
//! let r_a = Quantity::RetroReflectionCoefficient.of_brdf(f, &geometry).expect("needs no integral");
//! assert!((r_a - 250.0).abs() < 10.0, "{r_a} cd/lx/m2 at 0.2 degree");
//! # Ok::<(), catseye::ParamError>(())
//! ```
//!
//! # Conventions
//! - Angles are degrees where a name ends in `_deg`, radians elsewhere. Directions are those of [`catseye`]:
//!   unit vectors in the local frame, pointing away from the surface. `wo` points to the receiver, `wi` to
//!   the source.
//! - Everything is `f64`: a goniometer's angles are tenths of a degree, whose cosines differ from 1 in the
//!   sixth digit.
//! - Values are in the SI units of their [`Quantity`]: cd/lx/m2, cd/lx, 1/sr or 1. Other units end where text
//!   is read.

mod aperture;
pub mod brdf;
mod colour;
mod columns;
mod digits;
pub mod drive;
mod entrance;
mod error;
pub mod export;
pub mod fit;
mod gauss;
mod geometry;
pub mod half_power;
mod hints;
mod integral;
pub mod lamp;
mod lines;
mod lobe;
mod mtlx;
mod number;
pub mod openmaterial;
pub mod optics;
mod quantity;
mod record;
mod sheet;
mod sheeting;
pub mod standards;
mod table;
mod unit;
pub mod verdict;

pub use aperture::{ApertureRule, Apertures};
pub use colour::{Colour, ColourError, LUMINANCE, luminance};
pub use digits::significant;
pub use entrance::{EntranceLaw, LEAST_COSINE};
pub use error::Error;
pub use geometry::{Geometry, Goniometer, Intrinsic, RoadMarking};
pub use integral::{diffuse_luminance_coefficient, fractional_retro_reflectance};
pub use lines::line_of_record;
pub use mtlx::{MaterialText, to_mtlx};
pub use quantity::Quantity;
pub use sheeting::{PreparedSheeting, RetroLobe, Sheeting};
pub use table::{Limit, Row, Table};
pub use unit::Unit;
