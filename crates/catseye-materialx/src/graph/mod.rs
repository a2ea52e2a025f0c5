//! Names, scopes and connections: what feeds an input.

pub(crate) mod bind;
pub(crate) mod input;
pub(crate) mod library;
pub(crate) mod look;

use std::{
    cell::{Cell, RefCell},
    collections::HashMap,
    ptr,
};

use crate::{
    error::{Error, listed, quoted},
    graph::library::{Definition, Definitions, Library},
    text::element::Element,
};

/// Nodegraphs and definitions in use, each once for every place that uses it: nested ones could make 2^30.
const MAX_SCOPES: usize = 16_384;
/// Problems of one kind that are told.
pub(crate) const MOST_PROBLEMS: usize = 50;
/// Nodegraphs inside nodegraphs, and definitions that use definitions.
const MAX_SCOPE_DEPTH: usize = 24;

/// A node, and the scope whose names it sees.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NodeRef<'a> {
    pub(crate) element: &'a Element,
    pub(crate) scope: ScopeId,
}

/// A document, or a nodegraph at one of the places that use it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct ScopeId(usize);

/// The document's own scope.
pub(crate) const ROOT: ScopeId = ScopeId(0);

#[derive(Clone, Copy, Debug)]
struct Scope<'a> {
    element: &'a Element,
    /// What the interface inputs are taken from: a nodegraph's own element, or the node that a definition
    /// stands for.
    interface: Option<NodeRef<'a>>,
    /// Whether `interface` is a node of a definition.
    defined: bool,
    depth: usize,
}

/// What feeds an input.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Feed<'a> {
    /// The definition's default.
    Default,
    /// The text of `value` in an input. `owner` is the element around it.
    Value { owner: &'a Element, input: &'a Element },
    /// A node's output, by name where one is given.
    Node { node: NodeRef<'a>, output: Option<&'a str> },
    /// A property of the geometry, by its name.
    Geometry(&'a str),
}

/// The names of a document, its nodegraphs and the definitions that it sees.
#[derive(Debug)]
pub(crate) struct Graph<'a> {
    root: &'a Element,
    definitions: Definitions<'a>,
    names: HashMap<(*const Element, &'a str), &'a Element>,
    scopes: RefCell<Vec<Scope<'a>>>,
    known_scopes: RefCell<HashMap<(*const Element, *const Element, ScopeId), ScopeId>>,
    /// Connections followed without meeting a node.
    steps: Cell<usize>,
}

impl<'a> Graph<'a> {
    pub(crate) fn new(root: &'a Element, library: &'a Library) -> Result<Self, Error> {
        let (graph, mut problems, _) = Self::with_problems(root, library);
        if problems.is_empty() { Ok(graph) } else { Err(problems.swap_remove(0)) }
    }

    /// The graph, the names that are taken twice, and how many more of them there are.
    pub(crate) fn with_problems(root: &'a Element, library: &'a Library) -> (Self, Vec<Error>, usize) {
        let document = Scope { element: root, interface: None, defined: false, depth: 0 };
        let mut graph = Self {
            root,
            definitions: Definitions::new(library.roots().chain([root])),
            names: HashMap::new(),
            scopes: RefCell::new(vec![document]),
            known_scopes: RefCell::default(),
            steps: Cell::new(0),
        };
        let mut problems = Vec::new();
        let more = graph.index(root, &mut problems);
        (graph, problems, more)
    }

    /// The names of a scope and the nodegraphs in it; finding the lines of problems takes time, so that not
    /// all are told but counted.
    fn index(&mut self, scope: &'a Element, problems: &mut Vec<Error>) -> usize {
        let mut more = 0;
        for child in scope.children() {
            if child.tag() == "nodegraph" {
                more += self.index(child, problems);
            }
            let Some(name) = child.name() else { continue };
            match self.names.insert((ptr::from_ref(scope), name), child) {
                None => {}
                Some(_) if problems.len() >= MOST_PROBLEMS => more += 1,
                Some(first) => {
                    problems.push(Error::DuplicateName { at: child.place(), first_line: first.place().line });
                }
            }
        }
        more
    }

    pub(crate) fn definitions(&self) -> &Definitions<'a> {
        &self.definitions
    }

    /// The document's materials in its order.
    pub(crate) fn materials(&self) -> impl Iterator<Item = NodeRef<'a>> + use<'a> {
        self.root.children_of_kind("surfacematerial").map(|element| NodeRef { element, scope: ROOT })
    }

    /// The element whose names a scope has.
    pub(crate) fn element(&self, scope: ScopeId) -> &'a Element {
        self.scopes.borrow()[scope.0].element
    }

    /// Whether a node stands in the document itself, not in a definition.
    pub(crate) fn is_in_document(&self, scope: ScopeId) -> bool {
        let scopes = self.scopes.borrow();
        let mut scope = &scopes[scope.0];
        while let Some(interface) = scope.interface {
            if scope.defined {
                return false;
            }
            scope = &scopes[interface.scope.0];
        }
        true
    }

    /// What feeds `input`, which stands in `node`.
    pub(crate) fn feed(&self, node: NodeRef<'a>, input: &'a Element) -> Result<Feed<'a>, Error> {
        /// From input to interface to input, through nodegraphs inside one another.
        const MAX_STEPS: usize = 4 * MAX_SCOPE_DEPTH;
        if self.steps.get() > MAX_STEPS {
            return Err(Error::Cycle { at: node.element.place_of(input), cycle: node.element.quoted_name() });
        }
        self.steps.set(self.steps.get() + 1);
        let feed = self.follow(node, input);
        self.steps.set(self.steps.get() - 1);
        feed
    }

    fn follow(&self, node: NodeRef<'a>, input: &'a Element) -> Result<Feed<'a>, Error> {
        if let Some(name) = input.attribute("interfacename") {
            return self.interface(node, input, name);
        }
        refuse_channels(node, input)?;
        let output = input.attribute("output");
        let target = match (input.attribute("nodename"), input.attribute("nodegraph")) {
            (Some(name), _) => {
                // A nodegraph may be named like a node.
                match self.node(node.scope, name) {
                    Some(target) => return Ok(Feed::Node { node: target, output }),
                    None => self.through_nodegraph(node, name, output)?,
                }
            }
            (None, Some(graph)) => self.through_nodegraph(node, graph, output)?,
            (None, None) if output.is_some() => self.output(node.scope, output)?,
            (None, None) if input.attribute("value").is_some() => {
                return Ok(Feed::Value { owner: node.element, input });
            }
            (None, None) => {
                return Ok(input.attribute("defaultgeomprop").map_or(Feed::Default, Feed::Geometry));
            }
        };
        target.ok_or_else(|| Error::Dangling { at: node.element.place_of(input), target: target_name(input) })
    }

    /// What feeds the interface input of this name, in the scope of `node`.
    fn interface(&self, node: NodeRef<'a>, input: &'a Element, name: &str) -> Result<Feed<'a>, Error> {
        let scope = self.scopes.borrow()[node.scope.0];
        let dangling = || Error::Dangling {
            at: node.element.place_of(input),
            target: format!("interfacename={}", quoted(name)),
        };
        let caller = scope.interface.ok_or_else(dangling)?;
        let given = self.get(caller.element, name).filter(|element| element.tag() == "input");
        if !scope.defined {
            return self.feed(caller, given.ok_or_else(dangling)?);
        }
        if let Some(given) = given {
            match self.feed(caller, given)? {
                Feed::Default => {}
                feed => return Ok(feed),
            }
        }
        let definition = self.definitions.find(caller.element).ok_or_else(dangling)?;
        let default = definition.input(name).ok_or_else(dangling)?;
        if default.attribute("value").is_some() {
            return Ok(Feed::Value { owner: definition.nodedef(), input: default });
        }
        Ok(default.attribute("defaultgeomprop").map_or(Feed::Default, Feed::Geometry))
    }

    fn through_nodegraph(
        &self,
        node: NodeRef<'a>,
        name: &str,
        output: Option<&'a str>,
    ) -> Result<Option<Feed<'a>>, Error> {
        let mut scope = Some(node.scope);
        // A nodegraph sees its siblings and those of the nodegraphs around it.
        while let Some(id) = scope {
            let around = self.scopes.borrow()[id.0];
            if let Some(graph) = self.get(around.element, name).filter(|element| element.tag() == "nodegraph")
            {
                let inner = self.enter(graph, NodeRef { element: graph, scope: id }, false)?;
                return self.output(inner, output);
            }
            scope = around.interface.filter(|_| !around.defined).map(|interface| interface.scope);
        }
        Ok(None)
    }

    /// The output of the graph that defines `node`.
    pub(crate) fn inside(
        &self,
        definition: &Definition<'a>,
        node: NodeRef<'a>,
        output: Option<&'a str>,
    ) -> Result<Option<Feed<'a>>, Error> {
        let Some(graph) = definition.graph else { return Ok(None) };
        let inner = self.enter(graph, node, true)?;
        self.output(inner, output)
    }

    /// The scope of a nodegraph whose interface inputs are those of `interface`.
    pub(crate) fn enter(
        &self,
        element: &'a Element,
        interface: NodeRef<'a>,
        defined: bool,
    ) -> Result<ScopeId, Error> {
        let key = (ptr::from_ref(element), ptr::from_ref(interface.element), interface.scope);
        if let Some(&known) = self.known_scopes.borrow().get(&key) {
            return Ok(known);
        }
        let mut scopes = self.scopes.borrow_mut();
        let depth = scopes[interface.scope.0].depth + 1;
        let limit = |what, limit| Err(Error::Limit { at: interface.element.place(), what, limit });
        if defined {
            refuse_recursion(&scopes, element, interface)?;
        }
        if depth > MAX_SCOPE_DEPTH {
            return limit("nodegraphs inside nodegraphs", MAX_SCOPE_DEPTH);
        }
        if scopes.len() >= MAX_SCOPES {
            return limit("uses of nodegraphs", MAX_SCOPES);
        }
        scopes.push(Scope { element, interface: Some(interface), defined, depth });
        let id = ScopeId(scopes.len() - 1);
        self.known_scopes.borrow_mut().insert(key, id);
        Ok(id)
    }

    fn get(&self, scope: &'a Element, name: &str) -> Option<&'a Element> {
        match self.names.get(&(ptr::from_ref(scope), name)) {
            Some(element) => Some(element),
            // The graphs of definitions are not indexed: few are used, and they are short.
            None if !self.names.is_empty() && self.is_indexed(scope) => None,
            None => scope.children().iter().find(|child| child.name() == Some(name)),
        }
    }

    /// Whether all names of a scope are in the index: the document's are.
    fn is_indexed(&self, scope: &'a Element) -> bool {
        let first = scope.children().iter().find_map(Element::name);
        first.is_none_or(|name| self.names.contains_key(&(ptr::from_ref(scope), name)))
    }

    fn node(&self, scope: ScopeId, name: &str) -> Option<NodeRef<'a>> {
        let is_node = |element: &&Element| !matches!(element.tag(), "nodegraph" | "input" | "output");
        self.get(self.element(scope), name).filter(is_node).map(|element| NodeRef { element, scope })
    }

    /// What an output of a scope is connected to; its only output where no name is given.
    fn output(&self, scope: ScopeId, name: Option<&str>) -> Result<Option<Feed<'a>>, Error> {
        let element = self.element(scope);
        let mut outputs = element.children_of_kind("output");
        let output = match name {
            Some(name) => self.get(element, name).filter(|element| element.tag() == "output"),
            None => outputs.next().filter(|_| outputs.next().is_none()),
        };
        let Some(output) = output else { return Ok(None) };
        self.output_feed(scope, output)
    }

    /// What an output element is connected to.
    pub(crate) fn output_feed(&self, scope: ScopeId, output: &'a Element) -> Result<Option<Feed<'a>>, Error> {
        let owner = NodeRef { element: output, scope };
        if let Some(name) = output.attribute("nodename") {
            let target = self.node(scope, name);
            return Ok(target.map(|node| Feed::Node { node, output: output.attribute("output") }));
        }
        if output.attribute("interfacename").is_some() {
            return self.feed(owner, output).map(Some);
        }
        match output.attribute("nodegraph") {
            Some(graph) => self.through_nodegraph(owner, graph, output.attribute("output")),
            None => Ok(None),
        }
    }
}

/// Refuses what would change an input's meaning if it were overlooked.
fn refuse_channels(node: NodeRef<'_>, input: &Element) -> Result<(), Error> {
    if input.attribute("channels").is_none() {
        return Ok(());
    }
    Err(Error::Unsupported {
        at: node.element.place_of(input),
        what: "the attribute channels".to_owned(),
        instead: "use an extract, convert or separate node".to_owned(),
    })
}

/// What an input's attributes name, for messages.
fn target_name(input: &Element) -> String {
    let parts = ["nodename", "nodegraph", "output"].into_iter().filter_map(|attribute| {
        input.attribute(attribute).map(|value| format!("{attribute}={}", quoted(value)))
    });
    parts.collect::<Vec<_>>().join(" ")
}

/// Refuses a definition whose graph uses the node that it defines, itself or through others.
fn refuse_recursion(scopes: &[Scope<'_>], graph: &Element, node: NodeRef<'_>) -> Result<(), Error> {
    let mut through = vec![quoted(node.element.tag())];
    let mut scope = scopes[node.scope.0];
    while let Some(caller) = scope.interface {
        if scope.defined && ptr::eq(scope.element, graph) {
            through.reverse();
            return Err(Error::Cycle { at: node.element.place(), cycle: listed(through) });
        }
        if scope.defined {
            through.push(quoted(caller.element.tag()));
        }
        scope = scopes[caller.scope.0];
    }
    Ok(())
}
