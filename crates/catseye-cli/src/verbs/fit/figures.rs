//! The diagrams of a fit's report, and what is said below each.

use catseye::Vec3;
use catseye_photometry::brdf::BrdfSample;
use catseye_photometry::fit::{Aim, Observation};
use catseye_photometry::{ApertureRule, Geometry, Limit, PreparedSheeting, Quantity, Row};

use super::outcome::{Outcome, angles_deg};
use crate::plot::axes::signed;
use crate::plot::chart::{Chart, Curve, Mark, legend};
use crate::plot::ra::{self, MOST_CURVES, Over, Point, Request};
use crate::plot::residuals::{Residual, Residuals};

const SIZE: (u32, u32) = (720, 400);
/// Curves of a diagram where there are values at more angles than it has room for.
const CHOSEN: usize = 6;
/// How far from a chosen angle a value may be to stand beside its curve: degrees of the entrance angle, share
/// of the observation angle.
const NEAR_DEG: f64 = 0.5;
const NEAR_SHARE: f64 = 0.05;
/// Marks of a diagram: of more, evenly as many.
const MOST_MARKS: usize = 300;
/// Where the axis of the entrance angle ends at least, as far as a fit is checked, and at most.
const LAST_ENTRANCE_DEG: [f64; 2] = [75.0, 88.0];
/// Steps of a BRDF's curve: mirror peaks are narrow.
const STEPS: u32 = 480;
/// Angle from the normal that a BRDF is drawn to, in degrees: beyond it measurements are bad.
const LAST_VIEW_DEG: f64 = 85.0;
/// How far from the plane of incidence a direction may be to stand for one in it: half a degree.
const IN_PLANE: f64 = 9e-3;

/// A diagram and what is said below it.
#[derive(Debug)]
pub(crate) struct Drawing<F> {
    pub(crate) figure: F,
    pub(crate) caption: String,
}

/// A BSDF as an instrument sees it: its mean over the apertures.
fn seen(prepared: &PreparedSheeting<'_>, rule: &ApertureRule, geometry: &Geometry) -> f64 {
    let directions = rule.directions(geometry.wo, geometry.wi);
    directions.map(|(wo, wi, weight)| weight * prepared.eval_with_surface(wo, wi)).sum()
}

/// `R_A` with the table's values; `None` where the table has none.
pub(crate) fn r_a(
    outcome: &Outcome<'_>,
    rule: &ApertureRule,
    over: Over,
) -> anyhow::Result<Option<Drawing<Chart>>> {
    let all = points(outcome);
    if all.is_empty() {
        return Ok(None);
    }
    let (curves_deg, points) = chosen(&all, over);
    let known = ends(all.iter().map(|point| over.of(point)[0]));
    let curves = curves_deg.len();
    let request = Request {
        title: format!("R_A of {}", outcome.subject.title),
        subtitle: None,
        size: SIZE,
        over,
        curves_deg,
        x: axis(over, known),
        known: Some(known),
        points,
    };
    let prepared = outcome.fit.sheeting.prepare()?;
    let figure = ra::chart(request, |geometry| {
        let f = seen(&prepared, rule, geometry);
        Ok(Quantity::RetroReflectionCoefficient.of_brdf(f, geometry).unwrap_or_default())
    })?;
    let mut caption = format!("Lines: the material; {}.", legend(&figure.marks).replace("   ", ", "));
    if figure.marks.len() < all.len() {
        caption += &format!(" {curves} angles and {} of {} values are drawn.", figure.marks.len(), all.len());
    }
    if figure.marks.iter().any(|mark| mark.uncertainty.is_some()) {
        caption += " Bars: one standard deviation of the value.";
    }
    caption += " Grey: beyond the values.";
    Ok(Some(Drawing { figure, caption }))
}

/// The values that are `R_A`.
fn points(outcome: &Outcome<'_>) -> Vec<Point> {
    let is_r_a = |row: &&Row| row.quantity == Quantity::RetroReflectionCoefficient;
    let point = |row: &Row| {
        let Row { observation_deg, entrance_deg, limit, .. } = *row;
        row.value.map(|r_a| Point { observation_deg, entrance_deg, r_a, uncertainty: row.uncertainty, limit })
    };
    outcome.subject.rows.iter().filter(is_r_a).filter_map(point).collect()
}

/// Which angles have a curve, and the values beside them: all of a table, of many angles some.
fn chosen(all: &[Point], over: Over) -> (Vec<f64>, Vec<Point>) {
    let mut angles: Vec<f64> = all.iter().map(|point| over.of(point)[1]).collect();
    angles.sort_by(f64::total_cmp);
    angles.dedup();
    if angles.len() > MOST_CURVES {
        angles = evenly(&angles, CHOSEN);
    }
    let beside = |point: &Point| {
        let near = |angle: f64| match over {
            Over::Observation => NEAR_DEG,
            Over::Entrance => NEAR_SHARE * angle,
        };
        let other = over.of(point)[1];
        let angle = *angles.iter().find(|angle| (**angle - other).abs() <= near(**angle))?;
        Some(match over {
            Over::Observation => Point { entrance_deg: angle, ..*point },
            Over::Entrance => Point { observation_deg: angle, ..*point },
        })
    };
    let points: Vec<Point> = all.iter().filter_map(beside).collect();
    let points = evenly(&points, MOST_MARKS);
    (angles, points)
}

/// At most so many of them, the first and the last among them.
fn evenly<T: Clone>(all: &[T], most: usize) -> Vec<T> {
    if all.len() <= most {
        return all.to_vec();
    }
    (0..most).map(|i| all[i * (all.len() - 1) / (most - 1)].clone()).collect()
}

fn ends(angles: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    [angles.clone().fold(f64::INFINITY, f64::min), angles.fold(f64::NEG_INFINITY, f64::max)]
}

/// The ends of the axis.
fn axis(over: Over, [first, last]: [f64; 2]) -> [f64; 2] {
    match over {
        Over::Observation => [0.0, 1.3 * last],
        Over::Entrance => {
            let start = if first < 0.0 { 10.0 * (0.1 * (first - 1.0)).floor() } else { 0.0 };
            let [least, most] = LAST_ENTRANCE_DEG;
            [start.max(-most), least.max(last + 2.0).min(most)]
        }
    }
}

/// How far the model is from each value near the retro direction.
pub(crate) fn residuals(outcome: &Outcome<'_>) -> Drawing<Residuals> {
    let rows = outcome.observations.iter().zip(&outcome.fit.ratios);
    let residual = |(row, &ratio): (&Observation, &f64)| Residual {
        angles_deg: angles_deg(row),
        ratio,
        is_met: outcome.is_met(row.aim, ratio),
    };
    let all: Vec<Residual> = rows.filter(|(row, _)| row.is_retro()).map(residual).collect();
    let (off, met): (Vec<Residual>, Vec<Residual>) = all.iter().partition(|row| !row.is_met);
    let rows: Vec<Residual> = evenly(&met, MOST_MARKS).into_iter().chain(evenly(&off, MOST_MARKS)).collect();
    let tolerance = outcome.row_tolerance();
    let band = if tolerance.is_some() { " Green band: the tolerance; red: beyond it." } else { "" };
    let mut caption = format!("Every dot is a value, and by how much the material is off.{band}");
    if outcome.observations.iter().any(|row| row.aim == Aim::AtLeast) {
        caption += " Minima are met from the value on upwards.";
    }
    if rows.len() < all.len() {
        caption += &format!(" {} of {} values are drawn.", rows.len(), all.len());
    }
    Drawing { figure: Residuals { rows, tolerance }, caption }
}

/// A measured BRDF in the plane of incidence, within an angle from the lamp, a curve for each direction of
/// the light; `None` of a table, and of a file without samples there.
pub(crate) fn brdf(
    outcome: &Outcome<'_>,
    rule: &ApertureRule,
    reach_deg: f64,
) -> anyhow::Result<Option<Drawing<Chart>>> {
    let Some(file) = outcome.subject.brdf() else { return Ok(None) };
    let samples = file.samples.iter().filter_map(in_plane);
    let samples: Vec<[f64; 3]> = samples.filter(|[_, x, y]| x.abs() <= reach_deg && *y > 0.0).collect();
    if samples.is_empty() {
        return Ok(None);
    }
    let mut lights: Vec<f64> = samples.iter().map(|[light, ..]| *light).collect();
    lights.sort_by(f64::total_cmp);
    lights.dedup();
    let lights = if lights.len() > MOST_CURVES { evenly(&lights, CHOSEN) } else { lights };
    let known = ends(samples.iter().map(|[_, x, _]| *x));
    let margin = 0.05 * (known[1] - known[0]).max(1.0);
    let x = [known[0] - margin, known[1] + margin];
    let prepared = outcome.fit.sheeting.prepare()?;
    let curve = |&light: &f64| {
        let at = |step: u32| {
            let x = x[0] + (x[1] - x[0]) * f64::from(step) / f64::from(STEPS);
            let [wo, wi] = [light + x, light].map(|deg| Vec3::from_angles(deg.to_radians(), 0.0));
            (x, seen(&prepared, rule, &Geometry { wo, wi }))
        };
        let points = (0..=STEPS).map(at).filter(|(x, _)| (light + x).abs() < LAST_VIEW_DEG).collect();
        Curve { label: format!("{}°", signed(light)), points }
    };
    let mark = |&[light, x, y]: &[f64; 3]| {
        let curve = lights.iter().position(|other| *other == light)?;
        Some(Mark { x, y, uncertainty: None, limit: Limit::Typical, curve: Some(curve) })
    };
    let marks: Vec<Mark> = samples.iter().filter_map(mark).collect();
    let figure = Chart {
        title: format!("BRDF of {}", outcome.subject.title),
        heading: None,
        size: SIZE,
        titles: ["viewer's angle from the lamp, away from the normal", "BRDF in 1/sr", "lamp at"]
            .map(str::to_owned),
        x,
        known: Some(known),
        curves: lights.iter().map(curve).collect(),
        marks: evenly(&marks, MOST_MARKS),
    };
    let (shown, all) = (figure.marks.len(), file.samples.len());
    let caption = format!(
        "Lines: the material as the instrument sees it. Dots: {shown} of the file's {all} samples, in the \
         plane of incidence."
    );
    Ok(Some(Drawing { figure, caption }))
}

/// Of a sample in the plane of incidence: the light's angle from the normal to a tenth of a degree, how much
/// farther from the normal the viewer is, both in degrees, and the value.
fn in_plane(sample: &BrdfSample) -> Option<[f64; 3]> {
    let BrdfSample { wo, wi, .. } = *sample;
    let length = wi.x.hypot(wi.y);
    // Light along the normal has all planes.
    let [x, y] = if length > IN_PLANE { [wi.x / length, wi.y / length] } else { [1.0, 0.0] };
    let (along, across) = (wo.x * x + wo.y * y, wo.y * x - wo.x * y);
    let light = length.atan2(wi.z).to_degrees();
    let viewer = along.atan2(wo.z).to_degrees();
    (across.abs() < IN_PLANE && viewer.abs() < LAST_VIEW_DEG)
        .then(|| [(10.0 * light).round() / 10.0, viewer - light, sample.luminance()])
}
