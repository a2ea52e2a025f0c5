//! The pattern nodes that are built in: the one place that says which inputs they have.
//!
//! Names, types and defaults are those of MaterialX 1.39.

use crate::{program::Geometry, value::Type};

/// The types that an input may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Port {
    /// The node's own type.
    Same,
    /// The node's own type, or a float for all components.
    SameOrFloat,
    /// This type.
    Is(Type),
    /// A boolean, an integer or a float.
    Scalar,
    /// Any type that has components.
    Numeric,
}

impl Port {
    /// Whether an input of a node of type `node` may have a type.
    pub(crate) fn accepts(self, node: Type, ty: Type) -> bool {
        match self {
            Self::Same => ty == node,
            Self::SameOrFloat => ty == node || ty == Type::Float,
            Self::Is(expected) => ty == expected,
            Self::Scalar => ty.width() == 1,
            Self::Numeric => ty.width() > 0,
        }
    }

    /// The types in words.
    pub(crate) fn describe(self, node: Type) -> String {
        match self {
            Self::Same => node.name().to_owned(),
            Self::SameOrFloat if node != Type::Float => format!("{} or float", node.name()),
            Self::SameOrFloat => "float".to_owned(),
            Self::Is(ty) => ty.name().to_owned(),
            Self::Scalar => "float, integer or boolean".to_owned(),
            Self::Numeric => "a type with components".to_owned(),
        }
    }
}

/// What an input is when the document says nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fallback {
    /// This number in every component.
    Number(f32),
    /// These numbers.
    Lanes([f32; 4]),
    Geometry(Geometry),
    Text(&'static str),
}

/// An input of a pattern node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parameter {
    pub(crate) name: &'static str,
    pub(crate) port: Port,
    pub(crate) fallback: Fallback,
}

/// A pattern node.
#[derive(Debug)]
pub(crate) struct Signature {
    pub(crate) category: &'static str,
    /// The types that it exists for.
    pub(crate) types: &'static [Type],
    pub(crate) inputs: &'static [Parameter],
    /// Names and types of its outputs, where there are several.
    pub(crate) outputs: &'static [(&'static str, Type)],
}

impl Signature {
    pub(crate) fn input(&self, name: &str) -> Option<(usize, &'static Parameter)> {
        self.inputs.iter().enumerate().find(|(_, input)| input.name == name)
    }
}

/// The categories of the pattern nodes that are built in; others must be defined as graphs of them.
pub fn pattern_categories() -> impl Iterator<Item = &'static str> {
    SIGNATURES.chunk_by(|a, b| a.category == b.category).map(|group| group[0].category)
}

/// The pattern nodes of a category; several where its inputs depend on its type.
pub(crate) fn signatures(category: &str) -> impl Iterator<Item = &'static Signature> + '_ {
    SIGNATURES.iter().filter(move |signature| signature.category == category)
}

/// The pattern node of a category and type.
pub(crate) fn signature(category: &str, ty: Type) -> Option<&'static Signature> {
    signatures(category).find(|signature| signature.types.contains(&ty))
}

const fn p(name: &'static str, port: Port, fallback: Fallback) -> Parameter {
    Parameter { name, port, fallback }
}
const fn same(name: &'static str, default: f32) -> Parameter {
    p(name, Port::Same, Fallback::Number(default))
}
const fn same_or_float(name: &'static str, default: f32) -> Parameter {
    p(name, Port::SameOrFloat, Fallback::Number(default))
}
const fn float(name: &'static str, default: f32) -> Parameter {
    p(name, Port::Is(Type::Float), Fallback::Number(default))
}
const fn integer(name: &'static str, default: f32) -> Parameter {
    p(name, Port::Is(Type::Integer), Fallback::Number(default))
}
const fn boolean(name: &'static str) -> Parameter {
    p(name, Port::Is(Type::Boolean), Fallback::Number(0.0))
}
const fn scalar(name: &'static str, default: f32) -> Parameter {
    p(name, Port::Scalar, Fallback::Number(default))
}
const fn vector2(name: &'static str, default: f32) -> Parameter {
    p(name, Port::Is(Type::Vector2), Fallback::Number(default))
}
const fn vector3(name: &'static str, default: f32) -> Parameter {
    p(name, Port::Is(Type::Vector3), Fallback::Number(default))
}
const fn numeric(name: &'static str) -> Parameter {
    p(name, Port::Numeric, Fallback::Number(0.0))
}
const fn word(name: &'static str, default: &'static str) -> Parameter {
    p(name, Port::Is(Type::String), Fallback::Text(default))
}
const fn texcoord() -> Parameter {
    p("texcoord", Port::Is(Type::Vector2), Fallback::Geometry(Geometry::Texcoord))
}
const fn position() -> Parameter {
    p("position", Port::Is(Type::Vector3), Fallback::Geometry(Geometry::PositionObject))
}
const fn direction(name: &'static str, geometry: Geometry) -> Parameter {
    p(name, Port::Is(Type::Vector3), Fallback::Geometry(geometry))
}
const fn node(category: &'static str, types: &'static [Type], inputs: &'static [Parameter]) -> Signature {
    Signature { category, types, inputs, outputs: &[] }
}

const FLOAT: &[Type] = &[Type::Float];
const BOOLEAN: &[Type] = &[Type::Boolean];

const VECTOR2: &[Type] = &[Type::Vector2];
const VECTOR3: &[Type] = &[Type::Vector3];
const COLOR: &[Type] = &[Type::Color3, Type::Color4];
const VECTOR: &[Type] = &[Type::Vector2, Type::Vector3, Type::Vector4];
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
/// The types with floats for components.
const FLOATS: &[Type] =
    &[Type::Float, Type::Color3, Type::Color4, Type::Vector2, Type::Vector3, Type::Vector4, Type::Integer];

const UNARY: &[Parameter] = &[same("in", 0.0)];
const SUM: &[Parameter] = &[same("in1", 0.0), same_or_float("in2", 0.0)];
const PRODUCT: &[Parameter] = &[same("in1", 0.0), same_or_float("in2", 1.0)];
const BLEND: &[Parameter] = &[same("fg", 0.0), same("bg", 0.0), float("mix", 1.0)];
const IF: &[Parameter] = &[scalar("value1", 1.0), scalar("value2", 0.0), same("in1", 0.0), same("in2", 0.0)];
const LOGIC: &[Parameter] = &[boolean("in1"), boolean("in2")];
/// What `image` and `tiledimage` have in common.
const FILE: Parameter = p("file", Port::Is(Type::Filename), Fallback::Text(""));

/// Every pattern node, those of a category together.
static SIGNATURES: &[Signature] = &[
    node("constant", VALUES, &[same("value", 0.0)]),
    node(
        "image",
        FLOATS,
        &[
            FILE,
            word("layer", ""),
            same("default", 0.0),
            texcoord(),
            word("uaddressmode", "periodic"),
            word("vaddressmode", "periodic"),
            word("filtertype", "linear"),
            word("framerange", ""),
            integer("frameoffset", 0.0),
            word("frameendaction", "constant"),
        ],
    ),
    node(
        "tiledimage",
        FLOATS,
        &[
            FILE,
            same("default", 0.0),
            texcoord(),
            vector2("uvtiling", 1.0),
            vector2("uvoffset", 0.0),
            vector2("realworldimagesize", 1.0),
            vector2("realworldtilesize", 1.0),
            word("filtertype", "linear"),
            word("framerange", ""),
            integer("frameoffset", 0.0),
            word("frameendaction", "constant"),
        ],
    ),
    node("texcoord", &[Type::Vector2, Type::Vector3], &[integer("index", 0.0)]),
    node("position", VECTOR3, &[word("space", "object")]),
    node("normal", VECTOR3, &[word("space", "object")]),
    node("tangent", VECTOR3, &[word("space", "object"), integer("index", 0.0)]),
    node("bitangent", VECTOR3, &[word("space", "object"), integer("index", 0.0)]),
    node("viewdirection", VECTOR3, &[word("space", "world")]),
    node("geomcolor", FLOATS, &[integer("index", 0.0)]),
    node("geompropvalue", VALUES, &[word("geomprop", ""), same("default", 0.0)]),
    node("time", FLOAT, &[float("fps", 24.0)]),
    node("frame", FLOAT, &[]),
    node(
        "facingratio",
        FLOAT,
        &[
            direction("viewdirection", Geometry::View),
            direction("normal", Geometry::Normal),
            p("faceforward", Port::Is(Type::Boolean), Fallback::Number(1.0)),
            boolean("invert"),
        ],
    ),
    node("add", FLOATS, SUM),
    node("subtract", FLOATS, SUM),
    node("multiply", FLOATS, PRODUCT),
    node("divide", FLOATS, PRODUCT),
    node("modulo", FLOATS, PRODUCT),
    node("power", FLOATS, PRODUCT),
    node("safepower", FLOATS, PRODUCT),
    node("min", FLOATS, SUM),
    node("max", FLOATS, SUM),
    node("absval", FLOATS, UNARY),
    node("sign", FLOATS, UNARY),
    node("floor", FLOATS, &[p("in", Port::Numeric, Fallback::Number(0.0))]),
    node("ceil", FLOATS, &[p("in", Port::Numeric, Fallback::Number(0.0))]),
    node("round", FLOATS, &[p("in", Port::Numeric, Fallback::Number(0.0))]),
    node("fract", FLOATS, UNARY),
    node("sqrt", FLOATS, UNARY),
    node("sin", FLOATS, UNARY),
    node("cos", FLOATS, UNARY),
    node("tan", FLOATS, UNARY),
    node("asin", FLOATS, UNARY),
    node("acos", FLOATS, UNARY),
    node("ln", FLOATS, &[same("in", 1.0)]),
    node("exp", FLOATS, UNARY),
    node("atan2", FLOATS, &[same("iny", 0.0), same_or_float("inx", 1.0)]),
    node("trianglewave", FLOAT, &[float("in", 0.0)]),
    node("invert", FLOATS, &[same("in", 0.0), same_or_float("amount", 1.0)]),
    node("clamp", FLOATS, &[same("in", 0.0), same_or_float("low", 0.0), same_or_float("high", 1.0)]),
    node("mix", FLOATS, &[same("fg", 0.0), same("bg", 0.0), same_or_float("mix", 0.0)]),
    node("smoothstep", FLOATS, &[same("in", 0.0), same_or_float("low", 0.0), same_or_float("high", 1.0)]),
    node(
        "remap",
        FLOATS,
        &[
            same("in", 0.0),
            same_or_float("inlow", 0.0),
            same_or_float("inhigh", 1.0),
            same_or_float("outlow", 0.0),
            same_or_float("outhigh", 1.0),
        ],
    ),
    node(
        "range",
        FLOATS,
        &[
            same("in", 0.0),
            same_or_float("inlow", 0.0),
            same_or_float("inhigh", 1.0),
            same_or_float("gamma", 1.0),
            same_or_float("outlow", 0.0),
            same_or_float("outhigh", 1.0),
            boolean("doclamp"),
        ],
    ),
    node("contrast", FLOATS, &[same("in", 0.0), same_or_float("amount", 1.0), same_or_float("pivot", 0.5)]),
    node("plus", FLOATS, BLEND),
    node("minus", FLOATS, BLEND),
    node("difference", FLOATS, BLEND),
    node("screen", FLOATS, BLEND),
    node("overlay", FLOATS, BLEND),
    node("burn", FLOATS, BLEND),
    node("dodge", FLOATS, BLEND),
    node("inside", FLOATS, &[same("in", 0.0), float("mask", 1.0)]),
    node("outside", FLOATS, &[same("in", 0.0), float("mask", 0.0)]),
    node("ifgreater", VALUES, IF),
    node("ifgreatereq", VALUES, IF),
    node(
        "ifequal",
        VALUES,
        &[scalar("value1", 0.0), scalar("value2", 0.0), same("in1", 0.0), same("in2", 0.0)],
    ),
    node(
        "switch",
        VALUES,
        &[
            same("in1", 0.0),
            same("in2", 0.0),
            same("in3", 0.0),
            same("in4", 0.0),
            same("in5", 0.0),
            same("in6", 0.0),
            same("in7", 0.0),
            same("in8", 0.0),
            same("in9", 0.0),
            same("in10", 0.0),
            scalar("which", 0.0),
        ],
    ),
    node("and", BOOLEAN, LOGIC),
    node("or", BOOLEAN, LOGIC),
    node("xor", BOOLEAN, LOGIC),
    node("not", BOOLEAN, &[boolean("in")]),
    node("dot", VALUES, &[same("in", 0.0), word("note", "")]),
    node("normalize", VECTOR, UNARY),
    node("magnitude", FLOAT, &[numeric("in")]),
    node("distance", FLOAT, &[numeric("in1"), numeric("in2")]),
    node("dotproduct", FLOAT, &[numeric("in1"), numeric("in2")]),
    node("crossproduct", VECTOR3, &[vector3("in1", 0.0), vector3("in2", 0.0)]),
    node("reflect", VECTOR3, &[direction("in", Geometry::View), direction("normal", Geometry::Normal)]),
    node("rotate2d", VECTOR2, &[vector2("in", 0.0), float("amount", 0.0)]),
    node(
        "rotate3d",
        VECTOR3,
        &[
            vector3("in", 0.0),
            float("amount", 0.0),
            p("axis", Port::Is(Type::Vector3), Fallback::Lanes([0.0, 1.0, 0.0, 0.0])),
        ],
    ),
    node(
        "transformmatrix",
        &[Type::Vector3],
        &[vector3("in", 0.0), p("mat", Port::Is(Type::Matrix33), Fallback::Text(""))],
    ),
    node("transformpoint", VECTOR3, &[vector3("in", 0.0), word("fromspace", ""), word("tospace", "")]),
    node("transformvector", VECTOR3, &[vector3("in", 0.0), word("fromspace", ""), word("tospace", "")]),
    node("transformnormal", VECTOR3, &[vector3("in", 0.0), word("fromspace", ""), word("tospace", "")]),
    node(
        "normalmap",
        VECTOR3,
        &[
            p("in", Port::Is(Type::Vector3), Fallback::Lanes([0.5, 0.5, 1.0, 0.0])),
            p("scale", Port::Numeric, Fallback::Lanes([1.0, 1.0, 0.0, 0.0])),
            direction("normal", Geometry::Normal),
            direction("tangent", Geometry::Tangent),
            direction("bitangent", Geometry::Bitangent),
            // MaterialX 1.38.
            word("space", "tangent"),
        ],
    ),
    node(
        "luminance",
        COLOR,
        &[
            same("in", 0.0),
            p(
                "lumacoeffs",
                Port::Is(Type::Color3),
                Fallback::Lanes([0.272_228_7, 0.674_081_8, 0.053_689_5, 0.0]),
            ),
        ],
    ),
    node("rgbtohsv", COLOR, UNARY),
    node("hsvtorgb", COLOR, UNARY),
    node(
        "hsvadjust",
        COLOR,
        &[same("in", 0.0), p("amount", Port::Is(Type::Vector3), Fallback::Lanes([0.0, 1.0, 1.0, 0.0]))],
    ),
    node(
        "saturate",
        COLOR,
        &[
            same("in", 0.0),
            float("amount", 1.0),
            p(
                "lumacoeffs",
                Port::Is(Type::Color3),
                Fallback::Lanes([0.272_228_7, 0.674_081_8, 0.053_689_5, 0.0]),
            ),
        ],
    ),
    node("extract", FLOAT, &[numeric("in"), integer("index", 0.0)]),
    node("convert", VALUES, &[numeric("in")]),
    node("swizzle", VALUES, &[numeric("in"), word("channels", "")]),
    node("combine2", VECTOR2, &[float("in1", 0.0), float("in2", 0.0)]),
    node("combine2", &[Type::Color4, Type::Vector4], &[numeric("in1"), numeric("in2")]),
    node(
        "combine3",
        &[Type::Color3, Type::Vector3],
        &[float("in1", 0.0), float("in2", 0.0), float("in3", 0.0)],
    ),
    node(
        "combine4",
        &[Type::Color4, Type::Vector4],
        &[float("in1", 0.0), float("in2", 0.0), float("in3", 0.0), float("in4", 0.0)],
    ),
    Signature {
        category: "separate2",
        types: &[Type::MultiOutput],
        inputs: &[numeric("in")],
        outputs: &[("outx", Type::Float), ("outy", Type::Float)],
    },
    Signature {
        category: "separate3",
        types: &[Type::MultiOutput],
        inputs: &[numeric("in")],
        outputs: &[
            ("outr", Type::Float),
            ("outg", Type::Float),
            ("outb", Type::Float),
            ("outx", Type::Float),
            ("outy", Type::Float),
            ("outz", Type::Float),
        ],
    },
    Signature {
        category: "separate4",
        types: &[Type::MultiOutput],
        inputs: &[numeric("in")],
        outputs: &[
            ("outr", Type::Float),
            ("outg", Type::Float),
            ("outb", Type::Float),
            ("outa", Type::Float),
            ("outx", Type::Float),
            ("outy", Type::Float),
            ("outz", Type::Float),
            ("outw", Type::Float),
        ],
    },
    node("ramplr", FLOATS, &[same("valuel", 0.0), same("valuer", 0.0), texcoord()]),
    node("ramptb", FLOATS, &[same("valuet", 0.0), same("valueb", 0.0), texcoord()]),
    node(
        "ramp4",
        FLOATS,
        &[same("valuetl", 0.0), same("valuetr", 0.0), same("valuebl", 0.0), same("valuebr", 0.0), texcoord()],
    ),
    node("splitlr", FLOATS, &[same("valuel", 0.0), same("valuer", 0.0), float("center", 0.5), texcoord()]),
    node("splittb", FLOATS, &[same("valuet", 0.0), same("valueb", 0.0), float("center", 0.5), texcoord()]),
    node(
        "place2d",
        VECTOR2,
        &[
            vector2("texcoord", 0.0),
            vector2("pivot", 0.0),
            vector2("scale", 1.0),
            float("rotate", 0.0),
            vector2("offset", 0.0),
            integer("operationorder", 0.0),
        ],
    ),
    node(
        "noise2d",
        FLOATS,
        &[p("amplitude", Port::Numeric, Fallback::Number(1.0)), float("pivot", 0.0), texcoord()],
    ),
    node(
        "noise3d",
        FLOATS,
        &[p("amplitude", Port::Numeric, Fallback::Number(1.0)), float("pivot", 0.0), position()],
    ),
    node(
        "fractal2d",
        FLOATS,
        &[
            p("amplitude", Port::Numeric, Fallback::Number(1.0)),
            integer("octaves", 3.0),
            float("lacunarity", 2.0),
            float("diminish", 0.5),
            texcoord(),
        ],
    ),
    node(
        "fractal3d",
        FLOATS,
        &[
            p("amplitude", Port::Numeric, Fallback::Number(1.0)),
            integer("octaves", 3.0),
            float("lacunarity", 2.0),
            float("diminish", 0.5),
            position(),
        ],
    ),
    node("cellnoise2d", FLOAT, &[texcoord()]),
    node("cellnoise3d", FLOAT, &[position()]),
    node(
        "worleynoise2d",
        &[Type::Float, Type::Vector2, Type::Vector3],
        &[texcoord(), float("jitter", 1.0), integer("style", 0.0)],
    ),
    node(
        "worleynoise3d",
        &[Type::Float, Type::Vector2, Type::Vector3],
        &[position(), float("jitter", 1.0), integer("style", 0.0)],
    ),
    node(
        "checkerboard",
        &[Type::Color3],
        &[
            same("color1", 1.0),
            same("color2", 0.0),
            vector2("uvtiling", 8.0),
            vector2("uvoffset", 0.0),
            texcoord(),
        ],
    ),
    node(
        "randomfloat",
        FLOAT,
        &[scalar("in", 0.0), float("min", 0.0), float("max", 1.0), integer("seed", 0.0)],
    ),
    node("roughness_anisotropy", VECTOR2, &[float("roughness", 0.0), float("anisotropy", 0.0)]),
    node("roughness_dual", VECTOR2, &[vector2("roughness", 0.0)]),
    Signature {
        category: "artistic_ior",
        types: &[Type::MultiOutput],
        inputs: &[
            p("reflectivity", Port::Is(Type::Color3), Fallback::Lanes([0.944, 0.776, 0.373, 0.0])),
            p("edge_color", Port::Is(Type::Color3), Fallback::Lanes([0.998, 0.981, 0.751, 0.0])),
        ],
        outputs: &[("ior", Type::Color3), ("extinction", Type::Color3)],
    },
];
