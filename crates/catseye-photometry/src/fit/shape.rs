//! What no sum of lobes can do: the proof that a table can't be fitted.

use super::FitOptions;
use super::form::EXTREME_LAWS;
use super::observation::{Aim, Observation};
use crate::Geometry;
use crate::lobe::Pair;
use crate::sheeting::Sheeting;

/// Directions to the source that differ by less than this are one series of a table.
const SAME_DIRECTION: f64 = 1e-6;

/// Three rows of a table that no sum of disk lobes comes closer to.
///
/// Along a series of observation angles in one plane, every disk lobe is exp(-n u), with a coordinate u that
/// all lobes share, times factors of the viewer's direction: the law and the width, which change by a little
/// over the series. A sum of exponentials is log-convex in u, whatever their number, widths and strengths:
/// between two rows it lies below the line through them, and with factors that are log-convex but for e, at
/// most by e above it (Hoelder's inequality; docs/theory.md, section 10). e is the most that any law of a fit
/// can add. A table whose middle value lies farther above the line, because it falls slowly at first and then
/// fast, is missed by at least half the distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeBound {
    /// The rows, from the least observation angle to the greatest.
    pub rows: [usize; 3],
    /// The error that at least one of them has with any sum of lobes, as a share of the value.
    pub error: f64,
}

/// A row on the scales where lobes are straight lines: those of lobes along the datum axis, and of lobes that
/// keep their width.
struct Point {
    row: usize,
    geometry: Geometry,
    /// The direction of the offset d, up to its sign.
    plane: f64,
    pair: Pair,
    scales: [Scale; 2],
}

#[derive(Clone, Copy)]
struct Scale {
    /// The coordinate that the exponents are proportional to.
    u: f64,
    /// The logarithm of the value without what all lobes share, and of a base of albedo pi.
    log: f64,
    base: f64,
}

/// The three rows that are farthest from what a sum of lobes can do, if any are.
#[must_use]
pub(crate) fn shape_bound(observations: &[Observation], options: &FitOptions) -> Option<ShapeBound> {
    let point = |(row, observation)| Point::new(row, observation, options);
    let mut points: Vec<Point> = observations.iter().enumerate().filter_map(point).collect();
    points.sort_by(|a, b| a.scales[0].u.total_cmp(&b.scales[0].u));
    let mut worst: Option<ShapeBound> = None;
    for (i, first) in points.iter().enumerate() {
        for (j, last) in points.iter().enumerate().skip(i + 2).filter(|(_, last)| last.is_beside(first)) {
            for middle in points[i + 1..j].iter().filter(|middle| middle.is_beside(first)) {
                let three = [first, middle, last];
                // A form has lobes of one kind.
                let error = error(three, 0, options.diffuse).min(error(three, 1, options.diffuse));
                if error > worst.map_or(0.0, |bound| bound.error) {
                    worst = Some(ShapeBound { rows: three.map(|point| point.row), error });
                }
            }
        }
    }
    worst
}

/// The least error of three rows for lobes along the datum axis (0) or such that keep their width (1).
fn error(three: [&Point; 3], kind: usize, has_base: bool) -> f64 {
    let [first, middle, last] = three.map(|point| point.scales[kind]);
    let span = last.u - first.u;
    let share = (middle.u - first.u) / span;
    if !(span > 0.0 && (0.0..=1.0).contains(&share)) {
        return 0.0;
    }
    // By how much the middle is above the line.
    let above = |[a, b, c]: [f64; 3]| b - a - share * (c - a);
    // The same, at most, for what grows by at most `gain` from one row to another.
    let most = |gain: &dyn Fn(&Pair, &Pair) -> f64| {
        let [a, b, c] = three.map(|point| &point.pair);
        (1.0 - share) * gain(a, b).max(0.0) + share * gain(c, b).max(0.0)
    };
    // sqrt(n + 1/(N.o)^2) of a lobe that keeps its width grows most for n = 0.
    let width = if kind == 1 { most(&|from, to| (from.cosine / to.cosine).ln()) } else { 0.0 };
    let lobes = most(&greatest_gain) + width;
    let base = if has_base { above([first.base, middle.base, last.base]) } else { 0.0 };
    let excess = above([first.log, middle.log, last.log]) - lobes.max(base);
    (0.5 * excess).exp_m1().max(0.0)
}

/// The most that the logarithm of a law of a fit grows from one direction to another.
///
/// Its slope over x = ln tan^2 beta is -q/2 s(p (x - b) / 2) with s = e^y / (1 + e^y): steepest for the
/// greatest q and the least b, and for the least p before the bend and the greatest beyond it.
fn greatest_gain(from: &Pair, to: &Pair) -> f64 {
    let (low, high) = (to.log_tangent, from.log_tangent);
    if high <= low {
        return 0.0;
    }
    let [round, sharp] = EXTREME_LAWS;
    let bend = round.bend.ln();
    let at = |law: crate::EntranceLaw, x: f64| law.log_gradient(x).log;
    at(round, low.min(bend)) - at(round, high.min(bend)) + at(sharp, low.max(bend))
        - at(sharp, high.max(bend))
}

impl Point {
    fn new(row: usize, observation: &Observation, options: &FitOptions) -> Option<Self> {
        let [view] = observation.views[..] else { return None };
        if observation.aim != Aim::Equal {
            return None;
        }
        let geometry = Geometry { wo: view.wo, wi: view.wi };
        let pair = Pair::new(options.model, view.wo, view.wi);
        if pair.scale == 0.0 {
            return None;
        }
        let coat = Sheeting { coat_ior: options.coat_ior, ..Sheeting::default() };
        let log = (observation.value / (view.factor * coat.transmitted(view.wo) * pair.scale)).ln();
        let base = -pair.scale.ln();
        let [[e_u, e_v], [along, across]] = pair.exponents;
        let fixed = Scale { u: e_u + e_v, log, base };
        // Of (n c^2 + 1) e_u + (n + 1) e_v all lobes share what has no n.
        let shared = along + across;
        let u = pair.cosine * pair.cosine * along + across;
        let keeps_width = Scale { u, log: log + shared, base: base + shared };
        let plane = geometry.offset_plane();
        Some(Self { row, geometry, plane, pair, scales: [fixed, keeps_width] })
    }

    /// Whether both rows belong to one series: the same direction to the source, the same plane.
    fn is_beside(&self, other: &Self) -> bool {
        let (a, b) = (self.geometry.wi, other.geometry.wi);
        let turn = (self.plane - other.plane).abs();
        [a.x - b.x, a.y - b.y, a.z - b.z].iter().all(|x| x.abs() < SAME_DIRECTION)
            && turn.min(core::f64::consts::PI - turn) < SAME_DIRECTION
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::standards::Catalogue;
    use crate::{EntranceLaw, Goniometer, Quantity, RetroLobe};

    fn seen(value: f64, geometry: Geometry) -> Observation {
        let Geometry { wo, wi } = geometry;
        let factor = Quantity::RetroReflectionCoefficient.of_brdf(1.0, &geometry).unwrap();
        Observation {
            value,
            aim: Aim::Equal,
            views: vec![super::super::View { wo, wi, factor }],
            uncertainty: None,
        }
    }

    /// The bound of a table that a material of the family has, but for noise, is at most that noise: what
    /// would be left of a proof that forgets something.
    #[test]
    fn no_material_is_below_its_bound() {
        const NOISE: f64 = 0.02;
        let mut state = 3_u64;
        let mut uniform = |low: f64, high: f64| {
            // Knuth's linear congruence.
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * ((state >> 11) as f64 / (1_u64 << 53) as f64)
        };
        let mut most = 0.0_f64;
        for case in 0..2000 {
            let entrance = uniform(0.0, 1.0) > 0.3;
            let (bend, sharpness) = (uniform(1.0 / 3.0, 1.0), uniform(2.0, 12.0));
            let lobes = (0..3).map(|_| RetroLobe {
                strength: uniform(-9.0, -1.0).exp(),
                roughness: [uniform(-7.0, -1.0).exp(); 2],
                entrance: entrance.then(|| EntranceLaw { slope: uniform(1.0, 6.0), bend, sharpness }),
            });
            let lobes = lobes.collect();
            let options = FitOptions { diffuse: uniform(0.0, 1.0) > 0.5, ..FitOptions::default() };
            let diffuse = if options.diffuse { uniform(-9.0, -1.0).exp() } else { 0.0 };
            let sheeting = Sheeting { lobes, diffuse, ..Sheeting::default() };
            let prepared = sheeting.prepare().unwrap();
            // Where a sharp bend is, the viewer's direction crosses it within the series.
            let entrance_deg = uniform(-40.0, 50.0);
            let mut observation_deg = 0.05;
            let rows: Vec<Observation> = (0..6)
                .map(|_| {
                    observation_deg += uniform(0.05, 1.5);
                    let angles = Goniometer::from_degrees(observation_deg, entrance_deg, 0.0, 0.0);
                    let geometry = Geometry::from(angles);
                    let row = seen(1.0, geometry);
                    let value = prepared.eval(geometry.wo, geometry.wi) * row.views[0].factor;
                    Observation { value: value * (1.0 + uniform(-NOISE, NOISE)), ..row }
                })
                .filter(|row| row.value > 1e-250)
                .collect();
            let bound = shape_bound(&rows, &options).map_or(0.0, |bound| bound.error);
            assert!(bound <= NOISE / (1.0 - NOISE), "{case}: {bound} {sheeting:?}");
            most = most.max(bound);
        }
        // Noise is found where nothing hides it.
        assert!(most > 0.5 * NOISE, "{most}");
    }

    #[test]
    fn full_cube_sheeting_is_no_sum_of_lobes() {
        let catalogue = Catalogue::embedded().unwrap();
        let class = catalogue.find("3m:dg3:white").unwrap();
        let rows = class.rows().iter().map(|row| Observation::from_row(row, Aim::Equal, None).unwrap());
        let bound = shape_bound(&rows.collect::<Vec<_>>(), &FitOptions::default()).unwrap();
        assert!((0.07..0.10).contains(&bound.error), "{bound:?}");
    }
}
