//! `catseye albedo`: the directional albedo for each row.

use catseye::{AnyLobe, Lobe as _};

use crate::point::PointArgs;
use crate::query::{Cell, Row, RowError, Scalar};
use crate::table::{Query, TableArgs};

/// Directional albedo: CSV in, CSV out
///
/// Adds albedo_r, albedo_g, albedo_b: the share of the energy arriving along wo that is reflected, in [0, 1].
#[derive(Debug, clap::Args)]
#[command(after_help = crate::help::ALBEDO, after_long_help = crate::help::table(crate::help::ALBEDO))]
pub(crate) struct Args {
    #[command(flatten)]
    table: TableArgs,
    #[command(flatten)]
    point: PointArgs,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let table = self.point.table(None, self.table.has_file())?;
        self.table.run::<Albedo>(table)
    }
}

struct Albedo;

impl Query for Albedo {
    const ADDED: &'static [&'static str] = &["albedo_r", "albedo_g", "albedo_b"];
    const ARGUMENT: Option<[&'static str; 3]> = None;

    fn answer<T: Scalar>(lobe: &AnyLobe<T>, row: Row<'_>) -> Result<Vec<Cell>, RowError> {
        Ok(lobe.albedo(row.wo()?).map(T::cell).to_vec())
    }
}
