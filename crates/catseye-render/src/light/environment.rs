//! Light from all around.

use glam::Vec3;

use super::{LatLong, Light, LightSample};
use crate::Ray;
use crate::sampler::combine;

/// The light that comes from where there is nothing else.
#[derive(Clone, Debug)]
pub enum Environment {
    /// The same radiance from everywhere.
    Constant(Vec3),
    /// A smooth sky.
    Sky(Sky),
    /// A picture of the surroundings, the only kind that light sampling looks at: the others are smooth, and
    /// rays that surfaces scatter find them well enough.
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
    /// Radiance of the brightest stars.
    pub stars: Vec3,
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
        base + self.glow * self.glow_profile(direction) + self.stars * star(direction)
    }

    fn glow_profile(&self, direction: Vec3) -> f32 {
        let azimuth = |d: Vec3| d.x.atan2(-d.z);
        let turn = azimuth(direction) - azimuth(self.glow_direction);
        let along = turn.sin().atan2(turn.cos()) / self.glow_size[0];
        let up = (direction.y.asin() - self.glow_direction.y.asin()) / self.glow_size[1];
        (-(along * along) - up.abs()).exp()
    }
}

/// The strength of the star in a direction, in `[0, 1]`; nearly always 0. Few are bright, and none stands in
/// the haze of the horizon.
fn star(direction: Vec3) -> f32 {
    /// Cells of the sky along the edge of a cube around it; each may hold a star.
    const CELLS: f32 = 260.0;
    /// The part of the cells that hold one.
    const DENSITY: f32 = 0.014;
    /// Radius of a star in cells.
    const RADIUS: f32 = 0.22;
    let axis = direction.abs().max_position();
    let on_cube = direction * (CELLS / direction[axis].abs());
    let cell = on_cube.floor();
    let hash = [cell.x, cell.y, cell.z].into_iter().fold(axis as u32, |h, c| combine(h, c as i32 as u32));
    let pick = |purpose| (combine(hash, purpose) >> 8) as f32 / (1 << 24) as f32;
    if pick(0) >= DENSITY {
        return 0.0;
    }
    let mut offset = on_cube - cell - Vec3::new(pick(1), pick(2), pick(3)).lerp(Vec3::splat(0.5), 0.5);
    offset[axis] = 0.0;
    let inside = offset.length_squared() < RADIUS * RADIUS;
    let clear = (direction.y / 0.25).clamp(0.0, 1.0);
    if inside { pick(4).powi(5) * clear } else { 0.0 }
}

impl Light for Environment {
    fn sample(&self, position: Vec3, u: [f32; 2]) -> Option<LightSample> {
        let Self::Image(image) = self else { return None };
        let (wi, pdf) = image.sample(u)?;
        let (radiance, _) = self.radiance_pdf(position, wi);
        let radiance_over_pdf = radiance / pdf;
        Some(LightSample { wi, distance: f32::INFINITY, radiance_over_pdf, pdf, is_dirac: false })
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
