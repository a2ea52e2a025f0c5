//! BSDFs, EDFs, shaders and materials.

use catseye::Params;

use super::{
    Meaning, NodeDef,
    port::{Accepts, Port, color, color3, connection, flag, float, geometry, of, valued, word},
};
use crate::{
    program::Geometry,
    value::{Type, Value},
};

/// A BSDF that scatters by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lobe {
    RetroReflective,
    OrenNayarDiffuse,
    BurleyDiffuse,
    Translucent,
    Subsurface,
    Sheen,
    Dielectric,
    Conductor,
    GeneralizedSchlick,
}

/// A BSDF made of others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Combination {
    Mix,
    Layer,
    Add,
    Multiply,
}

/// What an EDF is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Edf {
    Uniform,
    GeneralizedSchlick,
    Mix,
    Add,
    Multiply,
}

/// What makes surfaces of closures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shader {
    Surface,
    SurfaceUnlit,
    SurfaceMaterial,
}

/// The parameters to more digits, so that a refusal shows 1.1 and not 1.100000023841858, the f32 next to it.
pub(crate) fn as_written(params: &Params<f32>) -> Params<f64> {
    params.map(|x| x.to_string().parse().unwrap_or(f64::from(x)))
}

const fn lobe(category: &'static str, lobe: Lobe, inputs: &'static [Port]) -> NodeDef {
    NodeDef { category, types: BSDF, inputs, outputs: &[], meaning: Meaning::Lobe(lobe) }
}

const fn combination(category: &'static str, combination: Combination, inputs: &'static [Port]) -> NodeDef {
    NodeDef { category, types: BSDF, inputs, outputs: &[], meaning: Meaning::Combination(combination) }
}

const fn edf(category: &'static str, edf: Edf, inputs: &'static [Port]) -> NodeDef {
    NodeDef { category, types: EDF, inputs, outputs: &[], meaning: Meaning::Edf(edf) }
}

const fn shader(
    category: &'static str,
    shader: Shader,
    types: &'static [Type],
    inputs: &'static [Port],
) -> NodeDef {
    NodeDef { category, types, inputs, outputs: &[], meaning: Meaning::Shader(shader) }
}

const fn unit_float(name: &'static str, default: f32) -> Port {
    float(name, default).accepting(Accepts::Unit)
}

const fn unit_color(name: &'static str, default: f32) -> Port {
    color(name, default).accepting(Accepts::Unit)
}

const BSDF: &[Type] = &[Type::Bsdf];
const EDF: &[Type] = &[Type::Edf];
const SURFACE: &[Type] = &[Type::SurfaceShader];

const WEIGHT: Port = unit_float("weight", 1.0);
const NORMAL: Port = geometry("normal", Geometry::Normal).accepting(Accepts::Direction);
const TANGENT: Port = geometry("tangent", Geometry::Tangent).accepting(Accepts::Direction);
/// GGX alpha.
const ALPHA: Port = valued("roughness", &[Type::Vector2], Value::Vector2([0.05; 2])).accepting(Accepts::Unit);
const RETROREFLECTIVE: Port = flag("retroreflective", false);
const FILM: Port = float("thinfilm_thickness", 0.0).accepting(Accepts::NotNegative);
/// Without a film its index does nothing.
const FILM_IOR: Port = float("thinfilm_ior", 1.5);
const DISTRIBUTION: Port = word("distribution", &["ggx"]);
const SCATTER_MODE: Port = word("scatter_mode", &["R", "T", "RT"]);
const EXPONENT: Port = float("exponent", 5.0).accepting(Accepts::NotNegative);

pub(super) static NODES: &[NodeDef] = &[
    lobe(
        "retro_reflective_bsdf",
        Lobe::RetroReflective,
        // `catseye::Params::validate` knows the ranges of the four inputs that accept any value.
        &[
            WEIGHT,
            float("roughness_u", 0.0),
            float("roughness_v", -1.0),
            color("tint", 1.0),
            color("multiscatter_tint", 0.0),
            geometry("tangent_u", Geometry::Tangent).accepting(Accepts::Direction),
            NORMAL,
        ],
    ),
    lobe(
        "oren_nayar_diffuse_bsdf",
        Lobe::OrenNayarDiffuse,
        &[
            WEIGHT,
            unit_color("color", 0.18),
            unit_float("roughness", 0.0),
            NORMAL,
            flag("energy_compensation", false),
        ],
    ),
    lobe(
        "dielectric_bsdf",
        Lobe::Dielectric,
        &[
            WEIGHT,
            unit_color("tint", 1.0),
            float("ior", 1.5).accepting(Accepts::Positive),
            ALPHA,
            RETROREFLECTIVE,
            FILM,
            FILM_IOR,
            NORMAL,
            TANGENT,
            DISTRIBUTION,
            SCATTER_MODE,
        ],
    ),
    lobe(
        "conductor_bsdf",
        Lobe::Conductor,
        &[
            WEIGHT,
            color3("ior", [0.183, 0.421, 1.373]).accepting(Accepts::NotNegative),
            color3("extinction", [3.424, 2.346, 1.770]).accepting(Accepts::NotNegative),
            ALPHA,
            RETROREFLECTIVE,
            FILM,
            FILM_IOR,
            NORMAL,
            TANGENT,
            DISTRIBUTION,
        ],
    ),
    lobe(
        "generalized_schlick_bsdf",
        Lobe::GeneralizedSchlick,
        &[
            WEIGHT,
            unit_color("color0", 1.0),
            unit_color("color82", 1.0),
            unit_color("color90", 1.0),
            EXPONENT,
            ALPHA,
            RETROREFLECTIVE,
            FILM,
            FILM_IOR,
            NORMAL,
            TANGENT,
            DISTRIBUTION,
            SCATTER_MODE,
        ],
    ),
    lobe(
        "burley_diffuse_bsdf",
        Lobe::BurleyDiffuse,
        &[WEIGHT, unit_color("color", 0.18), unit_float("roughness", 0.0), NORMAL],
    ),
    lobe("translucent_bsdf", Lobe::Translucent, &[WEIGHT, unit_color("color", 1.0), NORMAL]),
    lobe(
        "subsurface_bsdf",
        Lobe::Subsurface,
        &[
            WEIGHT,
            unit_color("color", 0.18),
            color("radius", 1.0).accepting(Accepts::NotNegative),
            float("anisotropy", 0.0),
            NORMAL,
        ],
    ),
    lobe(
        "sheen_bsdf",
        Lobe::Sheen,
        &[
            WEIGHT,
            unit_color("color", 1.0),
            unit_float("roughness", 0.3),
            NORMAL,
            word("mode", &["conty_kulla", "zeltner"]),
        ],
    ),
    combination(
        "mix",
        Combination::Mix,
        &[connection("fg", BSDF), connection("bg", BSDF), unit_float("mix", 0.0)],
    ),
    // The base may be a volume.
    combination(
        "layer",
        Combination::Layer,
        &[connection("top", BSDF), connection("base", &[Type::Bsdf, Type::Vdf])],
    ),
    combination("add", Combination::Add, &[connection("in1", BSDF), connection("in2", BSDF)]),
    combination(
        "multiply",
        Combination::Multiply,
        &[connection("in1", BSDF), of("in2", &[Type::Float, Type::Color3], 1.0).accepting(Accepts::Unit)],
    ),
    edf("uniform_edf", Edf::Uniform, &[color("color", 1.0).accepting(Accepts::NotNegative)]),
    edf(
        "generalized_schlick_edf",
        Edf::GeneralizedSchlick,
        &[unit_color("color0", 1.0), unit_color("color90", 1.0), EXPONENT, connection("base", EDF)],
    ),
    edf("mix", Edf::Mix, &[connection("fg", EDF), connection("bg", EDF), unit_float("mix", 0.0)]),
    edf("add", Edf::Add, &[connection("in1", EDF), connection("in2", EDF)]),
    edf(
        "multiply",
        Edf::Multiply,
        &[
            connection("in1", EDF),
            of("in2", &[Type::Float, Type::Color3], 1.0).accepting(Accepts::NotNegative),
        ],
    ),
    shader(
        "surface_unlit",
        Shader::SurfaceUnlit,
        SURFACE,
        &[
            float("emission", 1.0).accepting(Accepts::NotNegative),
            color("emission_color", 1.0).accepting(Accepts::NotNegative),
            float("transmission", 0.0).accepting(Accepts::DefaultOnly),
            color("transmission_color", 1.0),
            unit_float("opacity", 1.0),
        ],
    ),
    shader(
        "surface",
        Shader::Surface,
        SURFACE,
        &[
            connection("bsdf", BSDF),
            connection("edf", EDF),
            unit_float("opacity", 1.0),
            flag("thin_walled", false).accepting(Accepts::DefaultOnly),
        ],
    ),
    shader(
        "surfacematerial",
        Shader::SurfaceMaterial,
        &[Type::Material],
        &[
            connection("surfaceshader", SURFACE),
            connection("backsurfaceshader", SURFACE).accepting(Accepts::DefaultOnly),
            connection("displacementshader", &[Type::DisplacementShader]),
        ],
    ),
];
