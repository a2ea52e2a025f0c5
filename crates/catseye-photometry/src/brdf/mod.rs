//! Measured BRDFs: reading them, choosing what of them a fit looks at, and how far a model is from them.
//!
//! ALTA's text files and MERL's `.binary` are read. Such data say little below 1 or 2 degrees of observation
//! angle: the instruments saw more than that at once. Their apertures belong into the fit
//! ([`crate::Apertures`]); what the data can tell is the shape at wide angles and how it falls with the
//! entrance angle.

mod alta;
mod coat;
mod coordinates;
mod fitted;
mod merl;
mod metrics;
mod reciprocity;
mod selection;

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use catseye::Vec3;

use crate::{Error, luminance};

pub use coat::Coat;
pub use fitted::{BrdfFit, BrdfFitError, Part};
pub use metrics::{Metrics, metrics};
pub use reciprocity::{Contradiction, Reciprocity};
pub use selection::{Region, Selection};

/// Bytes of the largest file that is read: MERL's have 33 MiB, with 360 azimuths 67.
const LARGEST: u64 = 80 << 20;

/// A measured value of a BRDF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrdfSample {
    /// To the receiver, a unit vector above the surface.
    pub wo: Vec3<f64>,
    /// To the source, a unit vector above the surface.
    pub wi: Vec3<f64>,
    /// f in 1/sr, the cosine not included, not negative, for red, green and blue; three times the same where
    /// the file has one channel.
    pub value: [f64; 3],
}

impl BrdfSample {
    /// The value for white light, in 1/sr.
    #[must_use]
    pub fn luminance(&self) -> f64 {
        luminance(self.value)
    }
}

/// What the values of an ALTA file are. MERL's are f.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cosine {
    /// What the file's header says; f where it says nothing.
    #[default]
    AsStated,
    /// The BRDF f.
    Excluded,
    /// f times the cosine of the receiver's direction, ALTA's `INV_STERADIAN_COSINE_FACTOR`.
    Included,
}

/// Samples that a file has and that are left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Skipped {
    /// Negative, which is how MERL marks what was not measured, not finite, or above 1e9 per steradian.
    pub invalid: usize,
    /// With a direction below the surface or along it.
    pub below_horizon: usize,
}

/// A measured BRDF.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Brdf {
    /// The file's name.
    pub name: String,
    /// What was measured, in the order of the file.
    pub samples: Vec<BrdfSample>,
    /// What was left out.
    pub skipped: Skipped,
    /// What the file's values were read as; never [`Cosine::AsStated`].
    pub read_as: Cosine,
    /// What was assumed, a sentence each.
    pub remarks: Vec<String>,
}

impl Brdf {
    /// Reads an ALTA text file or MERL's `.binary`, told apart by how they begin.
    ///
    /// # Errors
    /// A file that can't be read, or is larger than 80 MiB, or neither; everything that [`Brdf::parse`]
    /// refuses.
    pub fn read(path: &Path, cosine: Cosine) -> Result<Self, Error> {
        let io = |source| Error::Io { path: path.to_owned(), source };
        let mut bytes = Vec::new();
        File::open(path).map_err(io)?.take(LARGEST + 1).read_to_end(&mut bytes).map_err(io)?;
        Self::parse(&bytes, &path.display().to_string(), cosine)
    }

    /// Reads the bytes of an ALTA text file or of MERL's `.binary`; `name` is what errors call it.
    ///
    /// # Errors
    /// Names the file, for ALTA also the line: dimensions that don't fit, a parametrisation that isn't known,
    /// a cell that is no number, missing cells, a file without usable samples. [`Error::Cosine`] where the
    /// header is believed and the values of exchanged directions contradict it; where `cosine` is given, that
    /// is a remark.
    pub fn parse(bytes: &[u8], name: &str, cosine: Cosine) -> Result<Self, Error> {
        let fail = |problem: String| Error::Table { table: name.to_owned(), problem };
        if bytes.len() as u64 > LARGEST {
            return Err(fail(format!("is larger than {} MiB; is it a BRDF?", LARGEST >> 20)));
        }
        let mut brdf = match merl::dimensions(bytes) {
            Some(dimensions) => merl::parse(bytes, dimensions).map_err(fail)?,
            None => alta::parse(bytes, name, cosine)?,
        };
        name.clone_into(&mut brdf.name);
        if brdf.samples.is_empty() {
            let Skipped { invalid, below_horizon } = brdf.skipped;
            let what = format!(
                "{invalid} are negative, not finite or above 1e9/sr, {below_horizon} below the surface"
            );
            return Err(fail(format!("has no usable samples: {what}")));
        }
        let found = brdf.reciprocity().and_then(|found| found.contradiction(brdf.read_as));
        match (found, cosine) {
            (Some(found), Cosine::AsStated) => Err(Error::Cosine { file: name.to_owned(), found }),
            (Some(found), _) => {
                brdf.remarks.push(found.to_string());
                Ok(brdf)
            }
            (None, _) => Ok(brdf),
        }
    }

    /// Adds a sample or counts why not.
    fn push(&mut self, wo: Vec3<f64>, wi: Vec3<f64>, value: [f64; 3]) {
        /// Cosines below this, at 89.9 degrees, are rounding of the horizon.
        const HORIZON: f64 = 1.7e-3;
        /// No instrument sees a mirror as more, 1/sr: it would resolve 2e-5 radians.
        const MOST: f64 = 1e9;
        let directions_are_finite = [wo.x, wo.y, wi.x, wi.y].iter().all(|x| x.is_finite());
        if !directions_are_finite || value.iter().any(|x| !(0.0..=MOST).contains(x)) {
            self.skipped.invalid += 1;
        } else if wo.z > HORIZON && wi.z > HORIZON {
            self.samples.push(BrdfSample { wo, wi, value });
        } else {
            self.skipped.below_horizon += 1;
        }
    }
}
