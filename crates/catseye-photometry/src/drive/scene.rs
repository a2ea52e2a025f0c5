//! From places to angles, and from angles to luminance.

use super::error::DriveError;
use super::sign::Axes;
use super::{Road, Sign, Vector, Vehicle};
use crate::lamp::Lamp;
use crate::{Geometry, Goniometer, Intrinsic};

/// The greatest distance: far beyond what headlamps light.
const FARTHEST_M: f64 = 1e5;

/// A vehicle on a road before a sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scene {
    /// Who looks, with which lamps where.
    pub vehicle: Vehicle,
    /// The road's course.
    pub road: Road,
    /// What is looked at.
    pub sign: Sign,
}

/// Where everything is, at one distance: in the vehicle's frame, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The sign's middle.
    pub sign: Vector,
    /// The sign's normal, towards the traffic.
    pub normal: Vector,
    /// The sheeting's datum axis, in the sign's plane.
    pub datum: Vector,
    /// The driver's eye.
    pub eye: Vector,
    /// The left and the right headlamp.
    pub lamps: [LampView; 2],
    /// Whether a crest hides the sign from the eye.
    pub is_hidden: bool,
}

/// How a headlamp lies to the sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LampView {
    /// Where it is.
    pub position: Vector,
    /// Its distance from the sign, in metres.
    pub distance_m: f64,
    /// The sign's direction as the lamp sees it, to the right of straight ahead, in degrees: the horizontal
    /// angle of LM-63's and FMVSS 108's Type A goniometer.
    pub right_deg: f64,
    /// The same upwards: the angle of elevation.
    pub up_deg: f64,
    /// Directions from the sign to the eye and to the lamp, in the frame of normal and datum axis.
    pub geometry: Geometry,
    /// Whether a crest hides the sign from the lamp.
    pub is_hidden: bool,
}

/// A view by the light of the headlamps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// Where everything is.
    pub view: View,
    /// What each headlamp brings, left and right.
    pub light: [Light; 2],
}

/// What one headlamp brings to the sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Its intensity towards the sign, in cd.
    pub intensity_cd: f64,
    /// Its illuminance at the sign, on a plane that faces the lamp, in lx; 0 behind a crest.
    pub illuminance_lx: f64,
}

impl Sight {
    /// The luminance in cd/m2 that each headlamp gives to sheeting of these coefficients of retro-reflection
    /// `R_A`, in cd/lx/m2, at the geometry of the left and of the right headlamp. The eye sees their sum.
    ///
    /// It is `R_A` E / cos nu: the coefficient of retro-reflected luminance is `R_A` / cos nu (CIE ILV
    /// 17-24-104), of the illuminance E = I / d^2 on a plane that faces the lamp. Light of the sky, of other
    /// vehicles and scattered by the air is left out.
    #[must_use]
    pub fn luminances(&self, r_a: [f64; 2]) -> [f64; 2] {
        let shown = if self.view.is_hidden { 0.0 } else { 1.0 };
        [0, 1].map(|i| {
            let cos_nu = self.view.lamps[i].geometry.wo.z;
            r_a[i] * self.light[i].illuminance_lx * shown / cos_nu
        })
    }
}

impl LampView {
    /// The angles of the CIE goniometer system: observation, entrance components and rotation.
    #[must_use]
    pub fn goniometer(&self) -> Goniometer {
        self.geometry.into()
    }

    /// The angles of the intrinsic system: entrance, presentation and orientation.
    #[must_use]
    pub fn intrinsic(&self) -> Intrinsic {
        self.geometry.into()
    }
}

impl Scene {
    /// Where everything is, with the sign so many metres ahead of the headlamps, along the road.
    ///
    /// # Errors
    /// A size, angle or distance out of its range, a sign beside or behind the vehicle, one that shows its
    /// back to a lamp or the eye.
    pub fn view(&self, distance_m: f64) -> Result<View, DriveError> {
        self.vehicle.validate()?;
        self.sign.validate()?;
        if !(distance_m > 0.0 && distance_m <= FARTHEST_M) {
            let (name, range) = ("the distance", "(0, 100000] m");
            return Err(DriveError::Range { name, value: distance_m, range });
        }
        self.road.validate(distance_m)?;
        let place = self.road.place(distance_m);
        let (position, axes) = (self.sign.position(&place), self.sign.axes(&place));
        let eye = self.vehicle.eye();
        if !(position.x > eye.x.max(0.0)) {
            return Err(DriveError::Behind { distance_m, ahead_m: position.x });
        }
        let lamps = self.vehicle.lamps();
        let places = [("left headlamp", lamps[0]), ("right headlamp", lamps[1]), ("driver's eye", eye)];
        for (whom, place) in places {
            if !((place - position).dot(axes.normal) > 0.0) {
                return Err(DriveError::Back { distance_m, whom });
            }
        }
        let lamps = lamps.map(|lamp| LampView {
            is_hidden: self.road.is_between(lamp, position),
            ..lamp_view(lamp, eye, position, axes)
        });
        let is_hidden = self.road.is_between(eye, position);
        Ok(View { sign: position, normal: axes.normal, datum: axes.datum, eye, lamps, is_hidden })
    }

    /// The same by the light of two such headlamps.
    ///
    /// # Errors
    /// As [`Scene::view`]; a direction that the lamp has no intensity for.
    pub fn sight(&self, distance_m: f64, lamp: &Lamp) -> Result<Sight, DriveError> {
        let view = self.view(distance_m)?;
        let light = |from: &LampView| {
            let LampView { right_deg, up_deg, .. } = *from;
            let dark = DriveError::Dark { distance_m, right_deg, up_deg };
            let intensity_cd = lamp.intensity_cd(right_deg, up_deg).ok_or(dark)?;
            let lit = if from.is_hidden { 0.0 } else { intensity_cd };
            Ok(Light { intensity_cd, illuminance_lx: lit / (from.distance_m * from.distance_m) })
        };
        let [left, right] = &view.lamps;
        Ok(Sight { light: [light(left)?, light(right)?], view })
    }
}

fn lamp_view(lamp: Vector, eye: Vector, sign: Vector, Axes { normal, datum }: Axes) -> LampView {
    let across = normal.cross(datum);
    let direction = |to: Vector| {
        let away = (to - sign).normalized();
        Vector::new(away.dot(datum), away.dot(across), away.dot(normal))
    };
    let ray = sign - lamp;
    LampView {
        position: lamp,
        distance_m: ray.dot(ray).sqrt(),
        right_deg: (-ray.y).atan2(ray.x).to_degrees(),
        up_deg: ray.z.atan2(ray.x.hypot(ray.y)).to_degrees(),
        geometry: Geometry { wo: direction(eye), wi: direction(lamp) },
        is_hidden: false,
    }
}
