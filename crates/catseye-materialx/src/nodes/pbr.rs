//! Roughnesses and refractive indices.

use super::{
    Inputs, Meaning, NodeDef, SEVERAL, VECTOR2, formula,
    port::{color3, float, vector2},
};
use crate::{
    program::{Expr, Op},
    value::Type,
};

fn artistic_ior<'p>(n: &Inputs<'p>) -> Vec<Expr<'p>> {
    let colors: [Expr<'p>; 2] = n.all();
    [Op::ArtisticIndex, Op::ArtisticExtinction].map(|op| n.program.op(op, 3, &colors)).to_vec()
}

pub(super) static NODES: &[NodeDef] = &[
    // Alpha along and across the tangent, from Kulla and Conty's anisotropy.
    formula("roughness_anisotropy", VECTOR2, &[float("roughness", 0.0), float("anisotropy", 0.0)], |n| {
        let [roughness, anisotropy] = n.all();
        let alpha = (roughness * roughness).clamp(0.0, 1.0);
        let aspect = (1.0 - anisotropy.clamp(0.0, 0.98)).sqrt();
        n.program.combine(&[(alpha / aspect).min(1.0), alpha * aspect])
    }),
    // The second is as the first where it is negative.
    formula("roughness_dual", VECTOR2, &[vector2("roughness", 0.0)], |n| {
        let [roughness] = n.all();
        let [u, v] = [0, 1].map(|i| roughness.part(i));
        let v = v.greater_or_equal(0.0).select(v, u);
        n.program.combine(&[u * u, v * v]).clamp(0.0, 1.0)
    }),
    NodeDef {
        category: "artistic_ior",
        types: SEVERAL,
        inputs: &[color3("reflectivity", [0.944, 0.776, 0.373]), color3("edge_color", [0.998, 0.981, 0.751])],
        outputs: &[("ior", Type::Color3), ("extinction", Type::Color3)],
        meaning: Meaning::Formulas(artistic_ior),
    },
];
