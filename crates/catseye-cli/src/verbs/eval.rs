//! `catseye eval`: the BSDF's value and density for each row.

use catseye::{AnyLobe, Lobe as _};

use crate::query::point::PointArgs;
use crate::query::row::{Cell, Row, RowError, Scalar, WI};
use crate::query::{Query, TableArgs};

/// Evaluate the BSDF: CSV in, CSV out
///
/// Adds `f_r`, `f_g`, `f_b` [1/sr, cosine not included] and `pdf` [1/sr], the density with which `sample`
/// chooses wi. Both are 0 below the horizon and for roughness 0, a Dirac lobe that only `sample` can meet.
#[derive(Debug, clap::Args)]
#[command(after_help = crate::help::EVAL, after_long_help = crate::help::table(crate::help::EVAL))]
pub(crate) struct Args {
    #[command(flatten)]
    table: TableArgs,
    #[command(flatten)]
    point: PointArgs,
    /// Direction towards the light
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    wi: Option<String>,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let table = self.point.table(Some(("wi", WI, self.wi.as_deref())), self.table.has_file())?;
        self.table.run(&Eval, table)
    }
}

struct Eval;

impl Query for Eval {
    const ADDED: &'static [&'static str] = &["f_r", "f_g", "f_b", "pdf"];
    const ARGUMENT: Option<[&'static str; 3]> = Some(WI);

    fn answer<T: Scalar>(
        &self,
        lobe: &AnyLobe<T>,
        row: Row<'_>,
        cells: &mut Vec<Cell>,
    ) -> Result<(), RowError> {
        let (f, pdf) = lobe.eval_pdf(row.wo()?, row.wi()?);
        cells.extend(f.into_iter().chain([pdf]).map(T::cell));
        Ok(())
    }
}
