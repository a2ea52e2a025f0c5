//! What diagrams of several curves share: the curves of the models, colours in an order, labels at the
//! curves' ends.

use catseye::Model;
use plotters::prelude::RGBColor;

/// Least distance between the labels at the curves' ends.
pub(crate) const LABEL_STEP: f64 = 22.0;

/// The curves for one direction of the light.
#[derive(Debug)]
pub(crate) struct Panel {
    pub(crate) title: String,
    pub(crate) theta_deg: f64,
    /// The angle from the retro direction, in degrees, within which there is something to see.
    pub(crate) reach_deg: f64,
    pub(crate) curves: Vec<Curve>,
}

/// One model's values.
#[derive(Debug)]
pub(crate) struct Curve {
    pub(crate) model: Model,
    /// Angle from the normal in degrees, positive on the light's side, and f cos there.
    pub(crate) values: Vec<(f64, f64)>,
}

impl Curve {
    /// The curve's colour and width: a narrow line stays visible on a wide one.
    pub(crate) fn style(&self) -> (RGBColor, f64) {
        style(self.model)
    }
}

/// Colours from Okabe and Ito's palette, which colour-blind people can tell apart; the brighter ones
/// darkened.
pub(crate) fn style(model: Model) -> (RGBColor, f64) {
    match model {
        Model::Reciprocal => (RGBColor(0x00, 0x72, 0xb2), 2.5),
        Model::Edwards => (RGBColor(0xb8, 0x52, 0x00), 5.0),
        Model::BackVector => (RGBColor(0x00, 0x7a, 0x59), 2.5),
    }
}

/// A colour between dark blue and orange, all of them of a contrast of 4.5 to 1 and more with white (WCAG
/// 2.2, 1.4.3).
pub(crate) fn shade(share: f64) -> RGBColor {
    const STOPS: [[f64; 3]; 5] = [
        [38.0, 38.0, 110.0],
        [40.0, 110.0, 160.0],
        [20.0, 122.0, 104.0],
        [108.0, 113.0, 16.0],
        [184.0, 78.0, 10.0],
    ];
    let position = share.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let below = (position as usize).min(STOPS.len() - 2);
    let t = position - below as f64;
    let [r, g, b] = [0, 1, 2].map(|c| (STOPS[below][c] * (1.0 - t) + STOPS[below + 1][c] * t).round() as u8);
    RGBColor(r, g, b)
}

/// Ascending positions at least `step` apart and not below `least`, as near to the given ones as a sweep in
/// each direction gets them.
pub(crate) fn spread(positions: &[f64], step: f64, least: f64) -> Vec<f64> {
    let mut down: Vec<f64> = Vec::with_capacity(positions.len());
    for &position in positions {
        down.push(down.last().map_or(position, |last| position.max(last + step)));
    }
    let mut up: Vec<f64> = Vec::with_capacity(positions.len());
    for &position in positions.iter().rev() {
        up.push(up.last().map_or(position, |last| position.min(last - step)));
    }
    let mean = down.iter().zip(up.iter().rev()).map(|(a, b)| 0.5 * (a + b));
    mean.enumerate().map(|(i, position)| position.max(least + step * i as f64)).collect()
}

/// What is said of a lobe that has no curve.
pub(crate) fn without_width(roughness: &str, model: Model) -> String {
    format!(
        "roughness {roughness} is a perfect retro-reflector in the model {}: it sends all light back in one \
         direction and has no curve",
        model.name()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::canvas::{INK, MUTED};

    /// The contrast with white (WCAG 2.2, "contrast ratio").
    fn contrast(RGBColor(r, g, b): RGBColor) -> f64 {
        let linear = |code: u8| {
            let x = f64::from(code) / 255.0;
            if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
        };
        1.05 / (catseye_photometry::luminance([r, g, b].map(linear)) + 0.05)
    }

    #[test]
    fn text_and_curves_stand_out_from_white() {
        let shades = (0..=100).map(|i| shade(f64::from(i) / 100.0));
        let models = Model::ALL.into_iter().map(|model| style(model).0);
        for color in shades.chain(models).chain([INK, MUTED]) {
            assert!(contrast(color) >= 4.5, "{color:?}: {}", contrast(color));
        }
    }
}
