//! ASAM `OpenMATERIAL` 3D: the scalar of its material files, and its tables of BRDFs.
//!
//! A material file (`.xomp`, JSON) may have one coefficient of retro-reflection, in cd/lx/m2 from 0 to 5000,
//! and nothing that says at which angles: [`OpenMaterial::table`] assumes some and says which. A table
//! (`_brdf.xompt`) has the BRDF over wavelength and directions. Both are written to the schemas of version
//! 1.0.0.

mod coefficient;
mod lookup;
mod metadata;

pub use coefficient::{Assumption, MAX_COEFFICIENT, OpenMaterial, write_material};
pub use lookup::{Band, BrdfTable, VISIBLE_NM};
pub use metadata::Metadata;
