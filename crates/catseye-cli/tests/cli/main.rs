//! The promises of the command, kept by the binary itself: one file for each kind.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod bad_input;
mod csv_contract;
mod fit;
mod furnace_table;
mod help;
mod materialx_check;
mod materialx_export;
mod photometry;
mod plots;
mod readme;
mod render_files;
mod run;
