//! The promises of the command, kept by the binary itself: one file for each kind.

mod bad_input;
mod csv_contract;
mod help;
mod plots;
mod run;
