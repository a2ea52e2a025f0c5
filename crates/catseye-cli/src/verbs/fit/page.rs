//! The report of a fit: one HTML page that needs nothing else, to look at and to print.

use catseye_photometry::brdf::Part;
use catseye_photometry::fit::{Estimate, Trial};
use catseye_photometry::standards::{Catalogue, StandardClass};
use catseye_photometry::verdict::{Check, Kind, Standing, Verdict, verdicts};
use catseye_photometry::{Apertures, Colour, Geometry, Limit, Quantity, Unit};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::figures::{self, Drawing};
use super::outcome::{Outcome, describe, interval, percent, short};
use super::provenance;
use crate::plot::axes::signed;
use crate::plot::figure::{self, Figure};
use crate::plot::ra::Over;

const STYLE: &str = include_str!("page.css");
/// Classes that are failed and listed: those that are missed by least.
const MOST_FAILED: usize = 5;
/// A measured BRDF is drawn up to this angle from the lamp, and as a whole.
const NEAR_DEG: f64 = 20.0;

/// What the page needs beside the outcome.
#[derive(Debug)]
pub(crate) struct Context<'a> {
    /// What the page is about.
    pub(crate) title: &'a str,
    /// The instrument's apertures.
    pub(crate) apertures: Apertures,
    /// The material's colour.
    pub(crate) colour: Colour,
    /// Area of a whole reflector.
    pub(crate) area_m2: Option<f64>,
    /// The file that the material goes to, where it is written.
    pub(crate) material: Option<String>,
}

/// The whole page.
pub(crate) fn page(outcome: &Outcome<'_>, context: &Context<'_>) -> anyhow::Result<String> {
    let (title, rule) = (context.title, &context.apertures.rule()?);
    let source = &outcome.subject.title;
    let fitted_to = if source == title { "photometric values" } else { source.as_str() };
    let drawings = [
        drawing(figures::r_a(outcome, rule, Over::Observation)?)?,
        drawing(figures::r_a(outcome, rule, Over::Entrance)?)?,
        drawing(figures::brdf(outcome, rule, NEAR_DEG)?)?,
        drawing(figures::brdf(outcome, rule, 180.0)?)?,
        drawing(Some(figures::residuals(outcome)))?,
    ];
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="generator" content=(concat!("catseye ", env!("CARGO_PKG_VERSION")));
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { (title) }
                p.kind { "Retro-reflective material fitted to " (fitted_to) }
                (verdict(outcome))
                (facts(outcome, context)?)
                (notes(outcome))
                h2 { "Diagrams" }
                @for drawing in &drawings { (drawing) }
                (standards(outcome, context)?)
                @if !outcome.subject.rows.is_empty() { (values(outcome)) }
                h2 { "The material" }
                p { (describe(&outcome.fit.form)) "." }
                (numbers(outcome))
                (remarks(outcome))
                (models(outcome))
            }
        }
    };
    Ok(page.into_string() + "\n")
}

fn drawing<F: Figure>(drawing: Option<Drawing<F>>) -> anyhow::Result<Markup> {
    let Some(Drawing { figure, caption }) = drawing else { return Ok(html! {}) };
    let svg = figure::svg(&figure)?;
    Ok(html! { figure { (PreEscaped(svg)) figcaption { (caption) } } })
}

/// The answer, before everything else.
fn verdict(outcome: &Outcome<'_>) -> Markup {
    let is_good = outcome.fit.acceptable;
    html! {
        div.verdict.good[is_good].off[!is_good] {
            p { b { (if is_good { "Accepted" } else { "Not accepted" }) } }
            p { (capital(&outcome.reason())) "." }
            @for line in [outcome.fault(), outcome.why_not()].into_iter().flatten() {
                p { (capital(&line)) "." }
            }
        }
    }
}

/// Where the result comes from.
fn facts(outcome: &Outcome<'_>, context: &Context<'_>) -> anyhow::Result<Markup> {
    let subject = outcome.subject;
    let Apertures { source, receiver } = context.apertures;
    let apertures = if source.max(receiver) > 0.0 {
        let [source, receiver] = [source, receiver].map(|angle| short(angle.to_degrees()));
        format!("source {source}\u{b0}, receiver {receiver}\u{b0}")
    } else {
        "points (no aperture was given)".to_owned()
    };
    Ok(html! {
        table.facts {
            tr { th { "Date" } td { (provenance::date()?) } }
            tr { th { "Program" } td { "catseye " (env!("CARGO_PKG_VERSION")) } }
            tr { th { "Command" } td { code { "catseye " (provenance::command_line()) } } }
            tr { th { "Input" } td { (subject.name) ", " (outcome.fitted()) } }
            tr { th { "SHA-256 of the input" } td { code { (subject.sha256) } } }
            @for (name, values) in &subject.facts { tr { th { (name) } td { (values.join("; ")) } } }
            tr { th { "Apertures" } td { (apertures) } }
            @for source in subject.sources() { tr { th { "Source of the values" } td { (source) } } }
            @if let Some(file) = &context.material { tr { th { "Material" } td { (file) } } }
        }
    })
}

/// What the reader has to know, in plain words.
fn notes(outcome: &Outcome<'_>) -> Markup {
    let lines: Vec<String> = outcome.subject.remarks.iter().chain(&outcome.fit.warnings).cloned().collect();
    let open = open_numbers(&outcome.fit.estimates);
    html! {
        @if !lines.is_empty() || open.is_some() {
            div.notes {
                b { "Please note" }
                ul {
                    @for line in lines.iter().chain(&open) { li { (capital(line)) "." } }
                }
            }
        }
    }
}

/// The numbers that the values leave open, in one sentence.
fn open_numbers(estimates: &[Estimate]) -> Option<String> {
    let name = |estimate: &Estimate| format!("{} ({})", estimate.meaning.name(), interval(estimate, 2));
    let open: Vec<String> = estimates.iter().filter(|estimate| !estimate.determined).map(name).collect();
    (!open.is_empty()).then(|| {
        format!(
            "the values leave open: {}. A material with others of these numbers meets the values as well; \
             the curves between the values hardly depend on them, those beyond do",
            open.join(", ")
        )
    })
}

/// What the classes of standards of the material's kind and colour have to say.
fn standards(outcome: &Outcome<'_>, context: &Context<'_>) -> anyhow::Result<Markup> {
    let Some(kind) = outcome.subject.kind() else { return Ok(html! {}) };
    let catalogue = Catalogue::embedded()?;
    let is_alike = |class: &&StandardClass| {
        Kind::of(class) == kind && Colour::named(&class.rows()[0].colour) == Some(context.colour)
    };
    let prepared = outcome.fit.sheeting.prepare()?;
    let measure = |quantity: Quantity, geometry: &Geometry| {
        let f = prepared.eval(geometry.wo, geometry.wi);
        match (quantity, context.area_m2) {
            (Quantity::LuminousIntensity, Some(area)) => {
                Quantity::RetroReflectionCoefficient.of_brdf(area * f, geometry)
            }
            _ => quantity.of_brdf(f, geometry),
        }
    };
    let (mut all, _) = verdicts(catalogue.classes().iter().filter(is_alike), 0.0, measure);
    // The class that was fitted, if it is one, before the others.
    all.sort_by_key(|verdict| verdict.class().id() != outcome.subject.name);
    let met = all.iter().filter(|verdict| verdict.is_met()).count();
    let count = all.len().min(met + MOST_FAILED);
    let (shown, left) = all.split_at(count);
    Ok(html! {
        @if let Some(first) = all.first() {
            h2 { "Standards" }
            table {
                thead {
                    tr {
                        th { "class" } th.text { "verdict" } th { "tightest at" } th { "found" }
                        th { "limit" }
                    }
                }
                @for verdict in shown { (standard(verdict)) }
            }
            p.small {
                "Classes of the same colour whose values come with the program; "
                code { "catseye standards list" } " names their sources. Not judged: "
                (first.not_judged().join(", ")) ". No guard band."
                @if !left.is_empty() { " " (left.len()) " more classes are not met." }
            }
        }
    })
}

fn standard(verdict: &Verdict<'_>) -> Markup {
    let Check { row, asked, found } = *verdict.tightest();
    let (class, word) = match verdict.standing() {
        Standing::Meets => ("text good", "meets"),
        Standing::WithinGuard => ("text near", "within the guard band"),
        Standing::Fails => ("text off", "fails"),
    };
    let [asked, found] = [asked, found].map(|value| short(row.unit.of_si(value)));
    let bound = if row.limit == Limit::Maximum { "at most" } else { "at least" };
    html! {
        tr {
            td { (verdict.class().title()) } td class=(class) { (word) }
            td { (angle(row.observation_deg)) ", " (angle(row.entrance_deg)) }
            td { (symbol(row.quantity)) " " (found) } td { (bound) " " (asked) " " (unit(row.unit)) }
        }
    }
}

fn values(outcome: &Outcome<'_>) -> Markup {
    let (rows, all) = (outcome.shown_rows(), outcome.subject.rows.len());
    html! {
        h2 { "Values" }
        table {
            thead {
                tr {
                    th { "quantity" } th { "observation" } th { "entrance" } th { "rotation" } th { "value" }
                    th.text { "unit" } th { "material" } th { "off by" }
                }
            }
            @for (row, ratio, is_met) in &rows {
                @let value = row.value_as_written().unwrap_or(f64::NAN);
                tr {
                    td { (symbol(row.quantity)) } td { (angle(row.observation_deg)) }
                    td { (angle(row.entrance_deg)) } td { (angle(row.rotation_deg)) }
                    td { (short(value)) } td.text { (unit(row.unit)) } td { (short(value * ratio)) }
                    td.off[!is_met] { (off_by(*ratio)) }
                }
            }
        }
        @if rows.len() < all {
            p.small { "The " (rows.len()) " of " (all) " values that the material is farthest from." }
        }
    }
}

fn numbers(outcome: &Outcome<'_>) -> Markup {
    html! {
        table {
            caption { "One standard deviation is " (outcome.fit.deviation.origin()) "." }
            thead { tr { th { "number" } th { "value" } th { "one standard deviation" } th.text {} } }
            @for estimate in &outcome.fit.estimates {
                tr {
                    td { (estimate.meaning.name()) }
                    td { (short(estimate.value)) }
                    td { (interval(estimate, 4)) }
                    td.text {
                        @match (estimate.determined, estimate.at_bound) {
                            (false, _) => "left open by the values",
                            (true, true) => "at the end of its range",
                            (true, false) => "",
                        }
                    }
                }
            }
            @if let Some(roughness) = outcome.coat_roughness() {
                tr { td { "coat roughness" } td { (short(roughness)) } td {} td.text {} }
            }
        }
    }
}

/// How good the model of a measured BRDF is in each of its regions, and what is of second rank.
fn remarks(outcome: &Outcome<'_>) -> Markup {
    html! {
        @if !outcome.parts.is_empty() {
            table {
                thead {
                    tr {
                        th { "region" } th { "samples" } th { "log-RMSE" } th { "NRMSE" } th { "95 % within" }
                        th.text {}
                    }
                }
                @for Part { name, metrics, .. } in outcome.parts {
                    tr {
                        td { (name) } td { (metrics.count) } td { (format!("{:.3}", metrics.log_rmse)) }
                        td { (format!("{:.4}", metrics.nrmse)) } td { (percent(metrics.percentile_95())) }
                        td.text { (outcome.all_but(metrics)) }
                    }
                }
            }
        }
        @if let Some(line) = outcome.reciprocity() { p.small { (capital(&line)) "." } }
    }
}

/// The models that were tried, folded away on a screen.
fn models(outcome: &Outcome<'_>) -> Markup {
    html! {
        h2 { "Models" }
        details {
            summary { "The models that were tried, from the simplest on" }
            (trials(&outcome.fit.trials))
            @if let Some(beside) = outcome.beside {
                p { "The same values with the back-vector GGX lobe of MaterialX 1.39.5:" }
                (trials(&beside.trials))
            }
        }
    }
}

fn trials(trials: &[Trial]) -> Markup {
    html! {
        table {
            thead { tr { th { "model" } th { "numbers" } th { "worst" } th { "rms" } th.text {} } }
            @for Trial { form, unknowns, worst, rms, fault } in trials {
                tr {
                    td { (describe(form)) } td { (unknowns) } td { (percent(*worst)) } td { (percent(*rms)) }
                    td.text { @if fault.is_some() { "not physical over the entrance angle" } }
                }
            }
        }
    }
}

/// A quantity's symbol with its index lowered.
fn symbol(quantity: Quantity) -> Markup {
    match quantity.symbol().split_once('_') {
        Some((letter, index)) => html! { (letter) sub { (index) } },
        None => html! { (quantity.symbol()) },
    }
}

fn angle(deg: f64) -> String {
    format!("{}\u{b0}", signed(deg))
}

fn unit(unit: Unit) -> String {
    if unit == Unit::One { String::new() } else { unit.symbol().replace('2', "\u{b2}") }
}

/// By how many percent a model is off.
fn off_by(ratio: f64) -> String {
    let percent = (1000.0 * (ratio - 1.0)).round() / 10.0;
    let sign = if percent > 0.0 {
        "+"
    } else if percent < 0.0 {
        "\u{2212}"
    } else {
        ""
    };
    format!("{sign}{:.1} %", percent.abs())
}

/// A sentence's beginning.
fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).collect())
}
