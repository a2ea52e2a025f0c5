//! The closure tree: which lobes there are, and how much of each reaches the eye.

use catseye::{AnyLobe, Model};
use catseye_materialx::{Closure, ScatterMode};
use glam::Vec3;

use super::dielectric::{Albedo, Dielectric};
use super::diffuse::Diffuse;
use super::fresnel::Fresnel;
use super::lobe::{Lobe, LobeKind, Outgoing};
use super::microfacet::Microfacet;
use super::oren_nayar::OrenNayar;
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
        Self::with_albedo(closure, model, Albedo::Exact)
    }

    /// As [`Bsdf::with_model`], the lobes' shares of energy exact or cached.
    pub(crate) fn with_albedo(closure: &Closure, model: Model, albedo: Albedo) -> Result<Self, Error> {
        let mut builder = Builder { model, albedo, lobes: Vec::new() };
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
        let kind = LobeKind::Diffuse(Diffuse::OrenNayar(OrenNayar::new(color, 0.0, false)));
        Self { lobes: vec![Lobe::new(1.0, kind)], root: Node::Lobe(0) }
    }

    /// Whether a lobe is a Dirac distribution in the direction that the light comes from.
    pub(crate) fn has_retro_mirror(&self) -> bool {
        self.lobes.iter().any(|lobe| lobe.is_dirac() && lobe.is_retroreflective())
    }

    /// Factors of the lobes' BSDFs, for a direction given in each lobe's own frame.
    pub(crate) fn shares(&self, out: &[Outgoing; MAX_LOBES]) -> [Vec3; MAX_LOBES] {
        let mut shares = [Vec3::ZERO; MAX_LOBES];
        self.spread(&self.root, out, Vec3::ONE, &mut shares);
        shares
    }

    /// Hands `factor` down the tree; returns the share of energy that passes the closure (MaterialX's
    /// `throughput`).
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

/// Makes a [`Bsdf`].
struct Builder {
    model: Model,
    albedo: Albedo,
    lobes: Vec<Lobe>,
}

impl Builder {
    fn prepare(&mut self, closure: &Closure) -> Result<Node, Error> {
        let color = |color: &[f32; 3]| Vec3::from(*color).clamp(Vec3::ZERO, Vec3::ONE);
        Ok(match closure {
            Closure::None => Node::None,
            Closure::Mix { foreground, background, amount } => match amount.clamp(0.0, 1.0) {
                // What doesn't count takes no room.
                0.0 => self.prepare(background)?,
                1.0 => self.prepare(foreground)?,
                amount => Node::Mix {
                    foreground: self.boxed(foreground)?,
                    background: self.boxed(background)?,
                    amount,
                },
            },
            Closure::Layer { top, base } => Node::Layer { top: self.boxed(top)?, base: self.boxed(base)? },
            Closure::Add { a, b } => Node::Add { a: self.boxed(a)?, b: self.boxed(b)? },
            Closure::Multiply { closure, factor } => {
                Node::Multiply { closure: self.boxed(closure)?, factor: Vec3::from(*factor) }
            }
            Closure::Oriented { closure, normal, tangent } => {
                let first = self.lobes.len();
                let node = self.prepare(closure)?;
                for lobe in &mut self.lobes[first..] {
                    let normal = normal.map(Vec3::from).and_then(Vec3::try_normalize);
                    lobe.normal_world = lobe.normal_world.or(normal);
                    lobe.tangent_world = lobe.tangent_world.or(tangent.map(Vec3::from));
                }
                node
            }
            Closure::RetroReflective { weight, .. } if *weight <= 0.0 => Node::None,
            Closure::RetroReflective { weight, params } => {
                let kind = LobeKind::Retro(Box::new(AnyLobe::new(self.model, params)?));
                self.leaf(Lobe::new(*weight, kind))
            }
            Closure::OrenNayarDiffuse { weight, color, roughness, energy_compensation } => {
                let lobe = OrenNayar::new(Vec3::from(*color), *roughness, *energy_compensation);
                self.diffuse(*weight, Diffuse::OrenNayar(lobe))
            }
            Closure::BurleyDiffuse { weight, color: c, roughness } => {
                self.diffuse(*weight, Diffuse::burley(color(c), *roughness))
            }
            Closure::Translucent { weight, color: c } => {
                self.diffuse(*weight, Diffuse::Translucent { color: color(c) })
            }
            Closure::Sheen { weight, color: c, roughness } => {
                self.diffuse(*weight, Diffuse::sheen(color(c), *roughness))
            }
            Closure::Dielectric { weight, tint, ior, roughness, retroreflective, scatter_mode } => {
                let kind = self.dielectric(Vec3::from(*tint), *ior, *roughness, *scatter_mode);
                self.leaf(Lobe { retroreflective: *retroreflective, ..Lobe::new(*weight, kind) })
            }
            Closure::Conductor { weight, ior, extinction, roughness, retroreflective } => {
                let fresnel = Fresnel::Conductor { n: Vec3::from(*ior), k: Vec3::from(*extinction) };
                let kind = LobeKind::Microfacet(Microfacet::new(fresnel, *roughness));
                self.leaf(Lobe { retroreflective: *retroreflective, ..Lobe::new(*weight, kind) })
            }
            Closure::GeneralizedSchlick {
                weight,
                color0,
                color82,
                color90,
                exponent,
                roughness,
                retroreflective,
                scatter_mode,
            } => {
                let kind = if *scatter_mode == ScatterMode::Reflect {
                    let [at_0, at_82, at_90] = [color0, color82, color90].map(color);
                    let fresnel = Fresnel::Schlick { at_0, at_82, at_90, exponent: exponent.max(0.0) };
                    LobeKind::Microfacet(Microfacet::new(fresnel, *roughness))
                } else {
                    // Refraction needs an index: that of a dielectric which reflects as much head on.
                    let root = (color(color0).element_sum() / 3.0).min(0.99).sqrt();
                    self.dielectric(Vec3::ONE, (1.0 + root) / (1.0 - root), *roughness, *scatter_mode)
                };
                self.leaf(Lobe { retroreflective: *retroreflective, ..Lobe::new(*weight, kind) })
            }
            // Those that the reader learns later. The test `every_bsdf_of_the_reader_is_rendered` meets them.
            other => return Err(Error::UnknownClosure { closure: format!("{other:?}") }),
        })
    }

    fn boxed(&mut self, closure: &Closure) -> Result<Box<Node>, Error> {
        self.prepare(closure).map(Box::new)
    }

    /// A lobe of weight 0 takes no room.
    fn leaf(&mut self, lobe: Lobe) -> Node {
        if lobe.weight <= 0.0 {
            return Node::None;
        }
        self.lobes.push(lobe);
        Node::Lobe(self.lobes.len() - 1)
    }

    fn diffuse(&mut self, weight: f32, lobe: Diffuse) -> Node {
        self.leaf(Lobe::new(weight, LobeKind::Diffuse(lobe)))
    }

    fn dielectric(&self, tint: Vec3, ior: f32, roughness: [f32; 2], mode: ScatterMode) -> LobeKind {
        LobeKind::Dielectric(Dielectric::new(tint, ior, roughness, mode, self.albedo))
    }
}
