//! From nodes to materials.

use std::ptr;

use super::{
    pattern::PatternCompiler,
    slot::{Slot, SurfaceFill},
};
use crate::{
    closure::Closure,
    error::{Error, listed},
    graph::{
        Feed, Graph, NodeRef,
        bind::{Node, is_built_in},
        input::unknown_category,
        library::Library,
    },
    nodes::{Meaning, closures::Shader, port::Accepts},
    program::{Assembler, Expr, ShadingPoint},
    surface::{Material, Patterns},
    text::element::Element,
};

/// BSDF nodes on one path from a surface down; also what keeps the recursion of readers and renderers
/// bounded.
const MAX_DEPTH: usize = 64;
/// Closures of all materials of a document: a node with two users counts twice, so 30 nodes could make 2^30.
const MAX_CLOSURES: usize = 65_536;

/// Builds the materials of one document.
#[derive(Debug)]
pub(crate) struct Builder<'a> {
    pub(super) graph: &'a Graph<'a>,
    pub(super) patterns: PatternCompiler<'a>,
    /// What varies of the material being built.
    pub(super) outputs: Vec<Expr<'a>>,
    /// The nodes between the surface and the closure being built.
    path: Vec<NodeRef<'a>>,
    closures: usize,
}

impl<'a> Builder<'a> {
    pub(crate) fn new(graph: &'a Graph<'a>, library: &'a Library, program: &'a Assembler) -> Self {
        let patterns = PatternCompiler::new(graph, library, program);
        Self { graph, patterns, outputs: Vec::new(), path: Vec::new(), closures: 0 }
    }

    pub(crate) fn material(&mut self, material: NodeRef<'a>) -> Result<Material, Error> {
        self.patterns.warnings.clear();
        self.outputs.clear();
        let name = material.element.require("name")?.to_owned();
        let node = Node::bind(self.graph, material)?;
        let Some(surface) = node.connected("surfaceshader") else {
            return Err(Error::NoSurface { at: material.element.place() });
        };
        let surface = self.surface(surface, 0)?;
        if node.connected("displacementshader").is_some() {
            self.warn(&node, "displacementshader", "surfaces are not displaced: the displacement is ignored");
        }
        self.finish(material.element, name, surface)
    }

    /// The surface node behind a shader node, which may be defined as a graph.
    fn surface(&mut self, node: NodeRef<'a>, depth: usize) -> Result<SurfaceFill, Error> {
        if is_built_in(node.element) || depth > MAX_DEPTH {
            let node = Node::bind(self.graph, node)?;
            return self.built_in_surface(&node);
        }
        let inside = self.defined(node, None)?;
        self.surface(inside, depth + 1)
    }

    /// The node behind a node that a definition's graph stands for.
    pub(super) fn defined(&self, node: NodeRef<'a>, output: Option<&'a str>) -> Result<NodeRef<'a>, Error> {
        let definition = self.graph.definitions().find(node.element);
        let definition = definition.ok_or_else(|| unknown_category(self.graph, node.element))?;
        match self.graph.inside(definition, node, output)? {
            Some(Feed::Node { node, .. }) => Ok(node),
            _ => Err(Error::NoGraph { at: node.element.place() }),
        }
    }

    fn built_in_surface(&mut self, node: &Node<'a>) -> Result<SurfaceFill, Error> {
        let opacity = self.float(node, "opacity")?;
        let (bsdf, emission) = match node.def.meaning {
            Meaning::Shader(Shader::Surface) => {
                if self.boolean(node, "thin_walled")? {
                    let what = "thin walls are not rendered: light is refracted at each surface";
                    self.warn(node, "thin_walled", what);
                }
                (self.closure(node, "bsdf")?, self.emission(node, "edf")?)
            }
            Meaning::Shader(Shader::SurfaceUnlit) => {
                let emission = self.bounded(node, "emission_color")? * self.bounded(node, "emission")?;
                (None, Some(emission))
            }
            _ => return Err(Error::NoGraph { at: node.node.element.place() }),
        };
        let emission = match emission {
            None => Slot::Constant([0.0; 3]),
            Some(emission) => self.slot_of(emission, Accepts::NotNegative),
        };
        let bsdf = bsdf.unwrap_or_else(|| Box::new(|_| Closure::None));
        Ok(SurfaceFill { bsdf, opacity, emission })
    }

    fn finish(&mut self, element: &Element, name: String, surface: SurfaceFill) -> Result<Material, Error> {
        let program = self.patterns.finish(element, &self.outputs)?;
        let warnings = core::mem::take(&mut self.patterns.warnings);
        let shown = surface.at(&program.run(&ShadingPoint::default(), &mut Vec::new()));
        let patterns = (program.outputs() > 0).then(|| Patterns::new(surface, program));
        Ok(Material { name, surface: shown, patterns, warnings })
    }

    pub(super) fn warn(&mut self, node: &Node<'a>, input: &str, what: &str) {
        self.patterns.warn(node.place_of(input), what);
    }

    /// Begins with a BSDF or an EDF; [`Self::leave`] ends.
    pub(super) fn enter(&mut self, target: NodeRef<'a>) -> Result<(), Error> {
        let element: &'a Element = target.element;
        let is_target =
            |visited: &NodeRef<'_>| ptr::eq(visited.element, element) && visited.scope == target.scope;
        if let Some(start) = self.path.iter().position(is_target) {
            let cycle = self.path[start..].iter().map(|node| node.element.quoted_name());
            return Err(Error::Cycle { at: element.place(), cycle: listed(cycle) });
        }
        let limit = |what, limit| Err(Error::Limit { at: element.place(), what, limit });
        if self.path.len() >= MAX_DEPTH {
            return limit("BSDF nodes in a chain", MAX_DEPTH);
        }
        if self.closures >= MAX_CLOSURES {
            return limit("closures in all materials together", MAX_CLOSURES);
        }
        self.path.push(target);
        self.closures += 1;
        Ok(())
    }

    pub(super) fn leave(&mut self) {
        self.path.pop();
    }
}
