//! How far a model is from measured values.

/// Errors of a model over many values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metrics {
    /// Root mean square error over the range of the measured values, greatest less least. Says how good the
    /// peak is.
    pub nrmse: f64,
    /// Root mean square of the natural logarithms of model over measured. Says how good the tails are: 0.1 is
    /// a typical error of 10 %.
    pub log_rmse: f64,
    /// Pairs that the metrics are over. For the logarithms only those where both are above 0.
    pub count: usize,
}

/// The metrics of pairs (model, measured); `None` where no pair is finite or all values are the same.
pub fn metrics(pairs: impl IntoIterator<Item = (f64, f64)>) -> Option<Metrics> {
    let (mut count, mut squares) = (0, 0.0);
    let (mut logarithms, mut log_squares) = (0, 0.0);
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    for (model, measured) in pairs.into_iter().filter(|(a, b)| a.is_finite() && b.is_finite()) {
        count += 1;
        squares += (model - measured).powi(2);
        (least, greatest) = (measured.min(least), measured.max(greatest));
        if model > 0.0 && measured > 0.0 {
            logarithms += 1;
            log_squares += (model / measured).ln().powi(2);
        }
    }
    (greatest > least).then(|| Metrics {
        nrmse: (squares / f64::from(count)).sqrt() / (greatest - least),
        log_rmse: if logarithms > 0 { (log_squares / f64::from(logarithms)).sqrt() } else { f64::NAN },
        count: count as usize,
    })
}
