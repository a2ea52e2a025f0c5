//! Light sources.

mod area;
mod distant;
mod environment;
mod lat_long;
mod point;
mod profile;
mod sphere;

use std::fmt::Debug;

use glam::Vec3;

use crate::Ray;

pub use area::AreaLight;
pub use distant::DistantLight;
pub use environment::{Environment, Sky};
pub use lat_long::LatLong;
pub use point::PointLight;
pub use profile::ProfileLight;
pub use sphere::{Beam, SphereLight};

/// A direction towards a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Unit vector from the shading point to the light.
    pub wi: Vec3,
    /// How far the light is along `wi`; infinite for an environment.
    pub distance: f32,
    /// Radiance over `pdf`; for a light without extent its irradiance on a plane that faces it.
    pub radiance_over_pdf: Vec3,
    /// Density per steradian; 1 for a light without extent.
    pub pdf: f32,
    /// Whether the light has no extent, so that no ray can meet it.
    pub is_dirac: bool,
}

/// A light source. Positions and directions are in world space.
pub trait Light: Debug + Send + Sync {
    /// A direction from `position` to the light for two uniform numbers; `None` where it doesn't shine.
    fn sample(&self, position: Vec3, u: [f32; 2]) -> Option<LightSample>;

    /// How far along the ray the light is, infinite for an environment; `None` if the ray doesn't meet it
    /// before its end, and always for a light without extent.
    fn distance(&self, ray: &Ray) -> Option<f32>;

    /// Radiance that reaches `position` along `wi`, a direction in which the light lies, and the density with
    /// which [`Light::sample`] chooses `wi`.
    fn radiance_pdf(&self, position: Vec3, wi: Vec3) -> (Vec3, f32);

    /// About how much irradiance the light brings to `position`. 0 takes it out of light sampling: then only
    /// rays that meet it by chance bring its light.
    fn importance(&self, position: Vec3) -> f32;
}

/// One number for the strength of a colour.
pub(crate) fn strength(color: Vec3) -> f32 {
    color.element_sum() / 3.0
}

/// The unit vector between two points and their distance; `None` where they coincide.
pub(crate) fn direction_and_distance(from: Vec3, to: Vec3) -> Option<(Vec3, f32)> {
    let distance = from.distance(to);
    (distance > 0.0 && distance.is_finite()).then(|| ((to - from) / distance, distance))
}
