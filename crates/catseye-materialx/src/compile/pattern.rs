//! Compiles what feeds inputs: constants, pattern nodes, and nodes defined as graphs of them.

use std::{
    collections::{HashMap, HashSet},
    path::PathBuf,
    ptr,
};

use crate::{
    color_space::{COLOR_SPACES, ColorSpace},
    error::{Error, listed, quoted},
    graph::{
        Feed, Graph, MOST_PROBLEMS, NodeRef, ROOT, ScopeId,
        input::{
            check_connection, color_space, constant, no_output, output_feed, output_type, unknown_category,
        },
        library::Library,
    },
    nodes::{Lowering, Operand, Parameter, Port, Signature, signature, signatures},
    output::Output,
    program::{Geometry, texture::Textures},
    text::{element::Element, files::Refusal},
    value::{Type, Value},
};

/// Pattern nodes in a chain: what keeps the recursion bounded.
const MAX_DEPTH: usize = 200;
/// Instructions of all materials of a document; the largest of MaterialX's examples has about 700.
const MAX_INSTRUCTIONS: usize = 1 << 18;

/// A node's output at one of the places that use it.
type Key<'a> = (ScopeId, *const Element, Option<&'a str>);

/// Compiles the patterns of one document.
#[derive(Debug)]
pub(crate) struct PatternCompiler<'a> {
    graph: &'a Graph<'a>,
    library: &'a Library,
    pub(crate) lowering: Lowering,
    done: HashMap<Key<'a>, Operand>,
    /// Nodes that are being compiled, the outermost first.
    open: Vec<(Key<'a>, &'a Element)>,
    textures: Textures,
}

impl<'a> PatternCompiler<'a> {
    pub(crate) fn new(graph: &'a Graph<'a>, library: &'a Library) -> Self {
        Self {
            graph,
            library,
            lowering: Lowering::default(),
            done: HashMap::new(),
            open: Vec::new(),
            textures: Textures::default(),
        }
    }

    /// The constant that feeds an input.
    pub(crate) fn constant(&self, feed: Feed<'a>, ty: Type) -> Result<Value<'a>, Error> {
        match feed {
            Feed::Value { owner, input } => constant(owner, input, ty),
            // Callers have looked.
            _ => Ok(Value::Float(0.0)),
        }
    }

    /// The register with what feeds an input of a BSDF, which stands in `owner`.
    pub(crate) fn feed(&mut self, owner: &'a Element, feed: Feed<'a>, ty: Type) -> Result<u32, Error> {
        match self.operand(feed, ty)? {
            Some(Operand::Register(register)) => Ok(register),
            Some(_) => Err(Error::NoGraph { at: owner.place() }),
            None => Ok(self.lowering.number(0.0, ty.width())),
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
        let register = self.feed(element, feed, ty)?;
        let (program, places) = self.lowering.assembler.finish(&[register]);
        Ok(Output::new(name.to_owned(), program, places[&register]))
    }

    /// What feeds an input; `None` where nothing does.
    fn operand(&mut self, feed: Feed<'a>, ty: Type) -> Result<Option<Operand>, Error> {
        Ok(match feed {
            Feed::Default => None,
            Feed::Geometry(name) => match geometric_property(name) {
                Some(geometry) => Some(Operand::Register(self.lowering.geometry(geometry))),
                None => Some(Operand::Register(self.lowering.number(0.0, ty.width()))),
            },
            Feed::Node { node, output } => Some(self.pattern(node, output)?),
            Feed::Value { owner, input } => Some(self.literal(owner, input, ty)?),
        })
    }

    fn literal(&mut self, owner: &'a Element, input: &'a Element, ty: Type) -> Result<Operand, Error> {
        Ok(match constant(owner, input, ty)? {
            Value::String(text) => Operand::Text(text.to_owned()),
            Value::Filename(name) => {
                return self.texture(owner, input, name, &COLOR_SPACES[0]).map(Operand::Texture);
            }
            Value::Matrix33(matrix) => Operand::Matrix(matrix),
            value if ty.width() > 0 => Operand::Register(self.lowering.lanes(value.lanes(), ty.width())),
            _ => Operand::Text(String::new()),
        })
    }

    /// The output of a pattern node.
    fn pattern(&mut self, node: NodeRef<'a>, output: Option<&'a str>) -> Result<Operand, Error> {
        let key = (node.scope, ptr::from_ref(node.element), output);
        if let Some(known) = self.done.get(&key) {
            return Ok(known.clone());
        }
        self.enter(key, node.element)?;
        let ty = Type::parse(node.element.require("type")?);
        let signature = ty.and_then(|ty| Some((signature(node.element.tag(), ty)?, ty)));
        let operand = match signature {
            Some((signature, ty)) => self.built_in(signature, ty, node, output)?,
            None => self.defined(node, output)?,
        };
        self.open.pop();
        self.done.insert(key, operand.clone());
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
        if self.lowering.assembler.len() > MAX_INSTRUCTIONS {
            return limit("pattern instructions", MAX_INSTRUCTIONS);
        }
        self.open.push((key, element));
        Ok(())
    }

    /// A node that a definition's graph stands for.
    fn defined(&mut self, node: NodeRef<'a>, output: Option<&'a str>) -> Result<Operand, Error> {
        let definition = self.graph.definitions().find(node.element);
        let definition = definition.ok_or_else(|| unknown_category(self.graph, node.element))?;
        let ty = output_type(self.graph, node, output)?;
        let inside = self.graph.inside(definition, node, output)?;
        let inside = inside.ok_or_else(|| Error::NoGraph { at: node.element.place() })?;
        self.operand(inside, ty)?.ok_or_else(|| Error::NoGraph { at: node.element.place() })
    }

    fn built_in(
        &mut self,
        signature: &'static Signature,
        ty: Type,
        node: NodeRef<'a>,
        output: Option<&'a str>,
    ) -> Result<Operand, Error> {
        let mut problems = Vec::new();
        let inputs = bind_pattern(self.graph, signature, ty, node, &mut problems);
        if !problems.is_empty() {
            return Err(problems.swap_remove(0));
        }
        let mut operands = Vec::with_capacity(inputs.len());
        for (given, parameter) in inputs.iter().zip(signature.inputs) {
            operands.push(self.argument(node.element, ty, parameter, *given)?);
        }
        let outputs = self.lowering.node(signature, ty, &operands).ok_or_else(|| Error::Unsupported {
            at: node.element.place(),
            what: "one of its settings, or a varying one that must be constant,".to_owned(),
            instead: "change it".to_owned(),
        })?;
        let Some(name) = output.filter(|_| !signature.outputs.is_empty()) else {
            return Ok(Operand::Register(outputs[0]));
        };
        let index = signature.outputs.iter().position(|(known, _)| *known == name);
        index.map(|index| Operand::Register(outputs[index])).ok_or_else(|| no_output(node.element, name))
    }

    /// An input of a pattern node: `given` is its element, what feeds it and its type, where the node has it.
    fn argument(
        &mut self,
        node: &'a Element,
        node_type: Type,
        parameter: &Parameter,
        given: Option<(&'a Element, Feed<'a>, Type)>,
    ) -> Result<Operand, Error> {
        let width = match parameter.port {
            Port::Is(ty) => ty.width(),
            Port::Scalar => 1,
            _ => node_type.width(),
        };
        let Some((child, feed, ty)) = given else {
            return Ok(self.lowering.fallback(parameter.fallback, width));
        };
        let operand = match feed {
            Feed::Value { owner, input } if ty == Type::Filename => {
                let space = picture_space(owner, input, child, node_type)?;
                let name = input.attribute("value").unwrap_or_default();
                Some(Operand::Texture(self.texture(owner, input, name, space)?))
            }
            feed => self.operand(feed, ty)?,
        };
        let operand = match operand {
            Some(operand) => operand,
            None => return Ok(self.lowering.fallback(parameter.fallback, width)),
        };
        Ok(match operand {
            Operand::Register(register) if parameter.port == Port::SameOrFloat && ty == Type::Float => {
                Operand::Register(self.lowering.splat(register, node_type.width()))
            }
            Operand::Texture(_) if ty != Type::Filename => return Err(Error::NoGraph { at: node.place() }),
            operand => operand,
        })
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
        Ok(Some(self.lowering.assembler.texture(texture)))
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
        }
    })
}

/// The colour space of a picture: that of the input that names it where the node gives colours, else its numbers are
/// taken as they are.
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

/// What feeds the inputs of a pattern node, in the signature's order.
pub(crate) fn bind_pattern<'a>(
    graph: &Graph<'a>,
    signature: &'static Signature,
    ty: Type,
    node: NodeRef<'a>,
    problems: &mut Vec<Error>,
) -> Vec<Option<(&'a Element, Feed<'a>, Type)>> {
    let mut inputs = vec![None; signature.inputs.len()];
    let mut seen = HashSet::new();
    let most = problems.len() + MOST_PROBLEMS;
    for child in node.element.children() {
        if problems.len() >= most {
            break;
        }
        match bind_input(graph, signature, ty, node, child) {
            Ok(Some((index, feed, input_type))) => {
                if seen.insert(index) {
                    inputs[index] = Some((child, feed, input_type));
                } else {
                    let first_line = node.element.place().line;
                    problems.push(Error::DuplicateName { at: node.element.place_of(child), first_line });
                }
            }
            Ok(None) => {}
            Err(problem) => problems.push(problem),
        }
    }
    inputs
}

type Bound<'a> = (usize, Feed<'a>, Type);

fn bind_input<'a>(
    graph: &Graph<'a>,
    signature: &'static Signature,
    ty: Type,
    node: NodeRef<'a>,
    child: &'a Element,
) -> Result<Option<Bound<'a>>, Error> {
    let at = || node.element.place_of(child);
    if child.tag() == "output" {
        // Declares one of the node's outputs again: harmless.
        return Ok(None);
    }
    if child.tag() != "input" {
        let (what, instead) = ("an element other than <input> in a node".to_owned(), "remove it".to_owned());
        return Err(Error::Unsupported { at: at(), what, instead });
    }
    let (name, type_name) =
        (node.element.require_of(child, "name")?, node.element.require_of(child, "type")?);
    let Some((index, parameter)) = signature.input(name) else {
        let mut all = signatures(signature.category).filter(|other| other.types.contains(&ty));
        if let Some((_, _)) = all.find_map(|other| other.input(name)) {
            return Ok(None);
        }
        let known = listed(signature.inputs.iter().map(|input| input.name));
        return Err(Error::UnknownInput { at: at(), category: signature.category.to_owned(), known });
    };
    let input_type = Type::parse(type_name).filter(|found| parameter.port.accepts(ty, *found));
    let Some(input_type) = input_type else {
        let expected = parameter.port.describe(ty);
        return Err(Error::WrongType { at: at(), found: quoted(type_name), expected });
    };
    let feed = graph.feed(node, child)?;
    check_connection(graph, node, child, feed, input_type)?;
    if let Feed::Value { owner, input } = feed {
        constant(owner, input, input_type)?;
    }
    Ok(Some((index, feed, input_type)))
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
