//! Instruments that a material is measured with, and the tables of values that they are compared with.

pub(crate) mod goniometer;
pub(crate) mod headlamps;
pub(crate) mod retroreflectometer;
pub(crate) mod subject;
pub(crate) mod table;

use anyhow::{anyhow, bail};
use catseye_photometry::LUMINANCE;
use clap::ValueEnum;

use crate::failure::Usage;

/// What is made of three colour channels.
///
/// Photometers measure in illuminant A; a material that is given in three channels can't say what changes in
/// that light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Channel {
    /// 0.2126 R + 0.7152 G + 0.0722 B
    #[default]
    Luminance,
    /// Red
    R,
    /// Green
    G,
    /// Blue
    B,
}

impl Channel {
    /// What each channel of linear Rec. 709 counts for.
    fn weights(self) -> [f64; 3] {
        match self {
            Self::Luminance => LUMINANCE,
            Self::R => [1.0, 0.0, 0.0],
            Self::G => [0.0, 1.0, 0.0],
            Self::B => [0.0, 0.0, 1.0],
        }
    }

    fn of(self, rgb: [f64; 3]) -> f64 {
        rgb.iter().zip(self.weights()).map(|(x, weight)| x * weight).sum()
    }
}

/// Refuses an `--area-m2` that is not positive.
pub(crate) fn check_area(area_m2: Option<f64>) -> anyhow::Result<()> {
    if area_m2.is_some_and(|area| !(area > 0.0 && area.is_finite())) {
        bail!(Usage("--area-m2 must be above 0".to_owned()));
    }
    Ok(())
}

/// What is said where a coefficient of luminous intensity is asked for without an area.
fn area_needed() -> anyhow::Error {
    anyhow!("R_I is of a whole reflector, R_A times its area: say which with --area-m2")
}
