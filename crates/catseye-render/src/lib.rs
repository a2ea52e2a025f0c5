//! A CPU path tracer that shows the catseye BSDF.
//!
//! It renders [`Scene`]s of triangle meshes and spheres, whose materials are [`Bsdf`]s made from MaterialX
//! closures, in the light of lamps, panels and environments. Paths are traced from the camera with light
//! sampling, multiple importance sampling and Owen-scrambled Sobol points; a picture is the same to the last
//! bit for any number of threads.
//!
//! ```
//! use catseye::{Model, Params};
//! use catseye_materialx::{Closure, Material};
//! use catseye_render::{RenderSettings, Scene, encode_png, render};
//!
//! let sheeting = Closure::RetroReflective {
//!     weight: 1.0,
//!     params: Params::isotropic(0.05).with_tint([0.8, 0.7, 0.2]),
//! };
//! let material = Material { name: "yellow_sheeting".to_owned(), ..Material::of(sheeting) };
//! let scene = Scene::preview(&material, Model::Reciprocal)?;
//! let settings = RenderSettings { width: 32, height: 18, spp: 1, ..RenderSettings::default() };
//! let image = render(&scene, &settings, &|_done| ())?;
//! let png: Vec<u8> = encode_png(&image, scene.tone_map())?;
//! # Ok::<(), catseye_render::Error>(())
//! ```
//!
//! # Conventions
//! - Scenes are right-handed with y up; lengths are metres in the scenes that come with the crate. Colours
//!   are linear Rec. 709. Light is in any radiometric or photometric system: radiance, irradiance and
//!   intensity agree.
//! - Vectors are those of [`glam`], which is re-exported: its version is part of the interface.
//! - Surfaces are two-sided: whichever side a ray meets is the upper side of its BSDF. Only dielectrics that
//!   transmit know inside from outside.
//! - A tangent points along increasing u of the texture coordinates, unless the material gives one in world
//!   space.
//! - Densities are per steradian. That of a Dirac distribution is 1, and its sample says `is_dirac`.
//! - A Dirac lobe (roughness 0) is met by scattered rays only, so it shows lights that have an extent, not
//!   points.

mod accel;
mod bsdf;
mod camera;
mod encode;
mod error;
mod film;
mod filter;
mod frame;
pub mod furnace;
mod glare;
mod image;
mod instrument;
mod integrator;
pub mod light;
mod material;
mod mesh;
mod part;
mod ray;
mod render;
mod sampler;
mod scene;
mod scenes;
mod specimen;
mod sphere;
mod surface;
mod tone;
mod triangle;

pub use glam;

pub use bsdf::{Bsdf, BsdfSample, Shading};
pub use camera::Camera;
pub use encode::{PictureInfo, encode_exr, encode_png, encode_png_rgb};
pub use error::Error;
pub use film::{Film, FilmKey, Region};
pub use filter::Filter;
pub use frame::Frame;
pub use image::Image;
pub use instrument::{Estimate, Reading, Retroreflectometer};
pub use light::Light;
pub use mesh::Mesh;
pub use part::Part;
pub use ray::Ray;
pub use render::{RenderSettings, expose, render};
pub use scene::{MaterialId, Scene, SceneBuilder};
pub use scenes::Lighting;
pub use specimen::Specimen;
pub use sphere::Sphere;
pub use tone::{ToneMap, encode_srgb};
