//! A CPU path tracer that shows the catseye BSDF.

mod accel;
mod bsdf;
mod camera;
mod error;
mod filter;
mod frame;
pub mod furnace;
mod image;
mod integrator;
pub mod light;
mod mesh;
mod output;
mod ray;
mod render;
mod sampler;
mod scene;
mod scenes;
mod sphere;
mod surface;
mod tone;
mod triangle;

pub use bsdf::{Bsdf, BsdfSample, Shading};
pub use camera::Camera;
pub use error::Error;
pub use filter::Filter;
pub use frame::Frame;
pub use image::Image;
pub use light::Light;
pub use mesh::Mesh;
pub use output::{write_exr, write_png, write_whole};
pub use ray::Ray;
pub use render::{RenderSettings, render};
pub use scene::{MaterialId, Scene, SceneBuilder};
pub use sphere::Sphere;
pub use tone::{ToneMap, encode_srgb};
