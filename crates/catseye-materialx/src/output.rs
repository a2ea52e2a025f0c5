//! The outputs of a document: patterns without a material.

use crate::program::{Program, ShadingPoint};

/// What an `<output>` of a document is connected to: numbers that may vary over a surface.
#[derive(Clone, Debug)]
pub struct Output {
    name: String,
    program: Program,
}

impl Output {
    /// The program has one output.
    pub(crate) fn new(name: String, program: Program) -> Self {
        Self { name, program }
    }

    /// The name of the element.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The numbers at a point, as computed: components that its type doesn't have are 0, booleans 0 or 1.
    #[must_use]
    pub fn at(&self, point: &ShadingPoint) -> [f32; 4] {
        self.program.run(point, &mut Vec::new()).get(0)
    }
}
