//! Names and connections: which node an input is connected to.

use std::{collections::HashMap, ptr};

use crate::{
    element::Element,
    error::{Error, quoted},
};

/// A node and the element whose names it sees: the document or a nodegraph.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NodeRef<'a> {
    pub(crate) element: &'a Element,
    pub(crate) scope: &'a Element,
}

/// The names of a document and its nodegraphs.
#[derive(Debug)]
pub(crate) struct Graph<'a> {
    root: &'a Element,
    names: HashMap<(*const Element, &'a str), &'a Element>,
}

impl<'a> Graph<'a> {
    pub(crate) fn new(root: &'a Element) -> Result<Self, Error> {
        let mut graph = Self { root, names: HashMap::new() };
        graph.index(root)?;
        for child in root.children() {
            match child.tag() {
                "nodegraph" => graph.index(child)?,
                "xi:include" => {
                    return Err(Error::Unsupported {
                        at: child.place(),
                        what: "including another file".to_owned(),
                        instead: "copy its elements into this document".to_owned(),
                    });
                }
                _ => {}
            }
        }
        Ok(graph)
    }

    fn index(&mut self, scope: &'a Element) -> Result<(), Error> {
        for child in scope.children() {
            let Some(name) = child.name() else { continue };
            if let Some(first) = self.names.insert((ptr::from_ref(scope), name), child) {
                return Err(Error::DuplicateName { at: child.place(), first_line: first.place().line });
            }
        }
        Ok(())
    }

    /// The document's materials in its order.
    pub(crate) fn materials(&self) -> impl Iterator<Item = NodeRef<'a>> + use<'a> {
        let scope = self.root;
        let is_material = |element: &&Element| element.tag() == "surfacematerial";
        scope.children().iter().filter(is_material).map(move |element| NodeRef { element, scope })
    }

    /// The node that `input` of `node` is connected to, if it is connected.
    pub(crate) fn connection(
        &self,
        node: NodeRef<'a>,
        input: &'a Element,
    ) -> Result<Option<NodeRef<'a>>, Error> {
        refuse_indirection(node, input)?;
        let output = input.attribute("output");
        let target = match (input.attribute("nodename"), input.attribute("nodegraph")) {
            (Some(name), _) => self.node(node.scope, name),
            (None, Some(graph)) => self.nodegraph(graph).and_then(|graph| self.output(graph, output)),
            (None, None) if output.is_some() => self.output(node.scope, output),
            (None, None) => return Ok(None),
        };
        match target {
            Some(target) => Ok(Some(target)),
            None => Err(Error::Dangling { at: node.element.place_of(input), target: target_name(input) }),
        }
    }

    fn get(&self, scope: &'a Element, name: &str) -> Option<&'a Element> {
        self.names.get(&(ptr::from_ref(scope), name)).copied()
    }

    fn node(&self, scope: &'a Element, name: &str) -> Option<NodeRef<'a>> {
        let is_node = |element: &&Element| !matches!(element.tag(), "nodegraph" | "input" | "output");
        self.get(scope, name).filter(is_node).map(|element| NodeRef { element, scope })
    }

    fn nodegraph(&self, name: &str) -> Option<&'a Element> {
        self.get(self.root, name).filter(|element| element.tag() == "nodegraph")
    }

    /// The node behind an output of a scope; its only output where no name is given.
    fn output(&self, scope: &'a Element, name: Option<&str>) -> Option<NodeRef<'a>> {
        let output = match name {
            Some(name) => self.get(scope, name).filter(|element| element.tag() == "output")?,
            None => {
                let mut outputs = scope.children().iter().filter(|element| element.tag() == "output");
                outputs.next().filter(|_| outputs.next().is_none())?
            }
        };
        self.node(scope, output.attribute("nodename")?)
    }
}

/// Refuses what would change an input's meaning if it were overlooked.
fn refuse_indirection(node: NodeRef<'_>, input: &Element) -> Result<(), Error> {
    for attribute in ["interfacename", "channels"] {
        if input.attribute(attribute).is_some() {
            return Err(Error::Unsupported {
                at: node.element.place_of(input),
                what: format!("the attribute {attribute}"),
                instead: "write the value itself".to_owned(),
            });
        }
    }
    Ok(())
}

/// What an input's attributes name, for messages.
fn target_name(input: &Element) -> String {
    let parts = ["nodename", "nodegraph", "output"].into_iter().filter_map(|attribute| {
        input.attribute(attribute).map(|value| format!("{attribute}={}", quoted(value)))
    });
    parts.collect::<Vec<_>>().join(" ")
}
