//! The result of a fit as text and as JSON.

use std::fmt::Write as _;

use catseye_photometry::brdf::{Metrics, Part, Region};
use catseye_photometry::fit::{Aim, EntranceKind, Fault, Fit, Form, Observation};
use catseye_photometry::half_power::half_power_angle;
use catseye_photometry::significant;
use serde_json::{Value, json};

use super::subject::Subject;

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
}

impl Outcome<'_> {
    /// One sentence: how good the fit is.
    pub(crate) fn verdict(&self) -> String {
        let (rows, worst, rms) = (self.observations.len(), percent(self.fit.worst), percent(self.fit.rms));
        let word = if self.fit.acceptable { "accepted" } else { "not accepted" };
        let tolerance = percent(self.tolerance);
        if let Some(metrics) = self.metrics() {
            let (count, most) = (metrics.count, percent(metrics.percentile_95()));
            return format!(
                "{word}: rms of the {count} samples around the incident direction {rms}, 95 % of them within \
                 {most}, {}, tolerance {tolerance}",
                self.all_but(metrics)
            );
        }
        let limits =
            self.observations.iter().zip(&self.fit.ratios).filter(|(row, _)| row.aim == Aim::AtLeast);
        let spare = limits.map(|(_, ratio)| ratio - 1.0).reduce(f64::max);
        let spare =
            spare.map_or(String::new(), |spare| format!(", minima exceeded by at most {}", percent(spare)));
        format!("{word}: worst of {rows} values {worst} off, rms {rms}, tolerance {tolerance}{spare}")
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
    fn all_but(&self, metrics: &Metrics) -> String {
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
            "at observation {} deg R_A goes from {} at entrance {from} deg to {} at {to} deg, which no sheeting does",
            short(observation_deg),
            short(before),
            short(after)
        ))
    }

    /// The result for people.
    pub(crate) fn text(&self) -> String {
        let mut text = String::new();
        let title = &self.subject.title;
        let _ = writeln!(text, "{title}: {}\n", describe(&self.fit.form));
        let _ = writeln!(text, "{:<28} {:>12}   one standard deviation", "number", "value");
        for estimate in &self.fit.estimates {
            let [low, high] = estimate.interval;
            let (name, value) = (estimate.meaning.name(), short(estimate.value));
            let _ = writeln!(text, "{name:<28} {value:>12}   {} to {}", short(low), short(high));
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
    fn coat_roughness(&self) -> Option<f64> {
        Some(self.fit.sheeting.coat_roughness).filter(|roughness| *roughness > 0.0)
    }

    /// The values one by one.
    fn rows(&self, text: &mut String) {
        if self.subject.rows.is_empty() {
            return;
        }
        let _ = writeln!(
            text,
            "\nobservation   entrance   rotation  quantity        value        model   model/value"
        );
        for (row, ratio) in self.subject.rows.iter().zip(&self.fit.ratios) {
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
    }

    fn warnings(&self) -> impl Iterator<Item = String> {
        let all = self.subject.remarks.iter().chain(&self.fit.warnings);
        all.map(|warning| format!("warning: {warning}"))
    }

    /// The result for programs.
    pub(crate) fn json(&self) -> Value {
        let estimate = |e: &catseye_photometry::fit::Estimate| {
            json!({
                "name": e.meaning.name(), "value": e.value, "low": e.interval[0], "high": e.interval[1],
                "determined": e.determined, "at_bound": e.at_bound,
            })
        };
        let row = |(row, ratio): (&catseye_photometry::Row, &f64)| {
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
            "warnings": self.fit.warnings,
        })
    }
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

/// A share in percent.
pub(crate) fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// Four digits.
pub(crate) fn short(value: f64) -> String {
    significant(value, 4)
}
