//! Constants, ramps, noise, cells.

use super::{
    COLOR3, FLOAT, Inputs, NUMBERS, NodeDef, VALUES, formula, operation,
    port::{Accepts, Port, float, geometry, integer, of, same, texcoord, vector2},
};
use crate::{
    program::{Expr, Geometry, Op},
    value::Type,
};

/// Octaves of a fractal: what keeps it bounded.
const MAX_OCTAVES: i32 = 16;

const AMPLITUDE: Port = of("amplitude", &[Type::Float, Type::Vector2, Type::Vector3, Type::Vector4], 1.0);
const OCTAVES: Port = integer("octaves", 3.0).accepting(Accepts::Integers(0, MAX_OCTAVES));
const POSITION: Port = geometry("position", Geometry::PositionObject);
const WORLEY: &[Type] = &[Type::Float, Type::Vector2, Type::Vector3];
/// Only distances, not cells.
const STYLE: Port = integer("style", 0.0).accepting(Accepts::Integers(0, 0));

fn noise<'p>(n: &Inputs<'p>, op: Op) -> Expr<'p> {
    let [amplitude, pivot, at] = n.all();
    n.op(op, &[at]) * amplitude + pivot
}

fn fractal<'p>(n: &Inputs<'p>, op: Op) -> Expr<'p> {
    let [amplitude, _, lacunarity, diminish, mut at] = n.all();
    let (mut sum, mut share) = (n.program.number(0.0).to(n.width()), n.program.number(1.0));
    for _ in 0..n.integer("octaves") {
        sum = sum + n.op(op, &[at]) * share;
        share = share * diminish;
        at = at * lacunarity;
    }
    sum * amplitude
}

/// The range of a hash of an input and a seed.
fn random<'p>(n: &Inputs<'p>, scale: f32) -> Expr<'p> {
    let [x, low, high, seed] = n.all();
    let share = n.program.op(Op::Cell2, 1, &[n.program.combine(&[x * scale, seed])]);
    low.mix(high, share).clamp(low, high)
}

fn split<'p>(n: &Inputs<'p>, axis: u8) -> Expr<'p> {
    let [first, second, centre, uv] = n.all();
    uv.part(axis).greater_or_equal(centre).select(second, first)
}

pub(super) static NODES: &[NodeDef] = &[
    formula("constant", VALUES, &[same("value", 0.0)], |n| {
        let [x] = n.all();
        x
    }),
    formula("ramplr", NUMBERS, &[same("valuel", 0.0), same("valuer", 0.0), texcoord()], |n| {
        let [left, right, uv] = n.all();
        left.mix(right, uv.part(0).clamp(0.0, 1.0))
    }),
    formula("ramptb", NUMBERS, &[same("valuet", 0.0), same("valueb", 0.0), texcoord()], |n| {
        let [top, bottom, uv] = n.all();
        bottom.mix(top, uv.part(1).clamp(0.0, 1.0))
    }),
    formula(
        "ramp4",
        NUMBERS,
        &[same("valuetl", 0.0), same("valuetr", 0.0), same("valuebl", 0.0), same("valuebr", 0.0), texcoord()],
        |n| {
            let [top_left, top_right, bottom_left, bottom_right, uv] = n.all();
            let [u, v] = [0, 1].map(|i| uv.part(i).clamp(0.0, 1.0));
            bottom_left.mix(bottom_right, u).mix(top_left.mix(top_right, u), v)
        },
    ),
    formula(
        "splitlr",
        NUMBERS,
        &[same("valuel", 0.0), same("valuer", 0.0), float("center", 0.5), texcoord()],
        |n| split(n, 0),
    ),
    // v points up.
    formula(
        "splittb",
        NUMBERS,
        &[same("valueb", 0.0), same("valuet", 0.0), float("center", 0.5), texcoord()],
        |n| split(n, 1),
    ),
    formula("noise2d", NUMBERS, &[AMPLITUDE, float("pivot", 0.0), texcoord()], |n| noise(n, Op::Noise2)),
    formula("noise3d", NUMBERS, &[AMPLITUDE, float("pivot", 0.0), POSITION], |n| noise(n, Op::Noise3)),
    formula(
        "fractal2d",
        NUMBERS,
        &[AMPLITUDE, OCTAVES, float("lacunarity", 2.0), float("diminish", 0.5), texcoord()],
        |n| fractal(n, Op::Noise2),
    ),
    formula(
        "fractal3d",
        NUMBERS,
        &[AMPLITUDE, OCTAVES, float("lacunarity", 2.0), float("diminish", 0.5), POSITION],
        |n| fractal(n, Op::Noise3),
    ),
    operation("cellnoise2d", FLOAT, &[texcoord()], Op::Cell2),
    operation("cellnoise3d", FLOAT, &[POSITION], Op::Cell3),
    formula("worleynoise2d", WORLEY, &[texcoord(), float("jitter", 1.0), STYLE], |n| {
        let [at, jitter] = n.all();
        n.op(Op::Worley2, &[at, jitter])
    }),
    formula("worleynoise3d", WORLEY, &[POSITION, float("jitter", 1.0), STYLE], |n| {
        let [at, jitter] = n.all();
        n.op(Op::Worley3, &[at, jitter])
    }),
    formula(
        "checkerboard",
        COLOR3,
        &[
            same("color1", 1.0),
            same("color2", 0.0),
            vector2("uvtiling", 8.0),
            vector2("uvoffset", 0.0),
            texcoord(),
        ],
        |n| {
            let [first, second, tiling, offset, uv] = n.all();
            let cell = (uv * tiling - offset).floor();
            second.mix(first, (cell.part(0) + cell.part(1)).modulo(2.0))
        },
    ),
    formula(
        "randomfloat",
        FLOAT,
        &[float("in", 0.0), float("min", 0.0), float("max", 1.0), integer("seed", 0.0)],
        |n| random(n, 4096.0),
    ),
    formula(
        "randomfloat",
        FLOAT,
        &[integer("in", 0.0), float("min", 0.0), float("max", 1.0), integer("seed", 0.0)],
        |n| random(n, 1.0),
    ),
];
