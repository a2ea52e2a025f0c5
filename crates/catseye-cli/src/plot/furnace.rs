//! The furnace figure: labelled spheres on white.

use catseye::Model;
use plotters::prelude::DrawingBackend;

use super::axes::roughness_label;
use super::canvas::{Canvas, GRID, INK, Lettering, MUTED, Point};
use super::figure::{self, Figure};

const MARGIN: f64 = 24.0;
const TOP: f64 = 132.0;
const LABELS: f64 = 190.0;
/// Distance between two tiles.
const GAP: f64 = 8.0;
/// Space below a tile for its numbers.
const NUMBERS: f64 = 58.0;
const CAPTION: f64 = 44.0;

/// The two rows of the figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scattering {
    Single,
    Multiple,
}

impl Scattering {
    /// From top to bottom.
    pub(crate) const ALL: [Self; 2] = [Self::Single, Self::Multiple];

    /// The word for it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::Multiple => "multiple",
        }
    }
}

/// One sphere.
#[derive(Debug)]
pub(crate) struct Tile {
    pub(crate) roughness: [f64; 2],
    pub(crate) measured: f64,
    pub(crate) expected: f64,
    /// Rows of RGB bytes.
    pub(crate) rgb: Vec<u8>,
}

/// All spheres, row by row.
#[derive(Debug)]
pub(crate) struct FurnaceFigure {
    pub(crate) model: Model,
    /// Side of a tile in pixels.
    pub(crate) side: usize,
    /// Tiles in a row.
    pub(crate) columns: usize,
    pub(crate) tiles: Vec<Tile>,
}

impl FurnaceFigure {
    /// The figure as a PNG file.
    pub(crate) fn png(&self) -> anyhow::Result<Vec<u8>> {
        let mut rgb = figure::pixels(self)?;
        let width = self.size().0 as usize;
        for (i, tile) in self.tiles.iter().enumerate() {
            let (left, top) = self.corner(i);
            for (y, row) in tile.rgb.chunks_exact(3 * self.side).enumerate() {
                let start = 3 * ((top as usize + y) * width + left as usize);
                rgb[start..start + row.len()].copy_from_slice(row);
            }
        }
        figure::png(self.size(), &rgb)
    }

    /// The upper left corner of a tile.
    fn corner(&self, tile: usize) -> Point {
        let (column, row) = (tile % self.columns, tile / self.columns);
        let side = self.side as f64;
        (MARGIN + LABELS + (side + GAP) * column as f64, TOP + (side + NUMBERS) * row as f64)
    }

    fn title(&self) -> String {
        format!("White furnace: {} lobe", self.model.name())
    }
}

impl Figure for FurnaceFigure {
    fn size(&self) -> (u32, u32) {
        let (right, _) = self.corner(self.columns - 1);
        let (_, bottom) = self.corner(self.tiles.len() - 1);
        let side = self.side as f64;
        ((right + side + MARGIN) as u32, (bottom + side + NUMBERS + CAPTION) as u32)
    }

    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let subtitle =
            "Spheres in a white environment of radiance 1. One that loses no energy can't be seen.";
        canvas.text(&self.title(), (MARGIN, 32.0), Lettering::left(24.0, INK))?;
        canvas.text(subtitle, (MARGIN, 62.0), Lettering::left(15.0, MUTED))?;
        canvas.text("roughness", (MARGIN, TOP - 20.0), Lettering::left(15.0, INK))?;
        for (i, tile) in self.tiles.iter().enumerate() {
            self.draw_tile(canvas, tile, self.corner(i), i < self.columns)?;
        }
        let rows = self.tiles.len().div_ceil(self.columns);
        for (row, scattering) in Scattering::ALL.into_iter().take(rows).enumerate() {
            self.draw_label(canvas, scattering, self.corner(row * self.columns).1)?;
        }
        let caption =
            "Numbers: mean albedo of the whole sphere, measured by sampling the lobe, and the exact value.";
        let bottom = f64::from(self.size().1) - 26.0;
        canvas.text(caption, (MARGIN, bottom), Lettering::left(13.0, MUTED))
    }
}

impl FurnaceFigure {
    fn draw_tile<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        tile: &Tile,
        (left, top): Point,
        is_first: bool,
    ) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let side = self.side as f64;
        let (right, bottom, middle) = (left + side, top + side, left + side / 2.0);
        if is_first {
            canvas.text(
                &roughness_label(tile.roughness),
                (middle, top - 20.0),
                Lettering::center(15.0, INK),
            )?;
        }
        let frame = [(left, top), (right, top), (right, bottom), (left, bottom)];
        let around =
            frame.map(|(x, y)| (x + (x - middle).signum() * 0.5, y + (y - top - 1.0).signum() * 0.5));
        canvas.line(&[around.as_slice(), &around[..1]].concat(), GRID, 1.0)?;
        let number = |value: f64| format!("{value:.4}");
        canvas.text(&number(tile.measured), (middle, bottom + 16.0), Lettering::center(14.0, INK))?;
        canvas.text(&number(tile.expected), (middle, bottom + 34.0), Lettering::center(13.0, MUTED))
    }

    fn draw_label<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        scattering: Scattering,
        top: f64,
    ) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let middle = top + self.side as f64 / 2.0;
        let (name, tint) = (scattering.name(), usize::from(scattering == Scattering::Multiple));
        canvas.text(&format!("{name} scattering"), (MARGIN, middle - 11.0), Lettering::left(16.0, INK))?;
        let setting = format!("multiscatter_tint {tint}");
        canvas.text(&setting, (MARGIN, middle + 12.0), Lettering::left(13.0, MUTED))?;
        let bottom = top + self.side as f64;
        canvas.text("measured", (MARGIN, bottom + 16.0), Lettering::left(14.0, INK))?;
        canvas.text("expected", (MARGIN, bottom + 34.0), Lettering::left(13.0, MUTED))
    }
}
