//! What feeds an input: a connected node, a constant, or the default.

use crate::{
    element::Element,
    error::{Error, listed, quoted},
    graph::{Graph, NodeRef},
    node::definitions,
    nodedef::{Accepts, InputDef, InputDefault},
    value::{COLOR_SPACES, Value},
};

/// Where an input's value comes from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Feed<'a> {
    Default,
    Value(Value<'a>),
    Node(NodeRef<'a>),
}

/// Finds what feeds an input. A connection is preferred to a value, as in MaterialX.
pub(crate) fn feed<'a>(
    graph: &Graph<'a>,
    node: NodeRef<'a>,
    child: &'a Element,
    input: &'static InputDef,
) -> Result<Feed<'a>, Error> {
    if let Some(target) = graph.connection(node, child)? {
        let output = definitions(target.element)?[0].output;
        if output != input.ty() {
            let found = format!("{} by its connection", quoted(output.name()));
            let at = node.element.place_of(child);
            return Err(Error::WrongType { at, found, expected: input.ty().name().to_owned() });
        }
        return match input.accepts {
            Accepts::DefaultOnly => Err(default_only(node.element, child, input)),
            _ => Ok(Feed::Node(target)),
        };
    }
    match child.attribute("value") {
        None => Ok(Feed::Default),
        Some(text) => value(node.element, child, input, text).map(Feed::Value),
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
    let is_default = matches!(input.default, InputDefault::Value(default) if default == value);
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
        InputDefault::Value(value) => value.to_string(),
        InputDefault::Geometry(property) => format!("the geometry's {property}"),
        InputDefault::Unconnected(_) => "unconnected".to_owned(),
    };
    Error::Unsupported {
        at: node.place_of(child),
        what: format!("anything but the default, {default},"),
        instead: "remove the input".to_owned(),
    }
}
