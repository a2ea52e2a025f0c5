//! The known node categories: the one place that says which inputs a node has, of which type, with which
//! default and range.
//!
//! Names, types and defaults are those of MaterialX 1.39 and, for `retro_reflective_bsdf`, of the proposal.

use catseye::Params;

use crate::value::{Type, Value};

/// What a node is, once its category and types are resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    RetroReflective,
    OrenNayarDiffuse,
    BurleyDiffuse,
    Translucent,
    Subsurface,
    Sheen,
    Dielectric,
    Conductor,
    GeneralizedSchlick,
    Mix,
    Layer,
    /// A BSDF over a volume.
    LayerVolume,
    Add,
    Multiply,
    UniformEdf,
    SchlickEdf,
    MixEdf,
    AddEdf,
    MultiplyEdf,
    Surface,
    SurfaceUnlit,
    SurfaceMaterial,
}

/// A node definition. A category that exists for several types has one for each, as in MaterialX.
#[derive(Debug)]
pub(crate) struct NodeDef {
    pub(crate) category: &'static str,
    pub(crate) kind: Kind,
    pub(crate) output: Type,
    pub(crate) inputs: &'static [InputDef],
}

impl NodeDef {
    pub(crate) fn input(&self, name: &str) -> Option<(usize, &'static InputDef)> {
        self.inputs.iter().enumerate().find(|(_, input)| input.name == name)
    }
}

/// An input of a node definition.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InputDef {
    pub(crate) name: &'static str,
    pub(crate) default: InputDefault,
    pub(crate) accepts: Accepts,
}

impl InputDef {
    const fn accepting(self, accepts: Accepts) -> Self {
        Self { accepts, ..self }
    }

    pub(crate) const fn ty(&self) -> Type {
        match self.default {
            InputDefault::Value(value) => value.ty(),
            InputDefault::Geometry(_) => Type::Vector3,
            InputDefault::Unconnected(ty) => ty,
        }
    }
}

/// What an input is when the document says nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) enum InputDefault {
    /// A constant.
    Value(Value<'static>),
    /// A direction of the geometry, by the name of MaterialX's geometric property.
    Geometry(&'static str),
    /// Nothing is connected.
    Unconnected(Type),
}

/// Which values an input may have, beyond its type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Accepts {
    /// Every one; or the receiver checks.
    Any,
    /// `[0, 1]`, each component.
    Unit,
    /// `(0, inf)`, each component.
    Positive,
    /// `[0, inf)`, each component.
    NotNegative,
    /// `[0, inf]`: what a computed roughness is brought to.
    Roughness,
    /// A direction: finite and not zero.
    Direction,
    /// One of these words.
    Words(&'static [&'static str]),
    /// Nothing but the default: the rest is not implemented.
    DefaultOnly,
}

impl Accepts {
    /// The range in words where `value` is outside it.
    pub(crate) fn refusal(self, value: Value<'_>) -> Option<String> {
        let all = |inside: fn(f32) -> bool| value.components().iter().all(|&x| inside(x));
        let (accepted, range) = match self {
            Self::Any | Self::Roughness | Self::DefaultOnly => return None,
            Self::Unit => (all(|x| (0.0..=1.0).contains(&x)), "outside [0, 1]".to_owned()),
            Self::Positive => (all(|x| x > 0.0 && x.is_finite()), "outside (0, inf)".to_owned()),
            Self::NotNegative => (all(|x| x >= 0.0 && x.is_finite()), "outside [0, inf)".to_owned()),
            Self::Direction => (
                all(f32::is_finite) && value.components().iter().any(|&x| x != 0.0),
                "not a direction; write one like 1, 0, 0".to_owned(),
            ),
            Self::Words(words) => {
                let known = matches!(value, Value::String(word) if words.contains(&word));
                (known, format!("not one of {}", words.join(", ")))
            }
        };
        (!accepted).then_some(range)
    }
}

impl Accepts {
    /// The nearest acceptable number: computed values are brought into range, written ones are refused.
    pub(crate) fn nearest(self, x: f32) -> f32 {
        /// A refractive index that is no longer singular.
        const SMALLEST: f32 = 1e-3;
        match self {
            Self::Unit => x.clamp(0.0, 1.0),
            Self::Positive => x.clamp(SMALLEST, f32::MAX),
            Self::NotNegative => x.clamp(0.0, f32::MAX),
            Self::Roughness => x.max(0.0),
            Self::Any | Self::Direction | Self::Words(_) | Self::DefaultOnly => x,
        }
    }
}

/// The parameters to more digits, so that a refusal shows 1.1 and not 1.100000023841858, the f32 next to it.
pub(crate) fn as_written(params: &Params<f32>) -> Params<f64> {
    params.map(|x| x.to_string().parse().unwrap_or(f64::from(x)))
}

const fn input(name: &'static str, default: Value<'static>) -> InputDef {
    InputDef { name, default: InputDefault::Value(default), accepts: Accepts::Any }
}

const fn float(name: &'static str, default: f32) -> InputDef {
    input(name, Value::Float(default))
}

const fn unit_float(name: &'static str, default: f32) -> InputDef {
    float(name, default).accepting(Accepts::Unit)
}

const fn color(name: &'static str, default: f32) -> InputDef {
    input(name, Value::Color3([default; 3]))
}

const fn unit_color(name: &'static str, default: f32) -> InputDef {
    color(name, default).accepting(Accepts::Unit)
}

const fn flag(name: &'static str, default: bool) -> InputDef {
    input(name, Value::Boolean(default))
}

const fn word(name: &'static str, default: &'static str, words: &'static [&'static str]) -> InputDef {
    input(name, Value::String(default)).accepting(Accepts::Words(words))
}

const fn geometry(name: &'static str, property: &'static str) -> InputDef {
    InputDef { name, default: InputDefault::Geometry(property), accepts: Accepts::DefaultOnly }
}

const fn connection(name: &'static str, ty: Type) -> InputDef {
    InputDef { name, default: InputDefault::Unconnected(ty), accepts: Accepts::Any }
}

/// Every known node definition.
pub(crate) static NODE_DEFS: &[NodeDef] = &[
    NodeDef {
        category: "retro_reflective_bsdf",
        kind: Kind::RetroReflective,
        output: Type::Bsdf,
        // `catseye::Params::validate` knows the ranges of the four inputs that accept any value.
        inputs: &[
            unit_float("weight", 1.0),
            float("roughness_u", 0.0),
            float("roughness_v", -1.0),
            color("tint", 1.0),
            color("multiscatter_tint", 0.0),
            geometry("tangent_u", "Tworld").accepting(Accepts::Direction),
            geometry("normal", "Nworld").accepting(Accepts::Direction),
        ],
    },
    NodeDef {
        category: "oren_nayar_diffuse_bsdf",
        kind: Kind::OrenNayarDiffuse,
        output: Type::Bsdf,
        inputs: &[
            unit_float("weight", 1.0),
            unit_color("color", 0.18),
            unit_float("roughness", 0.0),
            geometry("normal", "Nworld").accepting(Accepts::Direction),
            flag("energy_compensation", false),
        ],
    },
    NodeDef {
        category: "dielectric_bsdf",
        kind: Kind::Dielectric,
        output: Type::Bsdf,
        inputs: &[
            unit_float("weight", 1.0),
            unit_color("tint", 1.0),
            float("ior", 1.5).accepting(Accepts::Positive),
            input("roughness", Value::Vector2([0.05; 2])).accepting(Accepts::Unit),
            flag("retroreflective", false),
            float("thinfilm_thickness", 0.0).accepting(Accepts::DefaultOnly),
            // Without a film its index does nothing.
            float("thinfilm_ior", 1.5),
            geometry("normal", "Nworld").accepting(Accepts::Direction),
            geometry("tangent", "Tworld").accepting(Accepts::Direction),
            word("distribution", "ggx", &["ggx"]),
            word("scatter_mode", "R", &["R", "T", "RT"]),
        ],
    },
    NodeDef {
        category: "conductor_bsdf",
        kind: Kind::Conductor,
        output: Type::Bsdf,
        inputs: &[
            unit_float("weight", 1.0),
            input("ior", Value::Color3([0.183, 0.421, 1.373])).accepting(Accepts::NotNegative),
            input("extinction", Value::Color3([3.424, 2.346, 1.770])).accepting(Accepts::NotNegative),
            input("roughness", Value::Vector2([0.05; 2])).accepting(Accepts::Unit),
            flag("retroreflective", false),
            float("thinfilm_thickness", 0.0).accepting(Accepts::DefaultOnly),
            float("thinfilm_ior", 1.5),
            geometry("normal", "Nworld").accepting(Accepts::Direction),
            geometry("tangent", "Tworld").accepting(Accepts::Direction),
            word("distribution", "ggx", &["ggx"]),
        ],
    },
    NodeDef {
        category: "generalized_schlick_bsdf",
        kind: Kind::GeneralizedSchlick,
        output: Type::Bsdf,
        inputs: &[
            unit_float("weight", 1.0),
            unit_color("color0", 1.0),
            unit_color("color82", 1.0),
            unit_color("color90", 1.0),
            float("exponent", 5.0).accepting(Accepts::NotNegative),
            input("roughness", Value::Vector2([0.05; 2])).accepting(Accepts::Unit),
            flag("retroreflective", false),
            float("thinfilm_thickness", 0.0).accepting(Accepts::DefaultOnly),
            float("thinfilm_ior", 1.5),
            geometry("normal", "Nworld").accepting(Accepts::Direction),
            geometry("tangent", "Tworld").accepting(Accepts::Direction),
            word("distribution", "ggx", &["ggx"]),
            word("scatter_mode", "R", &["R", "T", "RT"]),
        ],
    },
    NodeDef {
        category: "burley_diffuse_bsdf",
        kind: Kind::BurleyDiffuse,
        output: Type::Bsdf,
        inputs: &[
            unit_float("weight", 1.0),
            unit_color("color", 0.18),
            unit_float("roughness", 0.0),
            geometry("normal", "Nworld").accepting(Accepts::Direction),
        ],
    },
    NodeDef {
        category: "translucent_bsdf",
        kind: Kind::Translucent,
        output: Type::Bsdf,
        inputs: &[
            unit_float("weight", 1.0),
            unit_color("color", 1.0),
            geometry("normal", "Nworld").accepting(Accepts::Direction),
        ],
    },
    NodeDef {
        category: "subsurface_bsdf",
        kind: Kind::Subsurface,
        output: Type::Bsdf,
        inputs: &[
            unit_float("weight", 1.0),
            unit_color("color", 0.18),
            input("radius", Value::Color3([1.0; 3])).accepting(Accepts::NotNegative),
            float("anisotropy", 0.0),
            geometry("normal", "Nworld").accepting(Accepts::Direction),
        ],
    },
    NodeDef {
        category: "sheen_bsdf",
        kind: Kind::Sheen,
        output: Type::Bsdf,
        inputs: &[
            unit_float("weight", 1.0),
            unit_color("color", 1.0),
            unit_float("roughness", 0.3),
            geometry("normal", "Nworld").accepting(Accepts::Direction),
            word("mode", "conty_kulla", &["conty_kulla", "zeltner"]),
        ],
    },
    NodeDef {
        category: "mix",
        kind: Kind::Mix,
        output: Type::Bsdf,
        inputs: &[connection("fg", Type::Bsdf), connection("bg", Type::Bsdf), unit_float("mix", 0.0)],
    },
    NodeDef {
        category: "layer",
        kind: Kind::Layer,
        output: Type::Bsdf,
        inputs: &[connection("top", Type::Bsdf), connection("base", Type::Bsdf)],
    },
    NodeDef {
        category: "layer",
        kind: Kind::LayerVolume,
        output: Type::Bsdf,
        inputs: &[connection("top", Type::Bsdf), connection("base", Type::Vdf)],
    },
    NodeDef {
        category: "add",
        kind: Kind::Add,
        output: Type::Bsdf,
        inputs: &[connection("in1", Type::Bsdf), connection("in2", Type::Bsdf)],
    },
    NodeDef {
        category: "multiply",
        kind: Kind::Multiply,
        output: Type::Bsdf,
        inputs: &[connection("in1", Type::Bsdf), unit_float("in2", 1.0)],
    },
    NodeDef {
        category: "multiply",
        kind: Kind::Multiply,
        output: Type::Bsdf,
        inputs: &[connection("in1", Type::Bsdf), unit_color("in2", 1.0)],
    },
    NodeDef {
        category: "uniform_edf",
        kind: Kind::UniformEdf,
        output: Type::Edf,
        inputs: &[color("color", 1.0).accepting(Accepts::NotNegative)],
    },
    NodeDef {
        category: "generalized_schlick_edf",
        kind: Kind::SchlickEdf,
        output: Type::Edf,
        inputs: &[
            unit_color("color0", 1.0),
            unit_color("color90", 1.0),
            float("exponent", 5.0).accepting(Accepts::NotNegative),
            connection("base", Type::Edf),
        ],
    },
    NodeDef {
        category: "mix",
        kind: Kind::MixEdf,
        output: Type::Edf,
        inputs: &[connection("fg", Type::Edf), connection("bg", Type::Edf), unit_float("mix", 0.0)],
    },
    NodeDef {
        category: "add",
        kind: Kind::AddEdf,
        output: Type::Edf,
        inputs: &[connection("in1", Type::Edf), connection("in2", Type::Edf)],
    },
    NodeDef {
        category: "multiply",
        kind: Kind::MultiplyEdf,
        output: Type::Edf,
        inputs: &[connection("in1", Type::Edf), float("in2", 1.0).accepting(Accepts::NotNegative)],
    },
    NodeDef {
        category: "multiply",
        kind: Kind::MultiplyEdf,
        output: Type::Edf,
        inputs: &[connection("in1", Type::Edf), color("in2", 1.0).accepting(Accepts::NotNegative)],
    },
    NodeDef {
        category: "surface_unlit",
        kind: Kind::SurfaceUnlit,
        output: Type::SurfaceShader,
        inputs: &[
            float("emission", 1.0).accepting(Accepts::NotNegative),
            color("emission_color", 1.0).accepting(Accepts::NotNegative),
            float("transmission", 0.0).accepting(Accepts::DefaultOnly),
            color("transmission_color", 1.0),
            unit_float("opacity", 1.0),
        ],
    },
    NodeDef {
        category: "surface",
        kind: Kind::Surface,
        output: Type::SurfaceShader,
        inputs: &[
            connection("bsdf", Type::Bsdf),
            connection("edf", Type::Edf),
            unit_float("opacity", 1.0),
            flag("thin_walled", false).accepting(Accepts::DefaultOnly),
        ],
    },
    NodeDef {
        category: "surfacematerial",
        kind: Kind::SurfaceMaterial,
        output: Type::Material,
        inputs: &[
            connection("surfaceshader", Type::SurfaceShader),
            connection("backsurfaceshader", Type::SurfaceShader).accepting(Accepts::DefaultOnly),
            connection("displacementshader", Type::DisplacementShader).accepting(Accepts::DefaultOnly),
        ],
    },
];
