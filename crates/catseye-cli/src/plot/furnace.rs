//! The furnace figure: labelled spheres in grey light.

use catseye::Model;
use catseye_render::{Image, encode_srgb};

use super::axes::roughness_label;
use super::sheet::{Sheet, Tile};

/// Spheres in a row.
const COLUMNS: usize = 5;
/// Radiance of the environment that is shown: below white, so that a gain of energy could be seen as well as
/// a loss.
const SHOWN: f32 = 0.5;

/// What multiple scattering returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scattering {
    Single,
    Multiple,
}

impl Scattering {
    /// In the order of the numbers.
    pub(crate) const ALL: [Self; 2] = [Self::Single, Self::Multiple];

    /// The word for it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::Multiple => "multiple",
        }
    }
}

/// One sphere and its mean albedo.
#[derive(Debug)]
pub(crate) struct Sphere {
    pub(crate) roughness: [f64; 2],
    pub(crate) scattering: Scattering,
    pub(crate) measured: f64,
    pub(crate) expected: f64,
    /// In an environment of radiance 1.
    pub(crate) image: Image,
}

/// The figure of spheres of rising roughness; of several for one roughness the left half is the first, the
/// right half the last one's.
pub(crate) fn figure(model: Model, spheres: &[Vec<Sphere>]) -> Sheet {
    let mut notes = vec![
        "Spheres in an environment of radiance 0.5: darker is a loss of energy, brighter would be a gain,"
            .to_owned(),
        "and a sphere that does neither can't be seen.".to_owned(),
        "Numbers: mean albedo of the sphere, measured by sampling the lobe / exact.".to_owned(),
    ];
    if spheres.iter().any(|pair| pair.len() > 1) {
        notes[1].push_str(" Left halves: single scattering, right halves: multiple.");
    }
    let side = spheres.first().and_then(|pair| pair.first()).map_or(0, |sphere| sphere.image.width());
    Sheet {
        title: format!("White furnace: {} lobe", model.name()),
        notes,
        pixels: [side; 2],
        columns: COLUMNS.min(spheres.len()),
        tiles: spheres.iter().map(|pair| tile(pair)).collect(),
    }
}

fn tile(pair: &[Sphere]) -> Tile {
    let (first, last) = (&pair[0], &pair[pair.len() - 1]);
    let side = first.image.width();
    let pixel = |i: usize| if i % side < side / 2 { first.image.pixels()[i] } else { last.image.pixels()[i] };
    let rgb = (0..side * side).flat_map(|i| pixel(i).map(|value| encode_srgb(SHOWN * value))).collect();
    let numbers = |sphere: &Sphere| {
        format!("{} {:.4} / {:.4}", sphere.scattering.name(), sphere.measured, sphere.expected)
    };
    let heading = format!("roughness {}", roughness_label(first.roughness));
    Tile { rgb, lines: std::iter::once(heading).chain(pair.iter().map(numbers)).collect() }
}
