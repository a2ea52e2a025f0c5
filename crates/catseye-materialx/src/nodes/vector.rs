//! Vectors: products, rotations, transformations, normal maps.

use super::{
    FLOAT, NodeDef, VECTOR, VECTOR2, VECTOR3, VECTOR4, formula, operation,
    port::{Accepts, Port, float, geometry, integer, of, same, text, valued, vector2, vector3, word},
};
use crate::{
    program::{Expr, Geometry, Op},
    value::{Type, Value},
};

const MATRIX33: Port =
    valued("mat", &[Type::Matrix33], Value::Matrix33([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]));
const MATRIX44: Port = valued(
    "mat",
    &[Type::Matrix44],
    Value::Matrix44([1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
);
const SPACES: [Port; 2] = [text("fromspace"), text("tospace")];

/// Clockwise, as MaterialX rotates: what is seen turns counter-clockwise.
fn rotate<'p>(v: Expr<'p>, degrees: Expr<'p>) -> Expr<'p> {
    let (sin, cos) = sin_cos(degrees);
    let (x, y) = (v.part(0), v.part(1));
    v.program().combine(&[cos * x + sin * y, cos * y - sin * x])
}

fn sin_cos(degrees: Expr<'_>) -> (Expr<'_>, Expr<'_>) {
    let angle = degrees * (core::f32::consts::PI / 180.0);
    (angle.sin(), angle.cos())
}

pub(super) static NODES: &[NodeDef] = &[
    operation("normalize", VECTOR, &[same("in", 0.0)], Op::Normalize),
    operation("magnitude", FLOAT, &[of("in", VECTOR, 0.0)], Op::Length),
    formula("distance", FLOAT, &[of("in1", VECTOR, 0.0), of("in2", VECTOR, 0.0)], |n| {
        let [a, b] = n.all();
        (a - b).length()
    }),
    operation("dotproduct", FLOAT, &[of("in1", VECTOR, 0.0), of("in2", VECTOR, 0.0)], Op::Dot),
    operation("crossproduct", VECTOR3, &[vector3("in1", 0.0), vector3("in2", 0.0)], Op::Cross),
    formula(
        "reflect",
        VECTOR3,
        &[valued("in", VECTOR3, Value::Vector3([1.0, 0.0, 0.0])), geometry("normal", Geometry::Normal)],
        |n| {
            let [x, normal] = n.all();
            x - normal * (normal.dot(x) * 2.0)
        },
    ),
    formula("rotate2d", VECTOR2, &[vector2("in", 0.0), float("amount", 0.0)], |n| {
        let [x, degrees] = n.all();
        rotate(x, degrees)
    }),
    // Rodrigues' formula, with the same sense.
    formula(
        "rotate3d",
        VECTOR3,
        &[vector3("in", 0.0), float("amount", 0.0), valued("axis", VECTOR3, Value::Vector3([0.0, 1.0, 0.0]))],
        |n| {
            let [v, degrees, axis] = n.all();
            let (axis, (sin, cos)) = (axis.normalize(), sin_cos(degrees));
            v * cos + v.cross(axis) * sin + axis * (axis.dot(v) * (1.0 - cos))
        },
    ),
    formula("transformmatrix", VECTOR2, &[vector2("in", 0.0), MATRIX33], transform),
    formula("transformmatrix", VECTOR3, &[vector3("in", 0.0), MATRIX33], transform),
    formula("transformmatrix", VECTOR3, &[vector3("in", 0.0), MATRIX44], transform),
    formula("transformmatrix", VECTOR4, &[same("in", 0.0), MATRIX44], transform),
    // Objects are moved here, not turned.
    formula("transformpoint", VECTOR3, &[vector3("in", 0.0), SPACES[0], SPACES[1]], |n| {
        let [x] = n.all();
        let [position, object] =
            [Geometry::Position, Geometry::PositionObject].map(|geometry| n.program.geometry(geometry));
        let [from, to] = ["fromspace", "tospace"].map(|name| n.text(name));
        match (from, to) {
            ("world", "object" | "model") => x - (position - object),
            ("object" | "model", "world") => x + (position - object),
            _ => x,
        }
    }),
    formula("transformvector", VECTOR3, &[vector3("in", 0.0), SPACES[0], SPACES[1]], |n| {
        let [x] = n.all();
        x
    }),
    formula(
        "transformnormal",
        VECTOR3,
        &[valued("in", VECTOR3, Value::Vector3([0.0, 0.0, 1.0])), SPACES[0], SPACES[1]],
        |n| {
            let [x] = n.all();
            x.normalize()
        },
    ),
    formula(
        "normalmap",
        VECTOR3,
        &[
            valued("in", VECTOR3, Value::Vector3([0.5, 0.5, 1.0])),
            of("scale", &[Type::Float, Type::Vector2], 1.0),
            geometry("normal", Geometry::Normal),
            geometry("tangent", Geometry::Tangent),
            geometry("bitangent", Geometry::Bitangent),
            // MaterialX 1.38.
            word("space", &["tangent"]),
        ],
        |n| {
            let [x, scale, normal, tangent, bitangent] = n.all();
            let up = n.program.lanes([0.0, 0.0, 1.0, 0.0], 3);
            let v = x.dot(x).equal(0.0).select(up, x * 2.0 - 1.0);
            let scale = scale.to(2);
            let along = tangent * (v.part(0) * scale.part(0)) + bitangent * (v.part(1) * scale.part(1));
            (along + normal * v.part(2)).normalize()
        },
    ),
    formula(
        "place2d",
        VECTOR2,
        &[
            vector2("texcoord", 0.0),
            vector2("pivot", 0.0),
            vector2("scale", 1.0),
            float("rotate", 0.0),
            vector2("offset", 0.0),
            integer("operationorder", 0.0).accepting(Accepts::Integers(0, 1)),
        ],
        |n| {
            let [uv, pivot, scale, degrees, offset] = n.all();
            let at = uv - pivot;
            let placed = match n.integer("operationorder") {
                0 => rotate(at / scale, degrees) - offset,
                _ => rotate(at - offset, degrees) / scale,
            };
            placed + pivot
        },
    ),
];

fn transform<'p>(n: &super::Inputs<'p>) -> Expr<'p> {
    let [v] = n.all();
    n.matrix("mat").transform(v)
}
