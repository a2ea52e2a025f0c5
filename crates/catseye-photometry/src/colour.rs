//! Colours of sheeting: what a table calls them, and how their tint is divided among red, green and blue.

use std::str::FromStr;

/// Luminance of linear Rec. 709 (ITU-R BT.709): coefficients are of luminance, materials have three channels.
pub const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Linear Rec. 709 of the colours that tables name, not normalised.
///
/// A table states how much light comes back, in a chromaticity region that is no colour. These stand in its
/// middle: they are the project's choice, close to painted signs in daylight, and `--colour` replaces them.
const NAMED: &[(&str, [f64; 3])] = &[
    ("white", [1.0, 1.0, 1.0]),
    ("silver", [1.0, 1.0, 1.0]),
    ("clear", [1.0, 1.0, 1.0]),
    ("grey", [1.0, 1.0, 1.0]),
    ("yellow", [1.0, 0.58, 0.01]),
    ("amber", [1.0, 0.33, 0.005]),
    ("orange", [0.9, 0.17, 0.01]),
    ("red", [0.5, 0.015, 0.02]),
    ("green", [0.01, 0.25, 0.09]),
    ("blue", [0.01, 0.08, 0.35]),
    ("brown", [0.14, 0.05, 0.02]),
    ("fluorescent yellow", [0.95, 0.9, 0.01]),
    ("fluorescent yellow-green", [0.6, 0.9, 0.01]),
    ("fluorescent orange", [1.0, 0.2, 0.02]),
    ("fluorescent red-orange", [1.0, 0.12, 0.03]),
    ("fluorescent lime-yellow", [0.6, 0.9, 0.01]),
];

/// A colour of luminance 1 in linear Rec. 709: a tint is its luminance times this.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour([f64; 3]);

impl Colour {
    /// White.
    pub const WHITE: Self = Self([1.0; 3]);

    /// The colour with the hue of a linear Rec. 709 triple; `None` for values below 0, NaN or infinite, and
    /// for black.
    #[must_use]
    pub fn from_rec709(rgb: [f64; 3]) -> Option<Self> {
        let luminance = luminance(rgb);
        let good = luminance > 0.0 && rgb.iter().all(|x| x.is_finite() && *x >= 0.0);
        good.then(|| Self(rgb.map(|x| x / luminance)))
    }

    /// The colour that a table's text names first, the longest name where several begin there:
    /// `white (silver)`, `yellow / fluorescent yellow`. `None` where it names none that is known.
    #[must_use]
    pub fn named(text: &str) -> Option<Self> {
        let text = text.to_lowercase();
        let found = NAMED.iter().filter_map(|(name, rgb)| Some((text.find(name)?, name.len(), *rgb)));
        let first = found.min_by_key(|&(place, length, _)| (place, usize::MAX - length))?;
        Self::from_rec709(first.2)
    }

    /// The names that are known.
    pub fn names() -> impl Iterator<Item = &'static str> {
        NAMED.iter().map(|(name, _)| *name)
    }

    /// Linear Rec. 709 for a luminance.
    #[must_use]
    pub fn of_luminance(self, luminance: f64) -> [f64; 3] {
        self.0.map(|x| x * luminance)
    }

    /// The greatest channel for luminance 1: how much sooner than white the colour runs out of energy.
    #[must_use]
    pub fn peak(self) -> f64 {
        self.0.into_iter().fold(0.0, f64::max)
    }
}

/// The luminance of a linear Rec. 709 triple.
#[must_use]
pub fn luminance(rgb: [f64; 3]) -> f64 {
    rgb.iter().zip(LUMINANCE).map(|(x, weight)| x * weight).sum()
}

/// Why a text is no colour.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{text:?} is no colour: give a name ({names}) or linear Rec. 709 as R,G,B", names = Colour::names().collect::<Vec<_>>().join(", "))]
pub struct ColourError {
    text: String,
}

impl FromStr for Colour {
    type Err = ColourError;

    fn from_str(text: &str) -> Result<Self, ColourError> {
        let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
        let colour = match numbers.as_deref() {
            Some(&[r, g, b]) => Self::from_rec709([r, g, b]),
            _ => Self::named(text),
        };
        colour.ok_or_else(|| ColourError { text: text.to_owned() })
    }
}
