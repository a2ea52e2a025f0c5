//! Expressions: formulas that write the instructions of a program.

use core::ops::{Add, Div, Mul, Sub};

use super::{Assembler, Geometry, Lanes, Op};

/// A value of a program that is being made. One number beside a wider value stands for all of its components.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expr<'p> {
    program: &'p Assembler,
    register: u32,
    width: u8,
}

/// What stands in a formula beside an expression.
pub(crate) trait Number<'p> {
    fn expr(self, program: &'p Assembler) -> Expr<'p>;
}

impl<'p> Number<'p> for Expr<'p> {
    fn expr(self, _: &'p Assembler) -> Self {
        self
    }
}

impl<'p> Number<'p> for f32 {
    fn expr(self, program: &'p Assembler) -> Expr<'p> {
        program.number(self)
    }
}

impl Assembler {
    /// The result of an instruction, of `width` components.
    pub(crate) fn op<'p>(&'p self, op: Op, width: u8, sources: &[Expr<'p>]) -> Expr<'p> {
        let sources: Vec<u32> = sources.iter().map(|source| source.register).collect();
        Expr { program: self, register: self.push(op, width, &sources), width }
    }

    pub(crate) fn number(&self, x: f32) -> Expr<'_> {
        self.lanes([x, 0.0, 0.0, 0.0], 1)
    }

    pub(crate) fn lanes(&self, lanes: Lanes, width: u8) -> Expr<'_> {
        self.op(Op::constant(lanes), width, &[])
    }

    pub(crate) fn geometry(&self, geometry: Geometry) -> Expr<'_> {
        self.op(Op::Geometry(geometry), if geometry == Geometry::Texcoord { 2 } else { 3 }, &[])
    }

    /// One component from each.
    pub(crate) fn combine<'p>(&'p self, parts: &[Expr<'p>]) -> Expr<'p> {
        match parts {
            [one] => *one,
            parts => self.op(Op::Combine, parts.len() as u8, parts),
        }
    }
}

impl<'p> Expr<'p> {
    pub(crate) fn program(self) -> &'p Assembler {
        self.program
    }

    pub(crate) fn register(self) -> u32 {
        self.register
    }

    /// How many components it has.
    pub(crate) fn width(self) -> u8 {
        self.width
    }

    /// What it is wherever on the surface; `None` where it varies.
    pub(crate) fn constant(self) -> Option<Lanes> {
        self.program.constant(self.register)
    }

    /// One number in all of `width` components; what has several stays as it is.
    pub(crate) fn to(self, width: u8) -> Self {
        if self.width > 1 || width <= 1 { self } else { self.program.op(Op::Splat, width, &[self]) }
    }

    /// An operation on each component.
    fn each<const N: usize>(self, op: Op, others: [Self; N]) -> Self {
        let width = others.iter().fold(self.width, |width, other| width.max(other.width));
        let sources: Vec<Self> = [self].into_iter().chain(others).map(|source| source.to(width)).collect();
        self.program.op(op, width, &sources)
    }

    fn pair(self, op: Op, other: impl Number<'p>) -> Self {
        self.each(op, [other.expr(self.program)])
    }

    pub(crate) fn min(self, other: impl Number<'p>) -> Self {
        self.pair(Op::Min, other)
    }

    pub(crate) fn max(self, other: impl Number<'p>) -> Self {
        self.pair(Op::Max, other)
    }

    pub(crate) fn clamp(self, low: impl Number<'p>, high: impl Number<'p>) -> Self {
        self.max(low).min(high)
    }

    pub(crate) fn modulo(self, other: impl Number<'p>) -> Self {
        self.pair(Op::Modulo, other)
    }

    pub(crate) fn power(self, exponent: impl Number<'p>) -> Self {
        self.pair(Op::Power, exponent)
    }

    pub(crate) fn abs(self) -> Self {
        self.each(Op::Abs, [])
    }

    pub(crate) fn sign(self) -> Self {
        self.each(Op::Sign, [])
    }

    pub(crate) fn floor(self) -> Self {
        self.each(Op::Floor, [])
    }

    pub(crate) fn sqrt(self) -> Self {
        self.each(Op::Sqrt, [])
    }

    pub(crate) fn sin(self) -> Self {
        self.each(Op::Sin, [])
    }

    pub(crate) fn cos(self) -> Self {
        self.each(Op::Cos, [])
    }

    /// From this at `share` 0 to `other` at 1.
    pub(crate) fn mix(self, other: Self, share: impl Number<'p>) -> Self {
        self.each(Op::Mix, [other, share.expr(self.program)])
    }

    pub(crate) fn dot(self, other: Self) -> Self {
        self.program.op(Op::Dot, 1, &[self, other])
    }

    pub(crate) fn length(self) -> Self {
        self.program.op(Op::Length, 1, &[self])
    }

    pub(crate) fn normalize(self) -> Self {
        self.program.op(Op::Normalize, self.width, &[self])
    }

    pub(crate) fn cross(self, other: Self) -> Self {
        self.program.op(Op::Cross, 3, &[self, other])
    }

    /// One component.
    pub(crate) fn part(self, index: u8) -> Self {
        self.program.op(Op::Extract(index), 1, &[self])
    }

    /// The first components, those that it lacks 0.
    pub(crate) fn resize(self, width: u8) -> Self {
        if width == self.width {
            return self;
        }
        let zero = self.program.lanes([0.0; 4], width);
        self.program.op(Op::Add, width, &[self, zero])
    }

    /// 1 or 0.
    pub(crate) fn greater(self, other: impl Number<'p>) -> Self {
        self.program.op(Op::Greater, 1, &[self, other.expr(self.program)])
    }

    pub(crate) fn greater_or_equal(self, other: impl Number<'p>) -> Self {
        self.program.op(Op::GreaterOrEqual, 1, &[self, other.expr(self.program)])
    }

    pub(crate) fn equal(self, other: impl Number<'p>) -> Self {
        self.program.op(Op::Equal, 1, &[self, other.expr(self.program)])
    }

    /// `yes` where this number is not 0, else `no`.
    pub(crate) fn select(self, yes: Self, no: Self) -> Self {
        match self.constant() {
            Some([x, ..]) if x != 0.0 => yes,
            Some(_) => no,
            None => {
                let width = yes.width.max(no.width);
                self.program.op(Op::Select, width, &[self, yes.to(width), no.to(width)])
            }
        }
    }

    /// A formula of one component, for each of them.
    pub(crate) fn for_each<const N: usize>(
        self,
        others: [Self; N],
        formula: impl Fn(Self, [Self; N]) -> Self,
    ) -> Self {
        let part = |x: Self, i| if x.width == 1 { x } else { x.part(i) };
        let parts: Vec<Self> =
            (0..self.width).map(|i| formula(part(self, i), others.map(|other| part(other, i)))).collect();
        self.program.combine(&parts)
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $op:ident),*) => {$(
        impl<'p, T: Number<'p>> $trait<T> for Expr<'p> {
            type Output = Self;

            fn $method(self, other: T) -> Self {
                self.pair(Op::$op, other)
            }
        }

        impl<'p> $trait<Expr<'p>> for f32 {
            type Output = Expr<'p>;

            fn $method(self, other: Expr<'p>) -> Expr<'p> {
                other.program.number(self).pair(Op::$op, other)
            }
        }
    )*};
}

operators!(Add add Add, Sub sub Subtract, Mul mul Multiply, Div div Divide);
