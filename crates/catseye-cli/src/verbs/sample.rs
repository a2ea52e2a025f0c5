//! `catseye sample`: a direction chosen by three uniform numbers for each row.

use catseye::{AnyLobe, Lobe as _, Sample};

use crate::query::point::PointArgs;
use crate::query::row::{Cell, Row, RowError, Scalar, U};
use crate::query::{Query, TableArgs};

/// Sample the BSDF: CSV in, CSV out
///
/// Adds the direction `wi_x`, `wi_y`, `wi_z` that `u1`, `u2`, `u3` choose, `weight_r`, `weight_g`, `weight_b`
/// = f cos / pdf, the density `pdf` [1/sr], and `lobe`: single, multiple, dirac (a direction without
/// alternatives; its pdf is given as 1), or none, with zeros, where wo is below the horizon.
#[derive(Debug, clap::Args)]
#[command(after_help = crate::help::SAMPLE, after_long_help = crate::help::table(crate::help::SAMPLE))]
pub(crate) struct Args {
    #[command(flatten)]
    table: TableArgs,
    #[command(flatten)]
    point: PointArgs,
    /// Three uniform numbers in [0, 1)
    #[arg(long, value_name = "U1,U2,U3", allow_hyphen_values = true)]
    u: Option<String>,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let table = self.point.table(Some(("u", U, self.u.as_deref())), self.table.has_file())?;
        self.table.run(&Draw, table)
    }
}

struct Draw;

impl Query for Draw {
    const ADDED: &'static [&'static str] =
        &["wi_x", "wi_y", "wi_z", "weight_r", "weight_g", "weight_b", "pdf", "lobe"];
    const ARGUMENT: Option<[&'static str; 3]> = Some(U);

    fn answer<T: Scalar>(
        &self,
        lobe: &AnyLobe<T>,
        row: Row<'_>,
        cells: &mut Vec<Cell>,
    ) -> Result<(), RowError> {
        let Some(Sample { wi, weight, pdf, component }) = lobe.sample(row.wo()?, row.u()?) else {
            cells.extend([T::ZERO.cell(); 7]);
            cells.push(Cell::Word("none"));
            return Ok(());
        };
        cells.extend(<[T; 3]>::from(wi).into_iter().chain(weight).chain([pdf]).map(T::cell));
        cells.push(Cell::Word(component.name()));
        Ok(())
    }
}
