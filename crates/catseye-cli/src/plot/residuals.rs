//! How far a model is from each value, over the observation and over the entrance angle.

use plotters::prelude::{DrawingBackend, RGBColor};

use super::axes::{Axes, degrees, signed, ticks_between};
use super::canvas::{Canvas, INK};
use super::figure::Figure;

const SIZE: (u32, u32) = (720, 290);
/// Left edges of the two diagrams, and their upper edge, width and height.
const LEFT: [f64; 2] = [74.0, 416.0];
const TOP: f64 = 44.0;
const WIDTH: f64 = 284.0;
const HEIGHT: f64 = 186.0;
const MARKER: f64 = 3.5;
/// The tolerance's band, and what lies within and beyond it.
const BAND: RGBColor = RGBColor(0xe3, 0xf1, 0xe8);
const GOOD: RGBColor = RGBColor(0x1b, 0x7f, 0x3b);
const OFF: RGBColor = RGBColor(0xb3, 0x26, 0x1e);
/// From this ratio of model and value on the axis is logarithmic.
const FAR: f64 = 2.0;

/// A row of a fit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Residual {
    /// Observation and entrance angle.
    pub(crate) angles_deg: [f64; 2],
    /// Model over value.
    pub(crate) ratio: f64,
    /// Whether the row is met.
    pub(crate) is_met: bool,
}

/// All rows of a fit.
#[derive(Clone, Debug)]
pub(crate) struct Residuals {
    pub(crate) rows: Vec<Residual>,
    /// What a row may be off, as a share of its value, where there is such a limit.
    pub(crate) tolerance: Option<f64>,
}

impl Residuals {
    /// The end of the vertical axis: the greatest share that a row is off, and some more; of a logarithmic
    /// axis the decades.
    fn reach(&self, scale: fn(f64) -> f64) -> f64 {
        let rows = self.rows.iter().map(|row| scale(row.ratio).abs()).filter(|x| x.is_finite());
        1.15 * rows.fold(1.2 * self.tolerance.map_or(1e-3, |tolerance| scale(1.0 + tolerance)), f64::max)
    }
}

impl Figure for Residuals {
    fn title(&self) -> String {
        "Model against value, over the observation and the entrance angle".to_owned()
    }

    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let is_far = self.rows.iter().any(|row| !(row.ratio.ln().abs() < FAR.ln()));
        let scale: fn(f64) -> f64 = if is_far { f64::log10 } else { |ratio| ratio - 1.0 };
        let reach = self.reach(scale);
        let y_ticks = y_ticks(reach, is_far);
        let y_title = if is_far { "model / value" } else { "model less value, % of the value" };
        for (i, title) in ["observation angle", "entrance angle"].into_iter().enumerate() {
            let left = LEFT[i];
            let x = range(self.rows.iter().map(|row| row.angles_deg[i]));
            let frame =
                Axes { origin: (left, TOP), size: (WIDTH, HEIGHT), x: x[0]..=x[1], y: -reach..=reach };
            if let Some(tolerance) = self.tolerance {
                let [low, high] = [1.0 - tolerance, 1.0 + tolerance].map(|ratio| scale(ratio).max(-reach));
                let corners = [(x[0], low), (x[1], low), (x[1], high), (x[0], high)];
                canvas.fill(&corners.map(|place| frame.place(place)), BAND)?;
            }
            let y_title = if i == 0 { y_title } else { "" };
            frame.draw_labelled(canvas, &degrees(&ticks_between(x, 6.0)), &y_ticks, [title, y_title])?;
            canvas.line(&[(x[0], 0.0), (x[1], 0.0)].map(|place| frame.place(place)), INK, 1.0)?;
            for row in &self.rows {
                let color = if row.is_met { GOOD } else { OFF };
                let y = scale(row.ratio).clamp(-reach, reach);
                canvas.disk(frame.place((row.angles_deg[i], y)), MARKER, color)?;
            }
        }
        Ok(())
    }
}

/// Both ends of some angles, and a little more.
fn range(angles: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let least = angles.clone().fold(f64::INFINITY, f64::min).min(0.0);
    let most = angles.fold(f64::NEG_INFINITY, f64::max).max(least + 1.0);
    let margin = 0.06 * (most - least);
    [if least < 0.0 { least - margin } else { 0.0 }, most + margin]
}

/// Shares in percent, or ratios where the axis is logarithmic.
fn y_ticks(reach: f64, is_far: bool) -> Vec<(f64, String)> {
    if !is_far {
        let ticks = ticks_between([-100.0 * reach, 100.0 * reach], 6.0);
        return ticks.into_iter().map(|percent| (0.01 * percent, signed(percent))).collect();
    }
    let ratios = (-9..9).flat_map(|decade| [1.0, 2.0, 5.0].map(|m| m * 10.0_f64.powi(decade)));
    let shown = ratios.filter(|ratio| ratio.log10().abs() <= reach);
    shown.map(|ratio| (ratio.log10(), ratio.to_string())).collect()
}
