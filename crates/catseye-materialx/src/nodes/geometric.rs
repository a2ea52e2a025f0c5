//! What the geometry gives. Space and time have one frame here, but for positions.

use super::{
    FLOAT, FLOAT_AND_COLORS, Inputs, NodeDef, VALUES, VECTOR2, VECTOR3, formula,
    port::{Port, flag, float, geometry, integer, same, text, word},
};
use crate::program::{Expr, Geometry};

const SPACE: Port = word("space", &["object", "model", "world"]);

fn own<'p>(n: &Inputs<'p>, geometry: Geometry) -> Expr<'p> {
    n.program.geometry(geometry)
}

pub(super) static NODES: &[NodeDef] = &[
    formula("texcoord", VECTOR2, &[integer("index", 0.0)], |n| own(n, Geometry::Texcoord)),
    formula("texcoord", VECTOR3, &[integer("index", 0.0)], |n| own(n, Geometry::Texcoord).resize(3)),
    formula("position", VECTOR3, &[SPACE], |n| {
        let geometry = if n.text("space") == "world" { Geometry::Position } else { Geometry::PositionObject };
        own(n, geometry)
    }),
    formula("normal", VECTOR3, &[SPACE], |n| own(n, Geometry::Normal)),
    formula("tangent", VECTOR3, &[SPACE, integer("index", 0.0)], |n| own(n, Geometry::Tangent)),
    formula("bitangent", VECTOR3, &[SPACE, integer("index", 0.0)], |n| own(n, Geometry::Bitangent)),
    formula("viewdirection", VECTOR3, &[word("space", &["world", "model", "object"])], |n| {
        own(n, Geometry::View)
    }),
    // No geometry has colours or properties of its own.
    formula("geomcolor", FLOAT_AND_COLORS, &[integer("index", 0.0)], |n| n.program.number(1.0)),
    formula("geompropvalue", VALUES, &[text("geomprop"), same("default", 0.0)], |n| {
        let [default] = n.all();
        default
    }),
    formula("time", FLOAT, &[float("fps", 24.0)], |n| n.program.number(0.0)),
    formula("frame", FLOAT, &[], |n| n.program.number(0.0)),
    formula(
        "facingratio",
        FLOAT,
        &[
            geometry("viewdirection", Geometry::View),
            geometry("normal", Geometry::Normal),
            flag("faceforward", true),
            flag("invert", false),
        ],
        |n| {
            let [view, normal, forward, invert] = n.all();
            let cos = view.dot(normal);
            let facing = forward.select(cos.abs(), cos * -1.0);
            invert.select(1.0 - facing, facing)
        },
    ),
];
