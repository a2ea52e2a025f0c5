//! Any bytes are a lamp in EULUMDAT, or give an error.
//!
//! CONTRIBUTING.md has the command.

#![no_main]

mod lamp;

use catseye_photometry::lamp::Lamp;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| lamp::check(bytes, Lamp::parse_eulumdat));
