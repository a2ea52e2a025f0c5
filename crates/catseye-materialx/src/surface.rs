//! Surface materials, constant or varying.

use core::fmt;
use std::sync::Arc;

use crate::{
    closure::{Closure, Surface},
    compile::slot::{Slot, SurfaceFill},
    error::Warning,
    program::{Program, ShadingPoint},
};

/// A surface material of a document.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Material {
    /// The name of the `surfacematerial` node.
    pub name: String,
    /// What its surface is; where it varies, at [`ShadingPoint::default`](crate::ShadingPoint).
    pub surface: Surface,
    /// What the surface is at each point; `None` where it is the same everywhere.
    pub patterns: Option<Patterns>,
    /// What of the document is ignored or approximated.
    pub warnings: Vec<Warning>,
}

impl Material {
    /// An opaque material without a name that scatters the same everywhere.
    #[must_use]
    pub fn of(bsdf: Closure) -> Self {
        Self { surface: Surface { bsdf, ..Surface::default() }, ..Self::default() }
    }

    /// What its surface is at a point.
    #[must_use]
    pub fn at(&self, point: &ShadingPoint) -> Surface {
        self.patterns.as_ref().map_or_else(|| self.surface.clone(), |patterns| patterns.at(point))
    }
}

/// A material that varies over the surface. Cheap to clone; used from any thread.
#[derive(Clone)]
pub struct Patterns {
    shared: Arc<(SurfaceFill, Program)>,
}

impl Patterns {
    pub(crate) fn new(surface: SurfaceFill, program: Program) -> Self {
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
        surface.at(&program.run(point, registers))
    }

    /// Whether the opacity varies.
    #[must_use]
    pub fn has_opacity(&self) -> bool {
        matches!(self.shared.0.opacity, Slot::Output { .. })
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

impl fmt::Debug for Patterns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Patterns").field(&self.shared.1).finish()
    }
}
