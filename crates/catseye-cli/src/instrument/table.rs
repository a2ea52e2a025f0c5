//! Tables of photometric values: a file, standard input, or a standard's name.

use std::io::{self, Read as _};
use std::path::Path;

use anyhow::Context as _;
use catseye_photometry::standards::{Catalogue, StandardClass};
use catseye_photometry::{Row, Table};

/// Bytes after which a table on standard input is too large for the library, which says so.
const LARGEST: u64 = 1 << 25;

/// Reads values from a CSV file, or from standard input where it is `-`.
pub(crate) fn read(path: &Path) -> anyhow::Result<Table> {
    if path != Path::new("-") {
        return Ok(Table::read_values(path)?);
    }
    Ok(Table::parse_values(&read_stdin()?, "<stdin>")?)
}

/// Reads geometries from a CSV file, or from standard input where it is `-`.
pub(crate) fn read_geometries(path: &Path) -> anyhow::Result<Table> {
    if path != Path::new("-") {
        return Ok(Table::read_geometries(path)?);
    }
    Ok(Table::parse_geometries(&read_stdin()?, "<stdin>")?)
}

fn read_stdin() -> anyhow::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    io::stdin().lock().take(LARGEST).read_to_end(&mut bytes).context("<stdin>: can't be read")?;
    Ok(bytes)
}

/// Whether a name is that of a file: a path that exists, ends in `.csv` or is `-`.
pub(crate) fn is_table(name: &str) -> bool {
    let path = Path::new(name);
    let is_csv = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
    name == "-" || is_csv || path.is_file()
}

/// The classes that a name means, or the one that a file is.
pub(crate) fn classes(name: &str) -> anyhow::Result<Vec<StandardClass>> {
    if is_table(name) {
        let table = read(Path::new(name))?;
        return Ok(StandardClass::from_table(table).into_iter().collect());
    }
    Ok(Catalogue::embedded()?.matching(name)?.into_iter().cloned().collect())
}

/// Several classes as one table.
pub(crate) fn joined(name: &str, classes: &[StandardClass]) -> Table {
    let header = classes.first().map_or(&[][..], |class| class.table().header());
    let rows: Vec<Row> = classes.iter().flat_map(StandardClass::rows).cloned().collect();
    Table::from_rows(name, header, rows)
}
