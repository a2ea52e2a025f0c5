//! The road between the vehicle and the sign.

use super::Vector;
use super::error::DriveError;

/// The least radius of a curve or a dip: that of a turning circle.
const LEAST_RADIUS_M: f64 = 5.0;

/// The course of the middle of the vehicle's lane; at the vehicle it is level and leads straight ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Road {
    /// Level and straight.
    Straight,
    /// Level, an arc of a circle.
    Curve {
        /// Its radius, positive to the left, negative to the right.
        radius_m: f64,
    },
    /// Straight as seen from above, an arc of a circle as seen from the side.
    Dip {
        /// Its radius, positive for a dip with the vehicle at its bottom, negative for a crest with the
        /// vehicle on its top.
        radius_m: f64,
    },
}

/// A place on the road.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) position: Vector,
    /// Horizontal unit vector along the road.
    pub(super) ahead: Vector,
}

impl Road {
    /// The place at a distance along the road from the headlamps.
    pub(super) fn place(self, distance_m: f64) -> Place {
        let ahead = Vector::new(1.0, 0.0, 0.0);
        match self {
            Self::Straight => Place { position: ahead * distance_m, ahead },
            Self::Curve { radius_m } => {
                let (sin, cos) = (distance_m / radius_m).sin_cos();
                let side = radius_m * rise(distance_m / radius_m);
                Place { position: Vector::new(radius_m * sin, side, 0.0), ahead: Vector::new(cos, sin, 0.0) }
            }
            Self::Dip { radius_m } => {
                let turn = distance_m / radius_m;
                let position = Vector::new(radius_m * turn.sin(), 0.0, radius_m * rise(turn));
                Place { position, ahead }
            }
        }
    }

    /// Whether the road itself is between two places above it, as behind a crest.
    pub(super) fn is_between(self, from: Vector, to: Vector) -> bool {
        let Self::Dip { radius_m } = self else { return false };
        if radius_m > 0.0 {
            return false;
        }
        // The road's profile is a circle below the vehicle; only what is ahead of both places counts.
        let centre = Vector::new(0.0, 0.0, radius_m);
        let flat = |v: Vector| Vector::new(v.x, 0.0, v.z);
        let (from, step) = (flat(from - centre), flat(to - from));
        let nearest = (-from.dot(step) / step.dot(step)).clamp(0.0, 1.0);
        let at = from + step * nearest;
        at.dot(at) < radius_m * radius_m
    }

    /// Refuses a circle so tight that the road has turned by a right angle before the sign.
    pub(super) fn validate(self, distance_m: f64) -> Result<(), DriveError> {
        let (name, radius) = match self {
            Self::Straight => return Ok(()),
            Self::Curve { radius_m } => ("the curve's radius", radius_m),
            Self::Dip { radius_m } => ("the radius of the dip or crest", radius_m),
        };
        let legal = radius.is_finite() && radius.abs() >= LEAST_RADIUS_M;
        if !legal {
            return Err(DriveError::Range { name, value: radius, range: "5 m and above" });
        }
        let (name, value) = ("the road's turn before the sign", (distance_m / radius).to_degrees());
        let range = "(-90, 90) degrees";
        if value.abs() < 90.0 { Ok(()) } else { Err(DriveError::Range { name, value, range }) }
    }
}

/// 1 - cos, without the loss of digits at small angles.
fn rise(angle: f64) -> f64 {
    2.0 * (0.5 * angle).sin().powi(2)
}
