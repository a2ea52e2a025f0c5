//! Spherical lamps, with or without a beam.

use std::f32::consts::PI;

use glam::Vec3;

use super::{Light, LightSample, strength};
use crate::{Frame, Ray, Sphere};

/// A shining sphere. With a beam it is a spot light or a headlamp whose small, finite size rays can meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereLight {
    /// Its extent.
    pub sphere: Sphere,
    /// Its radiance, with a beam that on the beam's axis.
    pub radiance: Vec3,
    /// How the radiance depends on the direction of the light; `None` is alike in all directions.
    pub beam: Option<Beam>,
}

/// A headlamp's beam, nothing behind it: an elliptical Gaussian on a screen in front of the lamp, and another
/// one on top of it that makes the hot spot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    wide: Cone,
    /// With its intensity in units of the wide part's.
    hot_spot: Option<(Cone, f32)>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Cone {
    /// `z` is the axis, `x` horizontal.
    frame: Frame,
    /// ln 2 over the squared tangent of the angle of half the intensity, horizontal and vertical.
    sharpness: [f32; 2],
}

impl Beam {
    /// A beam along `axis` (unit length) whose intensity is half at the given angles (radians, below a right
    /// angle) to the side and up.
    #[must_use]
    pub fn new(axis: Vec3, half_angles: [f32; 2]) -> Self {
        Self { wide: Cone::new(axis, half_angles), hot_spot: None }
    }

    /// The beam with a hot spot of so many times its intensity along another axis.
    #[must_use]
    pub fn with_hot_spot(self, axis: Vec3, half_angles: [f32; 2], intensity: f32) -> Self {
        Self { hot_spot: Some((Cone::new(axis, half_angles), intensity)), ..self }
    }

    /// Intensity in a direction away from the lamp, relative to the wide part's on its axis.
    fn profile(&self, direction: Vec3) -> f32 {
        let spot = self.hot_spot.map_or(0.0, |(cone, intensity)| intensity * cone.profile(direction));
        self.wide.profile(direction) + spot
    }
}

impl Cone {
    fn new(axis: Vec3, half_angles: [f32; 2]) -> Self {
        let frame = Frame::from_normal_tangent(axis, axis.cross(Vec3::Y));
        Self { frame, sharpness: half_angles.map(|a| std::f32::consts::LN_2 / a.tan().powi(2)) }
    }

    fn profile(&self, direction: Vec3) -> f32 {
        let d = self.frame.to_local(direction);
        if d.z <= 0.0 {
            return 0.0;
        }
        let (side, up) = (d.x / d.z, d.y / d.z);
        (-(self.sharpness[0] * side * side + self.sharpness[1] * up * up)).exp()
    }
}

impl SphereLight {
    /// A sphere of the given radiance.
    #[must_use]
    pub fn new(sphere: Sphere, radiance: Vec3) -> Self {
        Self { sphere, radiance, beam: None }
    }

    /// A lamp with a beam whose intensity on the axis is given (flux per steradian, candela in photometric
    /// units).
    #[must_use]
    pub fn headlamp(sphere: Sphere, intensity: Vec3, beam: Beam) -> Self {
        let radiance = intensity / (PI * sphere.radius * sphere.radius);
        Self { sphere, radiance, beam: Some(beam) }
    }

    /// Radiance towards a point: the far-field profile, the same for the whole lamp.
    fn radiance_at(&self, position: Vec3) -> Vec3 {
        let Some(beam) = &self.beam else { return self.radiance };
        self.radiance * beam.profile((position - self.sphere.centre).normalize_or_zero())
    }
}

impl Light for SphereLight {
    fn sample(&self, position: Vec3, u: [f32; 2]) -> Option<LightSample> {
        let one_minus_cos_max = self.sphere.one_minus_cos(position);
        if one_minus_cos_max >= 2.0 {
            return None;
        }
        // A direction in the cone around the sphere, written so that a narrow cone keeps its digits.
        let frame = Frame::from_normal((self.sphere.centre - position).try_normalize()?);
        let one_minus_cos = u[0] * one_minus_cos_max;
        let sin = (one_minus_cos * (2.0 - one_minus_cos)).sqrt();
        let (sin_phi, cos_phi) = (2.0 * PI * u[1]).sin_cos();
        let wi = frame.to_world(Vec3::new(sin * cos_phi, sin * sin_phi, 1.0 - one_minus_cos));
        let solid_angle = 2.0 * PI * one_minus_cos_max;
        // At the rim rounding may miss the sphere: its nearest point is at the same distance.
        let distance = self.sphere.intersect(&Ray::new(position, wi)).unwrap_or_else(|| {
            (position.distance_squared(self.sphere.centre) - self.sphere.radius.powi(2)).sqrt()
        });
        let radiance_over_pdf = self.radiance_at(position) * solid_angle;
        Some(LightSample { wi, distance, radiance_over_pdf, pdf: 1.0 / solid_angle, is_dirac: false })
    }

    fn distance(&self, ray: &Ray) -> Option<f32> {
        self.sphere.intersect(ray)
    }

    fn radiance_pdf(&self, position: Vec3, _wi: Vec3) -> (Vec3, f32) {
        let one_minus_cos = self.sphere.one_minus_cos(position);
        // From inside `sample` gives nothing.
        let pdf = if one_minus_cos < 2.0 { 1.0 / (2.0 * PI * one_minus_cos) } else { 0.0 };
        (self.radiance_at(position), pdf)
    }

    fn importance(&self, position: Vec3) -> f32 {
        strength(self.radiance_at(position)) * self.sphere.solid_angle(position)
    }
}
