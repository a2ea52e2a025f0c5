//! A built-in BSDF or shader node with its definition, its inputs checked against it.

use crate::{
    error::{Error, Place, listed, quoted},
    graph::{
        Feed, Graph, MOST_PROBLEMS, NodeRef,
        input::{feed, unknown_category},
    },
    nodes::closures::{InputDef, NODE_DEFS, NodeDef},
    text::element::Element,
    value::Type,
};

/// A node whose category, type and inputs agree with its definition.
#[derive(Debug)]
pub(crate) struct Node<'a> {
    pub(crate) node: NodeRef<'a>,
    pub(crate) def: &'static NodeDef,
    /// In the order of the definition's inputs.
    inputs: Vec<Input<'a>>,
}

/// What an input of a node is given.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Input<'a> {
    pub(crate) element: Option<&'a Element>,
    pub(crate) feed: Feed<'a>,
}

impl<'a> Node<'a> {
    /// Finds the node's definition and checks all its inputs, connections one step far; the first problem is an error.
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
        let def = match definitions(graph, node.element) {
            Ok(defs) => definition(defs, node.element, problems),
            Err(problem) => {
                problems.push(problem);
                return None;
            }
        };
        let mut inputs = vec![Input { element: None, feed: Feed::Default }; def.inputs.len()];
        let most = problems.len() + MOST_PROBLEMS;
        for child in node.element.children() {
            if problems.len() >= most {
                break;
            }
            // `definition` has reported inputs without a name, and those that there aren't.
            let Some((index, input)) = child.name().and_then(|name| def.input(name)) else { continue };
            if child.tag() != "input" || child.attribute("type") != Some(input.ty().name()) {
                continue;
            }
            if let Some(first) = inputs[index].element {
                let first_line = first.place().line;
                problems.push(Error::DuplicateName { at: node.element.place_of(child), first_line });
                continue;
            }
            match feed(graph, node, child, input) {
                Ok(feed) => inputs[index] = Input { element: Some(child), feed },
                Err(problem) => problems.push(problem),
            }
        }
        Some(Self { node, def, inputs })
    }

    /// What feeds its inputs.
    pub(crate) fn feeds(self) -> Vec<Feed<'a>> {
        self.inputs.into_iter().map(|input| input.feed).collect()
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

    pub(crate) fn input(&self, name: &str) -> (Input<'a>, &'static InputDef) {
        match self.def.input(name) {
            Some((index, input)) => (self.inputs[index], input),
            // The definitions and the code that reads nodes disagree: no document can cause this. The test
            // `defaults_are_those_of_the_node_definitions` reads every input of every category.
            None => unreachable!("{}'s definition: there is no input {name}", self.def.category),
        }
    }
}

/// The definition that fits the names and types of the element's inputs; what fits none is a problem.
fn definition(
    mut defs: Vec<&'static NodeDef>,
    node: &Element,
    problems: &mut Vec<Error>,
) -> &'static NodeDef {
    let most = problems.len() + MOST_PROBLEMS;
    for child in node.children() {
        if problems.len() >= most {
            break;
        }
        if let Err(problem) = narrow(&mut defs, node, child) {
            problems.push(problem);
        }
    }
    // Of several the first is the one MaterialX would take.
    defs[0]
}

/// Whether there are built-in BSDF or shader nodes of this category and type.
pub(crate) fn is_known(element: &Element) -> bool {
    let ty = element.attribute("type");
    NODE_DEFS.iter().any(|def| def.category == element.tag() && Some(def.output.name()) == ty)
}

/// Whether there are built-in BSDF or shader nodes of this category.
pub(crate) fn has_category(element: &Element) -> bool {
    NODE_DEFS.iter().any(|def| def.category == element.tag())
}

/// The definitions of an element's category and type; at least one.
fn definitions(graph: &Graph<'_>, node: &Element) -> Result<Vec<&'static NodeDef>, Error> {
    let mut defs: Vec<&NodeDef> = NODE_DEFS.iter().filter(|def| def.category == node.tag()).collect();
    if defs.is_empty() {
        return Err(unknown_category(graph, node));
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
    if !defs.iter().any(|def| def.input(name).is_some()) {
        let known = listed(defs[0].inputs.iter().map(|input| input.name));
        return Err(Error::UnknownInput { at: at(), category: defs[0].category.to_owned(), known });
    }
    defs.retain(|def| def.input(name).is_some());
    let type_of = |def: &NodeDef| def.input(name).map(|(_, input)| input.ty());
    if !defs.iter().any(|def| type_of(def).is_some_and(|expected| expected.name() == ty)) {
        let expected = one_of(defs.iter().filter_map(|def| type_of(def)));
        return Err(Error::WrongType { at: at(), found: quoted(ty), expected });
    }
    defs.retain(|def| type_of(def).is_some_and(|expected| expected.name() == ty));
    Ok(())
}

/// The types' names, each once, for messages.
fn one_of(types: impl Iterator<Item = Type>) -> String {
    let mut names: Vec<&str> = Vec::new();
    for ty in types {
        if !names.contains(&ty.name()) {
            names.push(ty.name());
        }
    }
    names.join(" or ")
}
