//! Patterns: what inputs are where they vary over a surface.
//!
//! A [`Program`] is a list of instructions, each writing one register of four numbers from earlier ones;
//! equal instructions are stored once, and those without the geometry among their sources are computed when
//! the document is read.

mod expr;
mod noise;
mod op;
pub(crate) mod texture;

use std::{
    cell::RefCell,
    collections::{BTreeSet, HashMap},
    sync::Arc,
};

pub(crate) use expr::Expr;
pub(crate) use op::{Geometry, Op};
use texture::Texture;

/// A register's content: components beyond the value's width are 0.
pub(crate) type Lanes = [f32; 4];

/// A point of a surface, as patterns see it. Directions are unit vectors in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadingPoint {
    /// World space.
    pub position: [f32; 3],
    /// In the space that the object was modelled in.
    pub position_object: [f32; 3],
    /// On the side of the viewer.
    pub normal: [f32; 3],
    /// Along increasing u.
    pub tangent: [f32; 3],
    /// Along increasing v.
    pub bitangent: [f32; 3],
    /// v points up.
    pub texcoord: [f32; 2],
    /// From the viewer to the point.
    pub view: [f32; 3],
}

impl Default for ShadingPoint {
    /// The origin of a plane at z = 0, seen head on.
    fn default() -> Self {
        Self {
            position: [0.0; 3],
            position_object: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
            tangent: [1.0, 0.0, 0.0],
            bitangent: [0.0, 1.0, 0.0],
            texcoord: [0.0; 2],
            view: [0.0, 0.0, -1.0],
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Instruction {
    op: Op,
    /// Components of the result.
    width: u8,
    /// Registers; [`NONE`] where the operation has no more.
    sources: [u32; MAX_SOURCES],
}

/// No register.
const NONE: u32 = u32::MAX;
/// What an operation reads where it has no source.
const NOTHING: Lanes = [0.0; 4];

impl Instruction {
    /// The registers that it reads.
    fn registers(&self) -> impl Iterator<Item = u32> {
        self.sources.into_iter().filter(|&register| register != NONE)
    }
}

/// Compiled patterns.
#[derive(Clone, Debug, Default)]
pub(crate) struct Program {
    instructions: Vec<Instruction>,
    textures: Vec<Arc<Texture>>,
    /// Registers with the results.
    outputs: Vec<u32>,
}

/// The results of a program at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outputs<'r> {
    registers: &'r [Lanes],
    outputs: &'r [u32],
}

impl Outputs<'_> {
    pub(crate) fn get(&self, index: usize) -> Lanes {
        self.registers[self.outputs[index] as usize]
    }
}

/// Most sources of one instruction.
const MAX_SOURCES: usize = 4;

impl Program {
    /// Computes all registers.
    pub(crate) fn run<'r>(&'r self, point: &ShadingPoint, registers: &'r mut Vec<Lanes>) -> Outputs<'r> {
        registers.resize(self.instructions.len(), NOTHING);
        for (i, Instruction { op, width, sources }) in self.instructions.iter().enumerate() {
            let (before, after) = registers.split_at_mut(i);
            let lanes = sources.map(|register| before.get(register as usize).unwrap_or(&NOTHING));
            after[0] = op.apply(*width, lanes, point, &self.textures);
        }
        Outputs { registers, outputs: &self.outputs }
    }

    pub(crate) fn len(&self) -> usize {
        self.instructions.len()
    }

    /// How many results there are.
    pub(crate) fn outputs(&self) -> usize {
        self.outputs.len()
    }

    /// Bytes of all its textures.
    pub(crate) fn texture_bytes(&self) -> usize {
        self.textures.iter().map(|texture| texture.bytes()).sum()
    }
}

/// Makes a [`Program`]; its expressions share it.
#[derive(Debug, Default)]
pub(crate) struct Assembler {
    state: RefCell<State>,
}

#[derive(Debug, Default)]
struct State {
    program: Program,
    /// What registers hold that don't depend on the geometry.
    constants: Vec<Option<Lanes>>,
    known: HashMap<Instruction, u32>,
}

impl Assembler {
    pub(crate) fn len(&self) -> usize {
        self.state.borrow().program.instructions.len()
    }

    /// The register with the result of an instruction.
    fn push(&self, op: Op, width: u8, sources: &[u32]) -> u32 {
        debug_assert!(sources.len() <= MAX_SOURCES, "{op:?} has {} sources", sources.len());
        self.state.borrow_mut().push(op, width, sources)
    }

    /// What a register holds, wherever on the surface.
    fn constant(&self, register: u32) -> Option<Lanes> {
        self.state.borrow().constants[register as usize]
    }

    /// The number of a texture.
    pub(crate) fn texture(&self, texture: Arc<Texture>) -> u32 {
        let textures = &mut self.state.borrow_mut().program.textures;
        match textures.iter().position(|known| Arc::ptr_eq(known, &texture)) {
            Some(index) => index as u32,
            None => {
                textures.push(texture);
                textures.len() as u32 - 1
            }
        }
    }

    /// The program with these results.
    pub(crate) fn finish(&self, results: &[Expr<'_>]) -> Program {
        let all = &self.state.borrow().program;
        // The time this takes depends on the program alone, not on those of other materials.
        let mut live = BTreeSet::new();
        let mut next: Vec<u32> = results.iter().map(|result| result.register()).collect();
        while let Some(register) = next.pop() {
            if live.insert(register) {
                next.extend(all.instructions[register as usize].registers());
            }
        }
        let places: HashMap<u32, u32> = live.iter().copied().zip(0..).collect();
        let relocated = |register: &u32| {
            let mut instruction = all.instructions[*register as usize].clone();
            let used = instruction.sources.iter_mut().filter(|source| **source != NONE);
            used.for_each(|source| *source = places[source]);
            instruction
        };
        let instructions = live.iter().map(relocated).collect();
        let mut program = Program { instructions, textures: all.textures.clone(), outputs: Vec::new() };
        program.outputs = results.iter().map(|result| places[&result.register()]).collect();
        program
    }
}

impl State {
    fn push(&mut self, op: Op, width: u8, sources: &[u32]) -> u32 {
        let mut registers = [NONE; MAX_SOURCES];
        registers[..sources.len()].copy_from_slice(sources);
        let instruction = Instruction { op, width, sources: registers };
        if let Some(&register) = self.known.get(&instruction) {
            return register;
        }
        if !matches!(op, Op::Constant(_)) && !op.reads_geometry() {
            let constants: Option<Vec<Lanes>> =
                sources.iter().map(|&source| self.constants[source as usize]).collect();
            if let Some(constants) = constants {
                let lanes = core::array::from_fn(|i| constants.get(i).unwrap_or(&NOTHING));
                let point = ShadingPoint::default();
                let result = op.apply(width, lanes, &point, &self.program.textures);
                return self.push(Op::constant(result), width, &[]);
            }
        }
        let register = self.program.instructions.len() as u32;
        self.constants.push(match op {
            Op::Constant(bits) => Some(bits.map(f32::from_bits)),
            _ => None,
        });
        self.program.instructions.push(instruction.clone());
        self.known.insert(instruction, register);
        register
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_folded_and_equal_instructions_shared() {
        let assembler = Assembler::default();
        assert_eq!((assembler.number(2.0) + 3.0).constant(), Some([5.0, 0.0, 0.0, 0.0]));
        let uv = assembler.geometry(Geometry::Texcoord);
        let sum = uv + uv;
        assert_eq!((uv + uv).register(), sum.register());
        assert_eq!(sum.constant(), None);
        let program = assembler.finish(&[sum]);
        assert_eq!(program.instructions.len(), 2);
        let point = ShadingPoint { texcoord: [0.25, 0.5], ..ShadingPoint::default() };
        assert_eq!(program.run(&point, &mut Vec::new()).get(0), [0.5, 1.0, 0.0, 0.0]);
    }
}
