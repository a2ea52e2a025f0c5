//! What light the coefficient is measured with.

use std::f64::consts::TAU;

use super::within;
use crate::Error;
use crate::gauss::gauss;

/// The photopic luminous efficiency V (CIE 1924, ISO 23539), from 380 nm in steps of 10 nm. Compared with the
/// table of the Python package `colour-science` 0.4: equal within 2e-7.
const EFFICIENCY: [f64; 41] = [
    0.000039, 0.00012, 0.000396, 0.00121, 0.004, 0.0116, 0.023, 0.038, 0.06, 0.09098, 0.13902, 0.20802,
    0.323, 0.503, 0.71, 0.862, 0.954, 0.99495, 0.995, 0.952, 0.87, 0.757, 0.631, 0.503, 0.381, 0.265, 0.175,
    0.107, 0.061, 0.032, 0.017, 0.00821, 0.004102, 0.002091, 0.001047, 0.00052, 0.000249, 0.00012, 0.00006,
    0.00003, 0.000015,
];

/// The light of the lamp, with the receiver's spectral response.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Light {
    /// CIE illuminant A, a tungsten lamp, seen with the eye's efficiency V: what `R_A` is defined with.
    #[default]
    White,
    /// One wavelength in air, in nanometres, from 300 to 2000: lidar for instance.
    Monochromatic(f64),
}

impl Light {
    /// # Errors
    /// A wavelength out of its range.
    pub(crate) fn check(self) -> Result<(), Error> {
        let Self::Monochromatic(nm) = self else { return Ok(()) };
        within("the wavelength", nm, (300.0..=2000.0).contains(&nm), "[300, 2000] nm")
    }

    /// Wave numbers in air, in radians per micrometre, and their shares, which add up to 1.
    pub(crate) fn spectrum(self) -> Vec<(f64, f64)> {
        let wave_number = |nm: f64| TAU * 1000.0 / nm;
        let nm = match self {
            Self::Monochromatic(nm) => return vec![(wave_number(nm), 1.0)],
            Self::White => (0..EFFICIENCY.len()).map(|i| 380.0 + 10.0 * i as f64),
        };
        let shares: Vec<(f64, f64)> =
            nm.zip(EFFICIENCY).map(|(nm, v)| (wave_number(nm), v * illuminant_a(nm))).collect();
        let total: f64 = shares.iter().map(|(_, share)| share).sum();
        shares.into_iter().map(|(k, share)| (k, share / total)).collect()
    }

    /// The mean wave number in air, in radians per micrometre.
    pub(crate) fn mean(self) -> f64 {
        self.spectrum().iter().map(|(k, share)| k * share).sum()
    }

    /// Gauss' quadrature of [`Light::spectrum`] with `count` nodes.
    pub(crate) fn nodes(self, count: usize) -> Vec<(f64, f64)> {
        match self {
            Self::Monochromatic(_) => self.spectrum(),
            Self::White => gauss(&self.spectrum(), count),
        }
    }
}

/// Relative spectral power of illuminant A (CIE 15:2004, equation 3.1); the constant factor is left out.
fn illuminant_a(nm: f64) -> f64 {
    /// Second radiation constant over the colour temperature of the definition, in nanometres.
    const EXPONENT_NM: f64 = 1.435e7 / 2848.0;
    (560.0 / nm).powi(5) / (EXPONENT_NM / nm).exp_m1()
}
