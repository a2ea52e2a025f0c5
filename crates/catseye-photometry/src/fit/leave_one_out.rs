//! Leave-one-row-out: how well a law predicts the values that it was not fitted to.

use rayon::prelude::*;

use super::form::{EntranceKind, Form};
use super::select::{Span, choose};
use super::{Aim, FitOptions, Observation};
use crate::Limit;
use crate::standards::{Catalogue, StandardClass};

/// A row that was left out.
#[derive(Clone, Copy, Debug)]
struct LeftOut {
    /// Logarithm of model over value.
    miss: f64,
    /// Whether other rows have as much of both angles and as little.
    inside: bool,
    /// Whether what was written would have been physical.
    physical: bool,
}

fn tables() -> Vec<(String, Vec<Observation>)> {
    let catalogue = Catalogue::embedded().unwrap();
    let observations = |class: &StandardClass| {
        let has = |limit| class.rows().iter().any(|row| row.limit == limit);
        let wanted = if has(Limit::Typical) { Limit::Typical } else { Limit::Minimum };
        let rows = class.rows().iter().filter(|row| row.limit == wanted || !has(Limit::Minimum));
        let rows = rows.map(|row| Observation::from_row(row, Aim::Equal, Some(0.01)));
        Some((class.id().to_owned(), rows.collect::<Result<Vec<_>, _>>().ok()?))
    };
    let tables = catalogue.classes().iter().filter_map(observations);
    tables.filter(|(_, rows)| Span::of(rows).is_grid()).collect()
}

fn left_out(rows: &[Observation], i: usize, is_tried: fn(&Form) -> bool) -> Option<LeftOut> {
    let mut rest = rows.to_vec();
    let row = rest.remove(i);
    let span = Span::of(&rest);
    if !span.is_grid() {
        return None;
    }
    let options = FitOptions::default();
    let forms: Vec<Form> = span.forms(&options, rest.len()).into_iter().filter(is_tried).collect();
    let (found, _) = choose(&rest, &options, &span, &forms).ok()?;
    let prepared = found.sheeting.prepare().ok()?;
    let value: f64 = row.views.iter().map(|view| view.factor * prepared.eval(view.wo, view.wi)).sum();
    Some(LeftOut {
        miss: (value / row.value).ln(),
        inside: span.holds(&row),
        physical: found.sheeting.fault(&[0.2_f64.to_radians()]).is_none(),
    })
}

/// Which forms a law is made of.
type Law = (&'static str, fn(&Form) -> bool);

#[test]
#[ignore = "takes minutes; prints the table of docs/photometry.md"]
fn leave_one_row_out() {
    let tables = tables();
    let variants: [Law; 5] = [
        ("nested law", |_| true),
        ("no power per lobe", |form| form.shared),
        ("no bend", |form| form.entrance != EntranceKind::Bend),
        ("cos^q", |form| form.entrance != EntranceKind::Bend && form.shared),
        ("one lobe", |form| form.lobes == 1),
    ];
    println!("{} tables, {} rows", tables.len(), tables.iter().map(|(_, rows)| rows.len()).sum::<usize>());
    println!("law                  rows  median  within 10 %  within 20 %  90 % within   rms(log)");
    for (name, forms) in variants {
        let found: Vec<LeftOut> = tables
            .par_iter()
            .flat_map_iter(|(_, rows)| (0..rows.len()).filter_map(|i| left_out(rows, i, forms)))
            .collect();
        for (place, inside) in [("between", true), ("beyond", false)] {
            let mut misses: Vec<f64> =
                found.iter().filter(|row| row.inside == inside).map(|row| row.miss.abs()).collect();
            misses.sort_by(f64::total_cmp);
            let count = misses.len();
            let within = |limit: f64| {
                100.0 * misses.iter().filter(|miss| **miss < limit.ln_1p()).count() as f64 / count as f64
            };
            let at = |share: f64| 100.0 * misses[((count - 1) as f64 * share) as usize].exp_m1();
            let rms = (misses.iter().map(|miss| miss.min(2.0).powi(2)).sum::<f64>() / count as f64).sqrt();
            println!(
                "{name:18} {place:8} {count:4} {:6.1} % {:8.0} % {:8.0} % {:10.0} %  {rms:.3}",
                at(0.5),
                within(0.1),
                within(0.2),
                at(0.9)
            );
        }
        println!("faults {}", found.iter().filter(|row| !row.physical).count());
    }
}
