//! The closure tree: which lobes there are, and how much of each reaches the eye.

use catseye::{AnyLobe, Model};
use catseye_materialx::Closure;
use glam::Vec3;

use super::dielectric::Dielectric;
use super::diffuse::OrenNayar;
use super::lobe::{Lobe, LobeKind, Outgoing};
use crate::Error;

/// Lobes that one material may have: room is kept on the stack of every shading point.
pub(crate) const MAX_LOBES: usize = 16;

/// A surface's BSDF: a MaterialX closure with its lobes prepared. Made once, used from any thread.
#[derive(Clone, Debug)]
pub struct Bsdf {
    pub(crate) lobes: Vec<Lobe>,
    root: Node,
}

#[derive(Clone, Debug)]
enum Node {
    None,
    Lobe(usize),
    Mix { foreground: Box<Node>, background: Box<Node>, amount: f32 },
    Layer { top: Box<Node>, base: Box<Node> },
    Add { a: Box<Node>, b: Box<Node> },
    Multiply { closure: Box<Node>, factor: Vec3 },
}

impl Bsdf {
    /// Prepares a closure.
    ///
    /// # Errors
    /// A parameter out of its range, or more lobes than a shading point has room for.
    pub fn new(closure: &Closure) -> Result<Self, Error> {
        Self::with_model(closure, Model::default())
    }

    /// Prepares a closure with another lobe in the place of every retro-reflective one.
    ///
    /// # Errors
    /// As [`Bsdf::new`].
    pub fn with_model(closure: &Closure, model: Model) -> Result<Self, Error> {
        let mut lobes = Vec::new();
        let root = prepare(closure, model, &mut lobes)?;
        if lobes.len() > MAX_LOBES {
            return Err(Error::TooManyLobes { found: lobes.len(), max: MAX_LOBES });
        }
        Ok(Self { lobes, root })
    }

    /// A BSDF of one retro-reflective lobe.
    #[must_use]
    pub fn from_lobe(lobe: AnyLobe<f32>) -> Self {
        let kind = LobeKind::Retro { lobe: Box::new(lobe), tangent_world: None };
        Self { lobes: vec![Lobe { weight: 1.0, kind }], root: Node::Lobe(0) }
    }

    /// A matte surface: Lambert's law.
    #[must_use]
    pub fn matte(color: Vec3) -> Self {
        let kind = LobeKind::Diffuse(OrenNayar::new(color, 0.0, false));
        Self { lobes: vec![Lobe { weight: 1.0, kind }], root: Node::Lobe(0) }
    }

    /// Factors of the lobes' BSDFs, for a direction given in each lobe's own frame.
    pub(crate) fn shares(&self, out: &[Outgoing; MAX_LOBES]) -> [Vec3; MAX_LOBES] {
        let mut shares = [Vec3::ZERO; MAX_LOBES];
        self.spread(&self.root, out, Vec3::ONE, &mut shares);
        shares
    }

    /// Hands `factor` down the tree; returns the share of energy that passes the closure (MaterialX's `throughput`).
    fn spread(
        &self,
        node: &Node,
        out: &[Outgoing; MAX_LOBES],
        factor: Vec3,
        shares: &mut [Vec3; MAX_LOBES],
    ) -> Vec3 {
        match node {
            Node::None => Vec3::ONE,
            Node::Lobe(i) => {
                let lobe = &self.lobes[*i];
                shares[*i] = factor * lobe.weight;
                // Nothing asks for what passes a tree of a single lobe.
                if self.lobes.len() > 1 { lobe.throughput(out[*i]) } else { Vec3::ZERO }
            }
            Node::Mix { foreground, background, amount } => {
                let f = self.spread(foreground, out, factor * *amount, shares);
                let b = self.spread(background, out, factor * (1.0 - *amount), shares);
                b.lerp(f, *amount)
            }
            Node::Layer { top, base } => {
                let passed = self.spread(top, out, factor, shares);
                passed * self.spread(base, out, factor * passed, shares)
            }
            Node::Add { a, b } => {
                let passed = self.spread(a, out, factor, shares) + self.spread(b, out, factor, shares);
                (passed - Vec3::ONE).max(Vec3::ZERO)
            }
            Node::Multiply { closure, factor: own } => self.spread(closure, out, factor * *own, shares),
        }
    }
}

fn prepare(closure: &Closure, model: Model, lobes: &mut Vec<Lobe>) -> Result<Node, Error> {
    let mut child = |closure: &Closure| prepare(closure, model, lobes).map(Box::new);
    let (weight, kind) = match closure {
        Closure::None => return Ok(Node::None),
        Closure::Mix { foreground, background, amount } => {
            let (foreground, background) = (child(foreground)?, child(background)?);
            return Ok(Node::Mix { foreground, background, amount: amount.clamp(0.0, 1.0) });
        }
        Closure::Layer { top, base } => return Ok(Node::Layer { top: child(top)?, base: child(base)? }),
        Closure::Add { a, b } => return Ok(Node::Add { a: child(a)?, b: child(b)? }),
        Closure::Multiply { closure, factor } => {
            return Ok(Node::Multiply { closure: child(closure)?, factor: Vec3::from(*factor) });
        }
        Closure::RetroReflective { weight, params, tangent_u } => {
            let lobe = Box::new(AnyLobe::new(model, params)?);
            (weight, LobeKind::Retro { lobe, tangent_world: tangent_u.map(Vec3::from) })
        }
        Closure::OrenNayarDiffuse { weight, color, roughness, energy_compensation } => {
            let lobe = OrenNayar::new(Vec3::from(*color), *roughness, *energy_compensation);
            (weight, LobeKind::Diffuse(lobe))
        }
        Closure::Dielectric { weight, tint, ior, roughness, scatter_mode } => {
            let lobe = Dielectric::new(Vec3::from(*tint), *ior, *roughness, *scatter_mode);
            (weight, LobeKind::Dielectric(lobe))
        }
    };
    lobes.push(Lobe { weight: weight.clamp(0.0, 1.0), kind });
    Ok(Node::Lobe(lobes.len() - 1))
}
