//! Materials in the forms that other programs read, and how far each is from its original.
//!
//! Radiance is given the lobes themselves, as functions. Engines have one back-vector lobe of constant
//! inputs, which is fitted ([`SingleLobe`]).

mod deviation;
mod engines;
mod law;
mod radiance;
mod single;

pub use deviation::{Deviation, LobeRows};
pub use engines::{gltf, open_pbr, three};
pub use law::{LobeFault, LobeSample, ViewedLobe};
pub use radiance::{Coat, Radiance};
pub use single::{Colours, Dielectric, OpenPbr, SingleLobe};
