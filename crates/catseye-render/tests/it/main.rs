//! What the crate promises, a file for each promise.

mod closures;
mod common;
mod determinism;
mod encode;
mod energy;
mod examples;
mod furnace;
mod instrument;
mod light_sampling;
mod parts;
mod retro;
mod scenes;
mod specimen;
mod varying;
