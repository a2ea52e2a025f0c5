//! Tests of the public interface: one file for each promise.

mod check;
mod errors;
mod hostile;
mod node_definition;
mod outputs;
mod patterns;
mod read;
mod support;
mod upgrade;
