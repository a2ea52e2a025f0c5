//! The report of a fit: one HTML page that needs nothing else.

use std::fmt::Write as _;

use catseye_photometry::fit::{Fit, Trial};
use catseye_photometry::{Quantity, Row};

use crate::plot::figure;
use crate::plot::ra::{Point, RaFigure, Request};

use super::outcome::{Outcome, describe, percent, short};

const STYLE: &str = "body{font:15px/1.5 system-ui,sans-serif;color:#22262b;max-width:60rem;\
margin:2rem auto;padding:0 1rem}\
table{border-collapse:collapse;margin:.5rem 0 1.5rem}th,td{padding:.2rem .8rem;text-align:right;\
border-bottom:1px solid #dde0e3}th:first-child,td:first-child{text-align:left}th{font-weight:600}\
.off{color:#b3261e}.good{color:#1b7f3b}svg{max-width:100%;height:auto}";

/// The whole page.
pub(crate) fn page(outcome: &Outcome<'_>) -> anyhow::Result<String> {
    let fit = outcome.fit;
    let title = escaped(&outcome.subject.title);
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n<h1>{title}</h1>\n<p>{}</p>\n",
        escaped(&describe(&fit.form))
    );
    let class = if fit.acceptable { "good" } else { "off" };
    let _ = writeln!(html, "<p class=\"{class}\">{}</p>", escaped(&outcome.verdict()));
    let said = [outcome.why_not(), outcome.reciprocity(), outcome.fault()];
    let remarks = outcome.subject.remarks.iter().chain(&fit.warnings).cloned();
    for line in outcome.accuracy().chain(said.into_iter().flatten()).chain(remarks) {
        let _ = writeln!(html, "<p>{}</p>", escaped(&line));
    }
    html.push_str(&curves(outcome, fit, "retro_reflective_bsdf")?);
    html.push_str("<h2>Numbers</h2>\n");
    numbers(&mut html, fit);
    if !outcome.subject.rows.is_empty() {
        html.push_str("<h2>Values</h2>\n");
        values(&mut html, outcome);
    }
    html.push_str("<h2>Models that were tried</h2>\n");
    trials(&mut html, &fit.trials, "");
    if let Some(beside) = outcome.beside {
        html.push_str("<h2>The same values with the back-vector GGX lobe</h2>\n");
        html.push_str(&curves(outcome, beside, "back-vector GGX")?);
        trials(&mut html, &beside.trials, "back-vector: ");
        numbers(&mut html, beside);
    }
    sources(&mut html, &outcome.subject.sources());
    html.push_str("</html>\n");
    Ok(html)
}

/// `R_A` over the observation angle with the table's values, as SVG; empty where the table has none.
fn curves(outcome: &Outcome<'_>, fit: &Fit, model: &str) -> anyhow::Result<String> {
    let is_r_a = |row: &&Row| row.quantity == Quantity::RetroReflectionCoefficient;
    let point = |row: &Row| {
        let Row { observation_deg, entrance_deg, limit, .. } = *row;
        row.value.map(|r_a| Point { observation_deg, entrance_deg, r_a, limit })
    };
    let points: Vec<Point> = outcome.subject.rows.iter().filter(is_r_a).filter_map(point).collect();
    if points.is_empty() {
        return Ok(String::new());
    }
    let mut entrance_deg: Vec<f64> = points.iter().map(|point| point.entrance_deg).collect();
    entrance_deg.sort_by(f64::total_cmp);
    entrance_deg.dedup();
    let end_deg = 1.3 * points.iter().map(|point| point.observation_deg).fold(0.0, f64::max);
    let prepared = fit.sheeting.prepare()?;
    let request = Request {
        title: format!("R_A of {}", outcome.subject.title),
        subtitle: format!("{model}: {}", describe(&fit.form)),
        entrance_deg,
        end_deg,
        points,
    };
    let figure = RaFigure::new(request, |geometry| {
        let f = prepared.eval(geometry.wo, geometry.wi);
        Ok(Quantity::RetroReflectionCoefficient.of_brdf(f, geometry).unwrap_or_default())
    })?;
    figure::svg(&figure)
}

fn sources(html: &mut String, sources: &[&str]) {
    if sources.is_empty() {
        return;
    }
    html.push_str("<h2>Sources</h2>\n<ul>\n");
    for source in sources {
        let _ = writeln!(html, "<li>{}</li>", escaped(source));
    }
    html.push_str("</ul>\n");
}

fn numbers(html: &mut String, fit: &Fit) {
    html.push_str("<table>\n<tr><th>number<th>value<th>one standard deviation<th></tr>\n");
    for estimate in &fit.estimates {
        let [low, high] = estimate.interval.map(short);
        let note = match (estimate.determined, estimate.at_bound) {
            (false, _) => "not determined by the data",
            (true, true) => "at the end of its range",
            (true, false) => "",
        };
        let (name, value) = (escaped(&estimate.meaning.name()), short(estimate.value));
        let _ = writeln!(html, "<tr><td>{name}<td>{value}<td>{low} to {high}<td>{note}</tr>");
    }
    html.push_str("</table>\n");
}

fn values(html: &mut String, outcome: &Outcome<'_>) {
    let beside = outcome.beside.map_or("", |_| "<th>back-vector");
    let _ = writeln!(
        html,
        "<table>\n<tr><th>quantity<th>observation<th>entrance<th>rotation<th>value<th>unit<th>model\
         <th>model/value{beside}</tr>"
    );
    for (i, (row, ratio)) in outcome.subject.rows.iter().zip(&outcome.fit.ratios).enumerate() {
        let Row { observation_deg, entrance_deg, rotation_deg, .. } = row;
        let value = row.value_as_written().unwrap_or(f64::NAN);
        let class = if (ratio - 1.0).abs() > outcome.tolerance { " class=\"off\"" } else { "" };
        let _ = write!(
            html,
            "<tr><td>{}<td>{observation_deg}°<td>{entrance_deg}°<td>{rotation_deg}°<td>{}<td>{}<td>{}\
             <td{class}>{ratio:.3}",
            row.quantity.symbol(),
            short(value),
            escaped(row.unit.symbol()),
            short(value * ratio),
        );
        if let Some(other) = outcome.beside.and_then(|fit| fit.ratios.get(i)) {
            let _ = write!(html, "<td>{other:.3}");
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</table>\n");
}

fn trials(html: &mut String, trials: &[Trial], prefix: &str) {
    html.push_str("<table>\n<tr><th>model<th>free numbers<th>worst<th>rms<th></tr>\n");
    for Trial { form, unknowns, worst, rms, fault } in trials {
        let (worst, rms, form) = (percent(*worst), percent(*rms), escaped(&describe(form)));
        let note = if fault.is_some() { "not physical over the entrance angle" } else { "" };
        let _ = writeln!(html, "<tr><td>{prefix}{form}<td>{unknowns}<td>{worst}<td>{rms}<td>{note}</tr>");
    }
    html.push_str("</table>\n");
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
