//! Pictures made of lines and text: SVG, or PNG with every edge smoothed.

use std::path::Path;
use std::sync::Once;

use anyhow::{anyhow, bail};
use catseye_render::encode_png_rgb;
use plotters::prelude::{BitMapBackend, DrawingBackend, IntoDrawingArea as _, SVGBackend};
use plotters::style::{FontStyle, WHITE, register_font};
use serde_json::json;

use super::canvas::Canvas;
use crate::failure::Usage;
use crate::output::Output;
use crate::report;

/// Bitmaps are drawn at this scale and then averaged: the backend's own wide lines have hard edges.
const SUPERSAMPLE: u32 = 4;
/// Vector graphics are drawn at this scale and shown smaller: the backend's coordinates are whole numbers.
const SUBPIXELS: u32 = 16;

/// The shipped font, `DejaVu` Sans 2.37: `assets/DejaVuSans-LICENSE.txt`.
static FONT: &[u8] = include_bytes!("../../assets/DejaVuSans.ttf");

/// Something that can be drawn on any surface.
pub(crate) trait Figure {
    /// Width and height.
    fn size(&self) -> (u32, u32);

    /// Draws everything.
    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static;
}

/// The file formats that a figure can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Svg,
    Png,
}

impl Format {
    /// The format of a file name, by its ending.
    fn of(path: &Path) -> anyhow::Result<Self> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match ending.as_str() {
            "svg" => Ok(Self::Svg),
            "png" => Ok(Self::Png),
            _ => bail!(Usage(format!("{}: the name must end in .svg or .png", path.display()))),
        }
    }
}

/// Writes the picture and says so.
pub(crate) fn finish(figure: &impl Figure, path: &Path, json: bool) -> anyhow::Result<()> {
    save(figure, path)?;
    let (width, height) = figure.size();
    let facts = json!({ "output": path.display().to_string(), "width": width, "height": height });
    report::print(json, &facts, &format!("wrote {} ({width} x {height})", path.display()))
}

/// Draws the figure into a file.
fn save(figure: &impl Figure, path: &Path) -> anyhow::Result<()> {
    let format = Format::of(path)?;
    let output = Output::new(path)?;
    match format {
        Format::Svg => output.write(svg(figure)?.as_bytes()),
        Format::Png => output.write(&png(figure.size(), &pixels(figure)?)?),
    }
}

/// The figure as an SVG document.
pub(crate) fn svg(figure: &impl Figure) -> anyhow::Result<String> {
    load_font()?;
    let (width, height) = figure.size();
    let (wide, high) = (width * SUBPIXELS, height * SUBPIXELS);
    let mut text = String::new();
    let area = SVGBackend::with_string(&mut text, (wide, high)).into_drawing_area();
    area.fill(&WHITE)?;
    figure.draw(&Canvas::new(&area, f64::from(SUBPIXELS)))?;
    area.present()?;
    drop(area);
    let drawn = format!("<svg width=\"{wide}\" height=\"{high}\"");
    Ok(text.replacen(&drawn, &format!("<svg width=\"{width}\" height=\"{height}\""), 1))
}

/// The figure as rows of RGB bytes.
pub(crate) fn pixels(figure: &impl Figure) -> anyhow::Result<Vec<u8>> {
    load_font()?;
    let (width, height) = figure.size();
    let (wide, high) = (width * SUPERSAMPLE, height * SUPERSAMPLE);
    let mut buffer = vec![0; wide as usize * high as usize * 3];
    let area = BitMapBackend::with_buffer(&mut buffer, (wide, high)).into_drawing_area();
    area.fill(&WHITE)?;
    figure.draw(&Canvas::new(&area, f64::from(SUPERSAMPLE)))?;
    area.present()?;
    drop(area);
    Ok(average(&buffer, width as usize, height as usize))
}

/// The mean of every block of `SUPERSAMPLE` x `SUPERSAMPLE` pixels.
fn average(buffer: &[u8], width: usize, height: usize) -> Vec<u8> {
    let n = SUPERSAMPLE as usize;
    let mut out = Vec::with_capacity(width * height * 3);
    for y in 0..height {
        for x in 0..width {
            for channel in 0..3 {
                let at = |i: usize, j: usize| ((y * n + j) * width * n + x * n + i) * 3 + channel;
                let block = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
                let sum: u32 = block.map(|(i, j)| u32::from(buffer[at(i, j)])).sum();
                out.push((sum / (SUPERSAMPLE * SUPERSAMPLE)) as u8);
            }
        }
    }
    out
}

/// Rows of RGB bytes as a PNG file.
pub(crate) fn png((width, height): (u32, u32), rgb: &[u8]) -> anyhow::Result<Vec<u8>> {
    Ok(encode_png_rgb([width as usize, height as usize], rgb)?)
}

/// Makes the shipped font known to the drawing library.
fn load_font() -> anyhow::Result<()> {
    static LOADED: Once = Once::new();
    let mut result = Ok(());
    LOADED.call_once(|| {
        result = register_font("sans-serif", FontStyle::Normal, FONT)
            .map_err(|_| anyhow!("the built-in font can't be read"));
    });
    result
}
