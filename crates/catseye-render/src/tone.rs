//! From radiance to what a screen shows.

use glam::Vec3;

use crate::Image;

/// Exposure and a tone curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToneMap {
    /// Factor on radiance, in stops: each doubles the brightness.
    pub exposure_ev: f32,
    /// Exposed radiance that becomes white. Infinite clips at 1 without a curve.
    pub white: f32,
    /// Share of the light that the lens or the eye scatters into a halo, in `[0, 1]`; see
    /// [`crate::Image::with_glare`].
    pub glare: f32,
}

impl ToneMap {
    /// Radiance 1 is white, nothing is bent: for furnaces and comparisons.
    pub const LINEAR: Self = Self { exposure_ev: 0.0, white: f32::INFINITY, glare: 0.0 };

    /// The exposure that shows the picture's mean logarithm as a middle tone, and its brightest thousandth as
    /// white.
    ///
    /// Reinhard et al., "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, Eq. 1 and 2, with
    /// the key 0.18. Pixels without light don't count; a picture without any keeps the exposure.
    #[must_use]
    pub fn fitted(self, image: &Image) -> Self {
        const KEY: f32 = 0.18;
        let mut peaks: Vec<f32> = image.pixels().iter().map(|rgb| Vec3::from(*rgb).max_element()).collect();
        peaks.retain(|peak| *peak > 0.0);
        peaks.sort_by(f32::total_cmp);
        let Some(brightest) = peaks.get(peaks.len() - peaks.len().div_ceil(1000).min(peaks.len())) else {
            return self;
        };
        let mean_log = peaks.iter().map(|peak| f64::from(peak.log2())).sum::<f64>() / peaks.len() as f64;
        let exposure_ev = KEY.log2() - mean_log as f32;
        Self { exposure_ev, white: (brightest * exposure_ev.exp2()).max(1.0), ..self }
    }

    /// The shown colour, linear and in `[0, 1]`: the logarithm of the strongest channel, so that colours keep
    /// their hue and highlights their differences; near white all fade to white.
    ///
    /// Stockham's curve ("Image Processing in the Context of a Visual Model", Proc. IEEE 60(7), 1972), with 1
    /// added so that dark tones are shown in proportion (Drago et al., "Adaptive Logarithmic Mapping", CGF
    /// 22(3), 2003).
    #[must_use]
    pub fn apply(&self, radiance: [f32; 3]) -> [f32; 3] {
        let exposed = Vec3::from(radiance).max(Vec3::ZERO) * self.exposure_ev.exp2();
        if self.white == f32::INFINITY {
            return exposed.min(Vec3::ONE).into();
        }
        let peak = exposed.max_element().max(f32::MIN_POSITIVE);
        let shown = peak.ln_1p() / self.white.ln_1p();
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
