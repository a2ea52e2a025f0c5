//! A headlamp's intensity in any direction.

/// A headlamp.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    intensity_cd: f64,
}

impl Lamp {
    /// A lamp of the same intensity in every direction, in cd.
    #[must_use]
    pub fn even(intensity_cd: f64) -> Self {
        Self { intensity_cd }
    }

    /// The intensity in cd in a direction of the Type A goniometer, degrees to the right of straight ahead
    /// and of elevation; `None` where nothing is known.
    #[must_use]
    pub fn intensity_cd(&self, _right_deg: f64, _up_deg: f64) -> Option<f64> {
        Some(self.intensity_cd)
    }
}
