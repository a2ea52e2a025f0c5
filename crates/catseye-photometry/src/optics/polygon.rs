//! Convex polygons: cut by lines, and their Fourier transform.

use nalgebra::{Complex, Vector2};

/// Corners in counter-clockwise order; none for an empty polygon.
pub(crate) type Polygon = Vec<Vector2<f64>>;

/// The part of a convex polygon where `side`, a linear function, is not negative (Sutherland and Hodgman).
pub(crate) fn clipped(polygon: &Polygon, side: impl Fn(&Vector2<f64>) -> f64) -> Polygon {
    let mut kept = Polygon::new();
    for (i, b) in polygon.iter().enumerate() {
        let a = &polygon[(i + polygon.len() - 1) % polygon.len()];
        let (at_a, at_b) = (side(a), side(b));
        if (at_a < 0.0) != (at_b < 0.0) {
            kept.push(a + (b - a) * (at_a / (at_a - at_b)));
        }
        if at_b >= 0.0 {
            kept.push(*b);
        }
    }
    kept
}

/// The edges of a polygon: from, to.
fn edges(polygon: &Polygon) -> impl Iterator<Item = (&Vector2<f64>, &Vector2<f64>)> {
    polygon.iter().zip(polygon.iter().cycle().skip(1))
}

/// The area.
pub(crate) fn area(polygon: &Polygon) -> f64 {
    0.5 * edges(polygon).map(|(a, b)| a.perp(b)).sum::<f64>()
}

/// The integral of exp(i g.r) over a polygon, r its places: by Gauss' theorem a sum over the edges. g r must
/// be below 1e8 or so.
pub(crate) fn transform(polygon: &Polygon, g: &Vector2<f64>) -> Complex<f64> {
    let reach = polygon.iter().map(|corner| corner.norm()).fold(0.0, f64::max);
    let squared = g.norm_squared();
    // Below, the sum would lose more digits than the polygon's extent is worth.
    if squared.sqrt() * reach < 1e-7 {
        return Complex::from(area(polygon));
    }
    let edge = |(a, b): (&Vector2<f64>, &Vector2<f64>)| {
        let along = 0.5 * g.dot(&(b - a));
        let sinc = if along.abs() < 1e-4 { 1.0 - along * along / 6.0 } else { along.sin() / along };
        Complex::cis(0.5 * g.dot(&(a + b))) * (g.perp(&(b - a)) * sinc)
    };
    // g x (b - a) is g times the outward normal times the edge's length.
    edges(polygon).map(edge).sum::<Complex<f64>>() * Complex::new(0.0, -1.0 / squared)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transform_is_the_integral() {
        // Against the midpoint rule over a fine grid of a square that a line has cut: pixels on the cut make
        // its error, about a pixel's phase on a length of 1.4.
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vector2::from).to_vec();
        let side = |r: &Vector2<f64>| 1.3 - r.x - r.y;
        let polygon = clipped(&square, side);
        assert!((area(&polygon) - (1.0 - 0.5 * 0.7 * 0.7)).abs() < 1e-15);
        for g in [[0.0, 0.0], [1e-6, 0.0], [3.0, -7.0], [0.0, 11.0], [-2e-3, 1e-3]].map(Vector2::from) {
            const STEPS: u32 = 1000;
            let mut sum = Complex::<f64>::default();
            for (i, j) in (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| (i, j))) {
                let r = Vector2::new(f64::from(i) + 0.5, f64::from(j) + 0.5) / f64::from(STEPS);
                let inside = if side(&r).abs() < 1e-9 { 0.5 } else { f64::from(side(&r) > 0.0) };
                sum += Complex::cis(g.dot(&r)) * inside;
            }
            let error = (transform(&polygon, &g) - sum / f64::from(STEPS * STEPS)).norm();
            assert!(error < 1e-5, "{g:?}: {error}");
        }
    }
}
