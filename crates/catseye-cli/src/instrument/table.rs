//! Tables of photometric values: a file, standard input, or a standard's name.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

use anyhow::{Context as _, anyhow};
use catseye_photometry::standards::{Catalogue, StandardClass};
use catseye_photometry::{Error, Row, Table};

/// Bytes after which every kind of file is too large for the library, which says so.
const LARGEST: u64 = 1 << 27;

/// The angles that materials are measured at where none are given, in degrees: those of the standards for
/// sheeting.
pub(crate) const OBSERVATIONS_DEG: [f64; 7] = [0.1, 0.2, 0.33, 0.5, 1.0, 1.5, 2.0];
pub(crate) const ENTRANCES_DEG: [f64; 5] = [-4.0, 5.0, 20.0, 30.0, 40.0];

/// Every pair of an observation and an entrance angle, in degrees, as geometries of `R_A`.
pub(crate) fn grid(observations_deg: &[f64], entrances_deg: &[f64]) -> anyhow::Result<Table> {
    let mut text = String::from("observation_deg,entrance_deg,quantity,unit\n");
    for observation in observations_deg {
        for entrance in entrances_deg {
            text += &format!("{observation},{entrance},R_A,cd/lx/m2\n");
        }
    }
    Ok(Table::parse_geometries(text.as_bytes(), "grid of angles")?)
}

/// Reads values from a CSV file, or from standard input where it is `-`.
fn read(path: &Path) -> anyhow::Result<Table> {
    let (bytes, name) = bytes(path)?;
    Ok(Table::parse_values(&bytes, &name)?)
}

/// Reads geometries from a CSV file, or from standard input where it is `-`.
pub(crate) fn read_geometries(path: &Path) -> anyhow::Result<Table> {
    let (bytes, name) = bytes(path)?;
    Ok(Table::parse_geometries(&bytes, &name)?)
}

/// The bytes of a file, or of standard input where it is `-`, and what errors call it.
pub(crate) fn bytes(path: &Path) -> anyhow::Result<(Vec<u8>, String)> {
    let mut bytes = Vec::new();
    if path == Path::new("-") {
        io::stdin().lock().take(LARGEST).read_to_end(&mut bytes).context("<stdin>: can't be read")?;
        return Ok((bytes, "<stdin>".to_owned()));
    }
    let io = |source| Error::Io { path: path.to_owned(), source };
    File::open(path).map_err(io)?.take(LARGEST).read_to_end(&mut bytes).map_err(io)?;
    Ok((bytes, path.display().to_string()))
}

/// Whether a name is that of a table: a file or pipe that exists, a name that ends in `.csv`, or `-`.
pub(crate) fn is_table(name: &str) -> bool {
    let path = Path::new(name);
    let is_csv = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
    name == "-" || is_csv || (path.exists() && !path.is_dir())
}

/// The classes that a name means, or the one that a file is.
pub(crate) fn classes(name: &str) -> anyhow::Result<Vec<StandardClass>> {
    if is_table(name) {
        let table = read(Path::new(name))?;
        return Ok(StandardClass::from_table(table).into_iter().collect());
    }
    let catalogue = Catalogue::embedded()?;
    let found = catalogue.matching(name).map_err(|error| unknown(name, error))?;
    Ok(found.into_iter().cloned().collect())
}

/// The one class that a name means, or that a file is.
pub(crate) fn class(name: &str) -> anyhow::Result<StandardClass> {
    let mut classes = classes(name)?;
    if classes.len() == 1 {
        return Ok(classes.remove(0));
    }
    // The error lists the candidates.
    let catalogue = Catalogue::embedded()?;
    Ok(catalogue.find(name).map_err(|error| unknown(name, error))?.clone())
}

/// What is said of a name that is no class of a standard: one that looks like a path was meant as a file.
fn unknown(name: &str, error: Error) -> anyhow::Error {
    if Path::new(name).is_dir() {
        return anyhow!("{name}: is a folder; a table or a class of a standard is needed");
    }
    if name.contains(['/', '\\', '.']) {
        return anyhow!(
            "{name}: no such file, and no class of a standard, which `catseye standards list` lists"
        );
    }
    anyhow!("{error}; `catseye standards list` lists all of them")
}

/// Several classes as one table.
pub(crate) fn joined(name: &str, classes: &[StandardClass]) -> Table {
    let header = classes.first().map_or(&[][..], |class| class.table().header());
    let rows: Vec<Row> = classes.iter().flat_map(StandardClass::rows).cloned().collect();
    Table::from_rows(name, header, rows)
}
