//! Components of colours and vectors.

use super::{
    BOOLEAN, COLOR3, COLOR4, FLOAT, FLOATS, INTEGER, Inputs, Meaning, NodeDef, SEVERAL, VALUES, VECTOR2,
    VECTOR3, VECTOR4, formula,
    port::{Accepts, Port, color, float, integer, of, same, text, vector2, vector3},
};
use crate::{program::Expr, value::Type};

const COLOR3_VECTOR3: &[Type] = &[Type::Color3, Type::Vector3];
const COLOR4_VECTOR4: &[Type] = &[Type::Color4, Type::Vector4];
const WITH_COMPONENTS: &[Type] = &[Type::Color3, Type::Color4, Type::Vector2, Type::Vector3, Type::Vector4];

const fn separate(
    category: &'static str,
    inputs: &'static [Port],
    outputs: &'static [(&'static str, Type)],
) -> NodeDef {
    NodeDef { category, types: SEVERAL, inputs, outputs, meaning: Meaning::Formulas(separated) }
}

/// The components, first under the names of colours, then under those of vectors.
fn separated<'p>(n: &Inputs<'p>) -> Vec<Expr<'p>> {
    let [x] = n.all();
    (0..x.width()).map(|i| x.part(i)).cycle().take(2 * usize::from(x.width())).collect()
}

fn combined<'p>(n: &Inputs<'p>) -> Expr<'p> {
    let parts: Vec<Expr<'p>> = n.numbers().flat_map(|x| (0..x.width()).map(move |i| x.part(i))).collect();
    n.program.combine(&parts)
}

/// One number becomes all components; a fourth one that is missing becomes 1, as alpha is; else components
/// are dropped or 0.
fn converted<'p>(n: &Inputs<'p>) -> Expr<'p> {
    let [x] = n.all();
    match (x.width(), n.ty) {
        (1, Type::Boolean) => 1.0 - x.equal(0.0),
        (1, _) => x.to(n.width()),
        (2 | 3, Type::Color4 | Type::Vector4) => {
            n.program.combine(&[x.part(0), x.part(1), x.part(2), n.program.number(1.0)])
        }
        _ => x.resize(n.width()),
    }
}

/// What is converted to each type: all others.
const WITHOUT_COLOR3: &[Type] = &without(Type::Color3);
const WITHOUT_COLOR4: &[Type] = &without(Type::Color4);
const WITHOUT_VECTOR2: &[Type] = &without(Type::Vector2);
const WITHOUT_VECTOR3: &[Type] = &without(Type::Vector3);
const WITHOUT_VECTOR4: &[Type] = &without(Type::Vector4);

const fn without(ty: Type) -> [Type; VALUES.len() - 1] {
    let mut rest = [Type::Float; VALUES.len() - 1];
    let (mut from, mut to) = (0, 0);
    while from < VALUES.len() {
        if VALUES[from] as u8 != ty as u8 {
            rest[to] = VALUES[from];
            to += 1;
        }
        from += 1;
    }
    rest
}

pub(super) static NODES: &[NodeDef] = &[
    formula("convert", BOOLEAN, &[of("in", &[Type::Integer], 0.0)], converted),
    formula("convert", INTEGER, &[of("in", &[Type::Boolean], 0.0)], converted),
    formula("convert", FLOAT, &[of("in", &[Type::Integer, Type::Boolean], 0.0)], converted),
    formula("convert", COLOR3, &[of("in", WITHOUT_COLOR3, 0.0)], converted),
    formula("convert", COLOR4, &[of("in", WITHOUT_COLOR4, 0.0)], converted),
    formula("convert", VECTOR2, &[of("in", WITHOUT_VECTOR2, 0.0)], converted),
    formula("convert", VECTOR3, &[of("in", WITHOUT_VECTOR3, 0.0)], converted),
    formula("convert", VECTOR4, &[of("in", WITHOUT_VECTOR4, 0.0)], converted),
    // MaterialX 1.38.
    formula(
        "swizzle",
        FLOATS,
        &[of("in", FLOATS, 0.0), text("channels").accepting(Accepts::Channels)],
        |n| {
            let [x] = n.all();
            let part = |channel| match channel {
                'r' | 'x' => x.part(0),
                'g' | 'y' => x.part(1),
                'b' | 'z' => x.part(2),
                'a' | 'w' => x.part(3),
                '1' => n.program.number(1.0),
                _ => n.program.number(0.0),
            };
            n.program.combine(&n.text("channels").chars().map(part).collect::<Vec<_>>())
        },
    ),
    formula(
        "extract",
        FLOAT,
        &[of("in", WITH_COMPONENTS, 0.0), integer("index", 0.0).accepting(Accepts::Integers(0, 3))],
        |n| {
            let [x] = n.all();
            x.part(n.integer("index") as u8)
        },
    ),
    formula("combine2", VECTOR2, &[float("in1", 0.0), float("in2", 0.0)], combined),
    formula("combine2", COLOR4, &[color("in1", 0.0), float("in2", 0.0)], combined),
    formula("combine2", VECTOR4, &[vector3("in1", 0.0), float("in2", 0.0)], combined),
    formula("combine2", VECTOR4, &[vector2("in1", 0.0), vector2("in2", 0.0)], combined),
    formula("combine3", COLOR3_VECTOR3, &[float("in1", 0.0), float("in2", 0.0), float("in3", 0.0)], combined),
    formula(
        "combine4",
        COLOR4_VECTOR4,
        &[float("in1", 0.0), float("in2", 0.0), float("in3", 0.0), float("in4", 0.0)],
        combined,
    ),
    separate("separate2", &[vector2("in", 0.0)], &[("outx", Type::Float), ("outy", Type::Float)]),
    separate(
        "separate3",
        &[of("in", COLOR3_VECTOR3, 0.0)],
        &[
            ("outr", Type::Float),
            ("outg", Type::Float),
            ("outb", Type::Float),
            ("outx", Type::Float),
            ("outy", Type::Float),
            ("outz", Type::Float),
        ],
    ),
    separate(
        "separate4",
        &[of("in", COLOR4_VECTOR4, 0.0)],
        &[
            ("outr", Type::Float),
            ("outg", Type::Float),
            ("outb", Type::Float),
            ("outa", Type::Float),
            ("outx", Type::Float),
            ("outy", Type::Float),
            ("outz", Type::Float),
            ("outw", Type::Float),
        ],
    ),
    formula("dot", VALUES, &[same("in", 0.0), text("note")], |n| {
        let [x] = n.all();
        x
    }),
];
