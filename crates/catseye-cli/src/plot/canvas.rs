//! Lines and text on any of the drawing library's surfaces, in units that don't depend on its resolution.

use plotters::coord::Shift;
use plotters::element::{Circle, PathElement, Polygon};
use plotters::prelude::{DrawingArea, DrawingBackend, RGBColor};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color as _, FontDesc, IntoFont as _, TextStyle};

/// Text and axes.
pub(crate) const INK: RGBColor = RGBColor(0x22, 0x26, 0x2b);
/// Text of second rank.
pub(crate) const MUTED: RGBColor = RGBColor(0x5c, 0x63, 0x6b);
/// Grid lines.
pub(crate) const GRID: RGBColor = RGBColor(0xdd, 0xe0, 0xe3);

/// How far the middle of a capital letter lies below that of its line, in units of the font's size.
const CAPITALS: f64 = 0.08;

/// A place in a drawing: to the right and down from the upper left corner.
pub(crate) type Point = (f64, f64);

/// A surface and its scale.
pub(crate) struct Canvas<'a, DB: DrawingBackend> {
    area: &'a DrawingArea<DB, Shift>,
    scale: f64,
}

/// How a text looks, and whether the middle of its left edge, of its right edge or of all of it is placed.
#[derive(Clone, Copy)]
pub(crate) struct Lettering {
    size: f64,
    color: RGBColor,
    horizontal: HPos,
}

impl Lettering {
    /// Left-aligned text.
    pub(crate) fn left(size: f64, color: RGBColor) -> Self {
        Self { size, color, horizontal: HPos::Left }
    }

    /// Right-aligned text.
    pub(crate) fn right(size: f64, color: RGBColor) -> Self {
        Self { horizontal: HPos::Right, ..Self::left(size, color) }
    }

    /// Centred text.
    pub(crate) fn center(size: f64, color: RGBColor) -> Self {
        Self { horizontal: HPos::Center, ..Self::left(size, color) }
    }
}

impl<'a, DB: DrawingBackend> Canvas<'a, DB>
where
    DB::ErrorType: 'static,
{
    /// A canvas whose unit is `scale` pixels of the area.
    pub(crate) fn new(area: &'a DrawingArea<DB, Shift>, scale: f64) -> Self {
        Self { area, scale }
    }

    /// Draws a line through the points.
    pub(crate) fn line(&self, points: &[Point], color: RGBColor, width: f64) -> anyhow::Result<()> {
        let width = (width * self.scale).round().max(1.0) as u32;
        Ok(self.area.draw(&PathElement::new(self.pixels(points), color.stroke_width(width)))?)
    }

    /// Fills a polygon.
    pub(crate) fn fill(&self, points: &[Point], color: RGBColor) -> anyhow::Result<()> {
        Ok(self.area.draw(&Polygon::new(self.pixels(points), color.filled()))?)
    }

    /// Fills a circle.
    pub(crate) fn disk(&self, centre: Point, radius: f64, color: RGBColor) -> anyhow::Result<()> {
        let radius = (radius * self.scale).round() as u32;
        Ok(self.area.draw(&Circle::new(self.pixel(centre), radius, color.filled()))?)
    }

    /// Writes a text.
    pub(crate) fn text(&self, text: &str, at: Point, style: Lettering) -> anyhow::Result<()> {
        let font: FontDesc<'static> = ("sans-serif", style.size * self.scale).into_font();
        // The centre of the font's box is above that of its capitals and digits.
        let at = (at.0, at.1 + CAPITALS * style.size);
        let position = Pos::new(style.horizontal, VPos::Center);
        let text_style = TextStyle::from(font).color(&style.color).pos(position);
        Ok(self.area.draw_text(text, &text_style, self.pixel(at))?)
    }

    fn pixel(&self, (x, y): Point) -> (i32, i32) {
        ((x * self.scale).round() as i32, (y * self.scale).round() as i32)
    }

    /// The points in pixels; neighbours in the same pixel are one, as a wide line has no direction between
    /// them.
    fn pixels(&self, points: &[Point]) -> Vec<(i32, i32)> {
        let mut pixels: Vec<_> = points.iter().map(|&point| self.pixel(point)).collect();
        pixels.dedup();
        pixels
    }
}
