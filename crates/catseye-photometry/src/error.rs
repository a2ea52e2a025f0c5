//! What can be wrong with photometric data.

use std::path::PathBuf;

use crate::brdf::Contradiction;
use crate::digits::significant;
use crate::drive::DriveError;

/// Why a table, a value or a name was refused. The text names the place, the value and the way out.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file that can't be read.
    #[error("{}: can't be read: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// Something wrong with a table as a whole.
    #[error("{table}: {problem}")]
    Table {
        /// The table's name: that of its file.
        table: String,
        /// What is wrong, and the way out.
        problem: String,
    },
    /// A measured BRDF whose values are not what its header says.
    #[error("{file}: {found}")]
    Cosine {
        /// The file.
        file: String,
        /// What they are.
        found: Contradiction,
    },
    /// Something wrong with a row.
    #[error("{table}:{line}: {problem}")]
    Row {
        /// The table's name: that of its file.
        table: String,
        /// The row's line, counted from 1.
        line: usize,
        /// What is wrong, and the way out.
        problem: String,
    },
    /// Something wrong with a cell.
    #[error("{table}:{line}: column {column}: {problem}")]
    Cell {
        /// The table's name: that of its file.
        table: String,
        /// The row's line, counted from 1.
        line: usize,
        /// The column's name.
        column: String,
        /// What is wrong, and the way out.
        problem: String,
    },
    /// A quantity by a name that isn't known.
    #[error("{name:?} is not a quantity; known are {known}")]
    UnknownQuantity {
        /// The name.
        name: String,
        /// The names that are known.
        known: String,
    },
    /// A unit by a name that isn't known.
    #[error("{name:?} is not a known unit; known are {known}")]
    UnknownUnit {
        /// The name.
        name: String,
        /// The names that are known.
        known: String,
    },
    /// A name that fits no class of a standard.
    #[error("{name:?} names no class of a standard; there are {known}")]
    UnknownStandard {
        /// The name.
        name: String,
        /// What there is: classes, or standards where the classes are many.
        known: String,
    },
    /// A name that fits several classes where one is asked for.
    #[error("{name:?} names several classes of standards: {candidates}; say which one")]
    AmbiguousStandard {
        /// The name.
        name: String,
        /// The classes, or their standards where they are many.
        candidates: String,
    },
    /// A number outside the range that a conversion is defined on.
    #[error("{name} is {}, outside {range}", significant(*value, 6))]
    Range {
        /// What the number is.
        name: &'static str,
        /// The number; an angle in degrees.
        value: f64,
        /// The range, in the notation `[0, 1]`, and the unit.
        range: &'static str,
    },
    /// A lamp's file that doesn't say which way the lamp looked.
    #[error(
        "{file}: has the angles of a luminaire (C, gamma); say whether gamma is counted from straight ahead \
         (`ahead`) or from straight down (`down`)"
    )]
    LampAxis {
        /// The file.
        file: String,
    },
    /// A scene in which there is nothing to be seen.
    #[error(transparent)]
    Drive(#[from] DriveError),
}
