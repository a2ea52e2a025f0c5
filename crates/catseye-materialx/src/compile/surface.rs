//! From nodes to materials.

use std::ptr;

use crate::{
    closure::ScatterMode,
    compile::{
        pattern::{PatternCompiler, varies},
        slot::{Leaf, Slot, SurfaceTemplate, Template, finite},
    },
    error::{Error, listed},
    graph::{
        Feed, Graph, NodeRef,
        bind::{Node, is_built_in},
        input::{constant, unknown_category},
        library::Library,
    },
    nodes::{
        Meaning,
        closures::Kind,
        port::{Accepts, Default},
    },
    program::{Assembler, Expr, Geometry},
    surface::{Material, Patterns},
    text::element::Element,
    value::{Type, Value},
};

/// BSDF nodes on one path from a surface down; also what keeps the recursion of readers and renderers bounded.
const MAX_DEPTH: usize = 64;
/// Closures of all materials of a document: a node with two users counts twice, so 30 nodes could make 2^30.
const MAX_CLOSURES: usize = 65_536;

/// Builds the materials of one document.
#[derive(Debug)]
pub(crate) struct Builder<'a> {
    graph: &'a Graph<'a>,
    patterns: PatternCompiler<'a>,
    /// The nodes between the surface and the closure being built.
    path: Vec<NodeRef<'a>>,
    closures: usize,
}

impl<'a> Builder<'a> {
    pub(crate) fn new(graph: &'a Graph<'a>, library: &'a Library, program: &'a Assembler) -> Self {
        Self { graph, patterns: PatternCompiler::new(graph, library, program), path: Vec::new(), closures: 0 }
    }

    pub(crate) fn material(&mut self, material: NodeRef<'a>) -> Result<Material, Error> {
        self.patterns.warnings.clear();
        let name = material.element.require("name")?.to_owned();
        let node = Node::bind(self.graph, material)?;
        let Some(surface) = node.connected("surfaceshader") else {
            return Err(Error::NoSurface { at: material.element.place() });
        };
        let surface = self.surface(surface, 0)?;
        if node.connected("displacementshader").is_some() {
            self.warn(&node, "displacementshader", "surfaces are not displaced: the displacement is ignored");
        }
        Ok(self.finish(name, surface))
    }

    /// The surface node behind a shader node, which may be defined as a graph.
    fn surface(&mut self, node: NodeRef<'a>, depth: usize) -> Result<SurfaceTemplate, Error> {
        if is_built_in(node.element) || depth > MAX_DEPTH {
            let node = Node::bind(self.graph, node)?;
            return self.built_in_surface(&node);
        }
        let inside = self.defined(node, None)?;
        self.surface(inside, depth + 1)
    }

    /// The node behind a node that a definition's graph stands for.
    fn defined(&self, node: NodeRef<'a>, output: Option<&'a str>) -> Result<NodeRef<'a>, Error> {
        let definition = self.graph.definitions().find(node.element);
        let definition = definition.ok_or_else(|| unknown_category(self.graph, node.element))?;
        match self.graph.inside(definition, node, output)? {
            Some(Feed::Node { node, .. }) => Ok(node),
            _ => Err(Error::NoGraph { at: node.element.place() }),
        }
    }

    fn built_in_surface(&mut self, node: &Node<'a>) -> Result<SurfaceTemplate, Error> {
        let opacity = self.float(node, "opacity")?;
        if node.def.input("thin_walled").is_some() && self.boolean(node, "thin_walled")? {
            self.warn(node, "thin_walled", "thin walls are not rendered: light is refracted at each surface");
        }
        let (bsdf, emission) = match kind(node) {
            Kind::SurfaceUnlit => {
                let emission = self.bounded(node, "emission_color")? * self.bounded(node, "emission")?;
                (Template::None, Some(emission))
            }
            _ => (self.closure(node, "bsdf")?, self.emission(node, "edf")?),
        };
        let emission = match emission {
            None => Slot::Constant([0.0; 3]),
            Some(emission) => slot_of(emission, Accepts::NotNegative),
        };
        Ok(SurfaceTemplate { bsdf, opacity, emission })
    }

    fn finish(&mut self, name: String, mut surface: SurfaceTemplate) -> Material {
        let wanted = surface.registers();
        let warnings = core::mem::take(&mut self.patterns.warnings);
        let (program, places) = self.patterns.program.finish(&wanted);
        surface.relocate(&|register| places[&register]);
        let mut registers = Vec::new();
        program.run(&crate::ShadingPoint::default(), &mut registers);
        let shown = surface.at(&registers);
        let patterns = (!wanted.is_empty()).then(|| Patterns::new(surface, program));
        let (bsdf, opacity, emission) = (shown.bsdf, shown.opacity, shown.emission);
        Material { name, bsdf, opacity, emission, patterns, warnings }
    }

    fn warn(&mut self, node: &Node<'a>, input: &str, what: &str) {
        self.patterns.warn(format!("{}: {what}", node.place_of(input)));
    }

    /// The closure that an input is connected to.
    fn closure(&mut self, node: &Node<'a>, input: &str) -> Result<Template, Error> {
        let Some(target) = node.connected(input) else { return Ok(Template::None) };
        self.closure_of(target)
    }

    fn closure_of(&mut self, target: NodeRef<'a>) -> Result<Template, Error> {
        self.enter(target)?;
        let closure = if is_built_in(target.element) {
            let node = Node::bind(self.graph, target)?;
            self.bsdf(&node)?
        } else {
            let inside = self.defined(target, None)?;
            self.closure_of(inside)?
        };
        self.path.pop();
        Ok(closure)
    }

    /// [`Self::closure`] on the heap.
    fn boxed(&mut self, node: &Node<'a>, input: &str) -> Result<Box<Template>, Error> {
        self.closure(node, input).map(Box::new)
    }

    fn enter(&mut self, target: NodeRef<'a>) -> Result<(), Error> {
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

    fn bsdf(&mut self, node: &Node<'a>) -> Result<Template, Error> {
        Ok(match kind(node) {
            Kind::Mix => return self.mix(node),
            Kind::Layer if node.input("base").0.ty == Type::Vdf => {
                if node.connected("base").is_some() {
                    self.warn(node, "base", "volumes are not rendered: the volume is ignored");
                }
                self.closure(node, "top")?
            }
            Kind::Layer => {
                let (top, base) = (self.boxed(node, "top")?, self.boxed(node, "base")?);
                match (&*top, &*base) {
                    (Template::None, _) if self.may_prune(node) => *base,
                    (_, Template::None) if self.may_prune(node) => *top,
                    _ => Template::Layer { top, base },
                }
            }
            Kind::Add => Template::Add { a: self.boxed(node, "in1")?, b: self.boxed(node, "in2")? },
            Kind::Multiply => {
                let factor = self.color(node, "in2")?;
                if factor == Slot::Constant([0.0; 3]) && self.may_prune(node) {
                    return Ok(Template::None);
                }
                Template::Multiply { closure: self.boxed(node, "in1")?, factor }
            }
            _ => return self.leaf(node),
        })
    }

    /// Whether what doesn't count may be left out: in a definition, whose author can't be told what is wrong.
    fn may_prune(&self, node: &Node<'a>) -> bool {
        !self.graph.is_in_document(node.node.scope)
    }

    fn mix(&mut self, node: &Node<'a>) -> Result<Template, Error> {
        let amount = self.float(node, "mix")?;
        if self.may_prune(node) {
            if amount == Slot::Constant([0.0]) {
                return self.closure(node, "bg");
            }
            if amount == Slot::Constant([1.0]) {
                return self.closure(node, "fg");
            }
        }
        Ok(Template::Mix { foreground: self.boxed(node, "fg")?, background: self.boxed(node, "bg")?, amount })
    }

    fn leaf(&mut self, node: &Node<'a>) -> Result<Template, Error> {
        let weight = self.float(node, "weight")?;
        if weight == Slot::Constant([0.0]) && self.may_prune(node) {
            return Ok(Template::None);
        }
        let leaf = match kind(node) {
            Kind::RetroReflective => self.retro_reflective(node)?,
            Kind::OrenNayarDiffuse => Leaf::OrenNayar {
                color: self.color(node, "color")?,
                roughness: self.float(node, "roughness")?,
                energy_compensation: self.boolean(node, "energy_compensation")?,
            },
            Kind::BurleyDiffuse => {
                Leaf::Burley { color: self.color(node, "color")?, roughness: self.float(node, "roughness")? }
            }
            Kind::Translucent => Leaf::Translucent { color: self.color(node, "color")? },
            Kind::Subsurface => {
                self.warn(node, "radius", "subsurface scattering is approximated by diffuse reflection");
                let color = self.color(node, "color")?;
                Leaf::OrenNayar { color, roughness: Slot::Constant([0.0]), energy_compensation: false }
            }
            Kind::Sheen => {
                if self.word(node, "mode")? == "zeltner" {
                    self.warn(node, "mode", "zeltner is approximated by conty_kulla");
                }
                Leaf::Sheen { color: self.color(node, "color")?, roughness: self.float(node, "roughness")? }
            }
            Kind::Dielectric => {
                self.film(node)?;
                Leaf::Dielectric {
                    tint: self.color(node, "tint")?,
                    ior: self.float(node, "ior")?,
                    roughness: self.slot(node, "roughness")?,
                    retroreflective: self.boolean(node, "retroreflective")?,
                    scatter_mode: self.scatter_mode(node)?,
                }
            }
            Kind::Conductor => {
                self.film(node)?;
                Leaf::Conductor {
                    ior: self.color(node, "ior")?,
                    extinction: self.color(node, "extinction")?,
                    roughness: self.slot(node, "roughness")?,
                    retroreflective: self.boolean(node, "retroreflective")?,
                }
            }
            Kind::GeneralizedSchlick => {
                self.film(node)?;
                Leaf::Schlick {
                    color0: self.color(node, "color0")?,
                    color82: self.color(node, "color82")?,
                    color90: self.color(node, "color90")?,
                    exponent: self.float(node, "exponent")?,
                    roughness: self.slot(node, "roughness")?,
                    retroreflective: self.boolean(node, "retroreflective")?,
                    scatter_mode: self.scatter_mode(node)?,
                }
            }
            // The connection's type excludes the rest.
            _ => return Ok(Template::None),
        };
        self.oriented(node, leaf, weight)
    }

    fn oriented(&mut self, node: &Node<'a>, leaf: Leaf, weight: Slot<1>) -> Result<Template, Error> {
        let normal = self.direction(node, "normal", Geometry::Normal)?;
        let tangent = match node.def.input("tangent") {
            Some(_) => self.direction(node, "tangent", Geometry::Tangent)?,
            None => None,
        };
        if normal.is_none() && tangent.is_none() {
            return Ok(Template::Leaf(leaf, weight));
        }
        Ok(Template::Oriented { leaf, weight, normal, tangent })
    }

    fn film(&mut self, node: &Node<'a>) -> Result<(), Error> {
        if self.float(node, "thinfilm_thickness")? != Slot::Constant([0.0]) {
            self.warn(node, "thinfilm_thickness", "thin films are not rendered: the film is ignored");
        }
        Ok(())
    }

    fn retro_reflective(&mut self, node: &Node<'a>) -> Result<Leaf, Error> {
        let leaf = Leaf::RetroReflective {
            roughness_u: self.slot_within(node, "roughness_u", Accepts::Roughness)?,
            roughness_v: self.slot(node, "roughness_v")?,
            tint: self.slot_within(node, "tint", Accepts::Unit)?,
            multiscatter_tint: self.slot_within(node, "multiscatter_tint", Accepts::Unit)?,
            tangent_u: self.direction(node, "tangent_u", Geometry::Tangent)?,
        };
        leaf.check(|cause| Error::OutOfRange {
            at: node.place_of(cause.name()),
            message: cause.to_string(),
        })?;
        Ok(leaf)
    }

    /// The radiance that an EDF input is connected to.
    fn emission(&mut self, node: &Node<'a>, input: &str) -> Result<Option<Expr<'a>>, Error> {
        let Some(target) = node.connected(input) else { return Ok(None) };
        self.emission_of(target)
    }

    fn emission_of(&mut self, target: NodeRef<'a>) -> Result<Option<Expr<'a>>, Error> {
        self.enter(target)?;
        let radiance = if is_built_in(target.element) {
            let node = Node::bind(self.graph, target)?;
            self.edf(&node)?
        } else {
            let inside = self.defined(target, None)?;
            self.emission_of(inside)?
        };
        self.path.pop();
        Ok(radiance)
    }

    /// `None` for an EDF that emits nothing.
    fn edf(&mut self, node: &Node<'a>) -> Result<Option<Expr<'a>>, Error> {
        let sum = |a: Option<Expr<'a>>, b: Option<Expr<'a>>| match (a, b) {
            (Some(a), Some(b)) => Some(a + b),
            (a, b) => a.or(b),
        };
        Ok(match kind(node) {
            Kind::UniformEdf => {
                let color = self.bounded(node, "color")?;
                (color.constant() != Some([0.0; 4])).then_some(color)
            }
            Kind::AddEdf => sum(self.emission(node, "in1")?, self.emission(node, "in2")?),
            Kind::MultiplyEdf => {
                let factor = self.bounded(node, "in2")?;
                self.emission(node, "in1")?.map(|a| a * factor)
            }
            Kind::MixEdf => {
                let amount = self.bounded(node, "mix")?;
                let (fg, bg) = (self.emission(node, "fg")?, self.emission(node, "bg")?);
                sum(fg.map(|fg| fg * amount), bg.map(|bg| bg * (1.0 - amount)))
            }
            Kind::SchlickEdf => self.schlick_edf(node)?,
            // The connection's type excludes the rest.
            _ => None,
        })
    }

    /// The base's radiance times `color0 + (color90 - color0) (1 - cos)^exponent`.
    fn schlick_edf(&mut self, node: &Node<'a>) -> Result<Option<Expr<'a>>, Error> {
        let Some(base) = self.emission(node, "base")? else { return Ok(None) };
        let (color0, color90) = (self.bounded(node, "color0")?, self.bounded(node, "color90")?);
        let exponent = self.bounded(node, "exponent")?;
        let [view, normal] =
            [Geometry::View, Geometry::Normal].map(|own| self.patterns.program.geometry(own));
        let share = (1.0 - view.dot(normal).abs()).max(0.0).power(exponent);
        Ok(Some(base * color0.mix(color90, share)))
    }

    /// An input's numbers in the range of its definition, to compute with.
    fn bounded(&mut self, node: &Node<'a>, input: &str) -> Result<Expr<'a>, Error> {
        let x = self.expr(node, input)?;
        Ok(match node.input(input).1.accepts {
            Accepts::Unit => x.clamp(0.0, 1.0),
            Accepts::NotNegative => x.max(0.0),
            _ => x,
        })
    }

    /// An input's numbers as they are computed.
    fn expr(&mut self, node: &Node<'a>, input: &str) -> Result<Expr<'a>, Error> {
        let (given, port) = node.input(input);
        let width = given.ty.width();
        match (given.feed, port.default) {
            (Feed::Default, Default::Number(x)) => Ok(self.patterns.program.number(x).to(width)),
            (Feed::Default, Default::Value(value)) => Ok(self.patterns.program.lanes(value.lanes(), width)),
            (feed, _) => self.patterns.feed(node.node.element, feed, given.ty),
        }
    }

    /// An input's numbers, computed ones in the range of its definition.
    fn slot<const N: usize>(&mut self, node: &Node<'a>, input: &str) -> Result<Slot<N>, Error> {
        let accepts = node.input(input).1.accepts;
        self.slot_within(node, input, accepts)
    }

    fn slot_within<const N: usize>(
        &mut self,
        node: &Node<'a>,
        input: &str,
        accepts: Accepts,
    ) -> Result<Slot<N>, Error> {
        let is_written = matches!(node.input(input).0.feed, Feed::Value { .. } | Feed::Default);
        let value = self.expr(node, input)?.to(N as u8);
        match value.constant() {
            // What a document says is in range, or its receiver refuses it.
            Some(lanes) if is_written && self.graph.is_in_document(node.node.scope) => {
                Ok(Slot::Constant(core::array::from_fn(|i| lanes[i])))
            }
            _ => Ok(slot_of(value, accepts)),
        }
    }

    fn float(&mut self, node: &Node<'a>, input: &str) -> Result<Slot<1>, Error> {
        self.slot(node, input)
    }

    /// A colour, or a float that stands for all three channels.
    fn color(&mut self, node: &Node<'a>, input: &str) -> Result<Slot<3>, Error> {
        self.slot(node, input)
    }

    /// A direction; `None` where it is the geometry's own.
    fn direction(&mut self, node: &Node<'a>, input: &str, own: Geometry) -> Result<Option<Slot<3>>, Error> {
        if matches!(node.input(input).0.feed, Feed::Default) {
            return Ok(None);
        }
        let slot: Slot<3> = self.slot(node, input)?;
        let own = self.patterns.program.geometry(own).register();
        Ok((slot.register() != Some(own)).then_some(slot))
    }

    fn boolean(&mut self, node: &Node<'a>, input: &str) -> Result<bool, Error> {
        match self.uniform(node, input)? {
            Value::Boolean(x) => Ok(x),
            _ => Ok(false),
        }
    }

    fn word(&mut self, node: &Node<'a>, input: &str) -> Result<&'a str, Error> {
        match self.uniform(node, input)? {
            Value::String(x) => Ok(x),
            _ => Ok(""),
        }
    }

    /// A value that can't vary over the surface.
    fn uniform(&mut self, node: &Node<'a>, input: &str) -> Result<Value<'a>, Error> {
        let (given, port) = node.input(input);
        match (given.feed, port.default) {
            (Feed::Value { owner, input }, _) => constant(owner, input, given.ty),
            (Feed::Node { .. }, _) if given.ty == Type::Boolean => {
                let value = self.patterns.feed(node.node.element, given.feed, given.ty)?.constant();
                value.map(|lanes| Value::Boolean(lanes[0] != 0.0)).ok_or_else(|| varies(node, input))
            }
            (Feed::Default, Default::Value(value)) => Ok(value),
            _ => Err(varies(node, input)),
        }
    }

    fn scatter_mode(&mut self, node: &Node<'a>) -> Result<ScatterMode, Error> {
        Ok(match self.word(node, "scatter_mode")? {
            "T" => ScatterMode::Transmit,
            "RT" => ScatterMode::ReflectTransmit,
            _ => ScatterMode::Reflect,
        })
    }
}

/// What a closure node is.
fn kind(node: &Node<'_>) -> Kind {
    match node.def.meaning {
        Meaning::Closure(kind) => kind,
        // Types of closures are none of patterns.
        _ => unreachable!("{} is no closure", node.def.category),
    }
}

fn slot_of<const N: usize>(value: Expr<'_>, accepts: Accepts) -> Slot<N> {
    match value.constant() {
        Some(lanes) => Slot::Constant(core::array::from_fn(|i| finite(accepts.nearest(lanes[i])))),
        None => Slot::Register { register: value.register(), accepts },
    }
}
