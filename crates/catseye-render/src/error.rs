//! What can go wrong, in one enum.

use std::ops::Range;

/// Why a scene could not be built, rendered or made a file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A picture could not be made a file.
    #[error("the picture can't be made a {format} file: {reason}")]
    Encode {
        /// The format.
        format: &'static str,
        /// What the encoder said.
        reason: String,
    },
    /// A setting is outside its range.
    #[error("{name} is {value}, outside {range}")]
    Setting {
        /// The field of [`RenderSettings`](crate::RenderSettings).
        name: &'static str,
        /// Its value.
        value: u64,
        /// Its legal values.
        range: &'static str,
    },
    /// A size or direction of the retroreflectometer is not what it must be.
    #[error("retroreflectometer: {name} is {value}, not {expected}")]
    Instrument {
        /// The field of [`Retroreflectometer`](crate::Retroreflectometer), or the direction.
        name: &'static str,
        /// Its value; of a direction the length.
        value: f64,
        /// What it must be.
        expected: &'static str,
    },
    /// A retro-reflective lobe has a parameter outside its range.
    #[error("retro_reflective_bsdf: {0}")]
    Parameter(#[from] catseye::ParamError),
    /// A closure that the reader knows and this renderer doesn't.
    #[error("the closure {closure} can't be rendered")]
    UnknownClosure {
        /// The closure.
        closure: String,
    },
    /// A material has more lobes than a shading point has room for.
    #[error("the material has {found} lobes, {max} are supported: mix fewer closures")]
    TooManyLobes {
        /// How many there are.
        found: usize,
        /// How many there may be.
        max: usize,
    },
    /// Light that is sent back in a single direction, where something was to be measured.
    #[error(
        "the material sends light back in a single direction (roughness 0), of which nothing reaches a \
         receiver beside the source: give its retro-reflective lobe a roughness, 0.006 for a half-power angle \
         of 0.4 degree"
    )]
    RetroMirror,
    /// A mesh is inconsistent.
    #[error("mesh {mesh}: {problem}")]
    Mesh {
        /// The number of the mesh in the order of addition, from 0.
        mesh: usize,
        /// What does not fit.
        problem: String,
    },
    /// A region that is empty or not inside the picture.
    #[error("the region {region} is empty or not inside the picture of {} x {} pixels", size[0], size[1])]
    Region {
        /// The region.
        region: crate::Region,
        /// Columns and rows of the picture.
        size: [usize; 2],
    },
    /// Samples of another picture.
    #[error("it is another picture: different {difference}")]
    OtherPicture {
        /// What differs.
        difference: String,
    },
    /// Nothing to merge.
    #[error("there are no parts to merge")]
    NoParts,
    /// Parts of different pictures.
    #[error("parts {} and {}: different {difference}", parts[0], parts[1])]
    Parts {
        /// Their numbers, from 0.
        parts: [usize; 2],
        /// What differs.
        difference: String,
    },
    /// Samples that two parts have.
    #[error("parts {} and {} both have the samples {samples:?} of some pixels", parts[0], parts[1])]
    Overlap {
        /// Their numbers, from 0.
        parts: [usize; 2],
        /// Which samples.
        samples: Range<u32>,
    },
    /// Samples that are not expected.
    #[error("part {part} has the samples {samples:?}, beyond {expected:?}")]
    Beyond {
        /// Its number, from 0.
        part: usize,
        /// Its samples.
        samples: Range<u32>,
        /// Those that the picture is to have.
        expected: Range<u32>,
    },
    /// Samples that no part has.
    #[error("no part has the samples {samples:?} of the pixel in column {} and row {}", pixel[0], pixel[1])]
    Gap {
        /// Which samples.
        samples: Range<u32>,
        /// Column and row of the first such pixel.
        pixel: [usize; 2],
    },
    /// A file that is no part of a picture.
    #[error("{reason}")]
    Part {
        /// What is wrong with it.
        reason: String,
    },
    /// The worker threads could not be started.
    #[error("cannot start {threads} threads: {reason}")]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// What the system said.
        reason: String,
    },
}
