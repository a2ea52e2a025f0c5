//! What a driver sees of a sign at night: where lamps, sign and eye are, the angles between them, and the
//! luminance that follows.
//!
//! The frame is the vehicle's, in metres: x ahead, y to the left, z up. Its origin lies on the road below the
//! middle of the headlamps. All angles of retro-reflection are at the sign, and exact: nothing is small here.
//!
//! ```
//! use catseye_photometry::drive::{Road, Scene, Sign, Vehicle};
//! use catseye_photometry::lamp::Lamp;
//!
//! let scene = Scene { vehicle: Vehicle::CAR, road: Road::Straight, sign: Sign::SHOULDER };
//! let sight = scene.sight(100.0, &Lamp::even(10_000.0))?;
//! // Two lamps of 10 000 cd bring about 1 lx each to 100 m: R_A times that, over the cosine of the view.
//! let luminance: f64 = sight.luminances([250.0, 250.0]).iter().sum();
//! assert!((luminance - 500.0).abs() < 5.0, "{luminance} cd/m2");
//! # Ok::<(), catseye_photometry::drive::DriveError>(())
//! ```

mod error;
mod road;
mod scene;
mod sign;
mod table;
mod vehicle;

pub use error::DriveError;
pub use road::Road;
pub use scene::{LampView, Light, Scene, Sight, View};
pub use sign::Sign;
pub use table::{CoefficientTable, Reading};
pub use vehicle::Vehicle;

/// A place or direction in the vehicle's frame.
type Vector = catseye::Vec3<f64>;
