//! The known nodes: their inputs, and what patterns compute.

pub(crate) mod closures;
mod lower;
mod signature;

pub(crate) use lower::{Lowering, Operand};
pub use signature::pattern_categories;
pub(crate) use signature::{Fallback, Parameter, Port, Signature, signature, signatures};
