//! `catseye fit` beside its options: what is fitted, and how the result is told.

mod outcome;
mod page;
mod subject;

pub(crate) use outcome::Outcome;
pub(crate) use page::page;
pub(crate) use subject::Subject;
