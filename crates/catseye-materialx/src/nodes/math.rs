//! Arithmetic on each component.

use super::{
    FLOAT, FLOAT_AND_VECTORS, FLOATS, INTEGER, NodeDef, formula, operation,
    port::{Port, float, same, same_or_float},
};
use crate::program::{Expr, Op};

const UNARY: &[Port] = &[same("in", 0.0)];
const SUM: &[Port] = &[same("in1", 0.0), same_or_float("in2", 0.0)];
const INTEGERS: &[Port] = &[same("in1", 0.0), same("in2", 0.0)];
const PRODUCT: &[Port] = &[same("in1", 0.0), same_or_float("in2", 1.0)];
/// From floats to integers.
const WHOLE: &[Port] = &[float("in", 0.0)];

/// From one range to another.
pub(super) fn remap<'p>(x: Expr<'p>, from: [Expr<'p>; 2], to: [Expr<'p>; 2]) -> Expr<'p> {
    to[0] + (x - from[0]) * (to[1] - to[0]) / (from[1] - from[0])
}

pub(super) static NODES: &[NodeDef] = &[
    operation("add", FLOATS, SUM, Op::Add),
    operation("add", INTEGER, INTEGERS, Op::Add),
    operation("subtract", FLOATS, SUM, Op::Subtract),
    operation("subtract", INTEGER, INTEGERS, Op::Subtract),
    operation("multiply", FLOATS, PRODUCT, Op::Multiply),
    operation("divide", FLOATS, PRODUCT, Op::Divide),
    operation("modulo", FLOATS, PRODUCT, Op::Modulo),
    operation("power", FLOATS, PRODUCT, Op::Power),
    formula("safepower", FLOATS, PRODUCT, |n| {
        let [x, exponent] = n.all();
        x.sign() * x.abs().power(exponent)
    }),
    operation("min", FLOATS, SUM, Op::Min),
    operation("max", FLOATS, SUM, Op::Max),
    operation("absval", FLOATS, UNARY, Op::Abs),
    operation("sign", FLOATS, UNARY, Op::Sign),
    operation("floor", FLOATS, UNARY, Op::Floor),
    operation("floor", INTEGER, WHOLE, Op::Floor),
    operation("ceil", FLOATS, UNARY, Op::Ceil),
    operation("ceil", INTEGER, WHOLE, Op::Ceil),
    operation("round", FLOATS, UNARY, Op::Round),
    operation("round", INTEGER, WHOLE, Op::Round),
    operation("fract", FLOATS, UNARY, Op::Fract),
    operation("sqrt", FLOAT_AND_VECTORS, UNARY, Op::Sqrt),
    operation("sin", FLOAT_AND_VECTORS, UNARY, Op::Sin),
    operation("cos", FLOAT_AND_VECTORS, UNARY, Op::Cos),
    operation("tan", FLOAT_AND_VECTORS, UNARY, Op::Tan),
    operation("asin", FLOAT_AND_VECTORS, UNARY, Op::Asin),
    operation("acos", FLOAT_AND_VECTORS, UNARY, Op::Acos),
    operation("atan2", FLOAT_AND_VECTORS, &[same("iny", 0.0), same("inx", 1.0)], Op::Atan2),
    operation("ln", FLOAT_AND_VECTORS, &[same("in", 1.0)], Op::Ln),
    operation("exp", FLOAT_AND_VECTORS, UNARY, Op::Exp),
    formula("trianglewave", FLOAT, &[float("in", 0.0)], |n| {
        let [x] = n.all();
        0.5 - (x.abs().modulo(1.0) - 0.5).abs()
    }),
    formula("invert", FLOATS, &[same("in", 0.0), same_or_float("amount", 1.0)], |n| {
        let [x, amount] = n.all();
        amount - x
    }),
    formula(
        "clamp",
        FLOATS,
        &[same("in", 0.0), same_or_float("low", 0.0), same_or_float("high", 1.0)],
        |n| {
            let [x, low, high] = n.all();
            x.clamp(low, high)
        },
    ),
    operation(
        "smoothstep",
        FLOATS,
        &[same("in", 0.0), same_or_float("low", 0.0), same_or_float("high", 1.0)],
        Op::Smoothstep,
    ),
    formula(
        "remap",
        FLOATS,
        &[
            same("in", 0.0),
            same_or_float("inlow", 0.0),
            same_or_float("inhigh", 1.0),
            same_or_float("outlow", 0.0),
            same_or_float("outhigh", 1.0),
        ],
        |n| {
            let [x, in_low, in_high, low, high] = n.all();
            remap(x, [in_low, in_high], [low, high])
        },
    ),
    formula(
        "contrast",
        FLOATS,
        &[same("in", 0.0), same_or_float("amount", 1.0), same_or_float("pivot", 0.5)],
        |n| {
            let [x, amount, pivot] = n.all();
            (x - pivot) * amount + pivot
        },
    ),
];
