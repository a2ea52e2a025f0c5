//! A look at every node of a document, also at those that no material uses.

use std::{
    collections::{HashMap, HashSet},
    path::PathBuf,
    ptr,
};

use crate::{
    compile::pattern::find_picture,
    error::{Error, Warning, listed, quoted},
    graph::{
        Feed, Graph, MOST_PROBLEMS, NodeRef, ROOT, ScopeId,
        bind::{Node, is_built_in},
        input::{check_connection, constant, output_feed, unknown_category},
        library::{Definition, Library},
    },
    nodes::of_category,
    picture::{Picture, Room},
    text::element::Element,
    value::{Type, Value},
};

/// Problems after which nothing more is looked at.
const MAX_PROBLEMS: usize = 400;

/// What a walk through a document finds.
pub(super) struct Walk {
    pub(super) problems: Vec<Error>,
    pub(super) warnings: Vec<Warning>,
    /// Problems, at least, that are not among them.
    pub(super) more: usize,
}

/// Checks every node of a document by itself, its connections, and where they lead in circles.
pub(super) fn walk<'a>(graph: &Graph<'a>, root: &'a Element, library: &'a Library) -> Walk {
    let mut checker = Checker {
        graph,
        library,
        found: Walk { problems: Vec::new(), warnings: Vec::new(), more: 0 },
        edges: HashMap::new(),
        seen: HashSet::new(),
        entered: HashSet::new(),
    };
    checker.scope(root, ROOT);
    checker.cycles();
    let is_full = checker.is_full();
    checker.found.more += usize::from(is_full);
    checker.found
}

/// A node, for the search for cycles.
type Key = (ScopeId, *const Element);

struct Checker<'a, 'g> {
    graph: &'g Graph<'a>,
    library: &'a Library,
    found: Walk,
    /// What each node is connected to.
    edges: HashMap<Key, (NodeRef<'a>, Vec<NodeRef<'a>>)>,
    /// Pictures that were looked at.
    seen: HashSet<PathBuf>,
    /// Graphs of the document's own definitions that were looked at.
    entered: HashSet<*const Element>,
}

impl<'a> Checker<'a, '_> {
    fn is_full(&self) -> bool {
        self.found.problems.len() >= MAX_PROBLEMS
    }

    fn report(&mut self, result: Result<(), Error>) {
        if let Err(problem) = result {
            self.found.problems.push(problem);
        }
    }

    /// Checks the nodes and outputs of the document or a nodegraph.
    fn scope(&mut self, element: &'a Element, scope: ScopeId) {
        for child in element.children() {
            if self.is_full() {
                return;
            }
            let node = NodeRef { element: child, scope };
            match child.tag() {
                "nodegraph" => self.nodegraph(child, scope),
                "output" => self.output(node),
                // The nodegraph's own, which may be connected to what is around it; checked there.
                "input" => {}
                "nodedef" => self.nodedef(child),
                "implementation" | "typedef" | "targetdef" | "unitdef" | "unittypedef" | "geompropdef"
                | "geominfo" | "look" | "lookgroup" | "collection" | "propertyset" | "variantset"
                | "backdrop" | "attributedef" | "xi:include" => {}
                _ => self.node(node),
            }
        }
    }

    /// Nodegraphs in nodegraphs are no deeper than elements may be nested: the parser has seen to it.
    fn nodegraph(&mut self, graph: &'a Element, around: ScopeId) {
        let node = NodeRef { element: graph, scope: around };
        // A graph that defines a node has its interface from the node that uses it, and is checked there.
        if graph.attribute("nodedef").is_some() {
            return;
        }
        for input in graph.children_of_kind("input") {
            if self.is_full() {
                return;
            }
            let result = self.interface_input(node, input);
            self.report(result);
        }
        match self.graph.enter(graph, node, false) {
            Ok(inner) => self.scope(graph, inner),
            Err(problem) => self.found.problems.push(problem),
        }
    }

    fn interface_input(&mut self, graph: NodeRef<'a>, input: &'a Element) -> Result<(), Error> {
        let ty = self.type_of(graph.element, input)?;
        let feed = self.graph.feed(graph, input)?;
        check_connection(self.graph, graph, input, feed, ty)?;
        self.value(feed, ty)
    }

    fn type_of(&self, owner: &Element, input: &Element) -> Result<Type, Error> {
        let name = owner.require_of(input, "type")?;
        Type::parse(name).ok_or_else(|| Error::WrongType {
            at: owner.place_of(input),
            found: quoted(name),
            expected: "a type of MaterialX".to_owned(),
        })
    }

    /// Checks a constant, and the file that it may name.
    fn value(&mut self, feed: Feed<'a>, ty: Type) -> Result<(), Error> {
        let Feed::Value { owner, input } = feed else { return Ok(()) };
        constant(owner, input, ty)?;
        match input.attribute("value") {
            Some(name) if ty == Type::Filename => self.picture(owner, input, name),
            _ => Ok(()),
        }
    }

    fn picture(&mut self, owner: &'a Element, input: &'a Element, name: &str) -> Result<(), Error> {
        let path = find_picture(self.library, owner, input, name)?;
        if !self.seen.insert(path.clone()) {
            return Ok(());
        }
        Picture::open(&path, Room::beside(0)).map(|_| ()).map_err(|refusal| Error::Picture {
            at: owner.place_of(input),
            name: quoted(name),
            message: refusal.to_string(),
        })
    }

    fn output(&mut self, output: NodeRef<'a>) {
        let result = (|| {
            if ["nodename", "nodegraph", "interfacename"]
                .iter()
                .all(|name| output.element.attribute(name).is_none())
            {
                return Ok(());
            }
            output_feed(self.graph, output).map(|_| ())
        })();
        self.report(result);
    }

    fn node(&mut self, node: NodeRef<'a>) {
        let mut feeds = Vec::new();
        if is_built_in(node.element)
            || !of_category(node.element.tag()).is_empty()
                && self.graph.definitions().find(node.element).is_none()
        {
            let before = self.found.problems.len();
            let bound = Node::bind_all(self.graph, node, &mut self.found.problems);
            self.found.more += usize::from(self.found.problems.len() >= before + MOST_PROBLEMS);
            if let Some(bound) = &bound {
                self.warn_of_mdl(bound);
            }
            for input in bound.into_iter().flat_map(|bound| bound.inputs) {
                feeds.push(input.feed);
                if input.ty == Type::Filename {
                    let result = self.value(input.feed, input.ty);
                    self.report(result);
                }
            }
        } else if node.element.attribute("type").is_none() {
            self.found.problems.push(Error::MissingAttribute { at: node.element.place(), attribute: "type" });
        } else {
            feeds = self.defined(node);
        }
        let targets = feeds.into_iter().filter_map(|feed| match feed {
            Feed::Node { node, .. } => Some(node),
            _ => None,
        });
        self.edges.insert((node.scope, ptr::from_ref(node.element)), (node, targets.collect()));
    }

    /// MaterialX's MDL leaves out what is under a lobe that can't be layered there.
    fn warn_of_mdl(&mut self, node: &Node<'a>) {
        let is_lobe = |top: NodeRef<'_>| top.element.tag() == "retro_reflective_bsdf";
        if node.def.category == "layer" && node.connected("top").is_some_and(is_lobe) {
            let message = "MDL, as MaterialX writes it, leaves out what is below this lobe; use mix or add if it is to be \
                           rendered from MDL";
            let at = node.place_of("top");
            self.found.warnings.push(Warning { at, message: message.to_owned() });
        }
    }

    /// A node that a library or the document defines.
    fn defined(&mut self, node: NodeRef<'a>) -> Vec<Feed<'a>> {
        let definition = self.graph.definitions().find(node.element);
        let Some(definition) = definition else {
            self.found.problems.push(unknown_category(self.graph, node.element));
            return Vec::new();
        };
        if definition.graph.is_none() {
            self.found.problems.push(Error::NoGraph { at: node.element.place() });
        }
        let mut feeds = Vec::new();
        for input in node.element.children_of_kind("input") {
            if self.is_full() {
                break;
            }
            match self.defined_input(node, definition, input) {
                Ok(feed) => feeds.push(feed),
                Err(problem) => self.found.problems.push(problem),
            }
        }
        if let Some(graph) = definition.graph {
            self.definition(graph, node);
        }
        feeds
    }

    /// Checks the graph behind a node where the document brings it: once, with the inputs of the first node
    /// that uses it.
    fn definition(&mut self, graph: &'a Element, node: NodeRef<'a>) {
        let own = self.graph.element(ROOT).children().as_ptr_range();
        if !own.contains(&ptr::from_ref(graph)) || !self.entered.insert(graph) {
            return;
        }
        match self.graph.enter(graph, node, true) {
            Ok(inner) => self.scope(graph, inner),
            Err(problem) => self.found.problems.push(problem),
        }
    }

    fn defined_input(
        &mut self,
        node: NodeRef<'a>,
        definition: &Definition<'a>,
        input: &'a Element,
    ) -> Result<Feed<'a>, Error> {
        let ty = self.type_of(node.element, input)?;
        let feed = self.graph.feed(node, input)?;
        check_connection(self.graph, node, input, feed, ty)?;
        self.value(feed, ty)?;
        let defined = input.name().and_then(|name| definition.input(name));
        if let (Some(defined), Feed::Value { owner, input }) = (defined, feed) {
            self.warn_of_bounds(owner, input, defined, ty)?;
        }
        Ok(feed)
    }

    /// The values of a definition's own inputs.
    fn nodedef(&mut self, nodedef: &'a Element) {
        for input in nodedef.children_of_kind("input") {
            let ty = input.attribute("type").and_then(Type::parse);
            if let (Some(ty), Some(_)) = (ty, input.attribute("value")) {
                let result = self.warn_of_bounds(nodedef, input, input, ty);
                self.report(result);
            }
        }
    }

    /// `uimin` and `uimax` are where an editor's slider ends, no limits.
    fn warn_of_bounds(
        &mut self,
        owner: &Element,
        input: &'a Element,
        defined: &Element,
        ty: Type,
    ) -> Result<(), Error> {
        let value = constant(owner, input, ty)?;
        let bound = |name| Value::parse(ty, defined.attribute(name)?);
        let (low, high) = (bound("uimin"), bound("uimax"));
        let at = |bound: &Option<Value<'_>>, i: usize| bound.and_then(|b| b.components().get(i).copied());
        let is_outside = |(i, x): (usize, &f32)| {
            at(&low, i).is_some_and(|low| *x < low) || at(&high, i).is_some_and(|high| *x > high)
        };
        if value.components().iter().enumerate().any(is_outside) {
            let [low, high] = [low, high].map(|b| b.map_or_else(|| "...".to_owned(), |b| b.to_string()));
            let name = quoted(defined.name().unwrap_or_default());
            let message = format!("{name} is {value}, outside the usual [{low}] to [{high}]");
            self.found.warnings.push(Warning { at: owner.place_of(input), message });
        }
        Ok(())
    }

    /// Reports every cycle once: a depth-first search without recursion.
    fn cycles(&mut self) {
        let mut done: HashSet<Key> = HashSet::new();
        let mut starts: Vec<NodeRef<'a>> = self.edges.values().map(|(node, _)| *node).collect();
        starts.sort_by_key(|node| node.element.offset());
        let key = |node: NodeRef<'_>| (node.scope, ptr::from_ref(node.element));
        for start in starts {
            let mut path: Vec<(NodeRef<'a>, usize)> = vec![(start, 0)];
            let mut on_path: HashSet<Key> = HashSet::from([key(start)]);
            if done.contains(&key(start)) {
                continue;
            }
            while let Some((node, next)) = path.last_mut() {
                let targets = self.edges.get(&key(*node)).map_or(&[][..], |(_, targets)| targets);
                let Some(&target) = targets.get(*next) else {
                    done.insert(key(*node));
                    on_path.remove(&key(*node));
                    path.pop();
                    continue;
                };
                *next += 1;
                if on_path.contains(&key(target)) {
                    if self.found.problems.len() >= MAX_PROBLEMS {
                        return;
                    }
                    let start = path.iter().position(|(node, _)| key(*node) == key(target)).unwrap_or(0);
                    let names = path[start..].iter().map(|(node, _)| node.element.quoted_name());
                    self.found
                        .problems
                        .push(Error::Cycle { at: target.element.place(), cycle: listed(names) });
                } else if !done.contains(&key(target)) {
                    on_path.insert(key(target));
                    path.push((target, 0));
                }
            }
        }
    }
}
