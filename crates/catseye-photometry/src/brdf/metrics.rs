//! How far a model is from measured values.

/// Errors of a model over many values.
#[derive(Clone, Debug, PartialEq)]
pub struct Metrics {
    /// Root mean square error over the range of the measured values, greatest less least. Says how good the
    /// peak is.
    pub nrmse: f64,
    /// Root mean square of the natural logarithms of model over measured. Says how good the tails are: 0.1 is
    /// a typical error of 10 %.
    pub log_rmse: f64,
    /// Pairs that the metrics are over. For the logarithms only those where both are above 0.
    pub count: usize,
    /// The sizes of the logarithms, from the least.
    logs: Vec<f64>,
}

/// Errors in multiples of the root mean square: 95 % of a normal distribution are within the first, all of
/// some thousands within the second.
const USUAL: f64 = 2.0;
const GREATEST: f64 = 4.0;
/// The share of values that may be beyond: instruments have faults.
const FAULTS: f64 = 0.005;

/// The metrics of pairs (model, measured); `None` where no pair is finite or all values are the same.
pub fn metrics(pairs: impl IntoIterator<Item = (f64, f64)>) -> Option<Metrics> {
    let (mut count, mut squares, mut logs) = (0, 0.0, Vec::new());
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    for (model, measured) in pairs.into_iter().filter(|(a, b)| a.is_finite() && b.is_finite()) {
        count += 1;
        squares += (model - measured).powi(2);
        (least, greatest) = (measured.min(least), measured.max(greatest));
        if model > 0.0 && measured > 0.0 {
            logs.push((model / measured).ln().abs());
        }
    }
    logs.sort_by(f64::total_cmp);
    (greatest > least).then(|| Metrics {
        nrmse: (squares / count as f64).sqrt() / (greatest - least),
        log_rmse: (logs.iter().map(|log| log * log).sum::<f64>() / logs.len() as f64).sqrt(),
        count,
        logs,
    })
}

impl Metrics {
    /// The error that 95 % of the values are within, as a share: 1 is twice or half the value.
    #[must_use]
    pub fn percentile_95(&self) -> f64 {
        let rank = (0.95 * self.logs.len() as f64).ceil() as usize;
        self.logs.get(rank.saturating_sub(1)).map_or(f64::NAN, |log| log.exp_m1())
    }

    /// The greatest error, as a share: 1 is twice or half the value.
    #[must_use]
    pub fn worst(&self) -> f64 {
        self.logs.last().map_or(f64::NAN, |log| log.exp_m1())
    }

    /// The error beyond which a value is an outlier, as a share: a logarithm of four times the tolerance.
    #[must_use]
    pub fn outlying(tolerance: f64) -> f64 {
        (GREATEST * tolerance).exp_m1()
    }

    /// Values that are farther off.
    #[must_use]
    pub fn outliers(&self, tolerance: f64) -> usize {
        self.logs.iter().filter(|log| **log > GREATEST * tolerance).count()
    }

    /// Whether the errors are those of a normal distribution of that width, or less: their root mean square
    /// is at most the tolerance, 95 % of them are within twice that, and all but one in 200 within four
    /// times. All are logarithms: of a tolerance of 0.4 they are 40 %, a factor of 2.2 and a factor of 5.
    #[must_use]
    pub fn is_within(&self, tolerance: f64) -> bool {
        self.log_rmse <= tolerance
            && self.percentile_95() <= (USUAL * tolerance).exp_m1()
            && self.outliers(tolerance) as f64 <= FAULTS * self.logs.len() as f64
    }
}
