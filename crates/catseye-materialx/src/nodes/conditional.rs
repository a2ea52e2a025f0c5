//! Choices and logic.

use super::{
    BOOLEAN, FLOATS, Inputs, NUMBERS, NodeDef, formula,
    port::{Port, flag, of, same},
};
use crate::{program::Expr, value::Type};

const COMPARABLE: &[Type] = &[Type::Float, Type::Integer];
const EQUATABLE: &[Type] = &[Type::Float, Type::Integer, Type::Boolean];

const IF: &[Port] =
    &[of("value1", COMPARABLE, 1.0), of("value2", COMPARABLE, 0.0), same("in1", 0.0), same("in2", 0.0)];
const IF_EQUAL: &[Port] =
    &[of("value1", EQUATABLE, 0.0), of("value2", EQUATABLE, 0.0), same("in1", 0.0), same("in2", 0.0)];
/// The comparison itself.
const COMPARE: &[Port] = &[of("value1", COMPARABLE, 1.0), of("value2", COMPARABLE, 0.0)];
const EQUATE: &[Port] = &[flag("value1", false), flag("value2", false)];
const LOGIC: &[Port] = &[flag("in1", false), flag("in2", false)];

fn choose<'p>(n: &Inputs<'p>, condition: impl Fn(Expr<'p>, Expr<'p>) -> Expr<'p>) -> Expr<'p> {
    let [a, b, yes, no] = n.all();
    condition(a, b).select(yes, no)
}

fn compare<'p>(n: &Inputs<'p>, condition: impl Fn(Expr<'p>, Expr<'p>) -> Expr<'p>) -> Expr<'p> {
    let [a, b] = n.all();
    condition(a, b)
}

pub(super) static NODES: &[NodeDef] = &[
    formula("ifgreater", NUMBERS, IF, |n| choose(n, |a, b| a.greater(b))),
    formula("ifgreater", BOOLEAN, COMPARE, |n| compare(n, |a, b| a.greater(b))),
    formula("ifgreatereq", NUMBERS, IF, |n| choose(n, |a, b| a.greater_or_equal(b))),
    formula("ifgreatereq", BOOLEAN, COMPARE, |n| compare(n, |a, b| a.greater_or_equal(b))),
    formula("ifequal", NUMBERS, IF_EQUAL, |n| choose(n, |a, b| a.equal(b))),
    formula("ifequal", BOOLEAN, COMPARE, |n| compare(n, |a, b| a.equal(b))),
    formula("ifequal", BOOLEAN, EQUATE, |n| compare(n, |a, b| a.equal(b))),
    formula(
        "switch",
        FLOATS,
        &[
            same("in1", 0.0),
            same("in2", 0.0),
            same("in3", 0.0),
            same("in4", 0.0),
            same("in5", 0.0),
            same("in6", 0.0),
            same("in7", 0.0),
            same("in8", 0.0),
            same("in9", 0.0),
            same("in10", 0.0),
            of("which", COMPARABLE, 0.0),
        ],
        |n| {
            let [options @ .., which]: [Expr<'_>; 11] = n.all();
            let nothing = n.program.number(0.0).to(n.width());
            (1..11_u8).zip(options).rev().fold(nothing, |rest, (i, option)| {
                n.program.number(f32::from(i)).greater(which).select(option, rest)
            })
        },
    ),
    formula("and", BOOLEAN, LOGIC, |n| compare(n, |a, b| a.min(b))),
    formula("or", BOOLEAN, LOGIC, |n| compare(n, |a, b| a.max(b))),
    formula("xor", BOOLEAN, LOGIC, |n| compare(n, |a, b| (a - b).abs())),
    formula("not", BOOLEAN, &[flag("in", false)], |n| {
        let [x] = n.all();
        1.0 - x
    }),
];
