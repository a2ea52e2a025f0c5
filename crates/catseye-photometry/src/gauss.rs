//! Gauss' quadrature for a weight that is known by its values.

/// Gauss' quadrature for a weight function that is given by many points (node, weight): exact for polynomials
/// up to the degree 2 `count` - 1 in the node.
///
/// The orthonormal polynomials come from the discretised Stieltjes procedure (Gautschi, "Orthogonal
/// Polynomials: Computation and Approximation", 2004, section 2.2.3); their roots are found between those of
/// the one before.
pub(crate) fn gauss(measure: &[(f64, f64)], count: usize) -> Vec<(f64, f64)> {
    let inner = |f: &dyn Fn(f64) -> f64| measure.iter().map(|&(t, w)| w * f(t)).sum::<f64>();
    let mut recurrence: Vec<[f64; 2]> = Vec::new();
    for k in 0..count {
        let last = |t: f64| *polynomials(&recurrence, t, k + 1).last().unwrap_or(&1.0);
        let norm = inner(&|t| last(t).powi(2));
        let centre = inner(&|t| t * last(t).powi(2)) / norm;
        recurrence.push([centre, norm]);
    }
    let upper = measure.iter().map(|(t, _)| *t).fold(0.0, f64::max);
    let mut roots = Vec::new();
    for degree in 1..=count {
        let value = |t: f64| polynomials(&recurrence, t, degree + 1)[degree];
        let edges: Vec<f64> = std::iter::once(0.0).chain(roots).chain([upper]).collect();
        roots = edges.windows(2).map(|edge| bisect(value, edge[0], edge[1])).collect();
    }
    let weight = |t: f64| {
        let values = polynomials(&recurrence, t, count);
        1.0 / values.iter().zip(&recurrence).map(|(p, [_, norm])| p * p / norm).sum::<f64>()
    };
    roots.into_iter().map(|t| (t, weight(t))).collect()
}

/// The first monic orthogonal polynomials at t, from their centres and squared norms.
fn polynomials(recurrence: &[[f64; 2]], t: f64, count: usize) -> Vec<f64> {
    let mut values = vec![1.0];
    for k in 1..count {
        let [centre, norm] = recurrence[k - 1];
        let before = if k > 1 { norm / recurrence[k - 2][1] * values[k - 2] } else { 0.0 };
        values.push((t - centre) * values[k - 1] - before);
    }
    values
}

/// The root of a function that changes its sign once between two points.
fn bisect(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let sign = value(low).signum();
    // Halving as often as a double has bits, and a few times more.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if value(middle).signum() == sign { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
