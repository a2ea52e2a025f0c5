//! Where a sign stands, and which way it faces.

use super::Vector;
use super::error::DriveError;
use super::road::Place;

/// A small sign on a vertical post, or the place on a large one that is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sign {
    /// How far it is to the right of the middle of the lane, in metres; negative to the left.
    pub right_m: f64,
    /// Its height above the road there, in metres.
    pub height_m: f64,
    /// How far it leans back, in degrees: positive faces the sky, negative the road.
    pub tilt_deg: f64,
    /// How far its face is turned to the driver's left, in degrees: towards the road where it stands on the
    /// right. At 0 it faces straight back along the road.
    pub yaw_deg: f64,
    /// How far the sheeting's datum mark is turned counter-clockwise from 12 o'clock, seen from the front.
    pub turn_deg: f64,
}

/// A sign's axes, unit vectors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axes {
    pub(super) normal: Vector,
    pub(super) datum: Vector,
}

impl Sign {
    /// Beside the right shoulder: 5.5 m to the right, 2.5 m high.
    pub const SHOULDER: Self =
        Self { right_m: 5.5, height_m: 2.5, tilt_deg: 0.0, yaw_deg: 0.0, turn_deg: 0.0 };
    /// Above the lane: 6.5 m high.
    pub const OVERHEAD: Self = Self { right_m: 0.0, height_m: 6.5, ..Self::SHOULDER };

    /// The sign's middle.
    pub(super) fn position(&self, place: &Place) -> Vector {
        place.position - left_of(place) * self.right_m + Vector::new(0.0, 0.0, self.height_m)
    }

    pub(super) fn axes(&self, place: &Place) -> Axes {
        let (sin_yaw, cos_yaw) = self.yaw_deg.to_radians().sin_cos();
        let (sin_tilt, cos_tilt) = self.tilt_deg.to_radians().sin_cos();
        let (sin_turn, cos_turn) = self.turn_deg.to_radians().sin_cos();
        let up = Vector::new(0.0, 0.0, 1.0);
        let level = left_of(place) * sin_yaw - place.ahead * cos_yaw;
        let normal = level * cos_tilt + up * sin_tilt;
        let twelve_o_clock = up * cos_tilt - level * sin_tilt;
        Axes { normal, datum: twelve_o_clock * cos_turn + normal.cross(twelve_o_clock) * sin_turn }
    }

    pub(super) fn validate(&self) -> Result<(), DriveError> {
        let within = |name, value: f64, most: f64, range| {
            if value.abs() <= most { Ok(()) } else { Err(DriveError::Range { name, value, range }) }
        };
        within("the sign's distance to the right", self.right_m, 1e3, "[-1000, 1000] m")?;
        within("the sign's height", self.height_m, 1e3, "[-1000, 1000] m")?;
        within("the sign's tilt", self.tilt_deg, 90.0, "[-90, 90] degrees")?;
        within("the sign's yaw", self.yaw_deg, 90.0, "[-90, 90] degrees")?;
        within("the datum mark's turn", self.turn_deg, 360.0, "[-360, 360] degrees")
    }
}

/// Horizontal unit vector to the left of the road.
fn left_of(place: &Place) -> Vector {
    Vector::new(-place.ahead.y, place.ahead.x, 0.0)
}
