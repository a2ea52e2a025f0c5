//! Compiles what feeds inputs: constants, pattern nodes, and nodes defined as graphs of them.

use std::{collections::HashMap, path::PathBuf, ptr};

use crate::{
    color_space::{COLOR_SPACES, ColorSpace},
    error::{Error, Place, Warning, listed, quoted},
    graph::{
        Feed, Graph, NodeRef, ROOT, ScopeId,
        bind::{Input, Node, is_built_in},
        input::{color_space, constant, no_output, output_feed, output_type, unknown_category},
        library::Library,
    },
    nodes::{
        Inputs, Meaning, Operand,
        port::{Port, Types},
    },
    output::Output,
    program::{Assembler, Expr, Geometry, Program, texture::Textures},
    text::{element::Element, files::Refusal},
    value::{Type, Value},
};

/// Pattern nodes in a chain: what keeps the recursion bounded.
const MAX_DEPTH: usize = 200;
/// Instructions of all materials of a document; the largest of MaterialX's examples has about 700.
const MAX_INSTRUCTIONS: usize = 1 << 18;

/// Instructions of the programs of all materials and outputs: what several use counts for each of them.
const MAX_COMPILED: usize = 1 << 20;

/// A node's output at one of the places that use it.
type Key<'a> = (ScopeId, *const Element, Option<&'a str>);

/// Compiles the patterns of one document.
#[derive(Debug)]
pub(crate) struct PatternCompiler<'a> {
    graph: &'a Graph<'a>,
    library: &'a Library,
    pub(crate) program: &'a Assembler,
    done: HashMap<Key<'a>, Operand<'a>>,
    /// Nodes that are being compiled, the outermost first.
    open: Vec<(Key<'a>, &'a Element)>,
    textures: Textures,
    /// Instructions of the programs so far.
    compiled: usize,
    /// What is approximated, a line each.
    pub(crate) warnings: Vec<Warning>,
}

impl<'a> PatternCompiler<'a> {
    pub(crate) fn new(graph: &'a Graph<'a>, library: &'a Library, program: &'a Assembler) -> Self {
        Self {
            graph,
            library,
            program,
            done: HashMap::new(),
            open: Vec::new(),
            textures: Textures::default(),
            compiled: 0,
            warnings: Vec::new(),
        }
    }

    pub(crate) fn warn(&mut self, at: Place, message: &str) {
        let warning = Warning { at, message: message.to_owned() };
        if !self.warnings.contains(&warning) {
            self.warnings.push(warning);
        }
    }

    /// What feeds an input of a BSDF, which stands in `owner`.
    pub(crate) fn feed(&mut self, owner: &'a Element, feed: Feed<'a>, ty: Type) -> Result<Expr<'a>, Error> {
        match self.operand(feed, ty)? {
            Some(Operand::Number(x)) => Ok(x),
            Some(_) => Err(Error::NoGraph { at: owner.place() }),
            None => Ok(self.program.number(0.0).to(ty.width())),
        }
    }

    /// One of the document's own outputs.
    pub(crate) fn output(&mut self, element: &'a Element) -> Result<Output, Error> {
        let name = element.require("name")?;
        if element.attribute("nodename").or(element.attribute("nodegraph")).is_none() {
            return Err(Error::MissingAttribute { at: element.place(), attribute: "nodename" });
        }
        let (feed, ty) = output_feed(self.graph, NodeRef { element, scope: ROOT })?;
        let Some(ty) = ty.filter(|ty| ty.width() > 0) else {
            let (found, expected) =
                (quoted(element.require("type")?), "a type of one to four numbers".to_owned());
            return Err(Error::WrongType { at: element.place(), found, expected });
        };
        let value = self.feed(element, feed, ty)?;
        Ok(Output::new(name.to_owned(), self.finish(element, &[value])?))
    }

    /// The program of a material or an output.
    pub(crate) fn finish(&mut self, element: &Element, results: &[Expr<'a>]) -> Result<Program, Error> {
        let program = self.program.finish(results);
        self.compiled += program.len();
        if self.compiled > MAX_COMPILED {
            let (what, limit) = ("pattern instructions of all materials together", MAX_COMPILED);
            return Err(Error::Limit { at: element.place(), what, limit });
        }
        Ok(program)
    }

    /// What feeds an input; `None` where nothing does.
    fn operand(&mut self, feed: Feed<'a>, ty: Type) -> Result<Option<Operand<'a>>, Error> {
        Ok(match feed {
            Feed::Default => None,
            Feed::Geometry(name) => Some(Operand::Number(match geometric_property(name) {
                Some(geometry) => self.program.geometry(geometry),
                None => self.program.number(0.0).to(ty.width()),
            })),
            Feed::Node { node, output } => Some(self.pattern(node, output)?),
            Feed::Value { owner, input } => Some(match constant(owner, input, ty)? {
                Value::Filename(name) => {
                    Operand::Texture(self.texture(owner, input, name, &COLOR_SPACES[0])?)
                }
                value => Operand::of_value(self.program, value),
            }),
        })
    }

    /// The output of a pattern node.
    fn pattern(&mut self, node: NodeRef<'a>, output: Option<&'a str>) -> Result<Operand<'a>, Error> {
        let key = (node.scope, ptr::from_ref(node.element), output);
        if let Some(known) = self.done.get(&key) {
            return Ok(*known);
        }
        self.enter(key, node.element)?;
        node.element.require("type")?;
        let operand = if is_built_in(node.element) {
            Operand::Number(self.built_in(&Node::bind(self.graph, node)?, output)?)
        } else {
            self.defined(node, output)?
        };
        self.open.pop();
        self.done.insert(key, operand);
        Ok(operand)
    }

    fn enter(&mut self, key: Key<'a>, element: &'a Element) -> Result<(), Error> {
        if let Some(start) = self.open.iter().position(|(open, _)| *open == key) {
            let cycle = self.open[start..].iter().map(|(_, element)| element.quoted_name());
            return Err(Error::Cycle { at: element.place(), cycle: listed(cycle) });
        }
        let limit = |what, limit| Err(Error::Limit { at: element.place(), what, limit });
        if self.open.len() >= MAX_DEPTH {
            return limit("pattern nodes in a chain", MAX_DEPTH);
        }
        if self.program.len() > MAX_INSTRUCTIONS {
            return limit("pattern instructions", MAX_INSTRUCTIONS);
        }
        self.open.push((key, element));
        Ok(())
    }

    /// A node that a definition's graph stands for.
    fn defined(&mut self, node: NodeRef<'a>, output: Option<&'a str>) -> Result<Operand<'a>, Error> {
        let definition = self.graph.definitions().find(node.element);
        let definition = definition.ok_or_else(|| unknown_category(self.graph, node.element))?;
        let ty = output_type(self.graph, node, output)?;
        let inside = self.graph.inside(definition, node, output)?;
        let inside = inside.ok_or_else(|| Error::NoGraph { at: node.element.place() })?;
        self.operand(inside, ty)?.ok_or_else(|| Error::NoGraph { at: node.element.place() })
    }

    fn built_in(&mut self, node: &Node<'a>, output: Option<&'a str>) -> Result<Expr<'a>, Error> {
        let mut operands = Vec::with_capacity(node.inputs.len());
        for (port, input) in node.def.inputs.iter().zip(&node.inputs) {
            operands.push(self.argument(node, port, *input)?);
        }
        let inputs = Inputs { program: self.program, ty: node.ty, ports: node.def.inputs, operands };
        match node.def.meaning {
            Meaning::Op(op) => Ok(inputs.op(op, &inputs.numbers().collect::<Vec<_>>())),
            Meaning::Formula(formula) => Ok(formula(&inputs).to(node.ty.width())),
            Meaning::Formulas(formulas) => {
                let name = output.unwrap_or_default();
                let index = node.def.outputs.iter().position(|(known, _)| *known == name);
                let found = index.and_then(|index| formulas(&inputs).get(index).copied());
                found.ok_or_else(|| no_output(node.node.element, name))
            }
            // The connection's type excludes it.
            Meaning::Lobe(_) | Meaning::Combination(_) | Meaning::Edf(_) | Meaning::Shader(_) => {
                Err(Error::NoGraph { at: node.node.element.place() })
            }
        }
    }

    /// An input of a pattern node.
    fn argument(
        &mut self,
        node: &Node<'a>,
        port: &'static Port,
        given: Input<'a>,
    ) -> Result<Operand<'a>, Error> {
        let operand = match (given.element, given.feed) {
            (Some(child), Feed::Value { owner, input }) if given.ty == Type::Filename => {
                let space = picture_space(owner, input, child, node.ty)?;
                let name = input.attribute("value").unwrap_or_default();
                Some(Operand::Texture(self.texture(owner, input, name, space)?))
            }
            (_, feed) => self.operand(feed, given.ty)?,
        };
        let Some(operand) = operand else { return Ok(Operand::of_default(self.program, port, node.ty)) };
        let at = || node.place_of(port.name);
        match (operand, given.ty) {
            (Operand::Number(x), ty) if ty.width() > 0 => {
                if port.accepts.is_uniform() {
                    let lanes = x.constant().ok_or_else(|| varies(node, port.name))?;
                    let value = Value::Integer(lanes[0] as i32);
                    if let Some(refusal) = port.accepts.refusal(value, node.ty) {
                        let message = format!("{} is {value}, {refusal}", port.name);
                        return Err(Error::OutOfRange { at: at(), message });
                    }
                }
                // A float stands for all components.
                let width =
                    if matches!(port.types, Types::SameOrFloat) { node.ty.width() } else { x.width() };
                Ok(Operand::Number(x.to(width)))
            }
            (Operand::Text(text), Type::String) => {
                if let Some(refusal) = port.accepts.refusal(Value::String(text), node.ty) {
                    let message = format!("{} is {}, {refusal}", port.name, quoted(text));
                    return Err(Error::OutOfRange { at: at(), message });
                }
                if port.name == "filtertype" && text == "cubic" {
                    self.warn(at(), "cubic is approximated by linear");
                }
                Ok(operand)
            }
            (Operand::Matrix(_), Type::Matrix33 | Type::Matrix44) | (Operand::Texture(_), Type::Filename) => {
                Ok(operand)
            }
            _ => Err(Error::NoGraph { at: at() }),
        }
    }

    /// The number of a texture; `None` where no file is named.
    fn texture(
        &mut self,
        owner: &'a Element,
        input: &'a Element,
        name: &str,
        space: &'static ColorSpace,
    ) -> Result<Option<u32>, Error> {
        if name.is_empty() {
            return Ok(None);
        }
        let path = find_picture(self.library, owner, input, name)?;
        let texture = self.textures.load(path, space).map_err(|refusal| Error::Picture {
            at: owner.place_of(input),
            name: quoted(name),
            message: refusal.to_string(),
        })?;
        Ok(Some(self.program.texture(texture)))
    }
}

/// The file that an input names.
pub(crate) fn find_picture(
    library: &Library,
    owner: &Element,
    input: &Element,
    name: &str,
) -> Result<PathBuf, Error> {
    let file = format!("{}{name}", input.fileprefix());
    library.search_path().find(input.source(), &file).map_err(|refusal| {
        let (at, name) = (owner.place_of(input), quoted(&file));
        match refusal {
            Refusal::Missing => Error::MissingFile { at, name },
            Refusal::Outside => Error::OutsideSearchPath { at, name },
            Refusal::Tiles => Error::Tiles { at, name },
        }
    })
}

/// The colour space of a picture: that of the input that names it where the node gives colours, else its
/// numbers are taken as they are.
fn picture_space(
    owner: &Element,
    literal: &Element,
    child: &Element,
    node_type: Type,
) -> Result<&'static ColorSpace, Error> {
    if !matches!(node_type, Type::Color3 | Type::Color4) {
        return Ok(&COLOR_SPACES[0]);
    }
    // An interface may name the space where the file is named, or where it is used.
    let named = if literal.attribute("colorspace").is_some() { literal } else { child };
    let named = if named.attribute("colorspace").is_some() { named } else { literal };
    color_space(owner, named)
}

/// What a default geometric property of MaterialX means.
fn geometric_property(name: &str) -> Option<Geometry> {
    Some(match name {
        "UV0" => Geometry::Texcoord,
        "Pobject" => Geometry::PositionObject,
        "Pworld" => Geometry::Position,
        "Nobject" | "Nworld" => Geometry::Normal,
        "Tobject" | "Tworld" => Geometry::Tangent,
        "Bobject" | "Bworld" => Geometry::Bitangent,
        "Vworld" => Geometry::View,
        _ => return None,
    })
}

/// That an input is connected to what varies, but must be the same everywhere.
pub(crate) fn varies(node: &Node<'_>, input: &str) -> Error {
    Error::Unsupported {
        at: node.place_of(input),
        what: "a connection to an input that is the same everywhere".to_owned(),
        instead: "write the value itself".to_owned(),
    }
}
