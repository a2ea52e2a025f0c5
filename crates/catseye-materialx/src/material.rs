//! From nodes to closures.

use std::ptr;

use catseye::Params;

use crate::{
    closure::{Closure, Material, ScatterMode},
    element::Element,
    error::{Error, listed},
    graph::{Graph, NodeRef},
    node::Node,
    nodedef::Kind,
};

/// BSDF nodes on one path from a surface down; also what keeps the recursion of readers and renderers bounded.
const MAX_DEPTH: usize = 64;
/// Closures of all materials of a document: a node with two users counts twice, so 30 nodes could make 2^30.
const MAX_CLOSURES: usize = 65_536;

/// Builds the materials of one document.
#[derive(Debug)]
pub(crate) struct Builder<'a> {
    graph: &'a Graph<'a>,
    /// The nodes between the surface and the closure being built.
    path: Vec<&'a Element>,
    closures: usize,
}

impl<'a> Builder<'a> {
    pub(crate) fn new(graph: &'a Graph<'a>) -> Self {
        Self { graph, path: Vec::new(), closures: 0 }
    }

    pub(crate) fn material(&mut self, material: NodeRef<'a>) -> Result<Material, Error> {
        let name = material.element.require("name")?.to_owned();
        let node = Node::bind(self.graph, material)?;
        let Some(surface) = node.connected("surfaceshader") else {
            return Err(Error::NoSurface { at: node.element.place() });
        };
        let surface = Node::bind(self.graph, surface)?;
        Ok(Material { name, bsdf: self.closure(&surface, "bsdf")?, opacity: surface.float("opacity") })
    }

    /// The closure that an input is connected to.
    fn closure(&mut self, node: &Node<'a>, input: &str) -> Result<Closure, Error> {
        let Some(target) = node.connected(input) else { return Ok(Closure::None) };
        self.enter(target.element)?;
        let closure = self.bsdf(&Node::bind(self.graph, target)?)?;
        self.path.pop();
        Ok(closure)
    }

    /// [`Self::closure`] on the heap.
    fn boxed(&mut self, node: &Node<'a>, input: &str) -> Result<Box<Closure>, Error> {
        self.closure(node, input).map(Box::new)
    }

    fn enter(&mut self, element: &'a Element) -> Result<(), Error> {
        if let Some(start) = self.path.iter().position(|&visited| ptr::eq(visited, element)) {
            let cycle = self.path[start..].iter().map(|element| element.quoted_name());
            return Err(Error::Cycle { at: element.place(), cycle: listed(cycle) });
        }
        let limit = |what, limit| Err(Error::Limit { at: element.place(), what, limit });
        if self.path.len() >= MAX_DEPTH {
            return limit("BSDF nodes in a chain", MAX_DEPTH);
        }
        if self.closures >= MAX_CLOSURES {
            return limit("closures in all materials together", MAX_CLOSURES);
        }
        self.path.push(element);
        self.closures += 1;
        Ok(())
    }

    fn bsdf(&mut self, node: &Node<'a>) -> Result<Closure, Error> {
        Ok(match node.def.kind {
            Kind::RetroReflective => retro_reflective(node)?,
            Kind::OrenNayarDiffuse => oren_nayar_diffuse(node),
            Kind::Dielectric => dielectric(node),
            Kind::Mix => Closure::Mix {
                foreground: self.boxed(node, "fg")?,
                background: self.boxed(node, "bg")?,
                amount: node.float("mix"),
            },
            Kind::Layer => Closure::Layer { top: self.boxed(node, "top")?, base: self.boxed(node, "base")? },
            Kind::Add => Closure::Add { a: self.boxed(node, "in1")?, b: self.boxed(node, "in2")? },
            Kind::Multiply => {
                Closure::Multiply { closure: self.boxed(node, "in1")?, factor: node.color("in2") }
            }
            // The connection's type excludes them.
            Kind::Surface | Kind::SurfaceMaterial => Closure::None,
        })
    }
}

fn retro_reflective(node: &Node<'_>) -> Result<Closure, Error> {
    let roughness_v = node.float("roughness_v");
    let params = Params {
        roughness_u: node.float("roughness_u"),
        // MaterialX has no default that refers to another input: a negative value means "as roughness_u".
        roughness_v: (roughness_v >= 0.0).then_some(roughness_v),
        tint: node.color("tint"),
        multiscatter_tint: node.color("multiscatter_tint"),
    };
    as_written(&params)
        .validate()
        .map_err(|cause| Error::OutOfRange { at: node.place_of(cause.name()), message: cause.to_string() })?;
    let tangent_u = node.direction("tangent_u").map(unit);
    Ok(Closure::RetroReflective { weight: node.float("weight"), params, tangent_u })
}

/// The parameters to more digits, so that a refusal shows 1.1 and not 1.100000023841858, the f32 next to it.
fn as_written(params: &Params<f32>) -> Params<f64> {
    let written = |x: f32| x.to_string().parse().unwrap_or(f64::from(x));
    Params {
        roughness_u: written(params.roughness_u),
        roughness_v: params.roughness_v.map(written),
        tint: params.tint.map(written),
        multiscatter_tint: params.multiscatter_tint.map(written),
    }
}

fn oren_nayar_diffuse(node: &Node<'_>) -> Closure {
    Closure::OrenNayarDiffuse {
        weight: node.float("weight"),
        color: node.color("color"),
        roughness: node.float("roughness"),
        energy_compensation: node.boolean("energy_compensation"),
    }
}

fn dielectric(node: &Node<'_>) -> Closure {
    Closure::Dielectric {
        weight: node.float("weight"),
        tint: node.color("tint"),
        ior: node.float("ior"),
        roughness: node.vector2("roughness"),
        scatter_mode: match node.word("scatter_mode") {
            "T" => ScatterMode::Transmit,
            "RT" => ScatterMode::ReflectTransmit,
            _ => ScatterMode::Reflect,
        },
    }
}

/// The direction at length 1, whatever its length; it must be finite and not zero.
fn unit(direction: [f32; 3]) -> [f32; 3] {
    let largest = direction.iter().fold(0.0_f32, |largest, x| largest.max(x.abs()));
    let scaled = direction.map(|x| x / largest);
    let length = scaled.iter().map(|x| x * x).sum::<f32>().sqrt();
    scaled.map(|x| x / length)
}
