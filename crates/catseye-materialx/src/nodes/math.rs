//! Arithmetic on each component.

use super::{
    FLOAT, FLOATS, INTEGER, NUMBERS, NodeDef, formula, operation,
    port::{Port, float, same, same_or_float},
};
use crate::program::{Expr, Op};

const UNARY: &[Port] = &[same("in", 0.0)];
const SUM: &[Port] = &[same("in1", 0.0), same_or_float("in2", 0.0)];
const PRODUCT: &[Port] = &[same("in1", 0.0), same_or_float("in2", 1.0)];
/// From floats to integers.
const WHOLE: &[Port] = &[float("in", 0.0)];

/// From one range to another.
pub(super) fn remap<'p>(x: Expr<'p>, from: [Expr<'p>; 2], to: [Expr<'p>; 2]) -> Expr<'p> {
    to[0] + (x - from[0]) * (to[1] - to[0]) / (from[1] - from[0])
}

pub(super) static NODES: &[NodeDef] = &[
    operation("add", NUMBERS, SUM, Op::Add),
    operation("subtract", NUMBERS, SUM, Op::Subtract),
    operation("multiply", NUMBERS, PRODUCT, Op::Multiply),
    operation("divide", NUMBERS, PRODUCT, Op::Divide),
    operation("modulo", NUMBERS, PRODUCT, Op::Modulo),
    operation("power", NUMBERS, PRODUCT, Op::Power),
    formula("safepower", NUMBERS, PRODUCT, |n| {
        let [x, exponent] = n.all();
        x.sign() * x.abs().power(exponent)
    }),
    operation("min", NUMBERS, SUM, Op::Min),
    operation("max", NUMBERS, SUM, Op::Max),
    operation("absval", NUMBERS, UNARY, Op::Abs),
    operation("sign", NUMBERS, UNARY, Op::Sign),
    operation("floor", FLOATS, UNARY, Op::Floor),
    operation("floor", INTEGER, WHOLE, Op::Floor),
    operation("ceil", FLOATS, UNARY, Op::Ceil),
    operation("ceil", INTEGER, WHOLE, Op::Ceil),
    operation("round", FLOATS, UNARY, Op::Round),
    operation("round", INTEGER, WHOLE, Op::Round),
    operation("fract", NUMBERS, UNARY, Op::Fract),
    operation("sqrt", NUMBERS, UNARY, Op::Sqrt),
    operation("sin", NUMBERS, UNARY, Op::Sin),
    operation("cos", NUMBERS, UNARY, Op::Cos),
    operation("tan", NUMBERS, UNARY, Op::Tan),
    operation("asin", NUMBERS, UNARY, Op::Asin),
    operation("acos", NUMBERS, UNARY, Op::Acos),
    operation("atan2", NUMBERS, &[same("iny", 0.0), same_or_float("inx", 1.0)], Op::Atan2),
    operation("ln", NUMBERS, &[same("in", 1.0)], Op::Ln),
    operation("exp", NUMBERS, UNARY, Op::Exp),
    formula("trianglewave", FLOAT, &[float("in", 0.0)], |n| {
        let [x] = n.all();
        0.5 - (x.abs().modulo(1.0) - 0.5).abs()
    }),
    formula("invert", NUMBERS, &[same("in", 0.0), same_or_float("amount", 1.0)], |n| {
        let [x, amount] = n.all();
        amount - x
    }),
    formula(
        "clamp",
        NUMBERS,
        &[same("in", 0.0), same_or_float("low", 0.0), same_or_float("high", 1.0)],
        |n| {
            let [x, low, high] = n.all();
            x.clamp(low, high)
        },
    ),
    operation(
        "smoothstep",
        NUMBERS,
        &[same("in", 0.0), same_or_float("low", 0.0), same_or_float("high", 1.0)],
        Op::Smoothstep,
    ),
    formula(
        "remap",
        NUMBERS,
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
        NUMBERS,
        &[same("in", 0.0), same_or_float("amount", 1.0), same_or_float("pivot", 0.5)],
        |n| {
            let [x, amount, pivot] = n.all();
            (x - pivot) * amount + pivot
        },
    ),
];
