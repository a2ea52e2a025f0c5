//! The coefficient of retro-reflection over the observation angle.

use std::f64::consts::TAU;

use catseye_photometry::{Geometry, Goniometer, Limit};
use plotters::prelude::{DrawingBackend, RGBColor};

use super::axes::{Axes, signed, ticks};
use super::canvas::{self, Canvas, GRID, INK, Lettering, MUTED};
use super::curves::{LABEL_STEP, shade, spread};
use super::figure::Figure;

/// Points of a curve.
const STEPS: u32 = 240;
/// Decades below the highest value that are shown at most.
const DECADES: f64 = 4.0;
/// Radius of a marker.
const MARKER: f64 = 6.5;
/// Least distance between labels side by side, and of a label from its curve.
const LABEL_WIDTH: f64 = 52.0;
const LABEL_GAP: f64 = 8.0;
const SIZE: (u32, u32) = (960, 640);

/// A value to show beside the curves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) observation_deg: f64,
    pub(crate) entrance_deg: f64,
    /// In cd/lx/m2.
    pub(crate) r_a: f64,
    pub(crate) limit: Limit,
}

/// What is to be shown.
#[derive(Clone, Debug)]
pub(crate) struct Request {
    pub(crate) title: String,
    pub(crate) subtitle: String,
    /// One curve for each, ascending.
    pub(crate) entrance_deg: Vec<f64>,
    /// Observation angle at the axis' end.
    pub(crate) end_deg: f64,
    pub(crate) points: Vec<Point>,
}

/// The computed curves.
#[derive(Debug)]
pub(crate) struct RaFigure {
    request: Request,
    /// Observation angle in degrees and `R_A`, for each entrance angle.
    curves: Vec<Vec<(f64, f64)>>,
    /// Decimal logarithms of the values at the lower and the upper end of the axis.
    decades: [f64; 2],
}

impl RaFigure {
    /// Computes the curves of a function of the geometry that gives `R_A` in cd/lx/m2.
    pub(crate) fn new(
        request: Request,
        r_a: impl Fn(&Geometry) -> anyhow::Result<f64>,
    ) -> anyhow::Result<Self> {
        let curve = |&entrance: &f64| {
            let value = |step: u32| {
                let observation = request.end_deg * f64::from(step) / f64::from(STEPS);
                let geometry = Geometry::from(Goniometer::from_degrees(observation, entrance, 0.0, 0.0));
                Ok((observation, r_a(&geometry)?))
            };
            (0..=STEPS).map(value).collect::<anyhow::Result<Vec<_>>>()
        };
        let curves = request.entrance_deg.iter().map(curve).collect::<anyhow::Result<Vec<_>>>()?;
        let decades = decades(&curves, &request.points);
        Ok(Self { request, curves, decades })
    }

    /// What is asked for, and what its markers mean.
    fn subtitle(&self) -> String {
        let shown = |limit: Limit| self.request.points.iter().any(|point| point.limit == limit);
        let markers =
            [(Limit::Minimum, '\u{25b2}'), (Limit::Maximum, '\u{25bc}'), (Limit::Typical, '\u{25cf}')];
        let legend = markers.into_iter().filter(|(limit, _)| shown(*limit));
        legend.fold(self.request.subtitle.clone(), |text, (limit, marker)| {
            format!("{text}   {marker} {}", limit.name())
        })
    }

    fn color(&self, i: usize) -> RGBColor {
        shade(i as f64 / (self.curves.len().max(2) - 1) as f64)
    }

    /// The colour of the curve for a point's entrance angle; a point without a curve is grey.
    fn point_color(&self, point: &Point) -> RGBColor {
        let same = |&angle: &f64| (angle - point.entrance_deg).abs() < 1e-9;
        self.request.entrance_deg.iter().position(same).map_or(MUTED, |i| self.color(i))
    }
}

/// The axis: whole decades around everything, but not more than [`DECADES`].
fn decades(curves: &[Vec<(f64, f64)>], points: &[Point]) -> [f64; 2] {
    let values = curves.iter().flatten().map(|&(_, value)| value).chain(points.iter().map(|point| point.r_a));
    let logs: Vec<f64> = values.filter(|value| *value > 0.0).map(f64::log10).collect();
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let least = logs.iter().copied().fold(f64::INFINITY, f64::min);
    if !most.is_finite() {
        return [-1.0, 1.0];
    }
    let top = round_up(most);
    let lowest_point = points.iter().map(|point| point.r_a.log10()).fold(f64::INFINITY, f64::min);
    let bottom = least.max(top - DECADES).min(lowest_point).floor();
    [bottom.min(top.ceil() - 1.0), top]
}

/// The logarithm of the next 1, 2 or 5 times a power of ten.
fn round_up(log: f64) -> f64 {
    let decade = log.floor();
    let steps = [1.0_f64, 2.0, 5.0, 10.0].map(|m| decade + m.log10());
    steps.into_iter().find(|&step| step >= log - 1e-9).unwrap_or(decade + 1.0)
}

impl Figure for RaFigure {
    fn title(&self) -> String {
        self.request.title.clone()
    }

    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        canvas.text(&self.request.title, (24.0, 32.0), Lettering::left(22.0, INK))?;
        canvas.text(&self.subtitle(), (24.0, 60.0), Lettering::left(15.0, MUTED))?;
        let [bottom, top] = self.decades;
        let end = self.request.end_deg;
        let frame = Axes { origin: (74.0, 122.0), size: (740.0, 440.0), x: 0.0..=end, y: bottom..=top };
        let x_ticks: Vec<f64> = std::iter::once(0.0).chain(ticks(end, 10.0)).collect();
        frame.draw_labelled(
            canvas,
            &x_ticks,
            &log_ticks(bottom, top),
            ["observation angle", "R_A in cd/lx/m²"],
        )?;
        for (i, curve) in self.curves.iter().enumerate() {
            let points: Vec<_> = visible(curve, bottom).map(|place| frame.place(place)).collect();
            canvas.line(&points, self.color(i), 2.5)?;
        }
        for point in self.request.points.iter().filter(|point| point.observation_deg <= end) {
            let at = frame.place((point.observation_deg, point.r_a.log10()));
            canvas.fill(&marker(at, point.limit, MARKER + 1.5), RGBColor(255, 255, 255))?;
            canvas.fill(&marker(at, point.limit, MARKER), self.point_color(point))?;
        }
        self.draw_labels(canvas, &frame)
    }
}

impl RaFigure {
    /// The entrance angle beside each curve's end, or above where it leaves through the lower edge.
    fn draw_labels<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>, frame: &Axes) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let bottom = self.decades[0];
        let ends = self.curves.iter().enumerate();
        let ends = ends.filter_map(|(i, curve)| Some((i, frame.place(visible(curve, bottom).last()?))));
        let right = frame.origin.0 + frame.size.0;
        let (mut beside, mut below): (Vec<_>, Vec<_>) = ends.partition(|(_, end)| end.0 > right - 0.5);
        let label = |i: usize| format!("{}°", signed(self.request.entrance_deg[i]));

        beside.sort_by(|(_, a), (_, b)| a.1.round().total_cmp(&b.1.round()));
        let heights: Vec<f64> = beside.iter().map(|(_, end)| end.1).collect();
        for (&(i, end), y) in beside.iter().zip(spread(&heights, LABEL_STEP, frame.origin.1)) {
            canvas.line(&[end, (right + 28.0, y)], GRID, 1.0)?;
            canvas.text(&label(i), (right + 34.0, y), Lettering::left(15.0, self.color(i)))?;
        }

        below.sort_by(|(_, a), (_, b)| a.0.total_cmp(&b.0));
        let places: Vec<f64> = below.iter().map(|(_, end)| end.0 + LABEL_GAP).collect();
        for (&(i, end), x) in below.iter().zip(spread(&places, LABEL_WIDTH, frame.origin.0)) {
            canvas.text(&label(i), (x, end.1 - LABEL_STEP), Lettering::left(15.0, self.color(i)))?;
        }
        canvas.text("entrance angle", (right + 34.0, frame.origin.1 - 22.0), Lettering::left(15.0, INK))
    }
}

/// The part of a curve above the lower end of the axis, as observation angles and logarithms; it ends on that
/// edge.
fn visible(curve: &[(f64, f64)], bottom: f64) -> impl Iterator<Item = canvas::Point> {
    let logs = curve.iter().map(|&(x, value)| (x, value.max(f64::MIN_POSITIVE).log10()));
    let mut above: Vec<canvas::Point> = logs.clone().take_while(|&(_, log)| log >= bottom).collect();
    if let (Some(&(x0, y0)), Some((x1, y1))) = (above.last(), logs.clone().nth(above.len())) {
        above.push((x0 + (x1 - x0) * (y0 - bottom) / (y0 - y1), bottom));
    }
    above.into_iter()
}

/// 1, 2 and 5 times the powers of ten, with their values as labels.
fn log_ticks(bottom: f64, top: f64) -> Vec<(f64, String)> {
    let decades = bottom.floor() as i32..=top.ceil() as i32;
    let all = decades.flat_map(|decade| [1.0, 2.0, 5.0].map(|m| m * 10.0_f64.powi(decade)));
    all.map(|value| (value.log10(), value))
        .filter(|(log, _)| (bottom - 1e-9..=top + 1e-9).contains(log))
        .map(|(log, value)| (log, signed(value)))
        .collect()
}

/// The outline of a marker: a triangle that stands on a minimum, hangs from a maximum, or a disk.
fn marker((x, y): canvas::Point, limit: Limit, radius: f64) -> Vec<canvas::Point> {
    let corners = |count: u32, turn: f64| -> Vec<canvas::Point> {
        let corner = |i| {
            let (sin, cos) = (turn + TAU * f64::from(i) / f64::from(count)).sin_cos();
            (x + radius * sin, y - radius * cos)
        };
        (0..count).map(corner).collect()
    };
    match limit {
        Limit::Minimum => corners(3, 0.0),
        Limit::Maximum => corners(3, TAU / 2.0),
        Limit::Typical => corners(24, 0.0),
    }
}
