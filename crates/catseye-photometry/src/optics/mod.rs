//! Coefficients of retro-reflection from first principles: glass beads and corner cubes.
//!
//! Nobody publishes what sheeting does between the angles of its data sheet. [`Beads`] and [`Cubes`] compute
//! it from glass, size and geometry, diffraction included, which rules below half a degree: a bead of 60 um
//! spreads light over 0.5 degrees, a prism of 150 um over 0.2. docs/optics.md derives the formulas and says
//! what is left out; the results are a synthetic truth for fits, not a prediction of a product.
//!
//! ```
//! use catseye_photometry::optics::{Beads, Mount};
//! use catseye_photometry::{Geometry, Goniometer};
//!
//! let tape = Beads { mount: Mount::ENCAPSULATED, index: 1.9, ..Beads::default() }.prepare()?;
//! let r_a = tape.r_a(&Geometry::from(Goniometer::from_degrees(0.2, 5.0, 0.0, 0.0)));
//! assert!((240.0..280.0).contains(&r_a), "{r_a} cd/lx/m2");
//! # Ok::<(), catseye_photometry::Error>(())
//! ```

mod angles;
mod bead;
mod cube;
mod diffuse;
mod fresnel;
mod light;
mod packing;
mod polygon;

pub use angles::{Angles, Computed, MAX_ENTRANCE_DEG, MAX_OBSERVATION_DEG};
pub use bead::{Back, Beads, Mount, PreparedBeads};
pub use cube::{Coating, Cubes, PreparedCubes};
pub use light::Light;

use crate::Error;

/// Refuses a number that is not in its range; `range` says the range to people.
fn within(name: &'static str, value: f64, legal: bool, range: &'static str) -> Result<(), Error> {
    if legal { Ok(()) } else { Err(Error::Range { name, value, range }) }
}
