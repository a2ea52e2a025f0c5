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
//! let sight = scene.sight(100.0, &Lamp::even(10_000.0), |_| Ok::<_, catseye_photometry::Error>(250.0))?;
//! // Two lamps of 10 000 cd bring about 1 lx each to 100 m: R_A times that, over the cosine of the view.
//! assert!((sight.luminance - 500.0).abs() < 5.0, "{} cd/m2", sight.luminance);
//! # Ok::<(), catseye_photometry::Error>(())
//! ```

mod error;
mod road;
mod scene;
mod sign;
mod table;
mod vehicle;

pub use error::DriveError;
pub use road::Road;
pub use scene::{LampSight, LampView, Scene, Sight, View};
pub use sign::Sign;
pub use table::{CoefficientTable, Reading};
pub use vehicle::Vehicle;

/// A place or direction in the vehicle's frame.
type Vector = catseye::Vec3<f64>;
