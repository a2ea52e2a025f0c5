//! A node with its definition, its inputs checked against it.

use crate::{
    element::Element,
    error::{Error, Place, listed, quoted},
    graph::{Graph, NodeRef},
    nodedef::{Accepts, Default, InputDef, NODE_DEFS, NodeDef, categories},
    value::{COLOR_SPACES, Type, Value},
};

/// A node whose category, type and inputs agree with its definition.
#[derive(Debug)]
pub(crate) struct Node<'a> {
    pub(crate) element: &'a Element,
    pub(crate) def: &'static NodeDef,
    /// In the order of the definition's inputs.
    inputs: Vec<Input<'a>>,
}

#[derive(Clone, Copy, Debug)]
struct Input<'a> {
    element: Option<&'a Element>,
    source: Source<'a>,
}

/// Where an input's value comes from.
#[derive(Clone, Copy, Debug)]
enum Source<'a> {
    Default,
    Value(Value<'a>),
    Node(NodeRef<'a>),
}

impl<'a> Node<'a> {
    /// Finds the node's definition and checks all its inputs, connections one step far.
    pub(crate) fn bind(graph: &Graph<'a>, node: NodeRef<'a>) -> Result<Self, Error> {
        let def = definition(node.element)?;
        let mut inputs = vec![Input { element: None, source: Source::Default }; def.inputs.len()];
        for child in node.element.children() {
            let name = child.require("name")?;
            // `definition` has made sure that there is such an input.
            let Some((index, input)) = def.input(name) else { continue };
            if let Some(first) = inputs[index].element {
                let first_line = first.place().line;
                return Err(Error::DuplicateName { at: node.element.place_of(child), first_line });
            }
            inputs[index] = Input { element: Some(child), source: source(graph, node, child, input)? };
        }
        Ok(Self { element: node.element, def, inputs })
    }

    /// The node that an input is connected to.
    pub(crate) fn connected(&self, input: &str) -> Option<NodeRef<'a>> {
        match self.input(input).0.source {
            Source::Node(node) => Some(node),
            Source::Default | Source::Value(_) => None,
        }
    }

    /// The value of an input, where it is not the geometry's.
    fn value(&self, input: &str) -> Option<Value<'a>> {
        match self.input(input) {
            (Input { source: Source::Value(value), .. }, _) => Some(*value),
            (_, InputDef { default: Default::Value(value), .. }) => Some(*value),
            _ => None,
        }
    }

    pub(crate) fn float(&self, input: &str) -> f32 {
        match self.value(input) {
            Some(Value::Float(x)) => x,
            other => self.disagreement(input, other),
        }
    }

    pub(crate) fn boolean(&self, input: &str) -> bool {
        match self.value(input) {
            Some(Value::Boolean(x)) => x,
            other => self.disagreement(input, other),
        }
    }

    pub(crate) fn vector2(&self, input: &str) -> [f32; 2] {
        match self.value(input) {
            Some(Value::Vector2(x)) => x,
            other => self.disagreement(input, other),
        }
    }

    /// A direction; `None` where it is the geometry's.
    pub(crate) fn direction(&self, input: &str) -> Option<[f32; 3]> {
        match self.value(input) {
            None => None,
            Some(Value::Vector3(x)) => Some(x),
            other => self.disagreement(input, other),
        }
    }

    /// A colour, or a float that stands for all three channels.
    pub(crate) fn color(&self, input: &str) -> [f32; 3] {
        match self.value(input) {
            Some(Value::Color3(x)) => x,
            Some(Value::Float(x)) => [x; 3],
            other => self.disagreement(input, other),
        }
    }

    pub(crate) fn word(&self, input: &str) -> &'a str {
        match self.value(input) {
            Some(Value::String(x)) => x,
            other => self.disagreement(input, other),
        }
    }

    /// Where an input stands; the node where the input is left to its default.
    pub(crate) fn place_of(&self, input: &str) -> Place {
        match self.input(input).0.element {
            Some(child) => self.element.place_of(child),
            None => self.element.place(),
        }
    }

    fn input(&self, name: &str) -> (&Input<'a>, &'static InputDef) {
        match self.def.input(name) {
            Some((index, input)) => (&self.inputs[index], input),
            None => self.disagreement(name, None),
        }
    }

    /// The table of definitions and the code that reads the nodes disagree: no document can cause this, and the
    /// test `every definition reads from its defaults` shows that the code doesn't.
    fn disagreement(&self, input: &str, value: Option<Value<'_>>) -> ! {
        unreachable!("{}'s definition: input {input} has value {value:?}", self.def.category)
    }
}

/// The definition that fits the element's category, type, and the names and types of its inputs.
fn definition(node: &Element) -> Result<&'static NodeDef, Error> {
    let mut defs = definitions(node)?;
    for child in node.children() {
        narrow(&mut defs, node, child)?;
    }
    // `definitions` and `narrow` leave at least one; of several the first is the one MaterialX would take.
    Ok(defs[0])
}

/// The definitions of an element's category and type; at least one.
fn definitions(node: &Element) -> Result<Vec<&'static NodeDef>, Error> {
    let mut defs: Vec<&NodeDef> = NODE_DEFS.iter().filter(|def| def.category == node.tag()).collect();
    if defs.is_empty() {
        return Err(Error::UnknownCategory { at: node.place(), known: listed(categories()) });
    }
    let ty = node.require("type")?;
    let expected = one_of(defs.iter().map(|def| def.output));
    defs.retain(|def| def.output.name() == ty);
    if defs.is_empty() {
        return Err(Error::WrongType { at: node.place(), found: quoted(ty), expected });
    }
    Ok(defs)
}

/// Keeps the definitions that have the input `child`; at least one.
fn narrow(defs: &mut Vec<&'static NodeDef>, node: &Element, child: &Element) -> Result<(), Error> {
    let at = || node.place_of(child);
    if child.tag() != "input" {
        return Err(Error::Unsupported {
            at: at(),
            what: "an element other than <input> in a node".to_owned(),
            instead: "remove it".to_owned(),
        });
    }
    let (name, ty) = (child.require("name")?, child.require("type")?);
    let category = defs[0].category;
    let known = defs[0].inputs.iter().map(|input| input.name);
    defs.retain(|def| def.input(name).is_some());
    if defs.is_empty() {
        return Err(Error::UnknownInput { at: at(), category, known: listed(known) });
    }
    let type_of = |def: &NodeDef| def.input(name).map(|(_, input)| input.ty());
    let expected = one_of(defs.iter().filter_map(|def| type_of(def)));
    defs.retain(|def| type_of(def).is_some_and(|expected| expected.name() == ty));
    if defs.is_empty() {
        return Err(Error::WrongType { at: at(), found: quoted(ty), expected });
    }
    Ok(())
}

/// The types' names, each once, for messages.
fn one_of(types: impl Iterator<Item = Type>) -> String {
    let mut names: Vec<&str> = types.map(Type::name).collect();
    names.dedup();
    names.join(" or ")
}

/// What feeds an input. A connection is preferred to a value, as in MaterialX.
fn source<'a>(
    graph: &Graph<'a>,
    node: NodeRef<'a>,
    child: &'a Element,
    input: &'static InputDef,
) -> Result<Source<'a>, Error> {
    if let Some(target) = graph.connection(node, child)? {
        let output = definitions(target.element)?[0].output;
        if output != input.ty() {
            let found = format!("{} by its connection", quoted(output.name()));
            let at = node.element.place_of(child);
            return Err(Error::WrongType { at, found, expected: input.ty().name().to_owned() });
        }
        return match input.accepts {
            Accepts::DefaultOnly => Err(default_only(node.element, child, input)),
            _ => Ok(Source::Node(target)),
        };
    }
    match child.attribute("value") {
        None => Ok(Source::Default),
        Some(text) => value(node.element, child, input, text).map(Source::Value),
    }
}

/// Reads a constant, converts its colour space and checks its range.
fn value<'a>(
    node: &Element,
    child: &'a Element,
    input: &InputDef,
    text: &'a str,
) -> Result<Value<'a>, Error> {
    let at = || node.place_of(child);
    let value = Value::parse(input.ty(), text).ok_or_else(|| Error::BadValue {
        at: at(),
        value: quoted(text),
        expected: input.ty().example(),
    })?;
    let value = linear(node, child, value)?;
    if let Some(refusal) = input.accepts.refusal(value) {
        return Err(Error::OutOfRange { at: at(), message: format!("{} is {value}, {refusal}", input.name) });
    }
    let is_default = matches!(input.default, Default::Value(default) if default == value);
    match input.accepts {
        Accepts::DefaultOnly if !is_default => Err(default_only(node, child, input)),
        _ => Ok(value),
    }
}

/// Converts a colour from the colour space that it is written in.
fn linear<'a>(node: &Element, child: &Element, value: Value<'a>) -> Result<Value<'a>, Error> {
    let (Value::Color3(color), Some(colorspace)) = (value, child.colorspace()) else { return Ok(value) };
    match COLOR_SPACES.iter().find(|(name, _)| *name == colorspace) {
        Some((_, to_linear)) => Ok(Value::Color3(color.map(to_linear))),
        None => Err(Error::ColorSpace {
            at: node.place_of(child),
            colorspace: quoted(colorspace),
            supported: listed(COLOR_SPACES.iter().map(|(name, _)| *name)),
        }),
    }
}

fn default_only(node: &Element, child: &Element, input: &InputDef) -> Error {
    let default = match input.default {
        Default::Value(value) => value.to_string(),
        Default::Geometry(property) => format!("the geometry's {property}"),
        Default::Unconnected(_) => "unconnected".to_owned(),
    };
    Error::Unsupported {
        at: node.place_of(child),
        what: format!("anything but the default, {default},"),
        instead: "remove the input".to_owned(),
    }
}
