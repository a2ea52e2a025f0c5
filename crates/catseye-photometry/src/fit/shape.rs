//! What no sum of lobes can do: the proof that a table can't be fitted.

use catseye::Vec3;

use super::observation::{Aim, Observation};
use crate::Geometry;

/// Directions to the source that differ by less than this are one series of a table.
const SAME_DIRECTION: f64 = 1e-6;

/// Three rows of a table that no sum of disk lobes comes closer to.
///
/// Along a series of observation angles in one plane, every disk lobe is exp(-(n+1) u) in u = -ln(1 - |d|^2),
/// times a factor that all lobes share. A sum of such terms is log-convex in u, a diffuse base included,
/// whatever their number, widths and strengths: between two rows it lies below the line through them. A table
/// whose middle value lies above that line, because it falls slowly at first and then fast, is missed by at
/// least half the distance. (The entrance factors are taken as constant over the observation angle, a degree
/// or two.)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeBound {
    /// The rows, from the least observation angle to the greatest.
    pub rows: [usize; 3],
    /// The error that at least one of them has with any sum of lobes, as a share of the value.
    pub error: f64,
}

/// A row on the scale where lobes are straight lines.
struct Point {
    row: usize,
    wi: Vec3<f64>,
    /// The direction of the offset d, up to its sign.
    plane: f64,
    u: f64,
    log: f64,
}

/// The three rows that are farthest from what a sum of lobes can do, if any are.
#[must_use]
pub(crate) fn shape_bound(observations: &[Observation]) -> Option<ShapeBound> {
    let mut points: Vec<Point> =
        observations.iter().enumerate().filter_map(|(row, observation)| point(row, observation)).collect();
    points.sort_by(|a, b| a.u.total_cmp(&b.u));
    let mut worst: Option<ShapeBound> = None;
    for (i, first) in points.iter().enumerate() {
        for (j, last) in points.iter().enumerate().skip(i + 2).filter(|(_, last)| last.is_beside(first)) {
            for middle in points[i + 1..j].iter().filter(|middle| middle.is_beside(first)) {
                let span = last.u - first.u;
                let line = first.log + (last.log - first.log) * (middle.u - first.u) / span;
                let error = (0.5 * (middle.log - line)).exp_m1();
                if span > 0.0 && error > worst.map_or(0.0, |bound| bound.error) {
                    worst = Some(ShapeBound { rows: [first.row, middle.row, last.row], error });
                }
            }
        }
    }
    worst
}

fn point(row: usize, observation: &Observation) -> Option<Point> {
    let [view] = observation.views[..] else { return None };
    if observation.aim != Aim::Equal {
        return None;
    }
    let (wo, wi) = (view.wo, view.wi);
    let (sum, low, high) = (wo.z + wi.z, wo.z.min(wi.z), wo.z.max(wi.z));
    let geometry = Geometry { wo, wi };
    let d = geometry.scaled_offset().map(|x| x / sum);
    let shared = view.factor * low / (high * high * sum);
    let u = -(-(d[0] * d[0] + d[1] * d[1])).ln_1p();
    Some(Point { row, wi, plane: geometry.offset_plane(), u, log: (observation.value / shared).ln() })
}

impl Point {
    /// Whether both rows belong to one series: the same direction to the source, the same plane.
    fn is_beside(&self, other: &Self) -> bool {
        let d = [self.wi.x - other.wi.x, self.wi.y - other.wi.y, self.wi.z - other.wi.z];
        let turn = (self.plane - other.plane).abs();
        d.iter().all(|x| x.abs() < SAME_DIRECTION) && turn.min(core::f64::consts::PI - turn) < SAME_DIRECTION
    }
}
