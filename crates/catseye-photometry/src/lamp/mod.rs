//! Headlamps: intensity in candela over direction, from a file or built in.
//!
//! Directions are those of the Type A goniometer, which FMVSS 108 and automotive LM-63 files use: an angle to
//! the right of straight ahead in the horizontal plane, and the angle of elevation.
//!
//! ```
//! use catseye_photometry::lamp::Lamp;
//!
//! let lamp = Lamp::low_beam();
//! // FMVSS 108 asks for 500 cd at least from 1 to 3 degrees right and half a degree up, where signs are.
//! assert_eq!(lamp.intensity_cd(2.0, 0.5), Some(500.0));
//! // Aimed half a degree lower it sends there what was meant for 1 degree up.
//! assert_eq!(lamp.clone().aimed(0.0, -0.5).intensity_cd(2.0, 0.5), lamp.intensity_cd(2.0, 1.0));
//! ```

mod eulumdat;
mod lm63;
mod low_beam;
mod net;
mod text;

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use crate::Error;
use low_beam::LowBeam;
use net::Net;

pub use low_beam::{Basis, LOW_BEAM, TestPoint};

/// Bytes of the largest file that is read: a million numbers.
const LARGEST: usize = 8 << 20;

/// Where the vertical axis of a C-gamma file, a luminaire's, is in a headlamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// gamma is counted from straight ahead: the lamp was measured looking down. C0 is to the right, C90 up.
    Ahead,
    /// gamma is counted from straight down: the lamp was measured as it is mounted. C0 is ahead, C90 to the
    /// left.
    Down,
}

/// A headlamp.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    source: Source,
    aim_deg: [f64; 2],
    factor: f64,
}

#[derive(Clone, Debug, PartialEq)]
enum Source {
    Even(f64),
    LowBeam(LowBeam),
    Net(Net),
}

impl Lamp {
    fn new(source: Source) -> Self {
        Self { source, aim_deg: [0.0; 2], factor: 1.0 }
    }

    /// A lamp of the same intensity in every direction, in cd.
    #[must_use]
    pub fn even(intensity_cd: f64) -> Self {
        Self::new(Source::Even(intensity_cd))
    }

    /// A lower beam for right-hand traffic that is just bright enough for FMVSS 108: see [`LOW_BEAM`].
    #[must_use]
    pub fn low_beam() -> Self {
        Self::new(Source::LowBeam(LowBeam))
    }

    /// Reads a file: EULUMDAT where its name ends in `.ldt`, else LM-63.
    ///
    /// # Errors
    /// A file that can't be read, and everything that [`Lamp::parse_lm63`] and [`Lamp::parse_eulumdat`]
    /// refuse.
    pub fn read(path: &Path, axis: Option<Axis>) -> Result<Self, Error> {
        let io = |source| Error::Io { path: path.to_owned(), source };
        let mut bytes = Vec::new();
        File::open(path).map_err(io)?.take(LARGEST as u64 + 1).read_to_end(&mut bytes).map_err(io)?;
        let name = path.display().to_string();
        let is_eulumdat = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ldt"));
        if is_eulumdat {
            Self::parse_eulumdat(&bytes, &name, axis)
        } else {
            Self::parse_lm63(&bytes, &name, axis)
        }
    }

    /// Reads the text of an LM-63 file (IES); `name` is what errors call it.
    ///
    /// Types A and B have straight ahead at 0, 0; Type C needs an `axis`.
    ///
    /// # Errors
    /// Names the line of what is missing, no number, or out of its range.
    pub fn parse_lm63(bytes: &[u8], name: &str, axis: Option<Axis>) -> Result<Self, Error> {
        lm63::parse(bytes, name, axis).map(|net| Self::new(Source::Net(net)))
    }

    /// Reads the text of an EULUMDAT file; `name` is what errors call it.
    ///
    /// The format knows C-gamma angles only, so an `axis` is needed.
    ///
    /// # Errors
    /// As [`Lamp::parse_lm63`].
    pub fn parse_eulumdat(bytes: &[u8], name: &str, axis: Option<Axis>) -> Result<Self, Error> {
        eulumdat::parse(bytes, name, axis).map(|net| Self::new(Source::Net(net)))
    }

    /// The lamp turned by so many degrees to the right and upwards.
    #[must_use]
    pub fn aimed(self, right_deg: f64, up_deg: f64) -> Self {
        let [right, up] = self.aim_deg;
        Self { aim_deg: [right + right_deg, up + up_deg], ..self }
    }

    /// The lamp with its intensities times a factor.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { factor: self.factor * factor, ..self }
    }

    /// The intensity in cd in a direction, degrees to the right of straight ahead and of elevation; `None`
    /// where the file has no angles.
    #[must_use]
    pub fn intensity_cd(&self, right_deg: f64, up_deg: f64) -> Option<f64> {
        let [right, up] = [right_deg - self.aim_deg[0], up_deg - self.aim_deg[1]];
        let own = match &self.source {
            Source::Even(intensity_cd) => Some(*intensity_cd),
            Source::LowBeam(beam) => Some(beam.intensity_cd(right, up)),
            Source::Net(net) => net.intensity_cd(right, up),
        };
        own.map(|intensity_cd| intensity_cd * self.factor)
    }
}
