//! A node with its definition, its inputs checked against it.

use crate::{
    element::Element,
    error::{Error, Place, listed, quoted},
    graph::{Graph, NodeRef},
    input::{Feed, feed},
    nodedef::{InputDef, InputDefault, NODE_DEFS, NodeDef, categories},
    value::{Type, Value},
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
    feed: Feed<'a>,
}

impl<'a> Node<'a> {
    /// Finds the node's definition and checks all its inputs, connections one step far.
    pub(crate) fn bind(graph: &Graph<'a>, node: NodeRef<'a>) -> Result<Self, Error> {
        let def = definition(node.element)?;
        let mut inputs = vec![Input { element: None, feed: Feed::Default }; def.inputs.len()];
        for child in node.element.children() {
            let name = node.element.require_of(child, "name")?;
            // `definition` has made sure that there is such an input.
            let Some((index, input)) = def.input(name) else { continue };
            if let Some(first) = inputs[index].element {
                let first_line = first.place().line;
                return Err(Error::DuplicateName { at: node.element.place_of(child), first_line });
            }
            inputs[index] = Input { element: Some(child), feed: feed(graph, node, child, input)? };
        }
        Ok(Self { element: node.element, def, inputs })
    }

    /// The node that an input is connected to.
    pub(crate) fn connected(&self, input: &str) -> Option<NodeRef<'a>> {
        match self.input(input).0.feed {
            Feed::Node(node) => Some(node),
            Feed::Default | Feed::Value(_) => None,
        }
    }

    /// The value of an input, where it is not the geometry's.
    fn value(&self, input: &str) -> Option<Value<'a>> {
        match self.input(input) {
            (Input { feed: Feed::Value(value), .. }, _) => Some(*value),
            (_, InputDef { default: InputDefault::Value(value), .. }) => Some(*value),
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

    /// The definitions and the code that reads nodes disagree: no document can cause this. The test
    /// `defaults_are_those_of_the_node_definitions` reads every input of every category.
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
pub(crate) fn definitions(node: &Element) -> Result<Vec<&'static NodeDef>, Error> {
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
    let (name, ty) = (node.require_of(child, "name")?, node.require_of(child, "type")?);
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
