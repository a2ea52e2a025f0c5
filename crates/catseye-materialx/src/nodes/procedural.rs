//! Constants, ramps, noise, cells.

use super::{
    COLOR3, FLOAT, FLOATS, Inputs, NodeDef, VALUES, formula, operation,
    port::{Accepts, Port, float, geometry, integer, same, texcoord, vector_or_float, vector2},
};
use crate::{
    program::{Expr, Geometry, Lanes, Op},
    value::Type,
};

/// Octaves of a fractal: what keeps it bounded.
const MAX_OCTAVES: i32 = 16;

const AMPLITUDE: Port = vector_or_float("amplitude", 1.0);
const OCTAVES: Port = integer("octaves", 3.0).accepting(Accepts::Integers(0, MAX_OCTAVES));
const POSITION: Port = geometry("position", Geometry::PositionObject);
const WORLEY: &[Type] = &[Type::Float, Type::Vector2, Type::Vector3];
/// Distances, or a colour for each cell.
const STYLE: Port = integer("style", 0.0).accepting(Accepts::Integers(0, 1));
/// Where MaterialX takes components from that a hash doesn't have.
const NOISE_OFFSET: [f32; 4] = [19.0, 73.0, 29.0, 0.0];
const FRACTAL_OFFSET: [f32; 4] = [19.0, 193.0, 17.0, 0.0];

/// The last component from elsewhere in the noise, where there is an offset.
fn with_last<'p>(
    n: &Inputs<'p>,
    at: Expr<'p>,
    offset: Option<Lanes>,
    noise: impl Fn(Expr<'p>, u8) -> Expr<'p>,
) -> Expr<'p> {
    let Some(offset) = offset else { return noise(at, n.width()) };
    let elsewhere = at + n.program.lanes(offset, at.width());
    let first = noise(at, n.width() - 1);
    let parts = (0..first.width()).map(|i| first.part(i)).chain([noise(elsewhere, 1)]);
    n.program.combine(&parts.collect::<Vec<_>>())
}

fn noise<'p>(n: &Inputs<'p>, op: Op) -> Expr<'p> {
    let [amplitude, pivot, at] = n.all();
    let offset = (n.width() == 4).then_some(NOISE_OFFSET);
    with_last(n, at, offset, |at, width| n.program.op(op, width, &[at])) * amplitude + pivot
}

fn fractal<'p>(n: &Inputs<'p>, op: Op) -> Expr<'p> {
    let [amplitude, _, lacunarity, diminish, at] = n.all();
    let octaves = |mut at: Expr<'p>, width| {
        let (mut sum, mut share) = (n.program.number(0.0).to(width), n.program.number(1.0));
        for _ in 0..n.integer("octaves") {
            sum = sum + n.program.op(op, width, &[at]) * share;
            share = share * diminish;
            at = at * lacunarity;
        }
        sum
    };
    let offset = matches!(n.width(), 2 | 4).then_some(FRACTAL_OFFSET);
    with_last(n, at, offset, octaves) * amplitude
}

/// Distances to the nearest feature points, or what is random for the cell of the nearest.
fn worley<'p>(n: &Inputs<'p>, [distances, nearest, cell]: [Op; 3]) -> Expr<'p> {
    let [at, jitter] = n.all();
    match n.integer("style") {
        0 => n.op(distances, &[at, jitter]),
        _ => n.op(cell, &[n.program.op(nearest, at.width(), &[at, jitter])]),
    }
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
    formula("ramplr", FLOATS, &[same("valuel", 0.0), same("valuer", 0.0), texcoord()], |n| {
        let [left, right, uv] = n.all();
        left.mix(right, uv.part(0).clamp(0.0, 1.0))
    }),
    formula("ramptb", FLOATS, &[same("valuet", 0.0), same("valueb", 0.0), texcoord()], |n| {
        let [top, bottom, uv] = n.all();
        bottom.mix(top, uv.part(1).clamp(0.0, 1.0))
    }),
    formula(
        "ramp4",
        FLOATS,
        &[same("valuetl", 0.0), same("valuetr", 0.0), same("valuebl", 0.0), same("valuebr", 0.0), texcoord()],
        |n| {
            let [top_left, top_right, bottom_left, bottom_right, uv] = n.all();
            let [u, v] = [0, 1].map(|i| uv.part(i).clamp(0.0, 1.0));
            bottom_left.mix(bottom_right, u).mix(top_left.mix(top_right, u), v)
        },
    ),
    formula(
        "splitlr",
        FLOATS,
        &[same("valuel", 0.0), same("valuer", 0.0), float("center", 0.5), texcoord()],
        |n| split(n, 0),
    ),
    // v points up.
    formula(
        "splittb",
        FLOATS,
        &[same("valueb", 0.0), same("valuet", 0.0), float("center", 0.5), texcoord()],
        |n| split(n, 1),
    ),
    formula("noise2d", FLOATS, &[AMPLITUDE, float("pivot", 0.0), texcoord()], |n| noise(n, Op::Noise2)),
    formula("noise3d", FLOATS, &[AMPLITUDE, float("pivot", 0.0), POSITION], |n| noise(n, Op::Noise3)),
    formula(
        "fractal2d",
        FLOATS,
        &[AMPLITUDE, OCTAVES, float("lacunarity", 2.0), float("diminish", 0.5), texcoord()],
        |n| fractal(n, Op::Noise2),
    ),
    formula(
        "fractal3d",
        FLOATS,
        &[AMPLITUDE, OCTAVES, float("lacunarity", 2.0), float("diminish", 0.5), POSITION],
        |n| fractal(n, Op::Noise3),
    ),
    operation("cellnoise2d", FLOAT, &[texcoord()], Op::Cell2),
    operation("cellnoise3d", FLOAT, &[POSITION], Op::Cell3),
    formula("worleynoise2d", WORLEY, &[texcoord(), float("jitter", 1.0), STYLE], |n| {
        worley(n, [Op::Worley2, Op::Nearest2, Op::Cell2])
    }),
    formula("worleynoise3d", WORLEY, &[POSITION, float("jitter", 1.0), STYLE], |n| {
        worley(n, [Op::Worley3, Op::Nearest3, Op::Cell3])
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
