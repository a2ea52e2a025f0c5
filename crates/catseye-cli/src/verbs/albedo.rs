//! `catseye albedo`: the directional albedo for each row.

use catseye::{AnyLobe, Lobe as _, Model};

use crate::options::Precision;
use crate::query::point::PointArgs;
use crate::query::row::{Cell, Row, RowError, Scalar};
use crate::query::{Query, TableArgs};

/// Directional albedo: CSV in, CSV out
///
/// Adds `albedo_r`, `albedo_g`, `albedo_b`: the share of the energy arriving along wo that is reflected, in
/// [0, 1]. In f64 by quadrature, to 1e-9; in f32 the fast approximation that eval and sample use.
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
        let (model, precision) = self.table.model_and_precision();
        self.table.run(&Albedo { model, precision }, table)
    }
}

struct Albedo {
    model: Model,
    precision: Precision,
}

impl Query for Albedo {
    const ADDED: &'static [&'static str] = &["albedo_r", "albedo_g", "albedo_b"];
    const ARGUMENT: Option<[&'static str; 3]> = None;

    fn answer<T: Scalar>(
        &self,
        lobe: &AnyLobe<T>,
        row: Row<'_>,
        cells: &mut Vec<Cell>,
    ) -> Result<(), RowError> {
        if self.precision == Precision::F32 {
            cells.extend(lobe.albedo(row.wo()?).map(T::cell));
            return Ok(());
        }
        let exact = self.model.exact_albedo(&row.params()?, row.wo()?);
        cells.extend(exact.map_err(|error| Row::out_of_range(&error))?.map(Cell::F64));
        Ok(())
    }
}
