//! Documents of version 1.38 as MaterialX 1.39 reads them.
//!
//! The rules are those of MaterialX's `Document::upgradeVersion`; test `upgrade` in `tests/materialx`
//! compares what comes out. Left alone is `swizzle`, which 1.39 no longer has and which is read here, and a
//! value beside a connection, which does nothing.

use std::collections::{HashMap, HashSet};

use crate::text::element::Element;

/// What connects an input, and the value that it has instead.
const BINDINGS: &[&str] = &["nodename", "nodegraph", "output", "interfacename", "value"];
/// BSDF nodes that have a film of their own in 1.39.
const WITH_FILM: &[&str] = &["dielectric_bsdf", "conductor_bsdf", "generalized_schlick_bsdf"];

/// Layers with films in a scope: each is followed down to the last node. What is beyond is refused later, as
/// unknown.
const MAX_FILMS: usize = 256;

/// Upgrades the document's scope and those of its nodegraphs.
pub(crate) fn upgrade(root: &mut Element) {
    let graphs = output_types(root);
    for child in root.children_mut() {
        if child.tag() == "nodegraph" {
            scope(child, &graphs);
        }
    }
    scope(root, &graphs);
}

/// The types of the outputs of a scope's nodegraphs, by the names of both; without the output's for an only
/// one.
type OutputTypes = HashMap<(String, Option<String>), String>;

fn output_types(root: &Element) -> OutputTypes {
    let mut types = HashMap::new();
    for graph in root.children_of_kind("nodegraph") {
        let Some(name) = graph.name() else { continue };
        for output in graph.children_of_kind("output") {
            let Some(ty) = output.attribute("type") else { continue };
            types.insert((name.to_owned(), output.name().map(str::to_owned)), ty.to_owned());
            types.insert((name.to_owned(), None), ty.to_owned());
        }
    }
    types
}

fn scope(scope: &mut Element, graphs: &OutputTypes) {
    channels(scope, graphs);
    films(scope);
    let mut names = Names::of(scope);
    let mut added = Vec::new();
    for node in scope.children_mut() {
        match node.tag() {
            "atan2" => {
                for (old, new) in [("in1", "iny"), ("in2", "inx")] {
                    if let Some(input) = node.child_mut("input", old) {
                        input.set("name", new);
                    }
                }
            }
            "subsurface_bsdf" => radius(node, &mut names, &mut added),
            "switch" => which(node),
            "normalmap" => normal_map(node, &mut names, &mut added),
            _ => {}
        }
    }
    scope.children_mut().append(&mut added);
}

/// The names of a scope, for new ones.
struct Names {
    taken: HashSet<String>,
    count: usize,
}

impl Names {
    fn of(scope: &Element) -> Self {
        let taken = scope.children().iter().filter_map(Element::name).map(str::to_owned).collect();
        Self { taken, count: 0 }
    }

    /// A name that is free, and taken from now on.
    fn new_one(&mut self, wanted: &str) -> String {
        loop {
            self.count += 1;
            let name = format!("{wanted}_{}", self.count);
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }
}

/// The attribute `channels` of inputs and outputs becomes a node `swizzle` in between.
fn channels(scope: &mut Element, graphs: &OutputTypes) {
    let mut names = Names::of(scope);
    let mut added = Vec::new();
    let nodes = |element: &&Element| !matches!(element.tag(), "input" | "output" | "nodegraph");
    let types: HashMap<String, String> = scope
        .children()
        .iter()
        .filter(nodes)
        .filter_map(|node| Some((node.name()?.to_owned(), node.attribute("type")?.to_owned())))
        .collect();
    let upstream = |port: &Element| match (port.attribute("nodename"), port.attribute("nodegraph")) {
        (Some(node), _) => types.get(node).map(String::as_str),
        (None, Some(graph)) => {
            let key = (graph.to_owned(), port.attribute("output").map(str::to_owned));
            graphs.get(&key).map(String::as_str)
        }
        (None, None) => None,
    };
    for child in scope.children_mut() {
        if child.tag() == "output" {
            added.extend(swizzle(child, upstream(child).map(str::to_owned), &mut names));
        } else if child.tag() != "nodegraph" && child.tag() != "nodedef" {
            for input in child.children_mut().iter_mut().filter(|input| input.tag() == "input") {
                added.extend(swizzle(input, upstream(input).map(str::to_owned), &mut names));
            }
        }
    }
    scope.children_mut().append(&mut added);
}

fn swizzle(port: &mut Element, upstream: Option<String>, names: &mut Names) -> Option<Element> {
    let channels = port.take("channels")?;
    let ty = port.attribute("type").unwrap_or_default().to_owned();
    // Where the type isn't told, the channels tell it.
    let told = upstream.filter(|ty| ty != "multioutput");
    let from = told.unwrap_or_else(|| {
        let guess = match channels.as_str() {
            "xx" | "xxx" | "xxxx" => "float",
            "xyz" | "x" | "y" | "z" => "vector3",
            "rgba" | "a" => "color4",
            _ if ty == "color3" => "color4",
            _ => "color3",
        };
        guess.to_owned()
    });
    if from == "float" && ty == "float" {
        return None;
    }
    let name = names.new_one("swizzle");
    let mut node = port.sibling("swizzle", &name, &ty);
    let mut input = port.sibling("input", "in", &from);
    for binding in BINDINGS {
        if let Some(value) = port.take(binding) {
            input.set(binding, &value);
        }
    }
    let mut word = port.sibling("input", "channels", "string");
    word.set("value", &channels);
    node.children_mut().extend([input, word]);
    port.set("nodename", &name);
    Some(node)
}

/// A film on top of a layer becomes the films of the BSDF nodes below it, and the layer goes.
fn films(scope: &mut Element) {
    let named: HashMap<&str, &Element> =
        scope.children().iter().filter_map(|node| Some((node.name()?, node))).collect();
    let target =
        |node: &Element, input: &str| Some(node.child("input", input)?.attribute("nodename")?.to_owned());
    // The layer's name, and what stands for it.
    let mut bypassed: HashMap<String, String> = HashMap::new();
    let mut unused: HashSet<String> = HashSet::new();
    let mut films: HashMap<String, Vec<Element>> = HashMap::new();
    for layer in scope.children_of_kind("layer") {
        if bypassed.len() >= MAX_FILMS {
            break;
        }
        let (Some(name), Some(top), Some(base)) = (layer.name(), target(layer, "top"), target(layer, "base"))
        else {
            continue;
        };
        let film = named.get(top.as_str()).filter(|node| node.tag() == "thin_film_bsdf");
        let (Some(film), true) = (film, named.contains_key(base.as_str())) else { continue };
        for coated in upstream(&named, &base) {
            let (node, inputs) = (named[coated.as_str()], films.entry(coated.clone()).or_default());
            let mode = node.child("input", "scatter_mode").and_then(|mode| mode.attribute("value"));
            if !WITH_FILM.contains(&node.tag()) || mode == Some("T") {
                continue;
            }
            for (old, new) in [("thickness", "thinfilm_thickness"), ("ior", "thinfilm_ior")] {
                let Some(given) = film.child("input", old) else { continue };
                inputs.push(bound_like(node, given, new));
            }
        }
        bypassed.insert(name.to_owned(), base);
        unused.extend([name.to_owned(), top]);
    }
    if bypassed.is_empty() {
        return;
    }
    let children = scope.children_mut();
    children.retain(|node| node.name().is_none_or(|name| !unused.contains(name)));
    for node in children {
        redirect(node, &bypassed);
        for input in node.children_mut() {
            redirect(input, &bypassed);
        }
        for film in node.name().and_then(|name| films.remove(name)).unwrap_or_default() {
            let name = film.name().unwrap_or_default().to_owned();
            node.children_mut().retain(|input| input.name() != Some(&name));
            node.children_mut().push(film);
        }
    }
}

/// Names of the nodes of a scope that a node is made of, itself included.
fn upstream(named: &HashMap<&str, &Element>, start: &str) -> Vec<String> {
    let (mut open, mut seen) = (vec![start.to_owned()], HashSet::new());
    while let Some(name) = open.pop() {
        let Some(node) = named.get(name.as_str()) else { continue };
        if seen.insert(name) {
            let inputs = node.children_of_kind("input");
            open.extend(inputs.filter_map(|input| input.attribute("nodename")).map(str::to_owned));
        }
    }
    seen.into_iter().collect()
}

fn redirect(port: &mut Element, bypassed: &HashMap<String, String>) {
    // Layers on layers: as many steps as there are layers.
    for _ in 0..bypassed.len() {
        let base = port.attribute("nodename").and_then(|name| bypassed.get(name)).cloned();
        match base {
            Some(base) => port.set("nodename", &base),
            None => return,
        }
    }
}

/// An input of another name with the type, connection and value of `given`.
fn bound_like(node: &Element, given: &Element, name: &str) -> Element {
    let mut input = node.sibling("input", name, given.attribute("type").unwrap_or_default());
    for binding in BINDINGS {
        if let Some(value) = given.attribute(binding) {
            input.set(binding, value);
        }
    }
    input
}

/// An input that a node is connected to.
fn connected(node: &Element, name: &str, ty: &str, target: &str) -> Element {
    let mut input = node.sibling("input", name, ty);
    input.set("nodename", target);
    input
}

/// A subsurface radius is a color3.
fn radius(node: &mut Element, names: &mut Names, added: &mut Vec<Element>) {
    let Some(radius) = node.child("input", "radius") else { return };
    if radius.attribute("type") != Some("vector3") {
        return;
    }
    let name = names.new_one("convert");
    let mut convert = node.sibling("convert", &name, "color3");
    convert.children_mut().push(bound_like(node, radius, "in"));
    added.push(convert);
    let input = connected(node, "radius", "color3", &name);
    replace(node, input);
}

/// A `switch` had five inputs; beyond them it took the first.
fn which(node: &mut Element) {
    let Some(which) = node.child_mut("input", "which") else { return };
    let beyond = |value: &str| value.trim().parse::<f32>().is_ok_and(|which| which >= 5.0);
    if which.attribute("value").is_some_and(beyond) {
        which.set("value", "0");
    }
}

/// `space` went: object space becomes arithmetic, and the bitangent of tangent space is given where it would
/// be another.
fn normal_map(node: &mut Element, names: &mut Names, added: &mut Vec<Element>) {
    let space = node.child("input", "space").and_then(|space| space.attribute("value"));
    if space == Some("object") {
        let (product, difference) = (names.new_one("multiply"), names.new_one("subtract"));
        let mut multiply = node.sibling("multiply", &product, "vector3");
        let number = |value| {
            let mut input = node.sibling("input", "in2", "float");
            input.set("value", value);
            input
        };
        multiply.children_mut().extend(node.child("input", "in").map(|given| bound_like(node, given, "in1")));
        multiply.children_mut().push(number("2"));
        let mut subtract = node.sibling("subtract", &difference, "vector3");
        subtract.children_mut().extend([connected(node, "in1", "vector3", &product), number("1")]);
        let input = connected(node, "in", "vector3", &difference);
        added.extend([multiply, subtract]);
        *node = node.sibling("normalize", node.name().unwrap_or_default(), "vector3");
        node.children_mut().push(input);
        return;
    }
    node.children_mut().retain(|input| input.name() != Some("space"));
    let given = |name| node.child("input", name);
    if given("bitangent").is_some() || given("normal").is_none() && given("tangent").is_none() {
        return;
    }
    let (cross, unit) = (names.new_one("normalmap_cross"), names.new_one("normalmap_cross_norm"));
    let mut product = node.sibling("crossproduct", &cross, "vector3");
    for (old, new) in [("normal", "in1"), ("tangent", "in2")] {
        product.children_mut().extend(given(old).map(|input| bound_like(node, input, new)));
    }
    let mut normalize = node.sibling("normalize", &unit, "vector3");
    normalize.children_mut().push(connected(node, "in", "vector3", &cross));
    let input = connected(node, "bitangent", "vector3", &unit);
    added.extend([product, normalize]);
    replace(node, input);
}

fn replace(node: &mut Element, input: Element) {
    let name = input.name().unwrap_or_default().to_owned();
    node.children_mut().retain(|child| child.name() != Some(&name));
    node.children_mut().push(input);
}
