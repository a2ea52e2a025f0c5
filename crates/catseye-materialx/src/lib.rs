//! Reads MaterialX documents into closure trees.

mod closure;

pub use closure::{Closure, Material, ScatterMode};
