//! Surface materials, constant or varying.

use std::sync::Arc;

use crate::{
    closure::{Closure, Surface},
    compile::slot::SurfaceTemplate,
    program::{Program, ShadingPoint},
};

/// A surface material of a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The name of the `surfacematerial` node.
    pub name: String,
    /// The BSDF of its surface; where it varies, what it is at [`ShadingPoint::default`](crate::ShadingPoint).
    pub bsdf: Closure,
    /// Surface opacity, in `[0, 1]`; where it varies, as for `bsdf`.
    pub opacity: f32,
    /// Radiance that the surface emits; where it varies, as for `bsdf`.
    pub emission: [f32; 3],
    /// What the surface is at each point; `None` where it is the same everywhere.
    pub patterns: Option<Patterns>,
    /// What of the document is ignored or approximated, a line each.
    pub warnings: Vec<String>,
}

impl Default for Material {
    /// A surface that scatters nothing.
    fn default() -> Self {
        Self {
            name: String::new(),
            bsdf: Closure::None,
            opacity: 1.0,
            emission: [0.0; 3],
            patterns: None,
            warnings: Vec::new(),
        }
    }
}

/// A material that varies over the surface. Cheap to clone; used from any thread.
#[derive(Clone, Debug)]
pub struct Patterns {
    shared: Arc<(SurfaceTemplate, Program)>,
}

impl Patterns {
    pub(crate) fn new(surface: SurfaceTemplate, program: Program) -> Self {
        Self { shared: Arc::new((surface, program)) }
    }

    /// What the surface is at a point.
    #[must_use]
    pub fn at(&self, point: &ShadingPoint) -> Surface {
        self.at_with(point, &mut Vec::new())
    }

    /// As [`Self::at`], with room for registers that is used again from point to point.
    pub fn at_with(&self, point: &ShadingPoint, registers: &mut Vec<[f32; 4]>) -> Surface {
        let (surface, program) = &*self.shared;
        program.run(point, registers);
        surface.at(registers)
    }

    /// Whether the opacity varies.
    #[must_use]
    pub fn has_opacity(&self) -> bool {
        self.shared.0.opacity.register().is_some()
    }

    /// Bytes of all textures.
    #[must_use]
    pub fn texture_bytes(&self) -> usize {
        self.shared.1.texture_bytes()
    }
}

impl PartialEq for Patterns {
    /// Whether they are the same patterns, not merely alike.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.shared, &other.shared)
    }
}
