//! Labelled pictures side by side.

use plotters::prelude::DrawingBackend;

use super::canvas::{Canvas, GRID, INK, Lettering, MUTED, Point};
use super::figure::{self, Figure, PNG_SCALE};

const MARGIN: f64 = 20.0;
/// Distance between two tiles.
const GAP: f64 = 10.0;
/// Height of a line of text below or above a tile.
const LINE: f64 = 19.0;
const TITLE: f64 = 34.0;

/// A picture with its words.
#[derive(Debug)]
pub(crate) struct Tile {
    /// Rows of RGB bytes.
    pub(crate) rgb: Vec<u8>,
    /// Below the picture.
    pub(crate) lines: Vec<String>,
}

/// Pictures of one size, row by row.
#[derive(Debug)]
pub(crate) struct Sheet {
    pub(crate) title: String,
    /// Lines below the title.
    pub(crate) notes: Vec<String>,
    /// Width and height of a picture in pixels, multiples of [`PNG_SCALE`].
    pub(crate) pixels: [usize; 2],
    /// Pictures in a row.
    pub(crate) columns: usize,
    pub(crate) tiles: Vec<Tile>,
}

impl Sheet {
    /// The sheet as a PNG file.
    pub(crate) fn png(&self) -> anyhow::Result<Vec<u8>> {
        let mut rgb = figure::pixels(self)?;
        let scale = PNG_SCALE as usize;
        let width = self.size().0 as usize * scale;
        for (i, tile) in self.tiles.iter().enumerate() {
            let (left, top) = self.corner(i);
            for (y, row) in tile.rgb.chunks_exact(3 * self.pixels[0]).enumerate() {
                let start = 3 * ((top as usize * scale + y) * width + left as usize * scale);
                rgb[start..start + row.len()].copy_from_slice(row);
            }
        }
        figure::png(self.size(), &rgb)
    }

    /// Width and height of a tile in the drawing.
    fn tile(&self) -> Point {
        let [width, height] = self.pixels.map(|pixels| (pixels / PNG_SCALE as usize) as f64);
        (width, height)
    }

    /// The upper left corner of a tile.
    fn corner(&self, tile: usize) -> Point {
        let (column, row) = ((tile % self.columns) as f64, (tile / self.columns) as f64);
        let (width, height) = self.tile();
        let head = if self.title.is_empty() { 0.0 } else { TITLE };
        let top = MARGIN + head + LINE * self.notes.len() as f64;
        (MARGIN + (width + GAP) * column, (top + (height + self.words() + GAP) * row).round())
    }

    /// Height of the words below a tile.
    fn words(&self) -> f64 {
        let lines = self.tiles.iter().map(|tile| tile.lines.len()).max().unwrap_or(0);
        LINE * lines as f64 + 4.0
    }
}

impl Figure for Sheet {
    fn title(&self) -> String {
        self.title.clone()
    }

    fn size(&self) -> (u32, u32) {
        let (right, _) = self.corner(self.columns.min(self.tiles.len()) - 1);
        let (_, bottom) = self.corner(self.tiles.len() - 1);
        let (width, height) = self.tile();
        ((right + width + MARGIN) as u32, (bottom + height + self.words() + MARGIN / 2.0) as u32)
    }

    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let mut y = MARGIN + 6.0;
        if !self.title.is_empty() {
            canvas.text(&self.title, (MARGIN, y), Lettering::left(20.0, INK))?;
            y += TITLE - 6.0;
        }
        for note in &self.notes {
            canvas.text(note, (MARGIN, y), Lettering::left(14.0, MUTED))?;
            y += LINE;
        }
        for (i, tile) in self.tiles.iter().enumerate() {
            let ((left, top), (width, height)) = (self.corner(i), self.tile());
            let (right, bottom) = (left + width, top + height);
            let frame =
                [(left, top), (right, top), (right, bottom), (left, bottom), (left, top), (right, top)];
            canvas.line(&frame, GRID, 2.0)?;
            for (row, line) in tile.lines.iter().enumerate() {
                let at = (left + width / 2.0, bottom + LINE * (row as f64 + 0.5) + 2.0);
                let color = if row == 0 { INK } else { MUTED };
                canvas.text(line, at, Lettering::center(13.0, color))?;
            }
        }
        Ok(())
    }
}
