//! The promises of the command, kept by the binary itself: one file for each.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod bad_input;
mod csv_contract;
mod drive;
mod export;
mod farm;
mod fit;
mod furnace_table;
mod half_power;
mod help;
mod ignored;
mod instrument;
mod interrupted;
mod lidar;
mod materialx_check;
mod materialx_export;
mod materialx_library;
mod measure;
mod memory;
mod messages;
mod openmaterial;
mod optics;
mod parts;
mod pictures;
mod plots;
mod python;
mod radiance;
mod readme;
mod render_files;
mod run;
mod sheeting;
mod shell;
mod standards;
mod streams;
