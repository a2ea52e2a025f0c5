//! What was measured, as a fit sees it.

use catseye::Vec3;

/// Whether a value is met or only bounded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Aim {
    /// The value itself.
    #[default]
    Equal,
    /// At least the value: the minimum of a standard.
    AtLeast,
    /// At most the value.
    AtMost,
}

/// A pair of directions and what its BSDF counts for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Towards the receiver.
    pub wo: Vec3<f64>,
    /// Towards the source.
    pub wi: Vec3<f64>,
    /// What the BSDF is multiplied by: the cosines of the quantity, and the weight within an aperture.
    pub factor: f64,
}

/// A value and the directions it was measured in: one pair, or a sum over an instrument's apertures.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// The value in the SI unit of its quantity, above 0.
    pub value: f64,
    /// Whether the value is met or only bounded.
    pub aim: Aim,
    /// The directions.
    pub views: Vec<View>,
}
