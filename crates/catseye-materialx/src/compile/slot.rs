//! Closures whose inputs are constants or registers of a pattern program.

use std::cell::RefCell;

use catseye::{ParamError, Params};

use crate::{
    closure::{Closure, ScatterMode, Surface},
    error::Error,
    nodes::{closures::as_written, port::Accepts},
    program::Lanes,
};

/// An input of `N` numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Slot<const N: usize> {
    Constant([f32; N]),
    Register { register: u32, accepts: Accepts },
}

impl<const N: usize> Slot<N> {
    fn at(&self, registers: &[Lanes]) -> [f32; N] {
        match *self {
            Self::Constant(value) => value,
            Self::Register { register, accepts } => {
                let lanes = registers[register as usize];
                core::array::from_fn(|i| finite(accepts.nearest(lanes[i])))
            }
        }
    }

    pub(crate) fn register(&self) -> Option<u32> {
        match *self {
            Self::Constant(_) => None,
            Self::Register { register, .. } => Some(register),
        }
    }

    fn relocate(&mut self, place: &impl Fn(u32) -> u32) {
        if let Self::Register { register, .. } = self {
            *register = place(*register);
        }
    }
}

impl Slot<1> {
    fn float(&self, registers: &[Lanes]) -> f32 {
        self.at(registers)[0]
    }
}

/// What a computation without a result becomes.
pub(crate) fn finite(x: f32) -> f32 {
    if x.is_nan() { 0.0 } else { x.clamp(f32::MIN, f32::MAX) }
}

/// A [`Closure`] to be filled in.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Template {
    None,
    Leaf(Leaf, Slot<1>),
    Oriented { leaf: Leaf, weight: Slot<1>, normal: Option<Slot<3>>, tangent: Option<Slot<3>> },
    Mix { foreground: Box<Template>, background: Box<Template>, amount: Slot<1> },
    Layer { top: Box<Template>, base: Box<Template> },
    Add { a: Box<Template>, b: Box<Template> },
    Multiply { closure: Box<Template>, factor: Slot<3> },
}

/// A lobe without its weight.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Leaf {
    RetroReflective {
        roughness_u: Slot<1>,
        roughness_v: Slot<1>,
        tint: Slot<3>,
        multiscatter_tint: Slot<3>,
        tangent_u: Option<Slot<3>>,
    },
    OrenNayar {
        color: Slot<3>,
        roughness: Slot<1>,
        energy_compensation: bool,
    },
    Burley {
        color: Slot<3>,
        roughness: Slot<1>,
    },
    Translucent {
        color: Slot<3>,
    },
    Sheen {
        color: Slot<3>,
        roughness: Slot<1>,
    },
    Dielectric {
        tint: Slot<3>,
        ior: Slot<1>,
        roughness: Slot<2>,
        retroreflective: bool,
        scatter_mode: ScatterMode,
    },
    Conductor {
        ior: Slot<3>,
        extinction: Slot<3>,
        roughness: Slot<2>,
        retroreflective: bool,
    },
    Schlick {
        color0: Slot<3>,
        color82: Slot<3>,
        color90: Slot<3>,
        exponent: Slot<1>,
        roughness: Slot<2>,
        retroreflective: bool,
        scatter_mode: ScatterMode,
    },
}

impl Leaf {
    fn at(&self, weight: f32, r: &[Lanes]) -> Closure {
        match self {
            Self::RetroReflective { roughness_u, roughness_v, tint, multiscatter_tint, tangent_u } => {
                let roughness_v = roughness_v.float(r);
                let params = Params::isotropic(roughness_u.float(r))
                    // MaterialX has no default that refers to another input: a negative value means "as roughness_u".
                    .with_roughness_v((roughness_v >= 0.0).then_some(roughness_v))
                    .with_tint(tint.at(r))
                    .with_multiscatter_tint(multiscatter_tint.at(r));
                let tangent_u = tangent_u.and_then(|tangent| unit(tangent.at(r)));
                Closure::RetroReflective { weight, params, tangent_u }
            }
            Self::OrenNayar { color, roughness, energy_compensation } => Closure::OrenNayarDiffuse {
                weight,
                color: color.at(r),
                roughness: roughness.float(r),
                energy_compensation: *energy_compensation,
            },
            Self::Burley { color, roughness } => {
                Closure::BurleyDiffuse { weight, color: color.at(r), roughness: roughness.float(r) }
            }
            Self::Translucent { color } => Closure::Translucent { weight, color: color.at(r) },
            Self::Sheen { color, roughness } => {
                Closure::Sheen { weight, color: color.at(r), roughness: roughness.float(r) }
            }
            Self::Dielectric { tint, ior, roughness, retroreflective, scatter_mode } => Closure::Dielectric {
                weight,
                tint: tint.at(r),
                ior: ior.float(r),
                roughness: roughness.at(r),
                retroreflective: *retroreflective,
                scatter_mode: *scatter_mode,
            },
            Self::Conductor { ior, extinction, roughness, retroreflective } => Closure::Conductor {
                weight,
                ior: ior.at(r),
                extinction: extinction.at(r),
                roughness: roughness.at(r),
                retroreflective: *retroreflective,
            },
            Self::Schlick {
                color0,
                color82,
                color90,
                exponent,
                roughness,
                retroreflective,
                scatter_mode,
            } => Closure::GeneralizedSchlick {
                weight,
                color0: color0.at(r),
                color82: color82.at(r),
                color90: color90.at(r),
                exponent: exponent.float(r),
                roughness: roughness.at(r),
                retroreflective: *retroreflective,
                scatter_mode: *scatter_mode,
            },
        }
    }

    /// Checks the parameters of a retro-reflective lobe as far as they are constant.
    pub(crate) fn check(&self, error: impl Fn(ParamError) -> Error) -> Result<(), Error> {
        let Self::RetroReflective { roughness_u, roughness_v, tint, multiscatter_tint, .. } = self else {
            return Ok(());
        };
        let float = |slot: &Slot<1>, or: f32| if let Slot::Constant([x]) = *slot { x } else { or };
        let color = |slot: &Slot<3>| if let Slot::Constant(x) = *slot { x } else { [1.0; 3] };
        let roughness_v = float(roughness_v, -1.0);
        let params = Params::isotropic(float(roughness_u, 0.0))
            .with_roughness_v((roughness_v >= 0.0).then_some(roughness_v))
            .with_tint(color(tint))
            .with_multiscatter_tint(color(multiscatter_tint));
        as_written(&params).validate().map(|_| ()).map_err(error)
    }

    fn relocate(&mut self, place: &impl Fn(u32) -> u32) {
        match self {
            Self::RetroReflective { roughness_u, roughness_v, tint, multiscatter_tint, tangent_u } => {
                roughness_u.relocate(place);
                roughness_v.relocate(place);
                tint.relocate(place);
                multiscatter_tint.relocate(place);
                tangent_u.iter_mut().for_each(|slot| slot.relocate(place));
            }
            Self::OrenNayar { color, roughness, .. }
            | Self::Burley { color, roughness }
            | Self::Sheen { color, roughness } => {
                color.relocate(place);
                roughness.relocate(place);
            }
            Self::Translucent { color } => color.relocate(place),
            Self::Dielectric { tint, ior, roughness, .. } => {
                tint.relocate(place);
                ior.relocate(place);
                roughness.relocate(place);
            }
            Self::Conductor { ior, extinction, roughness, .. } => {
                ior.relocate(place);
                extinction.relocate(place);
                roughness.relocate(place);
            }
            Self::Schlick { color0, color82, color90, exponent, roughness, .. } => {
                color0.relocate(place);
                color82.relocate(place);
                color90.relocate(place);
                exponent.relocate(place);
                roughness.relocate(place);
            }
        }
    }
}

impl Template {
    fn at(&self, r: &[Lanes]) -> Closure {
        let boxed = |template: &Self| Box::new(template.at(r));
        match self {
            Self::None => Closure::None,
            Self::Leaf(leaf, weight) => leaf.at(weight.float(r), r),
            Self::Oriented { leaf, weight, normal, tangent } => Closure::Oriented {
                closure: Box::new(leaf.at(weight.float(r), r)),
                normal: normal.and_then(|normal| unit(normal.at(r))),
                tangent: tangent.and_then(|tangent| unit(tangent.at(r))),
            },
            Self::Mix { foreground, background, amount } => Closure::Mix {
                foreground: boxed(foreground),
                background: boxed(background),
                amount: amount.float(r),
            },
            Self::Layer { top, base } => Closure::Layer { top: boxed(top), base: boxed(base) },
            Self::Add { a, b } => Closure::Add { a: boxed(a), b: boxed(b) },
            Self::Multiply { closure, factor } => {
                Closure::Multiply { closure: boxed(closure), factor: factor.at(r) }
            }
        }
    }

    /// Replaces the numbers of all registers.
    fn relocate(&mut self, place: &impl Fn(u32) -> u32) {
        match self {
            Self::None => {}
            Self::Leaf(leaf, weight) => {
                leaf.relocate(place);
                weight.relocate(place);
            }
            Self::Oriented { leaf, weight, normal, tangent } => {
                leaf.relocate(place);
                weight.relocate(place);
                normal.iter_mut().chain(tangent).for_each(|slot| slot.relocate(place));
            }
            Self::Mix { foreground, background, amount } => {
                foreground.relocate(place);
                background.relocate(place);
                amount.relocate(place);
            }
            Self::Layer { top: a, base: b } | Self::Add { a, b } => {
                a.relocate(place);
                b.relocate(place);
            }
            Self::Multiply { closure, factor } => {
                closure.relocate(place);
                factor.relocate(place);
            }
        }
    }
}

/// A surface to be filled in.
#[derive(Clone, Debug)]
pub(crate) struct SurfaceTemplate {
    pub(crate) bsdf: Template,
    pub(crate) opacity: Slot<1>,
    pub(crate) emission: Slot<3>,
}

impl SurfaceTemplate {
    pub(crate) fn at(&self, registers: &[Lanes]) -> Surface {
        Surface {
            bsdf: self.bsdf.at(registers),
            opacity: self.opacity.float(registers),
            emission: self.emission.at(registers),
        }
    }

    /// Every register that is used.
    pub(crate) fn registers(&self) -> Vec<u32> {
        let found = RefCell::new(Vec::new());
        let visit = |register| {
            found.borrow_mut().push(register);
            register
        };
        self.clone().relocate(&visit);
        found.into_inner()
    }

    pub(crate) fn relocate(&mut self, place: &impl Fn(u32) -> u32) {
        self.bsdf.relocate(place);
        self.opacity.relocate(place);
        self.emission.relocate(place);
    }
}

/// The direction at length 1, whatever its length; `None` where it is not finite or zero.
fn unit(direction: [f32; 3]) -> Option<[f32; 3]> {
    let largest = direction.iter().fold(0.0_f32, |largest, x| largest.max(x.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let scaled = direction.map(|x| x / largest);
    let length = scaled.iter().map(|x| x * x).sum::<f32>().sqrt();
    Some(scaled.map(|x| x / length))
}
