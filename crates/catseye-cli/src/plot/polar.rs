//! A half disk: the direction is the angle, the value the distance from the centre.

use plotters::prelude::DrawingBackend;

use super::axes::{signed, ticks};
use super::canvas::{Canvas, GRID, INK, Lettering, MUTED, Point};

/// Distance of the angles' labels from the edge.
const LABEL: f64 = 16.0;
/// Angles in degrees nearer to the light than this have no room for a label.
const ARROW_WIDTH: f64 = 8.0;
/// Degrees that a label which would stand at the arrow is moved to its side.
const ASIDE: f64 = 11.0;

/// The half disk that a diagram's data live in.
#[derive(Clone, Debug)]
pub(crate) struct Polar {
    center: Point,
    radius: f64,
    /// The value at the edge.
    edge: f64,
}

/// The radius of the half disk in a panel of a width.
fn radius(width: f64) -> f64 {
    0.5 * width - 22.0
}

/// Height of a panel of a width below its upper edge.
pub(crate) fn height(width: f64) -> f64 {
    radius(width) + 5.8 * LABEL
}

impl Polar {
    /// The frame of a panel at its upper left corner; the edge stands for a bit more than `greatest`.
    pub(crate) fn new([left, top]: [f64; 2], width: f64, greatest: f64) -> Self {
        let radius = radius(width);
        Self { center: (left + 0.5 * width, top + 2.2 * LABEL + radius), radius, edge: greatest * 1.05 }
    }

    /// Where an angle from the vertical, in degrees, and a value lie in the drawing.
    pub(crate) fn place(&self, (angle_deg, value): Point) -> Point {
        self.at(angle_deg, self.radius * value / self.edge)
    }

    /// The point at an angle in degrees from the vertical and a distance.
    fn at(&self, angle_deg: f64, distance: f64) -> Point {
        let (sin, cos) = angle_deg.to_radians().sin_cos();
        (self.center.0 + distance * sin, self.center.1 - distance * cos)
    }

    /// Draws grid, labels and title, which leave room for the light's arrow.
    pub(crate) fn draw<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        light_deg: f64,
        title: &str,
    ) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let Self { center: (x, y), radius, edge } = *self;
        let arc = |radius| (-90..=90).map(|angle| self.at(f64::from(angle), radius)).collect::<Vec<_>>();
        for &value in &ticks(edge, 4.0) {
            let distance = radius * value / edge;
            canvas.line(&arc(distance), GRID, 1.0)?;
            for side in [-distance, distance] {
                canvas.text(&signed(value), (x + side, y + LABEL), Lettering::center(13.0, MUTED))?;
            }
        }
        for angle in [-60.0, -30.0, 0.0, 30.0, 60.0] {
            canvas.line(&[(x, y), self.at(angle, radius)], GRID, 1.0)?;
            let aside = if f64::abs(angle - light_deg) < ARROW_WIDTH { ASIDE } else { 0.0 };
            let at = self.at(angle + aside, radius + LABEL);
            canvas.text(&format!("{}°", signed(angle)), at, Lettering::center(13.0, MUTED))?;
        }
        canvas.line(&arc(radius), GRID, 1.5)?;
        canvas.line(&[self.at(-90.0, radius), self.at(90.0, radius)], INK, 1.5)?;
        canvas.text(title, (x, y + 2.6 * LABEL), Lettering::center(15.0, INK))
    }

    /// Draws an arrow along the light's way, from outside to the edge.
    pub(crate) fn draw_light<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        light_deg: f64,
    ) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let at = |distance: f64| self.at(light_deg, self.radius + distance);
        canvas.line(&[at(34.0), at(12.0)], INK, 2.0)?;
        let side = |offset: f64| {
            let (sin, cos) = light_deg.to_radians().sin_cos();
            (at(14.0).0 + offset * cos, at(14.0).1 + offset * sin)
        };
        canvas.fill(&[at(4.0), side(5.0), side(-5.0)], INK)
    }
}
