//! From files to elements, in bounded time and memory.

pub(crate) mod element;
pub(crate) mod encoding;
pub(crate) mod files;
pub(crate) mod include;
pub(crate) mod root;
pub(crate) mod source;
pub(crate) mod upgrade;
pub(crate) mod xml;
