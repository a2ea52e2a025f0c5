//! Closures that are filled in at each point.

use crate::{
    closure::{Closure, Surface},
    nodes::port::Accepts,
    program::Outputs,
};

/// What makes a closure of a program's results.
pub(crate) type Fill = Box<dyn Fn(&Outputs<'_>) -> Closure + Send + Sync>;

/// An input of `N` numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Slot<const N: usize> {
    Constant([f32; N]),
    /// A result of the program, brought into range.
    Output {
        index: usize,
        accepts: Accepts,
    },
}

impl<const N: usize> Slot<N> {
    pub(crate) fn at(&self, outputs: &Outputs<'_>) -> [f32; N] {
        match *self {
            Self::Constant(value) => value,
            Self::Output { index, accepts } => {
                let lanes = outputs.get(index);
                core::array::from_fn(|i| finite(accepts.nearest(lanes[i])))
            }
        }
    }

    /// Its value where it is the same everywhere.
    pub(crate) fn constant(&self) -> Option<[f32; N]> {
        match *self {
            Self::Constant(value) => Some(value),
            Self::Output { .. } => None,
        }
    }
}

impl Slot<1> {
    pub(crate) fn float(&self, outputs: &Outputs<'_>) -> f32 {
        self.at(outputs)[0]
    }
}

impl Slot<3> {
    /// The direction at length 1, whatever its length; `None` where it is not finite or zero.
    pub(crate) fn direction(&self, outputs: &Outputs<'_>) -> Option<[f32; 3]> {
        let direction = self.at(outputs);
        let largest = direction.iter().fold(0.0_f32, |largest, x| largest.max(x.abs()));
        if !(largest > 0.0 && largest.is_finite()) {
            return None;
        }
        let scaled = direction.map(|x| x / largest);
        let length = scaled.iter().map(|x| x * x).sum::<f32>().sqrt();
        Some(scaled.map(|x| x / length))
    }
}

/// Replaces NaN by 0 and brings infinities into range.
pub(crate) fn finite(x: f32) -> f32 {
    if x.is_nan() { 0.0 } else { x.clamp(f32::MIN, f32::MAX) }
}

/// A surface to be filled in.
pub(crate) struct SurfaceFill {
    pub(crate) bsdf: Fill,
    pub(crate) opacity: Slot<1>,
    pub(crate) emission: Slot<3>,
}

impl SurfaceFill {
    pub(crate) fn at(&self, outputs: &Outputs<'_>) -> Surface {
        Surface {
            bsdf: (self.bsdf)(outputs),
            opacity: self.opacity.float(outputs),
            emission: self.emission.at(outputs),
        }
    }
}
