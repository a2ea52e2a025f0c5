//! From radiance to what a screen shows.

use glam::Vec3;

/// Exposure and a tone curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToneMap {
    /// Factor on radiance, in stops: each doubles the brightness.
    pub exposure_ev: f32,
    /// Exposed radiance that becomes white. Infinite clips at 1 without a curve.
    pub white: f32,
    /// Share of the light that the lens or the eye scatters into a halo, in `[0, 1]`; see [`crate::Image::with_glare`].
    pub glare: f32,
}

impl ToneMap {
    /// Radiance 1 is white, nothing is bent: for furnaces and comparisons.
    pub const LINEAR: Self = Self { exposure_ev: 0.0, white: f32::INFINITY, glare: 0.0 };

    /// The shown colour, linear and in `[0, 1]`.
    ///
    /// Reinhard et al., "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, Eq. 4, on the strongest
    /// channel so that colours keep their hue; what is brighter than white fades to white.
    #[must_use]
    pub fn apply(&self, radiance: [f32; 3]) -> [f32; 3] {
        let exposed = Vec3::from(radiance).max(Vec3::ZERO) * self.exposure_ev.exp2();
        if self.white == f32::INFINITY {
            return exposed.min(Vec3::ONE).into();
        }
        let peak = exposed.max_element().max(f32::MIN_POSITIVE);
        let shown = peak * (1.0 + peak / (self.white * self.white)) / (1.0 + peak);
        let color = exposed * (shown / peak);
        let fade = ((shown - 0.8) / 0.6).clamp(0.0, 1.0);
        color.min(Vec3::ONE).lerp(Vec3::splat(shown.min(1.0)), fade).into()
    }
}

impl Default for ToneMap {
    /// Radiance 1 is a middle tone, 8 is white.
    fn default() -> Self {
        Self { exposure_ev: 0.0, white: 8.0, glare: 0.0 }
    }
}

/// The sRGB code of a linear value in `[0, 1]` (IEC 61966-2-1).
#[must_use]
pub fn encode_srgb(linear: f32) -> u8 {
    let code = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    // The cast saturates, and turns NaN into 0.
    (code * 255.0 + 0.5) as u8
}
