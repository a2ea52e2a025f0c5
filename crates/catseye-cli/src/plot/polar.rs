//! A half disk: the direction is the angle, the value the distance from the centre.

use plotters::prelude::DrawingBackend;

use super::axes::{signed, ticks};
use super::canvas::{Canvas, GRID, INK, Lettering, MUTED, Point};
use super::curves::Panel;

/// Distance of the angles' labels from the edge.
const LABEL: f64 = 16.0;
/// Angles in degrees nearer to the light than this have no room for a label.
const ARROW_WIDTH: f64 = 8.0;
/// Degrees that a label which would stand at the arrow is moved to its side.
const ASIDE: f64 = 11.0;

/// The radius of the half disk in a panel of a width.
fn radius(width: f64) -> f64 {
    0.5 * width - 22.0
}

/// Height of a panel of a width below its upper edge.
pub(crate) fn height(width: f64) -> f64 {
    radius(width) + 5.8 * LABEL
}

/// Draws a panel at its upper left corner; the edge stands for a bit more than `greatest`.
pub(crate) fn draw<DB: DrawingBackend>(
    canvas: &Canvas<'_, DB>,
    panel: &Panel,
    [left, top]: [f64; 2],
    width: f64,
    greatest: f64,
) -> anyhow::Result<()>
where
    DB::ErrorType: 'static,
{
    let radius = radius(width);
    let center = (left + 0.5 * width, top + 2.2 * LABEL + radius);
    let edge = greatest * 1.05;
    draw_grid(canvas, center, radius, edge, panel.theta_deg)?;
    canvas.text(&panel.title, (center.0, center.1 + 2.6 * LABEL), Lettering::center(15.0, INK))?;
    for curve in &panel.curves {
        let (color, width) = curve.style();
        let points: Vec<_> =
            curve.values.iter().map(|&(angle, value)| place(center, angle, radius * value / edge)).collect();
        canvas.line(&points, color, width)?;
    }
    draw_light(canvas, center, radius, panel.theta_deg)
}

/// The point at an angle in degrees from the vertical and a distance.
fn place((x, y): Point, angle_deg: f64, distance: f64) -> Point {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    (x + distance * sin, y - distance * cos)
}

fn draw_grid<DB: DrawingBackend>(
    canvas: &Canvas<'_, DB>,
    center: Point,
    greatest_radius: f64,
    edge: f64,
    light_deg: f64,
) -> anyhow::Result<()>
where
    DB::ErrorType: 'static,
{
    let arc =
        |radius: f64| (-90..=90).map(|angle| place(center, f64::from(angle), radius)).collect::<Vec<_>>();
    let values = ticks(edge, 4.0);
    for &value in &values {
        let radius = greatest_radius * value / edge;
        canvas.line(&arc(radius), GRID, 1.0)?;
        canvas.text(&signed(value), (center.0 - radius, center.1 + LABEL), Lettering::center(13.0, MUTED))?;
        canvas.text(&signed(value), (center.0 + radius, center.1 + LABEL), Lettering::center(13.0, MUTED))?;
    }
    for angle in [-60.0, -30.0, 0.0, 30.0, 60.0] {
        canvas.line(&[center, place(center, angle, greatest_radius)], GRID, 1.0)?;
        let aside = if f64::abs(angle - light_deg) < ARROW_WIDTH { ASIDE } else { 0.0 };
        let at = place(center, angle + aside, greatest_radius + LABEL);
        canvas.text(&format!("{}°", signed(angle)), at, Lettering::center(13.0, MUTED))?;
    }
    canvas.line(&arc(greatest_radius), GRID, 1.5)?;
    canvas.line(&[place(center, -90.0, greatest_radius), place(center, 90.0, greatest_radius)], INK, 1.5)
}

/// An arrow along the light's way, from outside to the centre.
fn draw_light<DB: DrawingBackend>(
    canvas: &Canvas<'_, DB>,
    center: Point,
    radius: f64,
    theta_deg: f64,
) -> anyhow::Result<()>
where
    DB::ErrorType: 'static,
{
    let far = place(center, theta_deg, radius + 34.0);
    let near = place(center, theta_deg, radius + 4.0);
    canvas.line(&[far, place(center, theta_deg, radius + 12.0)], INK, 2.0)?;
    let side = |offset: f64| {
        let (sin, cos) = theta_deg.to_radians().sin_cos();
        let (x, y) = place(center, theta_deg, radius + 14.0);
        (x + offset * cos, y + offset * sin)
    };
    canvas.fill(&[near, side(5.0), side(-5.0)], INK)
}
