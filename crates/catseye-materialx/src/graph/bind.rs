//! Nodes and their definitions: the one place where inputs are checked against them.

use catseye::{ParamError, Params};

use crate::{
    error::{Error, Place, listed, quoted},
    graph::{
        Feed, Graph, MOST_PROBLEMS, NodeRef,
        input::{category, check_connection, constant, one_of, unknown_category},
    },
    nodes::{
        NodeDef,
        closures::as_written,
        of_category, of_type,
        port::{Accepts, Default, Port},
    },
    text::element::Element,
    value::{Type, Value},
};

/// A node whose category, type and inputs agree with its definition.
#[derive(Debug)]
pub(crate) struct Node<'a> {
    pub(crate) node: NodeRef<'a>,
    pub(crate) def: &'static NodeDef,
    pub(crate) ty: Type,
    /// In the order of the definition's inputs.
    pub(crate) inputs: Vec<Input<'a>>,
}

/// What an input of a node is given.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Input<'a> {
    pub(crate) element: Option<&'a Element>,
    pub(crate) feed: Feed<'a>,
    pub(crate) ty: Type,
}

/// Whether there are built-in nodes of an element's category and type.
pub(crate) fn is_built_in(element: &Element) -> bool {
    let ty = element.attribute("type").and_then(Type::parse);
    ty.is_some_and(|ty| of_type(category(element), ty).next().is_some())
}

impl<'a> Node<'a> {
    /// Finds the node's definition and checks all its inputs, connections one step far; the first problem is
    /// an error.
    pub(crate) fn bind(graph: &Graph<'a>, node: NodeRef<'a>) -> Result<Self, Error> {
        let mut problems = Vec::new();
        let bound = Self::bind_all(graph, node, &mut problems);
        if !problems.is_empty() {
            return Err(problems.swap_remove(0));
        }
        bound.ok_or_else(|| unknown_category(graph, node.element))
    }

    /// As [`Self::bind`], with all problems; `None` where the definition is not known.
    pub(crate) fn bind_all(graph: &Graph<'a>, node: NodeRef<'a>, problems: &mut Vec<Error>) -> Option<Self> {
        let (ty, def) = match definitions(graph, node.element) {
            Ok((ty, defs)) => (ty, definition(defs, ty, node.element, problems)),
            Err(problem) => {
                problems.push(problem);
                return None;
            }
        };
        let left_out = |port: &Port| Input { element: None, feed: Feed::Default, ty: port.default_type(ty) };
        let mut bound = Self { node, def, ty, inputs: def.inputs.iter().map(left_out).collect() };
        let most = problems.len() + MOST_PROBLEMS;
        for child in node.element.children() {
            if problems.len() >= most {
                break;
            }
            if let Err(problem) = bound.give(graph, child) {
                problems.push(problem);
            }
        }
        Some(bound)
    }

    fn give(&mut self, graph: &Graph<'a>, child: &'a Element) -> Result<(), Error> {
        // `definition` has reported what is no input of this node.
        let Some((index, port)) = child.name().and_then(|name| self.def.input(name)) else { return Ok(()) };
        let ty = child.attribute("type").and_then(Type::parse);
        let Some(ty) = ty.filter(|ty| child.tag() == "input" && port.has_type(self.ty, *ty)) else {
            return Ok(());
        };
        if let Some(first) = self.inputs[index].element {
            let (at, first_line) = (self.node.element.place_of(child), first.place().line);
            return Err(Error::DuplicateName { at, first_line });
        }
        let feed = self.feed(graph, child, port, ty)?;
        self.inputs[index] = Input { element: Some(child), feed, ty };
        Ok(())
    }

    /// What feeds an input, its type checked, and its value; in a definition numbers may be out of range.
    fn feed(
        &self,
        graph: &Graph<'a>,
        child: &'a Element,
        port: &'static Port,
        ty: Type,
    ) -> Result<Feed<'a>, Error> {
        let feed = graph.feed(self.node, child)?;
        let in_document = graph.is_in_document(self.node.scope);
        check_connection(graph, self.node, child, feed, ty)?;
        match feed {
            Feed::Node { .. } if in_document && port.accepts == Accepts::DefaultOnly => {
                return Err(default_only(self.node.element, child, port));
            }
            Feed::Value { owner, input } => {
                let value = constant(owner, input, ty)?;
                if in_document || !port.accepts.is_range() {
                    self.check_value(owner, input, port, value)?;
                }
            }
            _ => {}
        }
        Ok(feed)
    }

    fn check_value(
        &self,
        owner: &Element,
        input: &Element,
        port: &Port,
        value: Value<'_>,
    ) -> Result<(), Error> {
        if let Some(refusal) = port.accepts.refusal(value, self.ty) {
            let message = format!("{} is {value}, {refusal}", port.name);
            return Err(Error::OutOfRange { at: owner.place_of(input), message });
        }
        if self.def.category == "retro_reflective_bsdf" {
            check_params(owner, input, port, value)?;
        }
        match port.accepts {
            Accepts::DefaultOnly if !port.is_default(value) => Err(default_only(owner, input, port)),
            _ => Ok(()),
        }
    }

    /// The node that an input is connected to.
    pub(crate) fn connected(&self, input: &str) -> Option<NodeRef<'a>> {
        match self.input(input).0.feed {
            Feed::Node { node, .. } => Some(node),
            _ => None,
        }
    }

    /// Where an input stands; the node where the input is left to its default.
    pub(crate) fn place_of(&self, input: &str) -> Place {
        match self.input(input).0.element {
            Some(child) => self.node.element.place_of(child),
            None => self.node.element.place(),
        }
    }

    pub(crate) fn input(&self, name: &str) -> (Input<'a>, &'static Port) {
        match self.def.input(name) {
            Some((index, port)) => (self.inputs[index], port),
            // The definitions and the code that reads nodes disagree: no document can cause this. The test
            // `defaults_are_those_of_the_node_definitions` reads every input of every category.
            None => unreachable!("{}'s definition: there is no input {name}", self.def.category),
        }
    }
}

/// The definition that fits the names and types of the element's inputs; what fits none is a problem.
fn definition(
    mut defs: Vec<&'static NodeDef>,
    ty: Type,
    node: &Element,
    problems: &mut Vec<Error>,
) -> &'static NodeDef {
    let most = problems.len() + MOST_PROBLEMS;
    for child in node.children() {
        if problems.len() >= most {
            break;
        }
        if let Err(problem) = narrow(&mut defs, ty, node, child) {
            problems.push(problem);
        }
    }
    // Of several the first is the one MaterialX would take.
    defs[0]
}

/// The definitions of an element's category and type; at least one.
fn definitions(graph: &Graph<'_>, node: &Element) -> Result<(Type, Vec<&'static NodeDef>), Error> {
    if of_category(node.tag()).is_empty() {
        return Err(unknown_category(graph, node));
    }
    let name = node.require("type")?;
    let ty = Type::parse(name).ok_or_else(|| unknown_category(graph, node))?;
    let defs: Vec<&NodeDef> = of_type(category(node), ty).collect();
    if defs.is_empty() { Err(unknown_category(graph, node)) } else { Ok((ty, defs)) }
}

/// Keeps the definitions that have the input `child`; at least one.
fn narrow(defs: &mut Vec<&'static NodeDef>, ty: Type, node: &Element, child: &Element) -> Result<(), Error> {
    let at = || node.place_of(child);
    if child.tag() == "output" {
        // Declares one of the node's outputs again: harmless.
        return Ok(());
    }
    if child.tag() != "input" {
        return Err(Error::Unsupported {
            at: at(),
            what: "an element other than <input> in a node".to_owned(),
            instead: "remove it".to_owned(),
        });
    }
    let (name, type_name) = (node.require_of(child, "name")?, node.require_of(child, "type")?);
    let ports: Vec<&Port> = defs.iter().filter_map(|def| Some(def.input(name)?.1)).collect();
    if ports.is_empty() {
        let known = listed(defs[0].inputs.iter().map(|input| input.name));
        return Err(Error::UnknownInput { at: at(), category: defs[0].category.to_owned(), known });
    }
    let found = Type::parse(type_name);
    let fits = |port: &Port| found.is_some_and(|found| port.has_type(ty, found));
    if !ports.iter().any(|port| fits(port)) {
        let expected = one_of(ports.iter().flat_map(|port| port.types(ty)));
        return Err(Error::WrongType { at: at(), found: quoted(type_name), expected });
    }
    defs.retain(|def| def.input(name).is_some_and(|(_, port)| fits(port)));
    Ok(())
}

/// Asks the BSDF itself about one of its parameters.
fn check_params(node: &Element, child: &Element, port: &Port, value: Value<'_>) -> Result<(), Error> {
    let mut params = Params::default();
    match (port.name, value) {
        ("roughness_u", Value::Float(x)) => params.roughness_u = x,
        // A negative one stands for the default.
        ("roughness_v", Value::Float(x)) if x >= 0.0 => params.roughness_v = Some(x),
        ("tint", Value::Color3(color)) => params.tint = color,
        ("multiscatter_tint", Value::Color3(color)) => params.multiscatter_tint = color,
        _ => {}
    }
    let error =
        |cause: ParamError| Error::OutOfRange { at: node.place_of(child), message: cause.to_string() };
    as_written(&params).validate().map_err(error)
}

fn default_only(node: &Element, child: &Element, port: &Port) -> Error {
    let default = match port.default {
        Default::Number(x) => x.to_string(),
        Default::Value(value) => value.to_string(),
        Default::Geometry(_) => "the geometry's own".to_owned(),
        Default::Unconnected => "unconnected".to_owned(),
    };
    Error::Unsupported {
        at: node.place_of(child),
        what: format!("anything but the default, {default},"),
        instead: "remove the input".to_owned(),
    }
}
