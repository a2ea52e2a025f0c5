//! The known nodes: one row for each, in files that are named as MaterialX's groups of nodes.
//!
//! Names, types and defaults are those of MaterialX 1.39.5 and, for `retro_reflective_bsdf`, of the proposal.

mod channel;
pub(crate) mod closures;
mod color;
mod conditional;
mod geometric;
mod inputs;
mod math;
mod pbr;
pub(crate) mod port;
mod procedural;
mod texture;
mod vector;

use std::{collections::HashMap, sync::LazyLock};

pub(crate) use inputs::{Inputs, Operand};

use crate::{
    program::{Expr, Op},
    value::Type,
};
use closures::{Combination, Edf, Lobe, Shader};
use port::Port;

/// A node definition.
#[derive(Debug)]
pub(crate) struct NodeDef {
    pub(crate) category: &'static str,
    /// The types that it exists for.
    pub(crate) types: &'static [Type],
    pub(crate) inputs: &'static [Port],
    /// Names and types of its outputs, where there are several.
    pub(crate) outputs: &'static [(&'static str, Type)],
    pub(crate) meaning: Meaning,
}

/// What a node is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Meaning {
    Lobe(Lobe),
    Combination(Combination),
    Edf(Edf),
    /// A surface or a material.
    Shader(Shader),
    /// An operation on its inputs in their order.
    Op(Op),
    /// A formula.
    Formula(for<'p> fn(&Inputs<'p>) -> Expr<'p>),
    /// A formula for each output.
    Formulas(for<'p> fn(&Inputs<'p>) -> Vec<Expr<'p>>),
}

impl NodeDef {
    pub(crate) fn input(&self, name: &str) -> Option<(usize, &'static Port)> {
        self.inputs.iter().enumerate().find(|(_, input)| input.name == name)
    }
}

/// All rows; the definitions that MaterialX takes first come first, and those of a category together.
static GROUPS: [&[NodeDef]; 10] = [
    closures::NODES,
    math::NODES,
    vector::NODES,
    color::NODES,
    conditional::NODES,
    channel::NODES,
    procedural::NODES,
    texture::NODES,
    geometric::NODES,
    pbr::NODES,
];

static BY_CATEGORY: LazyLock<HashMap<&'static str, Vec<&'static NodeDef>>> = LazyLock::new(|| {
    let mut known: HashMap<_, Vec<_>> = HashMap::new();
    for def in GROUPS.into_iter().flatten() {
        known.entry(def.category).or_default().push(def);
    }
    known
});

/// The categories of the pattern nodes that are built in; others must be defined as graphs of them.
pub fn pattern_categories() -> impl Iterator<Item = &'static str> {
    let patterns = GROUPS.into_iter().skip(1);
    patterns.flat_map(|group| group.chunk_by(|a, b| a.category == b.category)).map(|rows| rows[0].category)
}

/// The node definitions of a category; several where its inputs depend on its type.
pub(crate) fn of_category(category: &str) -> &'static [&'static NodeDef] {
    BY_CATEGORY.get(category).map_or(&[], Vec::as_slice)
}

/// Those of a category and type.
pub(crate) fn of_type(category: &str, ty: Type) -> impl Iterator<Item = &'static NodeDef> {
    of_category(category).iter().copied().filter(move |def| def.types.contains(&ty))
}

/// The categories of the BSDFs that are built in.
pub fn bsdf_categories() -> impl Iterator<Item = &'static str> {
    closures::NODES.iter().filter(|def| def.types == [Type::Bsdf]).map(|def| def.category)
}

const fn formula(
    category: &'static str,
    types: &'static [Type],
    inputs: &'static [Port],
    formula: for<'p> fn(&Inputs<'p>) -> Expr<'p>,
) -> NodeDef {
    NodeDef { category, types, inputs, outputs: &[], meaning: Meaning::Formula(formula) }
}

const fn operation(
    category: &'static str,
    types: &'static [Type],
    inputs: &'static [Port],
    op: Op,
) -> NodeDef {
    NodeDef { category, types, inputs, outputs: &[], meaning: Meaning::Op(op) }
}

const BOOLEAN: &[Type] = &[Type::Boolean];
const FLOAT: &[Type] = &[Type::Float];
const INTEGER: &[Type] = &[Type::Integer];
const VECTOR2: &[Type] = &[Type::Vector2];
const VECTOR3: &[Type] = &[Type::Vector3];
const VECTOR4: &[Type] = &[Type::Vector4];
const COLOR3: &[Type] = &[Type::Color3];
const COLOR4: &[Type] = &[Type::Color4];
const COLOR: &[Type] = &[Type::Color3, Type::Color4];
const VECTOR: &[Type] = &[Type::Vector2, Type::Vector3, Type::Vector4];
const SEVERAL: &[Type] = &[Type::MultiOutput];
/// A float, a colour or a vector.
const FLOATS: &[Type] =
    &[Type::Float, Type::Color3, Type::Color4, Type::Vector2, Type::Vector3, Type::Vector4];
const NUMBERS: &[Type] =
    &[Type::Float, Type::Color3, Type::Color4, Type::Vector2, Type::Vector3, Type::Vector4, Type::Integer];
const FLOAT_AND_COLORS: &[Type] = &[Type::Float, Type::Color3, Type::Color4];
const FLOAT_AND_VECTORS: &[Type] = &[Type::Float, Type::Vector2, Type::Vector3, Type::Vector4];
/// All that a pattern computes.
const VALUES: &[Type] = &[
    Type::Float,
    Type::Color3,
    Type::Color4,
    Type::Vector2,
    Type::Vector3,
    Type::Vector4,
    Type::Integer,
    Type::Boolean,
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Assembler;

    /// Every row computes with what it declares; a formula that asks for more is unreachable code in a
    /// document.
    #[test]
    fn rows_compute_from_their_defaults() {
        for def in GROUPS.into_iter().flatten() {
            for &ty in def.types {
                let program = Assembler::default();
                let operands =
                    def.inputs.iter().map(|port| Operand::of_default(&program, port, ty)).collect();
                let inputs = Inputs { program: &program, ty, ports: def.inputs, operands };
                let results = match def.meaning {
                    Meaning::Lobe(_) | Meaning::Combination(_) | Meaning::Edf(_) | Meaning::Shader(_) => {
                        continue;
                    }
                    // As many sources as the operation has: asserted by the program.
                    Meaning::Op(op) => vec![inputs.op(op, &inputs.numbers().collect::<Vec<_>>())],
                    // Without channels it has no components.
                    Meaning::Formula(_) if def.category == "swizzle" => continue,
                    Meaning::Formula(formula) => vec![formula(&inputs).to(ty.width())],
                    Meaning::Formulas(formulas) => formulas(&inputs),
                };
                let several = def.outputs.iter().map(|(_, ty)| ty.width());
                let widths: Vec<u8> = if several.len() == 0 { vec![ty.width()] } else { several.collect() };
                let found: Vec<u8> = results.iter().map(|result| result.width()).collect();
                assert!(found.starts_with(&widths), "{} {ty:?}: {found:?}", def.category);
            }
        }
    }
}
