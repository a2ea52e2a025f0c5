//! Inputs of closures: numbers that may vary, and values that may not.

use super::{
    pattern::varies,
    slot::{Slot, finite},
    surface::Builder,
};
use crate::{
    closure::ScatterMode,
    error::Error,
    graph::{Feed, bind::Node, input::constant},
    nodes::port::{Accepts, Default},
    program::{Expr, Geometry},
    value::{Type, Value},
};

impl<'a> Builder<'a> {
    /// An input's numbers in the range of its definition, to compute with.
    pub(super) fn bounded(&mut self, node: &Node<'a>, input: &str) -> Result<Expr<'a>, Error> {
        let x = self.expr(node, input)?;
        Ok(match node.input(input).1.accepts {
            Accepts::Unit => x.clamp(0.0, 1.0),
            Accepts::NotNegative => x.max(0.0),
            _ => x,
        })
    }

    /// An input's numbers as they are computed.
    fn expr(&mut self, node: &Node<'a>, input: &str) -> Result<Expr<'a>, Error> {
        let (given, port) = node.input(input);
        let width = given.ty.width();
        match (given.feed, port.default) {
            (Feed::Default, Default::Number(x)) => Ok(self.patterns.program.number(x).to(width)),
            (Feed::Default, Default::Value(value)) => Ok(self.patterns.program.lanes(value.lanes(), width)),
            (feed, _) => self.patterns.feed(node.node.element, feed, given.ty),
        }
    }

    /// An input's numbers, computed ones in the range of its definition.
    pub(super) fn slot<const N: usize>(&mut self, node: &Node<'a>, input: &str) -> Result<Slot<N>, Error> {
        let accepts = node.input(input).1.accepts;
        self.slot_within(node, input, accepts)
    }

    pub(super) fn slot_within<const N: usize>(
        &mut self,
        node: &Node<'a>,
        input: &str,
        accepts: Accepts,
    ) -> Result<Slot<N>, Error> {
        let is_written = matches!(node.input(input).0.feed, Feed::Value { .. } | Feed::Default);
        let value = self.expr(node, input)?.to(N as u8);
        match value.constant() {
            // What a document says is in range, or its receiver refuses it.
            Some(lanes) if is_written && self.graph.is_in_document(node.node.scope) => {
                Ok(Slot::Constant(core::array::from_fn(|i| lanes[i])))
            }
            _ => Ok(self.slot_of(value, accepts)),
        }
    }

    pub(super) fn float(&mut self, node: &Node<'a>, input: &str) -> Result<Slot<1>, Error> {
        self.slot(node, input)
    }

    /// A colour, or a float that stands for all three channels.
    pub(super) fn color(&mut self, node: &Node<'a>, input: &str) -> Result<Slot<3>, Error> {
        self.slot(node, input)
    }

    /// A direction; `None` where it is the geometry's own.
    pub(super) fn direction(
        &mut self,
        node: &Node<'a>,
        input: &str,
        own: Geometry,
    ) -> Result<Option<Slot<3>>, Error> {
        if matches!(node.input(input).0.feed, Feed::Default) {
            return Ok(None);
        }
        if matches!(node.input(input).0.feed, Feed::Value { .. })
            && self.graph.is_in_document(node.node.scope)
        {
            self.warn(node, input, "MaterialX ignores a value here; connect a node, as in constant");
        }
        if self.expr(node, input)?.register() == self.patterns.program.geometry(own).register() {
            return Ok(None);
        }
        self.slot(node, input).map(Some)
    }

    pub(super) fn boolean(&mut self, node: &Node<'a>, input: &str) -> Result<bool, Error> {
        match self.uniform(node, input)? {
            Value::Boolean(x) => Ok(x),
            _ => Ok(false),
        }
    }

    pub(super) fn word(&mut self, node: &Node<'a>, input: &str) -> Result<&'a str, Error> {
        match self.uniform(node, input)? {
            Value::String(x) => Ok(x),
            _ => Ok(""),
        }
    }

    /// A value that can't vary over the surface.
    fn uniform(&mut self, node: &Node<'a>, input: &str) -> Result<Value<'a>, Error> {
        let (given, port) = node.input(input);
        match (given.feed, port.default) {
            (Feed::Value { owner, input }, _) => constant(owner, input, given.ty),
            (Feed::Node { .. }, _) if given.ty == Type::Boolean => {
                let value = self.patterns.feed(node.node.element, given.feed, given.ty)?.constant();
                value.map(|lanes| Value::Boolean(lanes[0] != 0.0)).ok_or_else(|| varies(node, input))
            }
            (Feed::Default, Default::Value(value)) => Ok(value),
            _ => Err(varies(node, input)),
        }
    }

    pub(super) fn scatter_mode(&mut self, node: &Node<'a>) -> Result<ScatterMode, Error> {
        Ok(match self.word(node, "scatter_mode")? {
            "T" => ScatterMode::Transmit,
            "RT" => ScatterMode::ReflectTransmit,
            _ => ScatterMode::Reflect,
        })
    }

    /// A slot for a value, which becomes one of the program's results where it varies.
    pub(super) fn slot_of<const N: usize>(&mut self, value: Expr<'a>, accepts: Accepts) -> Slot<N> {
        match value.constant() {
            Some(lanes) => Slot::Constant(core::array::from_fn(|i| finite(accepts.nearest(lanes[i])))),
            None => {
                self.outputs.push(value);
                Slot::Output { index: self.outputs.len() - 1, accepts }
            }
        }
    }
}
