//! Light from all around.

use glam::Vec3;

use super::{LatLong, Light, LightSample};
use crate::Ray;

/// The light that comes from where there is nothing else.
#[derive(Clone, Debug)]
pub enum Environment {
    /// The same radiance from everywhere.
    Constant(Vec3),
    /// A smooth sky.
    Sky(Sky),
    /// A picture of the surroundings, the only kind that light sampling looks at: the others are smooth, and rays
    /// that surfaces scatter find them well enough.
    Image(LatLong),
}

/// A clear sky at night: a gradient from horizon to zenith, and the glow of something beyond the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// Radiance straight up.
    pub zenith: Vec3,
    /// Radiance at the horizon.
    pub horizon: Vec3,
    /// Radiance from below the horizon.
    pub ground: Vec3,
    /// Unit vector to the centre of the glow.
    pub glow_direction: Vec3,
    /// Radiance that the glow adds at its centre.
    pub glow: Vec3,
    /// Angle (radians) at which the glow has fallen to 1/e: along the horizon, and upwards.
    pub glow_size: [f32; 2],
}

impl Sky {
    /// The radiance from a direction.
    #[must_use]
    pub fn radiance(&self, direction: Vec3) -> Vec3 {
        /// How fast the haze at the horizon clears upwards.
        const HAZE: f32 = 0.45;
        if direction.y < 0.0 {
            return self.ground;
        }
        let base = self.horizon.lerp(self.zenith, direction.y.powf(HAZE));
        let azimuth = |d: Vec3| d.x.atan2(-d.z);
        let turn = azimuth(direction) - azimuth(self.glow_direction);
        let along = turn.sin().atan2(turn.cos()) / self.glow_size[0];
        let up = (direction.y.asin() - self.glow_direction.y.asin()) / self.glow_size[1];
        base + self.glow * (-(along * along) - up.abs()).exp()
    }
}

impl Light for Environment {
    fn sample(&self, position: Vec3, u: [f32; 2]) -> Option<LightSample> {
        let Self::Image(image) = self else { return None };
        let (wi, pdf) = image.sample(u)?;
        let (radiance, _) = self.radiance_pdf(position, wi);
        Some(LightSample { wi, distance: f32::INFINITY, radiance_over_pdf: radiance / pdf, pdf: Some(pdf) })
    }

    fn distance(&self, ray: &Ray) -> Option<f32> {
        (ray.t_max == f32::INFINITY).then_some(f32::INFINITY)
    }

    fn radiance_pdf(&self, _position: Vec3, wi: Vec3) -> (Vec3, f32) {
        match self {
            Self::Constant(radiance) => (*radiance, 0.0),
            Self::Sky(sky) => (sky.radiance(wi), 0.0),
            Self::Image(image) => (image.radiance(wi), image.pdf(wi)),
        }
    }

    fn importance(&self, _position: Vec3) -> f32 {
        match self {
            Self::Constant(_) | Self::Sky(_) => 0.0,
            Self::Image(image) => std::f32::consts::PI * image.mean(),
        }
    }
}
