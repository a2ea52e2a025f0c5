//! Where headlamps and eye are.

use super::Vector;
use super::error::DriveError;

/// A vehicle's headlamps and its driver's eye, in metres.
///
/// No table of measured vehicles could be read for the three sizes that come with the crate: they are
/// assumed. What was read beside them: design values of 1.080 m for the eye and 0.600 m for the headlamps,
/// which 90 % of cars exceed (Fitzpatrick, Lienau and Fambro, Transportation Research Record 1612, 1998,
/// abstract), and headlamps of full-size pickups at 0.91 to 0.99 m (New York Times, 10 December 1998).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vehicle {
    /// Height of the headlamps' centres above the road.
    pub lamp_height_m: f64,
    /// Distance between the headlamps' centres; 0 for a motorcycle, both of whose lamps are then one.
    pub lamp_spacing_m: f64,
    /// Height of the eye above the road.
    pub eye_height_m: f64,
    /// How far the eye is to the left of the middle; negative in a car whose driver sits on the right.
    pub eye_left_m: f64,
    /// How far the eye is behind the headlamps.
    pub eye_behind_m: f64,
}

impl Vehicle {
    /// A passenger car; its sizes are assumed.
    pub const CAR: Self = Self::of(0.62, 1.12, [1.11, 0.35, 1.8]);
    /// A van, sport-utility vehicle or pickup; its sizes are assumed.
    pub const VAN: Self = Self::of(0.83, 1.30, [1.42, 0.37, 1.9]);
    /// A heavy truck; its sizes are assumed.
    pub const TRUCK: Self = Self::of(0.98, 1.80, [2.33, 0.55, 1.7]);

    const fn of(lamp_height_m: f64, lamp_spacing_m: f64, eye: [f64; 3]) -> Self {
        let [eye_height_m, eye_left_m, eye_behind_m] = eye;
        Self { lamp_height_m, lamp_spacing_m, eye_height_m, eye_left_m, eye_behind_m }
    }

    /// The left and the right headlamp.
    pub(super) fn lamps(&self) -> [Vector; 2] {
        [0.5, -0.5].map(|side| Vector::new(0.0, side * self.lamp_spacing_m, self.lamp_height_m))
    }

    pub(super) fn eye(&self) -> Vector {
        Vector::new(-self.eye_behind_m, self.eye_left_m, self.eye_height_m)
    }

    pub(super) fn validate(&self) -> Result<(), DriveError> {
        let within = |name, value: f64, [least, most]: [f64; 2], range| {
            let legal = (least..=most).contains(&value);
            if legal { Ok(()) } else { Err(DriveError::Range { name, value, range }) }
        };
        within("the headlamps' height", self.lamp_height_m, [0.05, 10.0], "[0.05, 10] m")?;
        within("the distance between the headlamps", self.lamp_spacing_m, [0.0, 10.0], "[0, 10] m")?;
        within("the eye's height", self.eye_height_m, [0.05, 10.0], "[0.05, 10] m")?;
        within("the eye's distance from the middle", self.eye_left_m, [-10.0, 10.0], "[-10, 10] m")?;
        within("the eye's distance behind the headlamps", self.eye_behind_m, [-10.0, 10.0], "[-10, 10] m")
    }
}
