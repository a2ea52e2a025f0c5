//! How the strength of a lobe depends on the entrance angle.

/// Least cosine that a law is evaluated at, so that it is finite: 89.4 degrees.
pub const LEAST_COSINE: f64 = 0.01;

/// The law `F = (1 + (tan beta / tan b0)^p)^(-q/p)` of the entrance angle beta: flat at first, one bend at
/// `b0`, and then a power `q` of the tangent.
///
/// What real sheeting returns at the observation angle 0 follows F alone; the width of the lobe is another
/// matter (docs/theory.md, section 10). With `p` = 2 and `b0` = 45 degrees F is cos^q, with `p` = `q` Hill's
/// law, and a great `p` makes a sharp bend. However sharp, the slope of log F over log tan beta is at most q.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EntranceLaw {
    /// q: the slope far beyond the bend.
    pub slope: f64,
    /// The squared tangent of the entrance angle of the bend, `tan^2 b0`.
    pub bend: f64,
    /// p: how sharp the bend is.
    pub sharpness: f64,
}

/// A law's logarithm and its derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LogGradient {
    /// log F.
    pub(crate) log: f64,
    pub(crate) by_slope: f64,
    pub(crate) by_log_bend: f64,
    pub(crate) by_log_sharpness: f64,
}

impl EntranceLaw {
    /// The power of the cosine, cos^q.
    #[must_use]
    pub fn power(exponent: f64) -> Self {
        Self { slope: exponent, bend: 1.0, sharpness: 2.0 }
    }

    /// Whether the law is a power of the cosine.
    #[must_use]
    pub fn is_power(&self) -> bool {
        self.bend == 1.0 && self.sharpness == 2.0
    }

    /// F for the cosine of an entrance angle; 1 where the cosine is 1.
    #[must_use]
    pub fn at(&self, cosine: f64) -> f64 {
        self.log_gradient(log_squared_tangent(cosine)).log.exp()
    }

    /// log F and its derivatives where the squared tangent has this logarithm.
    pub(crate) fn log_gradient(&self, log_squared_tangent: f64) -> LogGradient {
        let Self { slope: q, bend, sharpness: p } = *self;
        let distance = log_squared_tangent - bend.ln();
        let ratio = (0.5 * p * distance).exp();
        let (log_sum, share) = (ratio.ln_1p(), ratio / (1.0 + ratio));
        let log = -q / p * log_sum;
        LogGradient {
            log,
            by_slope: -log_sum / p,
            by_log_bend: 0.5 * q * share,
            by_log_sharpness: -log - 0.5 * q * share * distance,
        }
    }
}

/// The logarithm of the squared tangent for a cosine: 1/c^2 - 1, with a floor that keeps it finite at normal
/// incidence.
pub(crate) fn log_squared_tangent(cosine: f64) -> f64 {
    let c = cosine.clamp(LEAST_COSINE, 1.0);
    ((1.0 - c) * (1.0 + c) / (c * c)).max(f64::MIN_POSITIVE).ln()
}
