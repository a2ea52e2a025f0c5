//! The luminance of a sign over its distance.

use catseye_photometry::significant;
use plotters::prelude::{DrawingBackend, RGBColor};

use super::axes::{Axes, signed, ticks};
use super::canvas::{Canvas, INK, Lettering, MUTED};
use super::chart::{log_ticks, round_up};
use super::curves::{LABEL_STEP, shade, spread};
use super::figure::Figure;

/// Decades below the highest value that are shown at most.
const DECADES: f64 = 3.0;
const SIZE: (u32, u32) = (960, 600);
/// Widths of curves where a value is read, and where a table's is held.
const READ: f64 = 2.5;
const HELD: f64 = 1.0;

/// A point of a curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) distance_m: f64,
    /// In cd/m2, if it is known.
    pub(crate) luminance: Option<f64>,
    /// Whether it comes from a table's value that is held below its least angle.
    pub(crate) is_held: bool,
}

/// What is to be shown.
#[derive(Clone, Debug)]
pub(crate) struct Request {
    pub(crate) subtitle: String,
    /// The name of each subject and its points, in the order of the distance.
    pub(crate) curves: Vec<(String, Vec<Point>)>,
    /// In cd/m2.
    pub(crate) required: Option<f64>,
}

/// The figure.
#[derive(Debug)]
pub(crate) struct DriveFigure {
    request: Request,
    end_m: f64,
    /// Decimal logarithms of the values at the lower and the upper end of the axis.
    decades: [f64; 2],
}

impl DriveFigure {
    /// Finds the axes.
    pub(crate) fn new(request: Request) -> anyhow::Result<Self> {
        let points = || request.curves.iter().flat_map(|(_, points)| points);
        let known = points().filter_map(|point| point.luminance).filter(|luminance| *luminance > 0.0);
        let logs: Vec<f64> = known.chain(request.required).map(f64::log10).collect();
        if points().all(|point| point.luminance.is_none()) {
            anyhow::bail!("none of the luminances is known: all angles are beyond the tables' greatest");
        }
        let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = logs.iter().copied().fold(f64::INFINITY, f64::min);
        let top = if most.is_finite() { round_up(most) } else { 0.0 };
        let lowest = least.max(top - DECADES).min(request.required.map_or(f64::INFINITY, f64::log10));
        let decades = [lowest.floor().min(top.ceil() - 1.0), top];
        let end_m = points().map(|point| point.distance_m).fold(0.0, f64::max);
        Ok(Self { request, end_m, decades })
    }

    fn color(&self, i: usize) -> RGBColor {
        shade(i as f64 / (self.request.curves.len().max(2) - 1) as f64)
    }
}

impl Figure for DriveFigure {
    fn title(&self) -> String {
        "Luminance of a sign in headlamps".to_owned()
    }

    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        canvas.text(&self.title(), (24.0, 32.0), Lettering::left(22.0, INK))?;
        canvas.text(&self.request.subtitle, (24.0, 60.0), Lettering::left(15.0, MUTED))?;
        let [bottom, top] = self.decades;
        let frame =
            Axes { origin: (74.0, 122.0), size: (600.0, 400.0), x: 0.0..=self.end_m, y: bottom..=top };
        let distances = std::iter::once(0.0).chain(ticks(self.end_m, 8.0));
        let distances: Vec<(f64, String)> = distances.map(|x| (x, signed(x))).collect();
        frame.draw_labelled(
            canvas,
            &distances,
            &log_ticks(bottom, top),
            ["distance in m", "luminance in cd/m²"],
        )?;
        let mut labels: Vec<(f64, String, RGBColor)> = Vec::new();
        if let Some(required) = self.request.required {
            let y = required.log10();
            let ends = [(0.0, y), (self.end_m, y)].map(|place| frame.place(place));
            canvas.line(&ends, INK, 1.5)?;
            labels.push((ends[1].1, format!("required: {}", significant(required, 4)), INK));
        }
        for (i, (name, points)) in self.request.curves.iter().enumerate() {
            let mut last = None;
            for pair in points.windows(2) {
                let Some(ends) = visible(pair, bottom) else { continue };
                let held = pair.iter().any(|point| point.is_held);
                let ends = ends.map(|place| frame.place(place));
                canvas.line(&ends, self.color(i), if held { HELD } else { READ })?;
                last = Some(ends[1].1);
            }
            // A curve that leaves through the lower edge or ends early has its name where it ends.
            let y = last.unwrap_or(frame.origin.1 + frame.size.1);
            labels.push((y, name.clone(), self.color(i)));
        }
        labels.sort_by(|a, b| a.0.total_cmp(&b.0));
        let heights: Vec<f64> = labels.iter().map(|label| label.0).collect();
        let right = frame.origin.0 + frame.size.0 + 14.0;
        for ((_, text, color), y) in labels.iter().zip(spread(&heights, LABEL_STEP, frame.origin.1)) {
            canvas.text(&shortened(text), (right, y), Lettering::left(14.0, *color))?;
        }
        if self.request.curves.iter().flat_map(|(_, points)| points).any(|point| point.is_held) {
            let text = "thin: below the table's least angle, where its value is held";
            canvas.text(text, (frame.origin.0, 584.0), Lettering::left(13.0, MUTED))?;
        }
        Ok(())
    }
}

/// The part of a step of a curve above the lower edge, as distances and logarithms.
fn visible(pair: &[Point], bottom: f64) -> Option<[(f64, f64); 2]> {
    let log = |point: &Point| Some((point.distance_m, point.luminance?.max(f64::MIN_POSITIVE).log10()));
    let [a, b] = [log(&pair[0])?, log(&pair[1])?];
    let cut = |from: (f64, f64), to: (f64, f64)| {
        if to.1 >= bottom {
            return to;
        }
        (from.0 + (to.0 - from.0) * (bottom - from.1) / (to.1 - from.1), bottom)
    };
    (a.1 >= bottom || b.1 >= bottom).then(|| [cut(b, a), cut(a, b)])
}

/// A name that fits beside the diagram.
fn shortened(name: &str) -> String {
    const MOST: usize = 34;
    let count = name.chars().count();
    if count <= MOST {
        return name.to_owned();
    }
    let end: String = name.chars().skip(count + 1 - MOST).collect();
    format!("\u{2026}{end}")
}
