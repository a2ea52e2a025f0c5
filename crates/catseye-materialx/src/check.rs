//! Everything that is wrong with a document, in one go.

use std::{
    collections::{HashMap, HashSet},
    path::{Path, PathBuf},
    ptr,
    sync::Arc,
};

use crate::{
    compile::pattern::find_picture,
    error::{Error, Place, listed, quoted},
    graph::{
        Feed, Graph, NodeRef, ROOT, ScopeId,
        bind::{Node, is_built_in},
        input::{check_connection, constant, output_feed, unknown_category},
        library::{Definition, Library},
    },
    nodes::of_category,
    picture::{Picture, Room},
    text::{
        element::Element,
        files::SearchPath,
        include::Includer,
        root::{parse_bytes, read_root},
    },
    value::Type,
};

/// Most problems that are reported for a document.
const MAX_PROBLEMS: usize = 200;

/// What is wrong with a file, in the order of its lines; nothing if every node in it can be read.
///
/// Unlike [`Document::material`](crate::Document::material) this looks at every node, also at those that no material
/// uses, and goes on after the first problem.
#[must_use]
pub fn check(path: impl AsRef<Path>, library: &Library) -> Vec<Error> {
    let path = path.as_ref();
    match read_root(path, &path.to_string_lossy()) {
        Err(problem) => vec![problem],
        Ok(root) => check_root(root, path.canonicalize().ok(), library.search_path(), library),
    }
}

/// As [`check`], for a document's bytes; `name` stands for the file in messages.
#[must_use]
pub fn check_bytes(bytes: &[u8], name: &str, library: &Library) -> Vec<Error> {
    match parse_bytes(bytes, name, None) {
        Err(problem) => vec![problem],
        Ok(root) => check_root(root, None, library.search_path(), library),
    }
}

fn check_root(
    root: Element,
    path: Option<PathBuf>,
    search_path: &SearchPath,
    library: &Library,
) -> Vec<Error> {
    let mut includer = Includer::new(search_path, path).lenient();
    let own_file = Arc::clone(root.source().name());
    let root = match includer.expand(root) {
        Ok(root) => root,
        Err(problem) => return vec![problem],
    };
    let mut problems = includer.problems();
    let (graph, duplicates) = Graph::with_problems(&root, library);
    problems.extend(duplicates);
    let mut checker = Checker {
        graph: &graph,
        library,
        problems,
        edges: HashMap::new(),
        seen: HashSet::new(),
        entered: HashSet::new(),
    };
    checker.scope(&root, ROOT, 0);
    checker.cycles();
    let mut problems = checker.problems;
    problems.sort_by_cached_key(|problem| order(problem, &own_file));
    problems.dedup_by_key(|problem| problem.to_string());
    problems.truncate(MAX_PROBLEMS);
    problems
}

/// The document's own problems first, by line; then those of the files that it includes.
fn order(problem: &Error, own_file: &Arc<str>) -> (bool, Option<Arc<str>>, u32, u32) {
    match problem.place() {
        None => (false, None, 0, 0),
        Some(Place { file, line, column, .. }) => (file != own_file, Some(Arc::clone(file)), *line, *column),
    }
}

/// A node, for the search for cycles.
type Key = (ScopeId, *const Element);

struct Checker<'a, 'g> {
    graph: &'g Graph<'a>,
    library: &'a Library,
    problems: Vec<Error>,
    /// What each node is connected to.
    edges: HashMap<Key, (NodeRef<'a>, Vec<NodeRef<'a>>)>,
    /// Pictures that were looked at.
    seen: HashSet<PathBuf>,
    /// Graphs of the document's own definitions that were looked at.
    entered: HashSet<*const Element>,
}

impl<'a> Checker<'a, '_> {
    fn is_full(&self) -> bool {
        self.problems.len() >= 2 * MAX_PROBLEMS
    }

    fn report(&mut self, result: Result<(), Error>) {
        if let Err(problem) = result {
            self.problems.push(problem);
        }
    }

    /// Checks the nodes and outputs of the document or a nodegraph.
    fn scope(&mut self, element: &'a Element, scope: ScopeId, depth: usize) {
        for child in element.children() {
            if self.is_full() {
                return;
            }
            let node = NodeRef { element: child, scope };
            match child.tag() {
                "nodegraph" => self.nodegraph(child, scope, depth),
                "output" => self.output(node),
                // The nodegraph's own, which may be connected to what is around it; checked there.
                "input" => {}
                "look" => self.look(child),
                "nodedef" => self.nodedef(child),
                "implementation" | "typedef" | "targetdef" | "unitdef" | "unittypedef" | "geompropdef"
                | "geominfo" | "lookgroup" | "collection" | "propertyset" | "variantset" | "backdrop"
                | "attributedef" | "xi:include" => {}
                _ => self.node(node),
            }
        }
    }

    fn nodegraph(&mut self, graph: &'a Element, around: ScopeId, depth: usize) {
        // Elements are nested no deeper than this: the parser has seen to it.
        let _ = depth;
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
            Ok(inner) => self.scope(graph, inner, depth + 1),
            Err(problem) => self.problems.push(problem),
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
            let bound = Node::bind_all(self.graph, node, &mut self.problems);
            for input in bound.into_iter().flat_map(|bound| bound.inputs) {
                feeds.push(input.feed);
                if input.ty == Type::Filename {
                    let result = self.value(input.feed, input.ty);
                    self.report(result);
                }
            }
        } else if node.element.attribute("type").is_none() {
            self.problems.push(Error::MissingAttribute { at: node.element.place(), attribute: "type" });
        } else {
            feeds = self.defined(node);
        }
        let targets = feeds.into_iter().filter_map(|feed| match feed {
            Feed::Node { node, .. } => Some(node),
            _ => None,
        });
        self.edges.insert((node.scope, ptr::from_ref(node.element)), (node, targets.collect()));
    }

    /// A node that a library or the document defines.
    fn defined(&mut self, node: NodeRef<'a>) -> Vec<Feed<'a>> {
        let definition = self.graph.definitions().find(node.element);
        let Some(definition) = definition else {
            self.problems.push(unknown_category(self.graph, node.element));
            return Vec::new();
        };
        if definition.graph.is_none() {
            self.problems.push(Error::NoGraph { at: node.element.place() });
        }
        let mut feeds = Vec::new();
        for input in node.element.children_of_kind("input") {
            if self.is_full() {
                break;
            }
            match self.defined_input(node, definition, input) {
                Ok(feed) => feeds.push(feed),
                Err(problem) => self.problems.push(problem),
            }
        }
        if let Some(graph) = definition.graph {
            self.definition(graph, node);
        }
        feeds
    }

    /// Checks the graph behind a node where the document brings it: once, with the inputs of the first node that uses it.
    fn definition(&mut self, graph: &'a Element, node: NodeRef<'a>) {
        let own = self.graph.element(ROOT).children().as_ptr_range();
        if !own.contains(&ptr::from_ref(graph)) || !self.entered.insert(graph) {
            return;
        }
        match self.graph.enter(graph, node, true) {
            Ok(inner) => self.scope(graph, inner, 0),
            Err(problem) => self.problems.push(problem),
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
            check_bounds(owner, input, defined, ty)?;
        }
        Ok(feed)
    }

    /// A definition's defaults must lie within its own bounds.
    fn nodedef(&mut self, nodedef: &'a Element) {
        for input in nodedef.children_of_kind("input") {
            let ty = input.attribute("type").and_then(Type::parse);
            if let (Some(ty), Some(_)) = (ty, input.attribute("value")) {
                let result = check_bounds(nodedef, input, input, ty);
                self.report(result);
            }
        }
    }

    fn look(&mut self, look: &'a Element) {
        let materials: HashSet<&str> =
            self.graph.materials().filter_map(|node| node.element.name()).collect();
        let mut problems = Vec::new();
        for assign in look.children_of_kind("materialassign") {
            if problems.len() >= MAX_PROBLEMS {
                break;
            }
            match assign.attribute("material") {
                None => problems
                    .push(Error::MissingAttribute { at: look.place_of(assign), attribute: "material" }),
                Some(name) if !materials.contains(name) => problems.push(Error::Dangling {
                    at: look.place_of(assign),
                    target: format!("material={}", quoted(name)),
                }),
                Some(_) => {}
            }
        }
        self.problems.extend(problems);
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
                    if self.problems.len() >= 2 * MAX_PROBLEMS {
                        return;
                    }
                    let start = path.iter().position(|(node, _)| key(*node) == key(target)).unwrap_or(0);
                    let names = path[start..].iter().map(|(node, _)| node.element.quoted_name());
                    self.problems.push(Error::Cycle { at: target.element.place(), cycle: listed(names) });
                } else if !done.contains(&key(target)) {
                    on_path.insert(key(target));
                    path.push((target, 0));
                }
            }
        }
    }
}

/// Checks a value against the hard limits (`uimin`, `uimax`) of a definition's input.
fn check_bounds(owner: &Element, input: &Element, defined: &Element, ty: Type) -> Result<(), Error> {
    let value = constant(owner, input, ty)?;
    let bound = |name| {
        let text = defined.attribute(name)?;
        crate::value::Value::parse(ty, text)
    };
    let (low, high) = (bound("uimin"), bound("uimax"));
    for (i, x) in value.components().iter().enumerate() {
        let limit =
            |bound: &Option<crate::value::Value<'_>>| bound.and_then(|b| b.components().get(i).copied());
        let below = limit(&low).is_some_and(|low| *x < low);
        let above = limit(&high).is_some_and(|high| *x > high);
        if below || above {
            let range = [low, high].map(|b| b.map_or_else(|| "...".to_owned(), |b| b.to_string()));
            let name = defined.name().unwrap_or_default();
            let message = format!("{} is {value}, outside [{}] to [{}]", quoted(name), range[0], range[1]);
            return Err(Error::OutOfRange { at: owner.place_of(input), message });
        }
    }
    Ok(())
}
