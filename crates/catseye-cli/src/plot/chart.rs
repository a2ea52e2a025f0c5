//! Values on a logarithmic axis over an angle: curves, marks with their uncertainty, and where the marks end.

use std::f64::consts::TAU;

use catseye_photometry::Limit;
use plotters::prelude::{DrawingBackend, RGBColor};

use super::axes::{Axes, degrees, signed, ticks_between};
use super::canvas::{self, Canvas, GRID, INK, Lettering, MUTED};
use super::curves::{LABEL_STEP, shade, spread};
use super::figure::Figure;

/// Decades below the highest value that are shown at most.
const DECADES: f64 = 4.0;
/// Radius of a mark; of many marks, so that they can be told apart.
const MARKER: f64 = 6.5;
const SMALL_MARKER: f64 = 3.0;
const MANY: usize = 60;
/// Half the width of the end of an uncertainty's bar.
const CAP: f64 = 4.0;
/// Least distance between labels side by side, and of a label from its curve.
const LABEL_WIDTH: f64 = 52.0;
const LABEL_GAP: f64 = 8.0;
/// Around the diagram: left, right, above (below a heading) and below.
const MARGINS: [f64; 4] = [74.0, 146.0, 50.0, 78.0];
const HEADING: f64 = 72.0;
/// Where there are no values.
const UNKNOWN: RGBColor = RGBColor(0xed, 0xef, 0xf2);
const WHITE: RGBColor = RGBColor(255, 255, 255);

/// A value beside the curves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark {
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// One standard deviation, in the unit of the value, where it is known.
    pub(crate) uncertainty: Option<f64>,
    pub(crate) limit: Limit,
    /// The curve that it belongs to.
    pub(crate) curve: Option<usize>,
}

/// A curve and what stands at its end.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    pub(crate) label: String,
    pub(crate) points: Vec<canvas::Point>,
}

/// What is to be shown.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    /// What it shows, for those who can't see it.
    pub(crate) title: String,
    /// Two lines above the diagram, where nothing around it says what it is.
    pub(crate) heading: Option<[String; 2]>,
    pub(crate) size: (u32, u32),
    /// Titles of the horizontal and the vertical axis, and of the curves' labels.
    pub(crate) titles: [String; 3],
    /// The ends of the horizontal axis, in degrees.
    pub(crate) x: [f64; 2],
    /// Between which angles there are values; what lies beyond is shaded.
    pub(crate) known: Option<[f64; 2]>,
    pub(crate) curves: Vec<Curve>,
    pub(crate) marks: Vec<Mark>,
}

/// What the shapes of marks mean, of those that are there.
pub(crate) fn legend(marks: &[Mark]) -> String {
    let shapes = [
        (Limit::Minimum, "\u{25b2} minimum"),
        (Limit::Maximum, "\u{25bc} maximum"),
        (Limit::Typical, "\u{25cf} value"),
    ];
    let shown = shapes.into_iter().filter(|(limit, _)| marks.iter().any(|mark| mark.limit == *limit));
    shown.map(|(_, text)| text).collect::<Vec<_>>().join("   ")
}

impl Chart {
    fn color(&self, i: usize) -> RGBColor {
        shade(i as f64 / (self.curves.len().max(2) - 1) as f64)
    }

    /// Decimal logarithms at the ends of the vertical axis: whole decades around everything, but not more
    /// than [`DECADES`].
    fn decades(&self) -> [f64; 2] {
        let values = self.curves.iter().flat_map(|curve| &curve.points).map(|&(_, value)| value);
        let logs: Vec<f64> = values
            .chain(self.marks.iter().map(|mark| mark.y))
            .filter(|value| *value > 0.0)
            .map(f64::log10)
            .collect();
        let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = logs.iter().copied().fold(f64::INFINITY, f64::min);
        if !most.is_finite() {
            return [-1.0, 1.0];
        }
        let top = round_up(most);
        let lowest_mark = self.marks.iter().map(|mark| mark.y.log10()).fold(f64::INFINITY, f64::min);
        let bottom = least.max(top - DECADES).min(lowest_mark).floor();
        [bottom.min(top.ceil() - 1.0), top]
    }

    fn frame(&self, [bottom, top]: [f64; 2]) -> Axes {
        let [left, right, above, below] = MARGINS;
        let above = above + if self.heading.is_some() { HEADING } else { 0.0 };
        let (width, height) = (f64::from(self.size.0), f64::from(self.size.1));
        let size = (width - left - right, height - above - below);
        Axes { origin: (left, above), size, x: self.x[0]..=self.x[1], y: bottom..=top }
    }
}

/// The logarithm of the next 1, 2 or 5 times a power of ten.
pub(super) fn round_up(log: f64) -> f64 {
    let decade = log.floor();
    let steps = [1.0_f64, 2.0, 5.0, 10.0].map(|m| decade + m.log10());
    steps.into_iter().find(|&step| step >= log - 1e-9).unwrap_or(decade + 1.0)
}

impl Figure for Chart {
    fn title(&self) -> String {
        self.title.clone()
    }

    fn size(&self) -> (u32, u32) {
        self.size
    }

    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        if let Some([title, subtitle]) = &self.heading {
            canvas.text(title, (24.0, 32.0), Lettering::left(22.0, INK))?;
            canvas.text(subtitle, (24.0, 60.0), Lettering::left(15.0, MUTED))?;
        }
        let [bottom, top] = self.decades();
        let frame = self.frame([bottom, top]);
        self.draw_unknown(canvas, &frame)?;
        let [x_title, y_title, _] = &self.titles;
        let x_ticks = degrees(&ticks_between(self.x, 10.0));
        frame.draw_labelled(canvas, &x_ticks, &log_ticks(bottom, top), [x_title, y_title])?;
        // Few marks stand on their curves, many would hide them.
        if self.marks.len() > MANY {
            self.draw_marks(canvas, &frame)?;
            self.draw_curves(canvas, &frame)?;
        } else {
            self.draw_curves(canvas, &frame)?;
            self.draw_marks(canvas, &frame)?;
        }
        self.draw_labels(canvas, &frame)
    }
}

impl Chart {
    /// Shades what lies beyond the values.
    fn draw_unknown<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>, frame: &Axes) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let Some([first, last]) = self.known else { return Ok(()) };
        let [start, end] = self.x;
        for [from, to] in [[start, first], [last, end]] {
            if to > from {
                let [left, right] = [from, to].map(|x| frame.place((x, 0.0)).0);
                let (top, bottom) = (frame.origin.1, frame.origin.1 + frame.size.1);
                let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
                canvas.fill(&corners, UNKNOWN)?;
            }
        }
        Ok(())
    }

    fn draw_curves<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>, frame: &Axes) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        for (i, curve) in self.curves.iter().enumerate() {
            let places = visible(&curve.points, *frame.y.start());
            let points: Vec<_> = places.map(|place| frame.place(place)).collect();
            canvas.line(&points, self.color(i), 2.5)?;
        }
        Ok(())
    }

    fn draw_marks<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>, frame: &Axes) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let [start, end] = self.x;
        let radius = if self.marks.len() > MANY { SMALL_MARKER } else { MARKER };
        for mark in self.marks.iter().filter(|mark| (start..=end).contains(&mark.x)) {
            let color = mark.curve.map_or(MUTED, |i| self.color(i));
            let at = frame.place((mark.x, mark.y.log10()));
            if let Some(sigma) = mark.uncertainty {
                let floor = 10.0_f64.powf(*frame.y.start());
                let ends =
                    [mark.y - sigma, mark.y + sigma].map(|y| frame.place((mark.x, y.max(floor).log10())));
                canvas.line(&ends, color, 1.5)?;
                for (x, y) in ends {
                    canvas.line(&[(x - CAP, y), (x + CAP, y)], color, 1.5)?;
                }
            }
            draw_mark(canvas, at, mark.limit, radius + 1.5, WHITE)?;
            draw_mark(canvas, at, mark.limit, radius, color)?;
        }
        Ok(())
    }

    /// What tells the curves apart beside each curve's end, or above where it leaves through the lower edge.
    fn draw_labels<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>, frame: &Axes) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let bottom = *frame.y.start();
        let ends = self.curves.iter().enumerate();
        let ends =
            ends.filter_map(|(i, curve)| Some((i, frame.place(visible(&curve.points, bottom).last()?))));
        let right = frame.origin.0 + frame.size.0;
        let (mut beside, mut below): (Vec<_>, Vec<_>) = ends.partition(|(_, end)| end.0 > right - 0.5);
        let label = |i: usize| self.curves[i].label.as_str();

        beside.sort_by(|(_, a), (_, b)| a.1.round().total_cmp(&b.1.round()));
        let heights: Vec<f64> = beside.iter().map(|(_, end)| end.1).collect();
        for (&(i, end), y) in beside.iter().zip(spread(&heights, LABEL_STEP, frame.origin.1)) {
            canvas.line(&[end, (right + 28.0, y)], GRID, 1.0)?;
            canvas.text(label(i), (right + 34.0, y), Lettering::left(15.0, self.color(i)))?;
        }

        below.sort_by(|(_, a), (_, b)| a.0.total_cmp(&b.0));
        let places: Vec<f64> = below.iter().map(|(_, end)| end.0 + LABEL_GAP).collect();
        for (&(i, end), x) in below.iter().zip(spread(&places, LABEL_WIDTH, frame.origin.0)) {
            canvas.text(label(i), (x, end.1 - LABEL_STEP), Lettering::left(15.0, self.color(i)))?;
        }
        canvas.text(&self.titles[2], (right + 34.0, frame.origin.1 - 22.0), Lettering::left(15.0, INK))
    }
}

/// The part of a curve above the lower end of the axis, the first if there are several, as angles and
/// logarithms; it ends on that edge.
fn visible(curve: &[canvas::Point], bottom: f64) -> impl Iterator<Item = canvas::Point> {
    let logs = curve.iter().map(|&(x, value)| (x, value.max(f64::MIN_POSITIVE).log10()));
    let logs = logs.skip_while(|&(_, log)| log < bottom);
    let mut above: Vec<canvas::Point> = logs.clone().take_while(|&(_, log)| log >= bottom).collect();
    if let (Some(&(x0, y0)), Some((x1, y1))) = (above.last(), logs.clone().nth(above.len())) {
        above.push((x0 + (x1 - x0) * (y0 - bottom) / (y0 - y1), bottom));
    }
    above.into_iter()
}

/// 1, 2 and 5 times the powers of ten, with their values as labels; where there are many decades the powers
/// alone.
pub(super) fn log_ticks(bottom: f64, top: f64) -> Vec<(f64, String)> {
    let decades = bottom.floor() as i32..=top.ceil() as i32;
    let steps: &[f64] = if top - bottom > DECADES + 1.0 { &[1.0] } else { &[1.0, 2.0, 5.0] };
    let all = decades.flat_map(|decade| steps.iter().map(move |m| m * 10.0_f64.powi(decade)));
    all.map(|value| (value.log10(), value))
        .filter(|(log, _)| (bottom - 1e-9..=top + 1e-9).contains(log))
        .map(|(log, value)| (log, signed(value)))
        .collect()
}

/// A triangle that stands on a minimum, hangs from a maximum, or a disk.
fn draw_mark<DB: DrawingBackend>(
    canvas: &Canvas<'_, DB>,
    at: canvas::Point,
    limit: Limit,
    radius: f64,
    color: RGBColor,
) -> anyhow::Result<()>
where
    DB::ErrorType: 'static,
{
    let corner = |turn: f64| {
        let (sin, cos) = turn.sin_cos();
        (at.0 + radius * sin, at.1 - radius * cos)
    };
    let triangle = |turn: f64| [0.0, 1.0, 2.0].map(|i| corner(turn + TAU * i / 3.0));
    match limit {
        Limit::Minimum => canvas.fill(&triangle(0.0), color),
        Limit::Maximum => canvas.fill(&triangle(TAU / 2.0), color),
        Limit::Typical => canvas.disk(at, radius, color),
    }
}
