//! The closure tree: which lobes there are, and how much of each reaches the eye.

use catseye::{AnyLobe, Model};
use catseye_materialx::{Closure, ScatterMode};
use glam::Vec3;

use super::cloth::Cloth;
use super::dielectric::Dielectric;
use super::diffuse::OrenNayar;
use super::lobe::{Lobe, LobeKind, Outgoing};
use super::metal::{Fresnel, Metal};
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
        Self::prepared(closure, model, Care::Exact)
    }

    /// Prepares what a closure is at one point of a surface that varies: quick, its shares of energy a little off.
    pub(crate) fn at_point(closure: &Closure, model: Model) -> Result<Self, Error> {
        Self::prepared(closure, model, Care::Quick)
    }

    fn prepared(closure: &Closure, model: Model, care: Care) -> Result<Self, Error> {
        let mut builder = Builder { model, care, lobes: Vec::new() };
        let root = builder.prepare(closure)?;
        let lobes = builder.lobes;
        if lobes.len() > MAX_LOBES {
            return Err(Error::TooManyLobes { found: lobes.len(), max: MAX_LOBES });
        }
        Ok(Self { lobes, root })
    }

    /// A BSDF of one retro-reflective lobe.
    #[must_use]
    pub fn from_lobe(lobe: AnyLobe<f32>) -> Self {
        Self { lobes: vec![Lobe::new(1.0, LobeKind::Retro(Box::new(lobe)))], root: Node::Lobe(0) }
    }

    /// A matte surface: Lambert's law.
    #[must_use]
    pub fn matte(color: Vec3) -> Self {
        let kind = LobeKind::Diffuse(OrenNayar::new(color, 0.0, false));
        Self { lobes: vec![Lobe::new(1.0, kind)], root: Node::Lobe(0) }
    }

    /// Whether a lobe is a Dirac distribution in the direction that the light comes from.
    pub(crate) fn has_retro_mirror(&self) -> bool {
        self.lobes.iter().any(|lobe| lobe.is_dirac() && lobe.sends_back())
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

/// How much time there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Care {
    /// Once for a material.
    Exact,
    /// Once for a point.
    Quick,
}

/// Makes a [`Bsdf`].
struct Builder {
    model: Model,
    care: Care,
    lobes: Vec<Lobe>,
}

impl Builder {
    fn prepare(&mut self, closure: &Closure) -> Result<Node, Error> {
        match closure {
            Closure::None => Ok(Node::None),
            Closure::Mix { foreground, background, amount } => {
                // What doesn't count takes no room.
                match amount.clamp(0.0, 1.0) {
                    0.0 => self.prepare(background),
                    1.0 => self.prepare(foreground),
                    amount => Ok(Node::Mix {
                        foreground: self.boxed(foreground)?,
                        background: self.boxed(background)?,
                        amount,
                    }),
                }
            }
            Closure::Layer { top, base } => {
                Ok(Node::Layer { top: self.boxed(top)?, base: self.boxed(base)? })
            }
            Closure::Add { a, b } => Ok(Node::Add { a: self.boxed(a)?, b: self.boxed(b)? }),
            Closure::Multiply { closure, factor } => {
                Ok(Node::Multiply { closure: self.boxed(closure)?, factor: Vec3::from(*factor) })
            }
            leaf => {
                let Some(lobe) = self.lobe(leaf)? else { return Ok(Node::None) };
                self.lobes.push(lobe);
                Ok(Node::Lobe(self.lobes.len() - 1))
            }
        }
    }

    fn boxed(&mut self, closure: &Closure) -> Result<Box<Node>, Error> {
        self.prepare(closure).map(Box::new)
    }

    /// `None` for a lobe of weight 0.
    fn lobe(&self, closure: &Closure) -> Result<Option<Lobe>, Error> {
        let color = |color: &[f32; 3]| Vec3::from(*color).clamp(Vec3::ZERO, Vec3::ONE);
        let (weight, kind) = match closure {
            Closure::Oriented { closure, normal, tangent } => {
                let Some(mut lobe) = self.lobe(closure)? else { return Ok(None) };
                lobe.normal_world = normal.map(Vec3::from).and_then(Vec3::try_normalize);
                lobe.tangent_world = lobe.tangent_world.or(tangent.map(Vec3::from));
                return Ok(Some(lobe));
            }
            Closure::RetroReflective { weight, params, tangent_u } => {
                if *weight <= 0.0 {
                    return Ok(None);
                }
                let mut lobe =
                    Lobe::new(*weight, LobeKind::Retro(Box::new(AnyLobe::new(self.model, params)?)));
                lobe.tangent_world = tangent_u.map(Vec3::from);
                return Ok(Some(lobe));
            }
            Closure::OrenNayarDiffuse { weight, color, roughness, energy_compensation } => {
                let lobe = OrenNayar::new(Vec3::from(*color), *roughness, *energy_compensation);
                (weight, LobeKind::Diffuse(lobe))
            }
            Closure::BurleyDiffuse { weight, color: c, roughness } => {
                (weight, LobeKind::Cloth(Cloth::burley(color(c), *roughness)))
            }
            Closure::Translucent { weight, color: c } => {
                (weight, LobeKind::Cloth(Cloth::translucent(color(c))))
            }
            Closure::Sheen { weight, color: c, roughness } => {
                (weight, LobeKind::Cloth(Cloth::sheen(color(c), *roughness)))
            }
            Closure::Dielectric { weight, tint, ior, roughness, scatter_mode, .. } => (
                weight,
                LobeKind::Dielectric(self.dielectric(Vec3::from(*tint), *ior, *roughness, *scatter_mode)),
            ),
            Closure::Conductor { weight, ior, extinction, roughness, .. } => {
                let fresnel = Fresnel::Conductor { n: Vec3::from(*ior), k: Vec3::from(*extinction) };
                (weight, LobeKind::Metal(Metal::new(fresnel, *roughness)))
            }
            Closure::GeneralizedSchlick {
                weight,
                color0,
                color82,
                color90,
                exponent,
                roughness,
                scatter_mode,
                ..
            } => {
                let kind = if *scatter_mode == ScatterMode::Reflect {
                    let [at_0, at_82, at_90] = [color0, color82, color90].map(color);
                    let fresnel = Fresnel::Schlick { at_0, at_82, at_90, exponent: exponent.max(0.0) };
                    LobeKind::Metal(Metal::new(fresnel, *roughness))
                } else {
                    // Refraction needs an index: that of a dielectric which reflects as much head on.
                    let root = (color(color0).element_sum() / 3.0).min(0.99).sqrt();
                    let ior = (1.0 + root) / (1.0 - root);
                    LobeKind::Dielectric(self.dielectric(Vec3::ONE, ior, *roughness, *scatter_mode))
                };
                (weight, kind)
            }
            // Combinations of lobes have no lobe: MaterialX gives them no normal either.
            _ => return Ok(None),
        };
        if *weight <= 0.0 {
            return Ok(None);
        }
        let mut lobe = Lobe::new(*weight, kind);
        lobe.retroreflective = matches!(
            closure,
            Closure::Dielectric { retroreflective: true, .. }
                | Closure::Conductor { retroreflective: true, .. }
                | Closure::GeneralizedSchlick { retroreflective: true, .. }
        );
        Ok(Some(lobe))
    }

    fn dielectric(&self, tint: Vec3, ior: f32, roughness: [f32; 2], mode: ScatterMode) -> Dielectric {
        match self.care {
            Care::Exact => Dielectric::new(tint, ior, roughness, mode),
            Care::Quick => Dielectric::varying(tint, ior, roughness, mode),
        }
    }
}
