//! What the formulas of pattern nodes compute with.

use super::port::{Default, Port};
use crate::{
    program::{Assembler, Expr, Op},
    value::{Type, Value},
};

/// What an input of a pattern node is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Operand<'p> {
    Number(Expr<'p>),
    Text(&'p str),
    Matrix(Matrix),
    /// A texture by its number; `None` where no file is named.
    Texture(Option<u32>),
}

/// A square matrix, row by row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Matrix {
    side: usize,
    numbers: [f32; 16],
}

impl Matrix {
    fn new(side: usize, given: &[f32]) -> Self {
        let mut numbers = [0.0; 16];
        numbers[..given.len()].copy_from_slice(given);
        Self { side, numbers }
    }

    /// A row vector times the matrix, as MaterialX means it; components that the vector lacks are 1.
    pub(crate) fn transform<'p>(&self, v: Expr<'p>) -> Expr<'p> {
        let (width, side) = (usize::from(v.width()), self.side);
        let mut row: Vec<Expr<'p>> = (0..width).map(|i| v.part(i as u8)).collect();
        row.resize(side, v.program().number(1.0));
        let row = v.program().combine(&row);
        let column =
            |i: usize| core::array::from_fn(|r| if r < side { self.numbers[r * side + i] } else { 0.0 });
        let dots: Vec<Expr<'p>> =
            (0..width).map(|i| row.dot(v.program().lanes(column(i), side as u8))).collect();
        v.program().combine(&dots)
    }
}

impl<'p> Operand<'p> {
    /// A constant of a type.
    pub(crate) fn of_value(program: &'p Assembler, value: Value<'p>) -> Self {
        match value {
            Value::String(text) => Self::Text(text),
            Value::Filename(_) => Self::Texture(None),
            Value::Matrix33(numbers) => Self::Matrix(Matrix::new(3, &numbers)),
            Value::Matrix44(numbers) => Self::Matrix(Matrix::new(4, &numbers)),
            value => Self::Number(program.lanes(value.lanes(), value.ty().width())),
        }
    }

    /// What an input is that is left out.
    pub(crate) fn of_default(program: &'p Assembler, port: &Port, node: Type) -> Self {
        match port.default {
            Default::Number(x) => Self::Number(program.number(x).to(port.default_type(node).width())),
            Default::Value(value) => Self::of_value(program, value),
            Default::Geometry(geometry) => Self::Number(program.geometry(geometry)),
            Default::Unconnected => Self::Texture(None),
        }
    }
}

/// The inputs of one node.
#[derive(Debug)]
pub(crate) struct Inputs<'p> {
    pub(crate) program: &'p Assembler,
    /// The node's own type.
    pub(crate) ty: Type,
    pub(crate) ports: &'static [Port],
    /// In the order of the ports.
    pub(crate) operands: Vec<Operand<'p>>,
}

impl<'p> Inputs<'p> {
    /// How many components the node's value has.
    pub(crate) fn width(&self) -> u8 {
        self.ty.width()
    }

    /// The inputs that are numbers, in the order of the ports.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = Expr<'p>> {
        self.operands.iter().filter_map(|operand| match operand {
            Operand::Number(x) => Some(*x),
            _ => None,
        })
    }

    /// The first inputs that are numbers.
    pub(crate) fn all<const N: usize>(&self) -> [Expr<'p>; N] {
        let mut numbers = self.numbers();
        core::array::from_fn(|_| match numbers.next() {
            Some(x) => x,
            // A row asks for more than it declares: the test of all rows meets it, no document can.
            None => unreachable!("{:?} has fewer numbers than {N}", self.ports),
        })
    }

    fn operand(&self, name: &str) -> Operand<'p> {
        match self.ports.iter().position(|port| port.name == name) {
            Some(index) => self.operands[index],
            None => unreachable!("{:?} has no {name}", self.ports),
        }
    }

    /// An input that is a text.
    pub(crate) fn text(&self, name: &str) -> &'p str {
        match self.operand(name) {
            Operand::Text(text) => text,
            other => unreachable!("{name} is {other:?}"),
        }
    }

    /// An input that is an integer, the same everywhere.
    pub(crate) fn integer(&self, name: &str) -> i32 {
        match self.operand(name) {
            Operand::Number(x) => x.constant().map_or(0, |lanes| lanes[0] as i32),
            other => unreachable!("{name} is {other:?}"),
        }
    }

    /// The texture of an input that is a file name.
    pub(crate) fn texture(&self, name: &str) -> Option<u32> {
        match self.operand(name) {
            Operand::Texture(texture) => texture,
            other => unreachable!("{name} is {other:?}"),
        }
    }

    pub(crate) fn matrix(&self, name: &str) -> Matrix {
        match self.operand(name) {
            Operand::Matrix(matrix) => matrix,
            other => unreachable!("{name} is {other:?}"),
        }
    }

    /// The result of an operation, as wide as the node's value.
    pub(crate) fn op(&self, op: Op, sources: &[Expr<'p>]) -> Expr<'p> {
        self.program.op(op, self.width(), sources)
    }
}
