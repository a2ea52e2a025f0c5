//! The result of a fit as text and as JSON.

use std::fmt::Write as _;

use catseye_photometry::brdf::{Metrics, Part, Region};
use catseye_photometry::fit::{Aim, EntranceKind, Estimate, Fault, Fit, Form, Observation};
use catseye_photometry::half_power::half_power_angle;
use catseye_photometry::{Row, significant};
use serde_json::{Value, json};

use super::subject::Subject;

/// Rows that are listed: of more, half as many.
const MOST_ROWS: usize = 80;

/// A fit and all that is said of it.
#[derive(Clone, Debug)]
pub(crate) struct Outcome<'a> {
    /// What was fitted.
    pub(crate) subject: &'a Subject,
    /// The same as the fit saw it.
    pub(crate) observations: &'a [Observation],
    /// How good the fit is in the regions of a measured BRDF.
    pub(crate) parts: &'a [Part],
    /// The fit.
    pub(crate) fit: &'a Fit,
    /// The same table fitted with the back-vector lobe.
    pub(crate) beside: Option<&'a Fit>,
    /// The worst error that is accepted.
    pub(crate) tolerance: f64,
    /// Whether that is of the root mean square.
    pub(crate) of_rms: bool,
}

impl Outcome<'_> {
    /// One sentence: how good the fit is.
    pub(crate) fn verdict(&self) -> String {
        let word = if self.fit.acceptable { "accepted" } else { "not accepted" };
        format!("{word}: {}", self.reason())
    }

    /// The same without the word: what decided, in the sense in which the tolerance was asked for.
    pub(crate) fn reason(&self) -> String {
        let (rows, worst, rms) = (self.observations.len(), percent(self.fit.worst), percent(self.fit.rms));
        let tolerance = percent(self.tolerance);
        if let Some(metrics) = self.metrics() {
            let (count, most) = (metrics.count, percent(metrics.percentile_95()));
            return format!(
                "rms of the {count} samples around the incident direction {rms}, 95 % of them within {most}, \
                 {}, tolerance {tolerance}",
                self.all_but(metrics)
            );
        }
        let limits =
            self.observations.iter().zip(&self.fit.ratios).filter(|(row, _)| row.aim == Aim::AtLeast);
        let spare = limits.map(|(_, ratio)| ratio - 1.0).reduce(f64::max);
        let spare =
            spare.map_or(String::new(), |spare| format!(", minima exceeded by at most {}", percent(spare)));
        if self.of_rms {
            return format!(
                "rms of {rows} values {rms}, tolerance {tolerance} rms; worst {worst} off{spare}"
            );
        }
        let noun = if rows == 1 { "value" } else { "values" };
        format!("worst of {rows} {noun} {worst} off, rms {rms}, tolerance {tolerance}{spare}")
    }

    /// What each row may be off, where there is such a limit.
    pub(crate) fn row_tolerance(&self) -> Option<f64> {
        (!self.of_rms).then_some(self.tolerance)
    }

    /// Whether a row is within its tolerance.
    pub(crate) fn is_met(&self, aim: Aim, ratio: f64) -> bool {
        let Some(tolerance) = self.row_tolerance() else { return true };
        let is_below = aim != Aim::AtMost && ratio < 1.0 - tolerance;
        let is_above = aim != Aim::AtLeast && ratio > 1.0 + tolerance;
        !(is_below || is_above)
    }

    /// What was fitted: how many values of what, and the angles that they cover.
    pub(crate) fn fitted(&self) -> String {
        let mut quantities: Vec<&str> = Vec::new();
        for symbol in self.subject.rows.iter().map(|row| row.quantity.symbol()) {
            if !quantities.contains(&symbol) {
                quantities.push(symbol);
            }
        }
        let what = if quantities.is_empty() { "the BRDF".to_owned() } else { quantities.join(" and ") };
        let retro = self.observations.iter().filter(|row| row.is_retro()).map(angles_deg);
        let [observation, entrance] = [0, 1].map(|i| range(retro.clone().map(|angles| angles[i])));
        let count = self.observations.len();
        let noun = if count == 1 { "value" } else { "values" };
        format!("{count} {noun} of {what}, observation {observation} deg, entrance {entrance} deg")
    }

    /// The rows to list with their ratios and whether they are met: all of a table, of a long one those that
    /// are farthest off, in their order.
    pub(crate) fn shown_rows(&self) -> Vec<(&Row, f64, bool)> {
        let rows = self.subject.rows.iter().zip(self.observations).zip(&self.fit.ratios);
        let rows = rows.map(|((row, seen), &ratio)| (row, ratio, self.is_met(seen.aim, ratio)));
        let mut rows: Vec<(usize, (&Row, f64, bool))> = rows.enumerate().collect();
        if rows.len() > MOST_ROWS {
            rows.sort_by(|(_, a), (_, b)| b.1.ln().abs().total_cmp(&a.1.ln().abs()));
            rows.truncate(MOST_ROWS / 2);
            rows.sort_by_key(|(i, _)| *i);
        }
        rows.into_iter().map(|(_, row)| row).collect()
    }

    /// How good the model of a measured BRDF is around the incident direction.
    fn metrics(&self) -> Option<&Metrics> {
        let part = self.parts.iter().find(|part| part.region == Region::Retro)?;
        Some(&part.metrics)
    }

    /// How good the model of a measured BRDF is in each of its regions.
    pub(crate) fn accuracy(&self) -> impl Iterator<Item = String> {
        self.parts.iter().map(|Part { name, metrics, .. }| {
            format!(
                "{name}: {} samples, log-RMSE {:.3}, NRMSE {:.4}, 95 % of them within {}, {}",
                metrics.count,
                metrics.log_rmse,
                metrics.nrmse,
                percent(metrics.percentile_95()),
                self.all_but(metrics),
            )
        })
    }

    /// How many samples of a measured BRDF are no outliers.
    pub(crate) fn all_but(&self, metrics: &Metrics) -> String {
        let limit = percent(Metrics::outlying(self.tolerance));
        match metrics.outliers(self.tolerance) {
            0 => format!("all within {}", percent(metrics.worst())),
            outliers => format!("all but {outliers} within {limit}"),
        }
    }

    /// Why the tolerance can't be met, where that is known.
    pub(crate) fn why_not(&self) -> Option<String> {
        let bound = self.fit.shape?;
        let [first, middle, last] = bound.rows.map(|row| self.subject.rows.get(row));
        let (first, middle, last) = (first?, middle?, last?);
        Some(format!(
            "no sum of lobes comes closer than {} to the values at entrance {} deg and observation {}, {} \
             and {} deg ({}, {}, {}): they fall slowly at first and then fast, and a sum of \
             lobes does the reverse",
            percent(bound.error),
            first.entrance_deg,
            first.observation_deg,
            middle.observation_deg,
            last.observation_deg,
            short(first.value_as_written().unwrap_or(f64::NAN)),
            short(middle.value_as_written().unwrap_or(f64::NAN)),
            short(last.value_as_written().unwrap_or(f64::NAN)),
        ))
    }

    /// What the back-vector lobe makes of the same table.
    pub(crate) fn comparison(&self) -> Option<String> {
        let beside = self.beside?;
        let how = match self.parts {
            [] => format!("worst {} off", percent(beside.worst)),
            _ => format!("rms {}", percent(beside.rms)),
        };
        Some(format!("beside it, back-vector GGX: {}, {how}", describe(&beside.form)))
    }

    /// What it costs that the entrance laws see the direction to the viewer only.
    pub(crate) fn reciprocity(&self) -> Option<String> {
        let cost = self.fit.reciprocity_cost(self.observations);
        (cost > 0.0).then(|| {
            format!(
                "the entrance laws see the viewer's direction, as a node graph must: with viewer and light \
                 exchanged the values differ by at most {}",
                percent(cost)
            )
        })
    }

    /// Where the material is not what sheeting can be, if anywhere.
    pub(crate) fn fault(&self) -> Option<String> {
        let Fault { observation_deg, entrance_deg: [from, to], r_a: [before, after] } = self.fit.fault?;
        Some(format!(
            "at observation {} deg R_A goes from {} at entrance {from} deg to {} at {to} deg, which no \
             sheeting does",
            short(observation_deg),
            short(before),
            short(after)
        ))
    }

    /// The result for people.
    pub(crate) fn text(&self) -> String {
        let mut text = String::new();
        let title = &self.subject.title;
        let _ = writeln!(text, "{title}: {}", describe(&self.fit.form));
        let _ = writeln!(text, "fitted to {}\n", self.fitted());
        let origin = self.fit.deviation.origin();
        let _ = writeln!(text, "{:<28} {:>12}   one standard deviation, {origin}", "number", "value");
        for estimate in &self.fit.estimates {
            let (name, value) = (estimate.meaning.name(), short(estimate.value));
            let _ = writeln!(text, "{name:<28} {value:>12}   {}", interval(estimate, 4));
        }
        for (i, lobe) in self.fit.sheeting.lobes.iter().enumerate() {
            if let Ok(angle) = half_power_angle(lobe.roughness[0]) {
                let name = format!("lobe {} half-power angle", i + 1);
                let _ = writeln!(text, "{name:<28} {:>8} deg", short(angle.to_degrees()));
            }
        }
        if let Some(roughness) = self.coat_roughness() {
            let _ = writeln!(text, "{:<28} {:>12}", "coat roughness", short(roughness));
        }
        self.rows(&mut text);
        let _ = write!(text, "\n{}", self.verdict());
        let more = [self.why_not(), self.comparison(), self.reciprocity(), self.fault()];
        for line in self.accuracy().chain(more.into_iter().flatten()).chain(self.warnings()) {
            let _ = write!(text, "\n{line}");
        }
        text
    }

    /// Roughness of the coat that a mirror peak has.
    pub(crate) fn coat_roughness(&self) -> Option<f64> {
        Some(self.fit.sheeting.coat_roughness).filter(|roughness| *roughness > 0.0)
    }

    /// The values one by one.
    fn rows(&self, text: &mut String) {
        let (rows, all) = (self.shown_rows(), self.subject.rows.len());
        if rows.is_empty() {
            return;
        }
        let _ = writeln!(
            text,
            "\nobservation   entrance   rotation  quantity        value        model   model/value"
        );
        for (row, ratio, _) in &rows {
            let value = row.value_as_written().unwrap_or(f64::NAN);
            let _ = writeln!(
                text,
                "{:>7} deg {:>6} deg {:>6} deg  {:<8} {:>12} {:>12}   {ratio:.3}",
                row.observation_deg,
                row.entrance_deg,
                row.rotation_deg,
                row.quantity.symbol(),
                short(value),
                short(value * ratio),
            );
        }
        if rows.len() < all {
            let _ =
                writeln!(text, "the {} of {all} values that are farthest off; --json has all", rows.len());
        }
    }

    fn warnings(&self) -> impl Iterator<Item = String> {
        let all = self.subject.remarks.iter().chain(&self.fit.warnings).cloned().chain(self.open_numbers());
        all.map(|warning| format!("warning: {warning}"))
    }

    /// The numbers that the values leave open or that are at the end of their range, a sentence each.
    fn open_numbers(&self) -> impl Iterator<Item = String> {
        self.fit.estimates.iter().filter_map(Estimate::warning)
    }

    /// The result for programs.
    pub(crate) fn json(&self) -> Value {
        let estimate = |e: &Estimate| {
            json!({
                "name": e.meaning.name(), "value": e.value,
                "low": e.interval.map(|interval| interval[0]), "high": e.interval.map(|interval| interval[1]),
                "determined": e.determined, "at_bound": e.at_bound,
            })
        };
        let row = |(row, ratio): (&Row, &f64)| {
            let value = row.value_as_written();
            json!({
                "observation_deg": row.observation_deg, "entrance_deg": row.entrance_deg,
                "rotation_deg": row.rotation_deg, "quantity": row.quantity.symbol(),
                "unit": row.unit.symbol(),
                "value": value, "model": value.map(|value| value * ratio), "ratio": ratio,
            })
        };
        let beside = self.beside.map(|fit| {
            json!({
                "form": describe(&fit.form), "numbers": fit.estimates.len(),
                "worst": fit.worst, "rms": fit.rms,
            })
        });
        let part = |Part { name, metrics, .. }: &Part| {
            json!({
                "region": name, "samples": metrics.count, "log_rmse": metrics.log_rmse, "nrmse": metrics.nrmse,
                "percentile_95": metrics.percentile_95(), "worst": metrics.worst(),
                "outliers": metrics.outliers(self.tolerance),
            })
        };
        json!({
            "name": self.subject.name, "title": self.subject.title, "form": describe(&self.fit.form),
            "accepted": self.fit.acceptable, "tolerance": self.tolerance,
            "worst": self.fit.worst, "rms": self.fit.rms,
            "numbers": self.fit.estimates.iter().map(estimate).collect::<Vec<_>>(),
            "rows": self.subject.rows.iter().zip(&self.fit.ratios).map(row).collect::<Vec<_>>(),
            "reciprocity_cost": self.fit.reciprocity_cost(self.observations), "fault": self.fault(),
            "nrmse": self.metrics().map(|m| m.nrmse), "log_rmse": self.metrics().map(|m| m.log_rmse),
            "coat_ior": self.fit.form.coat_ior, "coat_roughness": self.coat_roughness(),
            "regions": self.parts.iter().map(part).collect::<Vec<_>>(),
            "remarks": self.subject.remarks, "why_not": self.why_not(), "back_vector": beside,
            "warnings": self.fit.warnings.iter().cloned().chain(self.open_numbers()).collect::<Vec<_>>(),
        })
    }
}

/// Observation and entrance angle in degrees; below 0 where the normal is tipped away from the receiver.
pub(crate) fn angles_deg(row: &Observation) -> [f64; 2] {
    let centre = row.centre();
    let [observation, entrance] = [centre.observation(), centre.entrance()].map(f64::to_degrees);
    [observation, if centre.wo.z < centre.wi.z { -entrance } else { entrance }]
}

/// The ends of some angles in degrees, to a hundredth.
fn range(angles: impl Iterator<Item = f64> + Clone) -> String {
    let round = |angle: f64| (100.0 * angle).round() / 100.0 + 0.0;
    let low = round(angles.clone().fold(f64::INFINITY, f64::min));
    let high = round(angles.fold(f64::NEG_INFINITY, f64::max));
    if low == high { low.to_string() } else { format!("{low} to {high}") }
}

/// A form in words.
pub(crate) fn describe(form: &Form) -> String {
    let lobes = if form.lobes == 1 { "1 lobe".to_owned() } else { format!("{} lobes", form.lobes) };
    let entrance = match form.entrance {
        EntranceKind::Constant => ", the same at every entrance angle",
        EntranceKind::Power => ", a power of the entrance angle's cosine",
        EntranceKind::Bend => ", a law of the entrance angle with a bend",
    };
    let own = match (form.entrance, form.shared || form.lobes == 1) {
        (EntranceKind::Constant, _) | (_, true) => "",
        (EntranceKind::Power, _) => " for each",
        (EntranceKind::Bend, _) => " and a power for each",
    };
    let base = if form.diffuse { ", a diffuse base" } else { "" };
    let coat = form.coat_ior.map_or(String::new(), |ior| format!(", a clear coat of index {}", short(ior)));
    format!("{lobes}{entrance}{own}{base}{coat}")
}

/// One standard deviation below and above.
pub(crate) fn interval(estimate: &Estimate, digits: i32) -> String {
    let Some(ends) = estimate.interval else { return "not known".to_owned() };
    ends.map(|end| significant(end, digits)).join(" to ")
}

/// A share in percent.
pub(crate) fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// Four digits.
pub(crate) fn short(value: f64) -> String {
    significant(value, 4)
}
