//! Values of inputs: read as their type, in linear light, within their range.

use crate::{
    color_space::{COLOR_SPACES, ColorSpace},
    error::{Error, listed, plain, quoted},
    graph::{Feed, Graph, NodeRef, library::Definition},
    nodes::{of_category, of_type},
    text::element::Element,
    value::{Type, Value, expected},
};

/// The category of a node: that of the built-in definition that it names, which counts more than its own.
pub(crate) fn category(node: &Element) -> &str {
    let named = || {
        let rest = node.attribute("nodedef")?.strip_prefix("ND_")?;
        rest.match_indices('_').rev().map(|(end, _)| &rest[..end]).find(|name| !of_category(name).is_empty())
    };
    let own = node.tag();
    if of_category(own).is_empty() { own } else { named().unwrap_or(own) }
}

/// The type of a node's output.
pub(crate) fn output_type(
    graph: &Graph<'_>,
    target: NodeRef<'_>,
    output: Option<&str>,
) -> Result<Type, Error> {
    let element = target.element;
    let unknown = |found: &str| Error::WrongType {
        at: element.place(),
        found: quoted(found),
        expected: "a type of MaterialX".to_owned(),
    };
    let name = element.require("type")?;
    let ty = Type::parse(name).ok_or_else(|| unknown(name))?;
    if ty != Type::MultiOutput {
        return Ok(ty);
    }
    let output = output.ok_or_else(|| Error::Unsupported {
        at: element.place(),
        what: "a connection to a node of several outputs without output=\"...\"".to_owned(),
        instead: "name the output where it is connected".to_owned(),
    })?;
    if let Some(def) = of_type(category(element), ty).next() {
        let known = def.outputs.iter().find(|(name, _)| *name == output);
        return known.map(|(_, ty)| *ty).ok_or_else(|| no_output(element, output));
    }
    let definition = graph.definitions().find(element).ok_or_else(|| unknown_category(graph, element))?;
    let defined = definition.outputs().find(|defined| defined.name() == Some(output));
    let defined = defined.and_then(|defined| defined.attribute("type")).and_then(Type::parse);
    defined.ok_or_else(|| no_output(element, output))
}

/// What an `<output>` is connected to, which is of its type, if that is a type of ours.
pub(crate) fn output_feed<'a>(
    graph: &Graph<'a>,
    output: NodeRef<'a>,
) -> Result<(Feed<'a>, Option<Type>), Error> {
    let element = output.element;
    let Some(feed) = graph.output_feed(output.scope, element)? else {
        let names = ["nodename", "nodegraph"]
            .iter()
            .filter_map(|name| element.attribute(name).map(|value| format!("{name}={}", quoted(value))));
        let target = names.collect::<Vec<_>>().join(" ");
        return Err(Error::Dangling { at: element.place(), target });
    };
    let ty = Type::parse(element.require("type")?);
    if let Some(ty) = ty {
        check_connection(graph, output, element, feed, ty)?;
    }
    Ok((feed, ty))
}

pub(crate) fn no_output(element: &Element, output: &str) -> Error {
    Error::Dangling { at: element.place(), target: format!("output={}", quoted(output)) }
}

/// That nothing is known of a node's category, or not with its type and inputs.
pub(crate) fn unknown_category(graph: &Graph<'_>, element: &Element) -> Error {
    let defined = graph.definitions().of(element.tag());
    if let Some(first) = defined.first() {
        return unfitting(element, first, defined.len());
    }
    let expected = one_of(of_category(element.tag()).iter().flat_map(|def| def.types).copied());
    if !expected.is_empty() {
        let found = quoted(element.attribute("type").unwrap_or_default());
        return Error::WrongType { at: element.place(), found, expected };
    }
    Error::UnknownCategory { at: element.place() }
}

/// Why a node doesn't fit the first definition of its category.
fn unfitting(element: &Element, definition: &Definition<'_>, count: usize) -> Error {
    let expected = definition.output_type().unwrap_or_default();
    let found = element.attribute("type").unwrap_or_default();
    if count == 1 && expected != found {
        return Error::WrongType { at: element.place(), found: quoted(found), expected: plain(expected) };
    }
    for input in element.children_of_kind("input") {
        let Some(name) = input.name() else { continue };
        let Some(defined) = definition.input(name) else {
            let known = listed(definition.inputs().filter_map(Element::name).map(plain));
            let category = plain(element.tag());
            return Error::UnknownInput { at: element.place_of(input), category, known };
        };
        let (expected, found) = (defined.attribute("type"), input.attribute("type"));
        if count == 1 && expected != found {
            return Error::WrongType {
                at: element.place_of(input),
                found: quoted(found.unwrap_or_default()),
                expected: plain(expected.unwrap_or_default()),
            };
        }
    }
    Error::WrongType {
        at: element.place(),
        found: quoted(found),
        expected: "another type, or inputs of other types,".to_owned(),
    }
}

/// The types' names, each once, for messages.
pub(crate) fn one_of(types: impl Iterator<Item = Type>) -> String {
    let mut names: Vec<&str> = Vec::new();
    for ty in types {
        if !names.contains(&ty.name()) {
            names.push(ty.name());
        }
    }
    names.join(" or ")
}

/// Checks the type of what an input is connected to.
pub(crate) fn check_connection<'a>(
    graph: &Graph<'a>,
    node: NodeRef<'a>,
    child: &'a Element,
    feed: Feed<'a>,
    expected: Type,
) -> Result<(), Error> {
    let Feed::Node { node: target, output } = feed else { return Ok(()) };
    let found = output_type(graph, target, output)?;
    if found == expected {
        return Ok(());
    }
    Err(Error::WrongType {
        at: node.element.place_of(child),
        found: format!("{} by its connection", quoted(found.name())),
        expected: expected.name().to_owned(),
    })
}

/// Reads the value of an input and converts its colour space.
pub(crate) fn constant<'a>(owner: &Element, input: &'a Element, ty: Type) -> Result<Value<'a>, Error> {
    let text = input.attribute("value").unwrap_or_default();
    let value = Value::parse(ty, text).ok_or_else(|| Error::BadValue {
        at: owner.place_of(input),
        value: quoted(text),
        expected: expected(ty, text),
    })?;
    Ok(match value {
        Value::Color3(color) => Value::Color3(color_space(owner, input)?.to_linear(color)),
        Value::Color4([r, g, b, alpha]) => {
            let [r, g, b] = color_space(owner, input)?.to_linear([r, g, b]);
            Value::Color4([r, g, b, alpha])
        }
        value => value,
    })
}

/// The colour space that an input's value is written in.
pub(crate) fn color_space(owner: &Element, input: &Element) -> Result<&'static ColorSpace, Error> {
    let Some(name) = input.colorspace() else { return Ok(&COLOR_SPACES[0]) };
    ColorSpace::named(name).ok_or_else(|| Error::ColorSpace {
        at: owner.place_of(input),
        colorspace: quoted(name),
        supported: listed(COLOR_SPACES.iter().map(|space| space.name)),
    })
}
