//! Pictures made of lines and text: SVG, or PNG with every edge smoothed.

use std::path::{Path, PathBuf};
use std::sync::Once;

use anyhow::anyhow;
use catseye_render::encode_png_rgb;
use plotters::prelude::{BitMapBackend, DrawingBackend, IntoDrawingArea as _, SVGBackend};
use plotters::style::{FontStyle, WHITE, register_font};
use serde_json::json;

use super::canvas::Canvas;
use crate::output::{self, Output};

/// Pixels of a bitmap for each unit of a drawing: sharp on screens of twice the usual density, too.
pub(crate) const PNG_SCALE: u32 = 2;
/// Bitmaps are drawn at this scale of a pixel and then averaged: the backend's own wide lines have hard
/// edges.
const SUPERSAMPLE: u32 = 3;
/// Vector graphics are drawn at this scale and shown smaller: the backend's coordinates are whole numbers.
const SUBPIXELS: u32 = 16;

/// The shipped font, `DejaVu` Sans 2.37: `assets/DejaVuSans-LICENSE.txt`.
static FONT: &[u8] = include_bytes!("../../assets/DejaVuSans.ttf");

/// Something that can be drawn on any surface.
pub(crate) trait Figure {
    /// What it shows, for those who can't see it.
    fn title(&self) -> String;

    /// Width and height.
    fn size(&self) -> (u32, u32);

    /// Draws everything.
    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static;
}

/// The file formats that a figure can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// Vector graphics
    Svg,
    /// Pixels
    Png,
}

/// Where a figure goes.
#[derive(Debug, clap::Args)]
pub(crate) struct FigureArgs {
    /// File to write, .svg or .png; `-` is standard output [default: what is plotted, with .svg]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Format of the file [default: by its name's ending; SVG on standard output]
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
}

impl FigureArgs {
    /// A file by its name, which is refused at once where it can't be written.
    pub(crate) fn at(path: &Path) -> anyhow::Result<Self> {
        output::format::<Format>(path, None)?;
        Output::new(path)?;
        Ok(Self { output: Some(path.to_owned()), format: None, json: false })
    }

    /// Writes the figure and says so; `name` is the file where none was asked for.
    pub(crate) fn write(&self, figure: &impl Figure, name: &str) -> anyhow::Result<()> {
        let path = self.output.as_deref().unwrap_or(Path::new(name));
        let format = output::format(path, self.format)?;
        let output = Output::new(path)?;
        let (width, height) = figure.size();
        let (bytes, scale) = match format {
            Format::Svg => (svg(figure)?.into_bytes(), 1),
            Format::Png => (png((width, height), &pixels(figure)?)?, PNG_SCALE),
        };
        output.write(&bytes)?;
        let (width, height) = (width * scale, height * scale);
        let facts = json!({ "output": output.name(), "width": width, "height": height });
        output.messages().note(self.json, &facts, &format!("wrote {} ({width} x {height})", output.name()))
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
    let text = text.replacen(&drawn, &format!("<svg role=\"img\" width=\"{width}\" height=\"{height}\""), 1);
    let title = figure.title().replace('&', "&amp;").replace('<', "&lt;");
    Ok(text.replacen('>', &format!(">\n<title>{title}</title>"), 1))
}

/// The figure as rows of RGB bytes, in pixels of a bitmap.
pub(crate) fn pixels(figure: &impl Figure) -> anyhow::Result<Vec<u8>> {
    load_font()?;
    let (width, height) = figure.size();
    let (width, height) = (width * PNG_SCALE, height * PNG_SCALE);
    let (wide, high) = (width * SUPERSAMPLE, height * SUPERSAMPLE);
    let mut buffer = vec![0; wide as usize * high as usize * 3];
    let area = BitMapBackend::with_buffer(&mut buffer, (wide, high)).into_drawing_area();
    area.fill(&WHITE)?;
    figure.draw(&Canvas::new(&area, f64::from(PNG_SCALE * SUPERSAMPLE)))?;
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

/// Rows of RGB bytes as a PNG file, for a drawing of the given size.
pub(crate) fn png((width, height): (u32, u32), rgb: &[u8]) -> anyhow::Result<Vec<u8>> {
    Ok(encode_png_rgb([width, height].map(|units| (units * PNG_SCALE) as usize), rgb)?)
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
