//! From nodes to closures and the programs that fill them.

pub(crate) mod pattern;
pub(crate) mod slot;
pub(crate) mod surface;
