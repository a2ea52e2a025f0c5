//! BSDFs: each node with the function that fills its closure in.

use catseye::Params;

use super::{
    slot::{Fill, Slot},
    surface::Builder,
};
use crate::{
    closure::Closure,
    error::Error,
    graph::{
        NodeRef,
        bind::{Node, is_built_in},
    },
    nodes::{
        Meaning,
        closures::{Combination, Lobe, as_written},
        port::Accepts,
    },
    program::{Geometry, Outputs},
    value::Type,
};

/// What fills a closure in.
fn fill(fill: impl Fn(&Outputs<'_>) -> Closure + Send + Sync + 'static) -> Fill {
    Box::new(fill)
}

/// The closure on the heap; nothing where there is none.
fn boxed(fill: Option<&Fill>, outputs: &Outputs<'_>) -> Box<Closure> {
    Box::new(fill.map_or(Closure::None, |fill| fill(outputs)))
}

impl<'a> Builder<'a> {
    /// The closure that an input is connected to; `None` where it scatters nothing.
    pub(super) fn closure(&mut self, node: &Node<'a>, input: &str) -> Result<Option<Fill>, Error> {
        node.connected(input).map_or(Ok(None), |target| self.closure_of(target))
    }

    fn closure_of(&mut self, target: NodeRef<'a>) -> Result<Option<Fill>, Error> {
        self.enter(target)?;
        let closure = if is_built_in(target.element) {
            let node = Node::bind(self.graph, target)?;
            match node.def.meaning {
                Meaning::Lobe(lobe) => self.lobe(lobe, &node)?,
                Meaning::Combination(combination) => self.combination(combination, &node)?,
                _ => return Err(Error::NoGraph { at: target.element.place() }),
            }
        } else {
            let inside = self.defined(target, None)?;
            self.closure_of(inside)?
        };
        self.leave();
        Ok(closure)
    }

    /// Whether what doesn't count may be left out: in a definition, whose author can't be told what is wrong.
    fn may_prune(&self, node: &Node<'a>) -> bool {
        !self.graph.is_in_document(node.node.scope)
    }

    fn combination(&mut self, combination: Combination, node: &Node<'a>) -> Result<Option<Fill>, Error> {
        match combination {
            Combination::Mix => self.mix(node),
            Combination::Layer => self.layer(node),
            Combination::Add => {
                let (a, b) = (self.closure(node, "in1")?, self.closure(node, "in2")?);
                Ok(Some(fill(move |r| Closure::Add { a: boxed(a.as_ref(), r), b: boxed(b.as_ref(), r) })))
            }
            Combination::Multiply => {
                let factor: Slot<3> = self.slot(node, "in2")?;
                if factor.constant() == Some([0.0; 3]) && self.may_prune(node) {
                    return Ok(None);
                }
                let closure = self.closure(node, "in1")?;
                Ok(Some(fill(move |r| Closure::Multiply {
                    closure: boxed(closure.as_ref(), r),
                    factor: factor.at(r),
                })))
            }
        }
    }

    fn mix(&mut self, node: &Node<'a>) -> Result<Option<Fill>, Error> {
        let amount = self.float(node, "mix")?;
        if self.may_prune(node) {
            match amount.constant() {
                Some([0.0]) => return self.closure(node, "bg"),
                Some([1.0]) => return self.closure(node, "fg"),
                _ => {}
            }
        }
        let (foreground, background) = (self.closure(node, "fg")?, self.closure(node, "bg")?);
        Ok(Some(fill(move |r| Closure::Mix {
            foreground: boxed(foreground.as_ref(), r),
            background: boxed(background.as_ref(), r),
            amount: amount.float(r),
        })))
    }

    fn layer(&mut self, node: &Node<'a>) -> Result<Option<Fill>, Error> {
        if node.input("base").0.ty == Type::Vdf {
            if node.connected("base").is_some() {
                self.warn(node, "base", "volumes are not rendered: the volume is ignored");
            }
            return self.closure(node, "top");
        }
        let (top, base) = (self.closure(node, "top")?, self.closure(node, "base")?);
        Ok(match (top, base) {
            (None, only) | (only, None) if self.may_prune(node) => only,
            (top, base) => Some(fill(move |r| Closure::Layer {
                top: boxed(top.as_ref(), r),
                base: boxed(base.as_ref(), r),
            })),
        })
    }

    fn lobe(&mut self, lobe: Lobe, node: &Node<'a>) -> Result<Option<Fill>, Error> {
        let weight = self.float(node, "weight")?;
        if weight.constant() == Some([0.0]) && self.may_prune(node) {
            return Ok(None);
        }
        let filled = match lobe {
            Lobe::RetroReflective => {
                let params = self.params(node)?;
                fill(move |r| Closure::RetroReflective { weight: weight.float(r), params: params(r) })
            }
            Lobe::OrenNayarDiffuse => {
                let (color, roughness) = (self.color(node, "color")?, self.float(node, "roughness")?);
                let energy_compensation = self.boolean(node, "energy_compensation")?;
                fill(move |r| Closure::OrenNayarDiffuse {
                    weight: weight.float(r),
                    color: color.at(r),
                    roughness: roughness.float(r),
                    energy_compensation,
                })
            }
            Lobe::BurleyDiffuse => {
                let (color, roughness) = (self.color(node, "color")?, self.float(node, "roughness")?);
                fill(move |r| Closure::BurleyDiffuse {
                    weight: weight.float(r),
                    color: color.at(r),
                    roughness: roughness.float(r),
                })
            }
            Lobe::Translucent => {
                let color = self.color(node, "color")?;
                fill(move |r| Closure::Translucent { weight: weight.float(r), color: color.at(r) })
            }
            Lobe::Subsurface => {
                self.warn(node, "radius", "subsurface scattering is approximated by diffuse reflection");
                let color = self.color(node, "color")?;
                fill(move |r| Closure::OrenNayarDiffuse {
                    weight: weight.float(r),
                    color: color.at(r),
                    roughness: 0.0,
                    energy_compensation: false,
                })
            }
            Lobe::Sheen => {
                if self.word(node, "mode")? == "zeltner" {
                    self.warn(node, "mode", "zeltner is approximated by conty_kulla");
                }
                let (color, roughness) = (self.color(node, "color")?, self.float(node, "roughness")?);
                fill(move |r| Closure::Sheen {
                    weight: weight.float(r),
                    color: color.at(r),
                    roughness: roughness.float(r),
                })
            }
            Lobe::Dielectric => {
                self.film(node)?;
                let (tint, ior) = (self.color(node, "tint")?, self.float(node, "ior")?);
                let roughness = self.slot(node, "roughness")?;
                let retroreflective = self.boolean(node, "retroreflective")?;
                let scatter_mode = self.scatter_mode(node)?;
                fill(move |r| Closure::Dielectric {
                    weight: weight.float(r),
                    tint: tint.at(r),
                    ior: ior.float(r),
                    roughness: roughness.at(r),
                    retroreflective,
                    scatter_mode,
                })
            }
            Lobe::Conductor => {
                self.film(node)?;
                let (ior, extinction) = (self.color(node, "ior")?, self.color(node, "extinction")?);
                let roughness = self.slot(node, "roughness")?;
                let retroreflective = self.boolean(node, "retroreflective")?;
                fill(move |r| Closure::Conductor {
                    weight: weight.float(r),
                    ior: ior.at(r),
                    extinction: extinction.at(r),
                    roughness: roughness.at(r),
                    retroreflective,
                })
            }
            Lobe::GeneralizedSchlick => {
                self.film(node)?;
                let (color0, color82) = (self.color(node, "color0")?, self.color(node, "color82")?);
                let (color90, exponent) = (self.color(node, "color90")?, self.float(node, "exponent")?);
                let roughness = self.slot(node, "roughness")?;
                let retroreflective = self.boolean(node, "retroreflective")?;
                let scatter_mode = self.scatter_mode(node)?;
                fill(move |r| Closure::GeneralizedSchlick {
                    weight: weight.float(r),
                    color0: color0.at(r),
                    color82: color82.at(r),
                    color90: color90.at(r),
                    exponent: exponent.float(r),
                    roughness: roughness.at(r),
                    retroreflective,
                    scatter_mode,
                })
            }
        };
        self.oriented(node, filled).map(Some)
    }

    /// The lobe in a frame of its own where its node gives a normal or a tangent.
    fn oriented(&mut self, node: &Node<'a>, lobe: Fill) -> Result<Fill, Error> {
        let normal = self.direction(node, "normal", Geometry::Normal)?;
        let tangent = ["tangent", "tangent_u"].into_iter().find(|name| node.def.input(name).is_some());
        let tangent = match tangent {
            Some(name) => self.direction(node, name, Geometry::Tangent)?,
            None => None,
        };
        if normal.is_none() && tangent.is_none() {
            return Ok(lobe);
        }
        Ok(fill(move |r| Closure::Oriented {
            closure: Box::new(lobe(r)),
            normal: normal.and_then(|normal| normal.direction(r)),
            tangent: tangent.and_then(|tangent| tangent.direction(r)),
        }))
    }

    fn film(&mut self, node: &Node<'a>) -> Result<(), Error> {
        if self.bounded(node, "thinfilm_thickness")?.constant() != Some([0.0; 4]) {
            self.warn(node, "thinfilm_thickness", "thin films are not rendered: the film is ignored");
        }
        Ok(())
    }

    /// The parameters of a retro-reflective lobe, validated as far as they are constant.
    fn params(&mut self, node: &Node<'a>) -> Result<impl Fn(&Outputs<'_>) -> Params<f32> + use<>, Error> {
        let roughness_u: Slot<1> = self.slot_within(node, "roughness_u", Accepts::Roughness)?;
        let roughness_v: Slot<1> = self.slot(node, "roughness_v")?;
        let tint: Slot<3> = self.slot_within(node, "tint", Accepts::Unit)?;
        let multiscatter_tint: Slot<3> = self.slot_within(node, "multiscatter_tint", Accepts::Unit)?;
        let params = |[u]: [f32; 1], [v]: [f32; 1], tint, multiscatter_tint| {
            Params::isotropic(u)
                // MaterialX has no default that refers to another input: a negative value means "as
                // roughness_u".
                .with_roughness_v((v >= 0.0).then_some(v))
                .with_tint(tint)
                .with_multiscatter_tint(multiscatter_tint)
        };
        let known = params(
            roughness_u.constant().unwrap_or([0.0]),
            roughness_v.constant().unwrap_or([-1.0]),
            tint.constant().unwrap_or([1.0; 3]),
            multiscatter_tint.constant().unwrap_or([1.0; 3]),
        );
        as_written(&known).validate().map_err(|cause| Error::OutOfRange {
            at: node.place_of(cause.name()),
            message: cause.to_string(),
        })?;
        Ok(move |r: &Outputs<'_>| {
            params(roughness_u.at(r), roughness_v.at(r), tint.at(r), multiscatter_tint.at(r))
        })
    }
}
