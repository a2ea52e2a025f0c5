//! A rectangular diagram's frame: grid, ticks and titles.

use std::ops::RangeInclusive;

use plotters::prelude::DrawingBackend;

use super::canvas::{Canvas, GRID, INK, Lettering, MUTED, Point};

/// The rectangle that a diagram's data live in.
#[derive(Clone, Debug)]
pub(crate) struct Axes {
    /// Left and top edge in the drawing.
    pub(crate) origin: Point,
    /// Width and height in the drawing.
    pub(crate) size: Point,
    /// Values from left to right.
    pub(crate) x: RangeInclusive<f64>,
    /// Values from bottom to top.
    pub(crate) y: RangeInclusive<f64>,
}

impl Axes {
    /// Where a pair of values lies in the drawing.
    pub(crate) fn place(&self, (x, y): Point) -> Point {
        let share =
            |value: f64, range: &RangeInclusive<f64>| (value - range.start()) / (range.end() - range.start());
        let ((left, top), (width, height)) = (self.origin, self.size);
        (left + width * share(x, &self.x), top + height * (1.0 - share(y, &self.y)))
    }

    /// Draws grid and labels; the y axis' title stands above it, where it can be read without turning one's
    /// head.
    pub(crate) fn draw<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        [x_ticks, y_ticks]: [&[f64]; 2],
        titles: [&str; 2],
    ) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let y_ticks: Vec<(f64, String)> = y_ticks.iter().map(|&y| (y, signed(y))).collect();
        self.draw_labelled(canvas, &degrees(x_ticks), &y_ticks, titles)
    }

    /// As [`Axes::draw`], where labels are not the values, as of logarithms, or not in degrees.
    pub(crate) fn draw_labelled<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        x_ticks: &[(f64, String)],
        y_ticks: &[(f64, String)],
        [x_title, y_title]: [&str; 2],
    ) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let ((left, top), (width, height)) = (self.origin, self.size);
        let bottom = top + height;
        for (x, label) in x_ticks {
            let (at, _) = self.place((*x, *self.y.start()));
            canvas.line(&[(at, top), (at, bottom)], GRID, 1.0)?;
            canvas.text(label, (at, bottom + 16.0), Lettering::center(14.0, MUTED))?;
        }
        for (y, label) in y_ticks {
            let (_, at) = self.place((*self.x.start(), *y));
            canvas.line(&[(left, at), (left + width, at)], GRID, 1.0)?;
            canvas.text(label, (left - 8.0, at), Lettering::right(14.0, MUTED))?;
        }
        canvas.line(&[(left, top), (left, bottom), (left + width, bottom)], INK, 1.5)?;
        canvas.text(x_title, (left + width / 2.0, bottom + 42.0), Lettering::center(15.0, INK))?;
        canvas.text(y_title, (left - 30.0, top - 22.0), Lettering::left(15.0, INK))
    }
}

/// Ticks with their angles in degrees as labels.
pub(crate) fn degrees(ticks: &[f64]) -> Vec<(f64, String)> {
    ticks.iter().map(|&x| (x, format!("{}°", signed(x)))).collect()
}

/// A number with a proper minus sign.
pub(crate) fn signed(value: f64) -> String {
    // The sum of steps such as 0.1 is not a multiple of them.
    let rounded = (value * 1e6).round() / 1e6;
    rounded.to_string().replace('-', "\u{2212}")
}

/// A number that may be infinite.
pub(crate) fn unbounded(value: f64) -> String {
    if value.is_infinite() { "\u{221e}".to_owned() } else { value.to_string() }
}

/// A roughness along the tangent, and across it where that is another one.
pub(crate) fn roughness_label([u, v]: [f64; 2]) -> String {
    if u == v { unbounded(u) } else { format!("{}, {}", unbounded(u), unbounded(v)) }
}

/// Multiples of 1, 2 or 5 times a power of ten up to `greatest`, about `count` of them, without 0.
pub(crate) fn ticks(greatest: f64, count: f64) -> Vec<f64> {
    let step = step(greatest, count);
    (1..).map(|i| f64::from(i) * step).take_while(|&value| value <= greatest * 1.000_001).collect()
}

/// The same between two numbers, with 0 where it lies between them.
pub(crate) fn ticks_between([start, end]: [f64; 2], count: f64) -> Vec<f64> {
    let step = step(end - start, count);
    let [first, last] = [(start / step - 1e-6).ceil() as i32, (end / step + 1e-6).floor() as i32];
    (first..=last).map(|i| f64::from(i) * step).collect()
}

fn step(range: f64, count: f64) -> f64 {
    let power = 10.0_f64.powf((range / count).log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * power).find(|step| range / step <= count + 0.5);
    step.unwrap_or(10.0 * power)
}
