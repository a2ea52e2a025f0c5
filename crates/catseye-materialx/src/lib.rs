//! Reads [MaterialX](https://materialx.org) documents into closure trees.
//!
//! [`Document::load`] reads a file, [`Document::materials`] turns each of its surface materials into a tree
//! of [`Closure`]s whose inputs are resolved, validated and in linear Rec. 709; what a renderer does with it
//! is its own business. Every [`Error`] is one line that names the file, line and column, the element, the
//! value and the way out.
//!
//! ```
//! use catseye_materialx::{Closure, Document};
//!
//! let text = r#"
//!     <materialx version="1.39">
//!       <retro_reflective_bsdf name="beads" type="BSDF">
//!         <input name="roughness_u" type="float" value="0.05" />
//!       </retro_reflective_bsdf>
//!       <surface name="skin" type="surfaceshader">
//!         <input name="bsdf" type="BSDF" nodename="beads" />
//!       </surface>
//!       <surfacematerial name="vest" type="material">
//!         <input name="surfaceshader" type="surfaceshader" nodename="skin" />
//!       </surfacematerial>
//!     </materialx>"#;
//! let vest = Document::parse(text, "vest.mtlx")?.material(None)?;
//! let Closure::RetroReflective { params, .. } = vest.surface.bsdf else { panic!("{vest:?}") };
//! assert_eq!(params.roughness_u, 0.05);
//!
//! let error = Document::parse(&text.replace("0.05", "shiny"), "vest.mtlx")?.material(None).unwrap_err();
//! assert_eq!(
//!     error.to_string(),
//!     "vest.mtlx:4:9: retro_reflective_bsdf \"beads\", input \"roughness_u\": \
//!      value \"shiny\" is not a number; write one like 0.5"
//! );
//! # Ok::<(), catseye_materialx::Error>(())
//! ```
//!
//! # What is read
//!
//! Documents of version 1.39, and of 1.38 as MaterialX upgrades them, in UTF-8, UTF-16 and ISO-8859-1:
//! `surfacematerial`, `surface` (`bsdf`, `edf`, `opacity`), `surface_unlit`, nodegraphs with interface
//! inputs, inside one another too, `xi:include`, looks, `fileprefix`, the colour spaces that MaterialX
//! defines, also inherited from an element further out. Units are ignored: [`Document::warnings`] says where.
//!
//! - BSDFs: `retro_reflective_bsdf`, `oren_nayar_diffuse_bsdf`, `burley_diffuse_bsdf`, `dielectric_bsdf`,
//!   `conductor_bsdf`, `generalized_schlick_bsdf` (these three with `retroreflective`), `sheen_bsdf`,
//!   `translucent_bsdf`, `mix`, `layer`, `add`, `multiply`; with a warning, `subsurface_bsdf` as diffuse
//!   reflection, and volumes and thin films not at all.
//! - EDFs: `uniform_edf`, `generalized_schlick_edf`, `mix`, `add`, `multiply`.
//! - Inputs that vary: 110 pattern nodes, from `image` to `worleynoise3d`. What of them doesn't depend on the
//!   geometry is computed once; the rest is a [`Patterns`] program, which [`Material::patterns`] runs at each
//!   [`ShadingPoint`].
//! - `retro_sheeting_surface` of our own data library.
//! - Nodes that the document or a [`Library`] defines as nodegraphs: `standard_surface`, `open_pbr_surface`,
//!   `gltf_pbr` where MaterialX's own libraries are on the [`SearchPath`]. In a definition's graph what has
//!   no weight is left out, and numbers outside their range are brought into it, not refused.
//!
//! Only what a material refers to is checked, and the first problem ends the reading; [`check`](check())
//! looks at everything, and has errors exactly where a material or look is refused.
//!
//! Hostile documents are refused in bounded time and memory: no document type declarations, at most 16 MiB,
//! 32 levels of elements, 64 BSDF nodes or 200 pattern nodes in a chain, 65,536 closures, 1,048,576 pattern
//! instructions, 256 included files, pictures of at most 16,384 pixels a side, 2^26 pixels, and 640 MiB of
//! memory together with what decoding takes, and no file outside the document's folder and the search path.

mod check;
mod closure;
mod color_space;
mod compile;
pub mod data_library;
mod document;
mod error;
mod graph;
mod nodes;
mod output;
mod picture;
mod program;
mod surface;
mod text;
mod value;

pub use check::{Finding, Report, Severity, check, check_bytes};
pub use closure::{Closure, ScatterMode, Surface};
pub use document::Document;
pub use error::{Error, Place, Warning};
pub use graph::library::Library;
pub use graph::look::{Assignment, Look};
pub use nodes::{bsdf_categories, pattern_categories};
pub use output::Output;
pub use program::ShadingPoint;
pub use surface::{Material, Patterns};
pub use text::files::SearchPath;
