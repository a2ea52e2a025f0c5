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

/// The parameters to more digits, so that a refusal shows 1.1 and not 1.100000023841858, the f32 next to it.
pub(crate) fn as_written(params: &Params<f32>) -> Params<f64> {
    params.map(|x| x.to_string().parse().unwrap_or(f64::from(x)))
}

const fn closure(
    category: &'static str,
    kind: Kind,
    types: &'static [Type],
    inputs: &'static [Port],
) -> NodeDef {
    NodeDef { category, types, inputs, outputs: &[], meaning: Meaning::Closure(kind) }
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
    closure(
        "retro_reflective_bsdf",
        Kind::RetroReflective,
        BSDF,
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
    closure(
        "oren_nayar_diffuse_bsdf",
        Kind::OrenNayarDiffuse,
        BSDF,
        &[
            WEIGHT,
            unit_color("color", 0.18),
            unit_float("roughness", 0.0),
            NORMAL,
            flag("energy_compensation", false),
        ],
    ),
    closure(
        "dielectric_bsdf",
        Kind::Dielectric,
        BSDF,
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
    closure(
        "conductor_bsdf",
        Kind::Conductor,
        BSDF,
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
    closure(
        "generalized_schlick_bsdf",
        Kind::GeneralizedSchlick,
        BSDF,
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
    closure(
        "burley_diffuse_bsdf",
        Kind::BurleyDiffuse,
        BSDF,
        &[WEIGHT, unit_color("color", 0.18), unit_float("roughness", 0.0), NORMAL],
    ),
    closure("translucent_bsdf", Kind::Translucent, BSDF, &[WEIGHT, unit_color("color", 1.0), NORMAL]),
    closure(
        "subsurface_bsdf",
        Kind::Subsurface,
        BSDF,
        &[
            WEIGHT,
            unit_color("color", 0.18),
            color("radius", 1.0).accepting(Accepts::NotNegative),
            float("anisotropy", 0.0),
            NORMAL,
        ],
    ),
    closure(
        "sheen_bsdf",
        Kind::Sheen,
        BSDF,
        &[
            WEIGHT,
            unit_color("color", 1.0),
            unit_float("roughness", 0.3),
            NORMAL,
            word("mode", &["conty_kulla", "zeltner"]),
        ],
    ),
    closure(
        "mix",
        Kind::Mix,
        BSDF,
        &[connection("fg", BSDF), connection("bg", BSDF), unit_float("mix", 0.0)],
    ),
    // The base may be a volume.
    closure(
        "layer",
        Kind::Layer,
        BSDF,
        &[connection("top", BSDF), connection("base", &[Type::Bsdf, Type::Vdf])],
    ),
    closure("add", Kind::Add, BSDF, &[connection("in1", BSDF), connection("in2", BSDF)]),
    closure(
        "multiply",
        Kind::Multiply,
        BSDF,
        &[connection("in1", BSDF), of("in2", &[Type::Float, Type::Color3], 1.0).accepting(Accepts::Unit)],
    ),
    closure("uniform_edf", Kind::UniformEdf, EDF, &[color("color", 1.0).accepting(Accepts::NotNegative)]),
    closure(
        "generalized_schlick_edf",
        Kind::SchlickEdf,
        EDF,
        &[unit_color("color0", 1.0), unit_color("color90", 1.0), EXPONENT, connection("base", EDF)],
    ),
    closure(
        "mix",
        Kind::MixEdf,
        EDF,
        &[connection("fg", EDF), connection("bg", EDF), unit_float("mix", 0.0)],
    ),
    closure("add", Kind::AddEdf, EDF, &[connection("in1", EDF), connection("in2", EDF)]),
    closure(
        "multiply",
        Kind::MultiplyEdf,
        EDF,
        &[
            connection("in1", EDF),
            of("in2", &[Type::Float, Type::Color3], 1.0).accepting(Accepts::NotNegative),
        ],
    ),
    closure(
        "surface_unlit",
        Kind::SurfaceUnlit,
        SURFACE,
        &[
            float("emission", 1.0).accepting(Accepts::NotNegative),
            color("emission_color", 1.0).accepting(Accepts::NotNegative),
            float("transmission", 0.0).accepting(Accepts::DefaultOnly),
            color("transmission_color", 1.0),
            unit_float("opacity", 1.0),
        ],
    ),
    closure(
        "surface",
        Kind::Surface,
        SURFACE,
        &[
            connection("bsdf", BSDF),
            connection("edf", EDF),
            unit_float("opacity", 1.0),
            flag("thin_walled", false).accepting(Accepts::DefaultOnly),
        ],
    ),
    closure(
        "surfacematerial",
        Kind::SurfaceMaterial,
        &[Type::Material],
        &[
            connection("surfaceshader", SURFACE),
            connection("backsurfaceshader", SURFACE).accepting(Accepts::DefaultOnly),
            connection("displacementshader", &[Type::DisplacementShader]),
        ],
    ),
];
