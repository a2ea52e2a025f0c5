//! How the strength of a lobe depends on the entrance angle.

/// Least cosine that a factor is evaluated at, so that it is finite: 89.4 degrees.
pub const LEAST_COSINE: f64 = 0.01;

/// Greatest negative logarithm of a knee's factor: single precision has no smaller one.
pub(crate) const DEEPEST_FALL: f64 = 80.0;

/// A limit beyond which prisms or beads stop sending light back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knee {
    /// The squared tangent of the entrance angle where the factor has fallen to 1/e.
    pub position: f64,
    /// How sharp the fall is, at least 1.
    pub steepness: f64,
}

/// The factor `c^power exp(-((1/c^2 - 1) / position)^steepness)` of the cosine c of the entrance angle, the exponential
/// only where there is a knee.
///
/// A single retro-reflective lobe has the same coefficient of retro-reflection at every entrance angle (docs/theory.md,
/// section 9); real sheeting loses light. A power of the cosine does for beads. Prisms are as good at 30 degrees as at 0
/// and then stop, which takes a knee; the tangent in it ends every lobe towards the horizon. A negative power is possible beside a knee: a lobe becomes narrower within the
/// plane of incidence as the entrance angle grows, and sheeting does not.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EntranceFactor {
    /// Exponent of the cosine; 0 is no factor.
    pub power: f64,
    /// Where the factor breaks off, if it does.
    pub knee: Option<Knee>,
}

impl EntranceFactor {
    /// The factor for the cosine of an entrance angle; it is 1 where the cosine is 1.
    #[must_use]
    pub fn at(&self, cosine: f64) -> f64 {
        self.log_gradient(cosine).value
    }

    /// The factor and the derivatives of its logarithm.
    #[must_use]
    pub(crate) fn log_gradient(&self, cosine: f64) -> LogGradient {
        let c = cosine.clamp(LEAST_COSINE, 1.0);
        let log_c = c.ln();
        let mut gradient = LogGradient {
            value: (self.power * log_c).exp(),
            by_power: log_c,
            by_log_position: 0.0,
            by_log_steepness: 0.0,
        };
        // The squared tangent, and a floor that keeps the logarithm finite at normal incidence.
        let x = ((1.0 - c) * (1.0 + c) / (c * c)).max(f64::MIN_POSITIVE);
        if let Some(Knee { position, steepness }) = self.knee {
            let log_ratio = (x / position).ln();
            let fall = (steepness * log_ratio).exp().min(DEEPEST_FALL);
            gradient.value *= (-fall).exp();
            gradient.by_log_position = steepness * fall;
            gradient.by_log_steepness = -steepness * fall * log_ratio;
        }
        gradient
    }
}

/// A factor and the derivatives of its logarithm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LogGradient {
    /// The factor.
    pub(crate) value: f64,
    /// By the power.
    pub(crate) by_power: f64,
    /// By the logarithm of the knee's position.
    pub(crate) by_log_position: f64,
    /// By the logarithm of the knee's steepness.
    pub(crate) by_log_steepness: f64,
}
