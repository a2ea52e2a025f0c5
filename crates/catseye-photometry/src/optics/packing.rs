//! What neighbours leave of a bead at a slant.

use std::f64::consts::{FRAC_PI_2, PI};

/// Azimuths of the lattice in a twelfth of the circle, which its symmetry makes enough.
const AZIMUTHS: u32 = 6;
/// Lines along the slant across the bead.
const LINES: u32 = 64;
/// Rows of neighbours to either side that may stand before a bead.
const ROWS: i32 = 6;

/// The share of a bead's cross section that light enters and leaves by, at an entrance angle in radians,
/// below pi/2.
///
/// A ray enters at b and leaves at -b (docs/optics.md, section 4): both must be on the half that is exposed,
/// and no neighbour of a hexagonal lattice of the given packing, averaged over its azimuths, may stand before
/// either. A lone bead has cos(angle).
pub(crate) fn visible_share(angle: f64, packing: f64) -> f64 {
    let distance = (2.0 * PI / (3.0_f64.sqrt() * packing)).sqrt();
    let (slant, upright) = angle.sin_cos();
    let mut area = 0.0;
    for turn in (0..AZIMUTHS).map(|i| (f64::from(i) + 0.5) / f64::from(AZIMUTHS) * PI / 6.0) {
        let before = neighbours(distance, turn).filter(|[along, _]| along * slant > 1e-9);
        let shadows: Vec<[f64; 2]> = before.map(|[along, across]| [along * upright, across]).collect();
        for i in 0..LINES {
            let (across, cos) = (PI * (f64::from(i) + 0.5) / f64::from(LINES) - FRAC_PI_2).sin_cos();
            area += free_length(&shadows, across, upright * cos) * cos;
        }
    }
    area / f64::from(AZIMUTHS * LINES)
}

/// Places of the neighbours in the plane of the sheet, in bead radii: towards the light, and across.
fn neighbours(distance: f64, turn: f64) -> impl Iterator<Item = [f64; 2]> {
    let (sin, cos) = turn.sin_cos();
    (-ROWS..=ROWS)
        .flat_map(move |i| (-ROWS..=ROWS).map(move |j| (i, j)))
        .filter(|place| *place != (0, 0))
        .map(move |(i, j)| {
            let (x, y) =
                (distance * (f64::from(i) + 0.5 * f64::from(j)), distance * 0.75_f64.sqrt() * f64::from(j));
            [x * cos - y * sin, x * sin + y * cos]
        })
}

/// What the shadows, disks of radius 1 and their images through the bead's centre, leave of the line from
/// -half to half at `across`.
fn free_length(shadows: &[[f64; 2]], across: f64, half: f64) -> f64 {
    let mut hidden: Vec<[f64; 2]> = Vec::new();
    for &[along, side] in shadows {
        for (centre, off) in [(along, across - side), (-along, across + side)] {
            let chord = (1.0 - off * off).max(0.0).sqrt();
            if chord > 0.0 {
                hidden.push([centre - chord, centre + chord]);
            }
        }
    }
    hidden.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut free, mut reached) = (0.0, -half);
    for [from, to] in hidden {
        free += (from.min(half) - reached).max(0.0);
        reached = reached.max(to);
    }
    free + (half - reached).max(0.0)
}
