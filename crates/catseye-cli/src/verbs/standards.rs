//! `catseye standards`: the values of standards and products that come with the command.

use catseye_photometry::Row;
use catseye_photometry::standards::{Catalogue, StandardClass};
use clap::Subcommand;
use serde_json::{Value, json};

use crate::instrument::table;
use crate::{help, report};

/// List and show the values of standards and products
///
/// Without a verb: the list. A name is STANDARD:CLASS:COLOUR; case and signs don't matter, what is unique may
/// be left out, and wherever the command takes a name it takes a CSV file in the same columns as well.
#[derive(Debug, clap::Args)]
#[command(after_help = help::STANDARDS)]
pub(crate) struct Args {
    #[command(subcommand)]
    verb: Option<Verb>,
}

#[derive(Debug, Subcommand)]
enum Verb {
    List(List),
    Show(Show),
}

/// List the classes: their names, how many values they have, where, and who says so
#[derive(Debug, Default, clap::Args)]
#[command(after_help = help::STANDARDS_LIST)]
struct List {
    /// Only the classes of this standard
    name: Option<String>,
    /// Print a JSON array with one object per class
    #[arg(long)]
    json: bool,
}

/// Print a class as CSV that `measure --geometry` and `fit` take
#[derive(Debug, clap::Args)]
#[command(after_help = help::STANDARDS_SHOW)]
struct Show {
    /// `STANDARD[:CLASS[:COLOUR]]`; all classes that it fits are printed
    name: String,
    /// Print a JSON array with one object per row
    #[arg(long)]
    json: bool,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        match &self.verb {
            None => List::default().run(),
            Some(Verb::List(list)) => list.run(),
            Some(Verb::Show(show)) => show.run(),
        }
    }
}

impl List {
    fn run(&self) -> anyhow::Result<()> {
        let classes = match &self.name {
            Some(name) => table::classes(name)?,
            None => Catalogue::embedded()?.classes().to_vec(),
        };
        if self.json {
            let facts: Vec<Value> = classes.iter().map(facts).collect();
            return report::print(true, &Value::from(facts), "");
        }
        let mut text = String::new();
        let width = classes.iter().map(|class| class.id().len()).max().unwrap_or_default();
        let mut heading = (String::new(), String::new());
        for class in &classes {
            let first = &class.rows()[0];
            let own = (first.standard.clone(), first.source.clone());
            if own != heading {
                let sources = sources(class).join("\n  ");
                text += &format!("{}\n  {sources}\n", own.0);
                heading = own;
            }
            text += &format!("  {:width$}  {}\n", class.id(), geometry(class));
        }
        report::to_stdout(text.as_bytes())
    }
}

impl Show {
    fn run(&self) -> anyhow::Result<()> {
        let classes = table::classes(&self.name)?;
        let table = table::joined(&self.name, &classes);
        if self.json {
            let rows: Vec<Value> =
                classes.iter().flat_map(|class| class.rows().iter().map(row_facts)).collect();
            return report::print(true, &Value::from(rows), "");
        }
        report::to_stdout(table.to_csv(&[]).as_bytes())
    }
}

/// How many values there are, of what, and at which angles.
fn geometry(class: &StandardClass) -> String {
    let rows = class.rows();
    let limits = distinct(rows.iter().map(|row| row.limit.name().to_owned())).join(" and ");
    format!(
        "{:2} x {} {limits} at observation {}, entrance {}",
        rows.len(),
        rows[0].quantity,
        angles(rows, |row| row.observation_deg),
        angles(rows, |row| row.entrance_deg)
    )
}

fn angles(rows: &[Row], angle: impl Fn(&Row) -> f64) -> String {
    let mut angles: Vec<f64> = rows.iter().map(angle).collect();
    angles.sort_by(f64::total_cmp);
    distinct(angles.into_iter().map(|angle| angle.to_string())).join(" ")
}

fn sources(class: &StandardClass) -> Vec<String> {
    distinct(class.rows().iter().map(|row| row.source.clone()))
}

/// The texts without repetitions, in their order.
fn distinct(texts: impl Iterator<Item = String>) -> Vec<String> {
    let mut found = Vec::new();
    for text in texts {
        if !found.contains(&text) {
            found.push(text);
        }
    }
    found
}

fn facts(class: &StandardClass) -> Value {
    let rows = class.rows();
    let list = |angle: fn(&Row) -> f64| {
        let mut angles: Vec<f64> = rows.iter().map(angle).collect();
        angles.sort_by(f64::total_cmp);
        angles.dedup();
        angles
    };
    json!({
        "id": class.id(),
        "title": class.title(),
        "points": rows.len(),
        "quantity": rows[0].quantity.symbol(),
        "observation_deg": list(|row| row.observation_deg),
        "entrance_deg": list(|row| row.entrance_deg),
        "limits": distinct(rows.iter().map(|row| row.limit.name().to_owned())),
        "sources": sources(class),
    })
}

fn row_facts(row: &Row) -> Value {
    json!({
        "standard": row.standard,
        "class": row.class,
        "colour": row.colour,
        "observation_deg": row.observation_deg,
        "entrance_deg": row.entrance_deg,
        "rotation_deg": row.rotation_deg,
        "quantity": row.quantity.symbol(),
        "value": row.value_as_written(),
        "unit": row.unit.symbol(),
        "limit": row.limit.name(),
        "source": row.source,
    })
}
