//! Gauss-Legendre quadrature.

use crate::Real;

/// Nodes and weights of the `N`-point rule on `[0, 1]`.
#[derive(Clone, Debug)]
pub(crate) struct Gauss<const N: usize> {
    pub(crate) nodes: [f64; N],
    weights: [f64; N],
}

impl<const N: usize> Gauss<N> {
    /// Finds the roots of the Legendre polynomial by Newton's method.
    pub(crate) fn new() -> Self {
        let (mut nodes, mut weights) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            let guess = core::f64::consts::PI * (i as f64 + 0.75) / (N as f64 + 0.5);
            let mut x = Real::sin_cos(guess).1;
            let mut slope = 0.0;
            for _ in 0..8 {
                let (value, derivative) = legendre(N, x);
                slope = derivative;
                x -= value / derivative;
            }
            nodes[i] = 0.5 * (1.0 - x);
            weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
        }
        Self { nodes, weights }
    }

    /// The integral of `f` from `a` to `b`.
    pub(crate) fn integrate(&self, a: f64, b: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
        let mut sum = 0.0;
        for (x, w) in self.nodes.iter().zip(&self.weights) {
            sum += w * f(a + (b - a) * x);
        }
        sum * (b - a)
    }
}

/// The Legendre polynomial of degree `n` and its derivative at `x`.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut current) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (previous, current) = (current, ((2.0 * k - 1.0) * x * current - (k - 1.0) * previous) / k);
    }
    (current, n as f64 * (x * current - previous) / (x * x - 1.0))
}
