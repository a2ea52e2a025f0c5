//! The coefficient of retro-reflection over the observation or the entrance angle.

use catseye_photometry::{Geometry, Goniometer, Limit};

use super::axes::signed;
use super::canvas;
use super::chart::{Chart, Curve, Mark, legend};

/// Points of a curve.
const STEPS: u32 = 240;
/// Curves of one diagram: more can't be told apart.
pub(crate) const MOST_CURVES: usize = 8;

/// The angle of the horizontal axis; there is a curve for each of the other ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Over {
    /// The observation angle, a curve for each entrance angle
    Observation,
    /// The entrance angle, a curve for each observation angle
    Entrance,
}

impl Over {
    /// The angle's name, and that of the other one.
    fn names(self) -> [&'static str; 2] {
        match self {
            Self::Observation => ["observation angle", "entrance angle"],
            Self::Entrance => ["entrance angle", "observation angle"],
        }
    }

    /// The angle itself, and the other one.
    pub(crate) fn of(self, point: &Point) -> [f64; 2] {
        self.swapped([point.observation_deg, point.entrance_deg])
    }

    /// Observation and entrance angle from the angle and the other one, and back.
    fn swapped(self, [a, b]: [f64; 2]) -> [f64; 2] {
        if self == Self::Observation { [a, b] } else { [b, a] }
    }
}

/// A value to show beside the curves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) observation_deg: f64,
    pub(crate) entrance_deg: f64,
    /// In cd/lx/m2.
    pub(crate) r_a: f64,
    /// One standard deviation, in cd/lx/m2, where it is known.
    pub(crate) uncertainty: Option<f64>,
    pub(crate) limit: Limit,
}

/// What is to be shown.
#[derive(Clone, Debug)]
pub(crate) struct Request {
    pub(crate) title: String,
    /// What stands below the title, both above the diagram; nothing stands there without.
    pub(crate) subtitle: Option<String>,
    pub(crate) size: (u32, u32),
    pub(crate) over: Over,
    /// The other angle of each curve, ascending.
    pub(crate) curves_deg: Vec<f64>,
    /// The ends of the axis.
    pub(crate) x: [f64; 2],
    /// Between which angles there are values, where what lies beyond is to be shaded.
    pub(crate) known: Option<[f64; 2]>,
    pub(crate) points: Vec<Point>,
}

/// The curves of a function of the geometry that gives `R_A` in cd/lx/m2, and the values beside them; those
/// at angles without a curve are grey.
pub(crate) fn chart(
    request: Request,
    r_a: impl Fn(&Geometry) -> anyhow::Result<f64>,
) -> anyhow::Result<Chart> {
    let Request { over, x: [start, end], .. } = request;
    let value = |x: f64, other: f64| {
        let [observation, entrance] = over.swapped([x, other]);
        r_a(&Geometry::from(Goniometer::from_degrees(observation, entrance, 0.0, 0.0)))
    };
    let curve = |&other: &f64| -> anyhow::Result<Curve> {
        let at = |step: u32| {
            let x = start + (end - start) * f64::from(step) / f64::from(STEPS);
            value(x, other).map(|y| (x, y))
        };
        let points = (0..=STEPS).map(at).collect::<anyhow::Result<Vec<canvas::Point>>>()?;
        let label = format!("{}°", signed((100.0 * other).round() / 100.0));
        Ok(Curve { label, points })
    };
    let curves = request.curves_deg.iter().map(curve).collect::<anyhow::Result<_>>()?;
    let mark = |point: &Point| {
        let [x, other] = over.of(point);
        let curve = request.curves_deg.iter().position(|angle| (angle - other).abs() < 1e-9);
        Mark { x, y: point.r_a, uncertainty: point.uncertainty, limit: point.limit, curve }
    };
    let marks: Vec<Mark> = request.points.iter().map(mark).collect();
    let title = request.title;
    let heading =
        request.subtitle.map(|subtitle| [title.clone(), format!("{subtitle}   {}", legend(&marks))]);
    let [x_title, curve_title] = over.names();
    let titles = [x_title, "R_A in cd/lx/m²", curve_title].map(str::to_owned);
    Ok(Chart {
        title,
        heading,
        size: request.size,
        titles,
        x: [start, end],
        known: request.known,
        curves,
        marks,
    })
}
