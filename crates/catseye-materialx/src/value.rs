//! Types and constant values of inputs.

use crate::error::quoted;

/// The types of inputs and outputs that the known nodes have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Type {
    Boolean,
    Integer,
    Float,
    Color3,
    Color4,
    Vector2,
    Vector3,
    Vector4,
    Matrix33,
    Matrix44,
    String,
    Filename,
    Bsdf,
    Edf,
    Vdf,
    SurfaceShader,
    DisplacementShader,
    VolumeShader,
    LightShader,
    Material,
    MultiOutput,
}

/// Every type, for the way back from its name.
const TYPES: &[Type] = &[
    Type::Boolean,
    Type::Integer,
    Type::Float,
    Type::Color3,
    Type::Color4,
    Type::Vector2,
    Type::Vector3,
    Type::Vector4,
    Type::Matrix33,
    Type::Matrix44,
    Type::String,
    Type::Filename,
    Type::Bsdf,
    Type::Edf,
    Type::Vdf,
    Type::SurfaceShader,
    Type::DisplacementShader,
    Type::VolumeShader,
    Type::LightShader,
    Type::Material,
    Type::MultiOutput,
];

impl Type {
    /// The name in documents.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Boolean => "boolean",
            Self::Integer => "integer",
            Self::Float => "float",
            Self::Color3 => "color3",
            Self::Color4 => "color4",
            Self::Vector2 => "vector2",
            Self::Vector3 => "vector3",
            Self::Vector4 => "vector4",
            Self::Matrix33 => "matrix33",
            Self::Matrix44 => "matrix44",
            Self::String => "string",
            Self::Filename => "filename",
            Self::Bsdf => "BSDF",
            Self::Edf => "EDF",
            Self::Vdf => "VDF",
            Self::SurfaceShader => "surfaceshader",
            Self::DisplacementShader => "displacementshader",
            Self::VolumeShader => "volumeshader",
            Self::LightShader => "lightshader",
            Self::Material => "material",
            Self::MultiOutput => "multioutput",
        }
    }

    /// The type of this name.
    pub(crate) fn parse(name: &str) -> Option<Self> {
        TYPES.iter().copied().find(|ty| ty.name() == name)
    }

    /// How many numbers a value has; 0 where it is none that a pattern can compute.
    pub(crate) const fn width(self) -> u8 {
        match self {
            Self::Boolean | Self::Integer | Self::Float => 1,
            Self::Vector2 => 2,
            Self::Color3 | Self::Vector3 => 3,
            Self::Color4 | Self::Vector4 => 4,
            _ => 0,
        }
    }

    /// What a value of this type looks like, for messages.
    pub(crate) const fn example(self) -> &'static str {
        match self {
            Self::Boolean => "a boolean; write true or false",
            Self::Integer => "an integer; write one like 3",
            Self::Float => "a number; write one like 0.5",
            Self::Vector2 => "a vector2; write two numbers like 0.1, 0.2",
            Self::Color3 => "a color3; write three numbers like 0.8, 0.8, 0.8",
            Self::Color4 => "a color4; write four numbers like 0.8, 0.8, 0.8, 1",
            Self::Vector3 => "a vector3; write three numbers like 1, 0, 0",
            Self::Vector4 => "a vector4; write four numbers like 1, 0, 0, 0",
            Self::Matrix33 => "a matrix33; write nine numbers, row by row",
            Self::Matrix44 => "a matrix44; write sixteen numbers, row by row",
            Self::String => "a string",
            Self::Filename => "a file name",
            _ => "possible here; connect a node with nodename=\"...\"",
        }
    }
}

/// A constant of one of the types that have constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Value<'a> {
    Boolean(bool),
    Integer(i32),
    Float(f32),
    Color3([f32; 3]),
    Color4([f32; 4]),
    Vector2([f32; 2]),
    Vector3([f32; 3]),
    Vector4([f32; 4]),
    Matrix33([f32; 9]),
    Matrix44([f32; 16]),
    String(&'a str),
    Filename(&'a str),
}

impl<'a> Value<'a> {
    /// Reads a value; `None` where the text is no constant of this type. Infinity is one, NaN is not.
    pub(crate) fn parse(ty: Type, text: &'a str) -> Option<Self> {
        match ty {
            Type::Boolean => text.trim().parse().ok().map(Value::Boolean),
            Type::Integer => text.trim().parse().ok().map(Value::Integer),
            Type::Float => number(text).map(Value::Float),
            Type::Color3 => numbers(text).map(Value::Color3),
            Type::Color4 => numbers(text).map(Value::Color4),
            Type::Vector2 => numbers(text).map(Value::Vector2),
            Type::Vector3 => numbers(text).map(Value::Vector3),
            Type::Vector4 => numbers(text).map(Value::Vector4),
            Type::Matrix33 => numbers(text).map(Value::Matrix33),
            Type::Matrix44 => numbers(text).map(Value::Matrix44),
            Type::String => Some(Value::String(text)),
            Type::Filename => Some(Value::Filename(text)),
            _ => None,
        }
    }

    pub(crate) const fn ty(self) -> Type {
        match self {
            Value::Boolean(_) => Type::Boolean,
            Value::Integer(_) => Type::Integer,
            Value::Float(_) => Type::Float,
            Value::Color3(_) => Type::Color3,
            Value::Color4(_) => Type::Color4,
            Value::Vector2(_) => Type::Vector2,
            Value::Vector3(_) => Type::Vector3,
            Value::Vector4(_) => Type::Vector4,
            Value::Matrix33(_) => Type::Matrix33,
            Value::Matrix44(_) => Type::Matrix44,
            Value::String(_) => Type::String,
            Value::Filename(_) => Type::Filename,
        }
    }

    /// The value's numbers; none where it has none.
    pub(crate) fn components(&self) -> &[f32] {
        match self {
            Value::Float(x) => core::slice::from_ref(x),
            Value::Color3(x) | Value::Vector3(x) => x,
            Value::Color4(x) | Value::Vector4(x) => x,
            Value::Vector2(x) => x,
            Value::Matrix33(x) => x,
            Value::Matrix44(x) => x,
            Value::Boolean(_) | Value::Integer(_) | Value::String(_) | Value::Filename(_) => &[],
        }
    }

    /// The value as a pattern computes with it: up to four numbers, the rest 0.
    pub(crate) fn lanes(&self) -> [f32; 4] {
        let mut lanes = [0.0; 4];
        match self {
            Value::Boolean(x) => lanes[0] = f32::from(u8::from(*x)),
            Value::Integer(x) => lanes[0] = *x as f32,
            _ => lanes.iter_mut().zip(self.components()).for_each(|(lane, x)| *lane = *x),
        }
        lanes
    }
}

impl core::fmt::Display for Value<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Value::Boolean(x) => write!(f, "{x}"),
            Value::Integer(x) => write!(f, "{x}"),
            Value::String(x) | Value::Filename(x) => f.write_str(&quoted(x)),
            _ => {
                let numbers = self.components().iter().map(f32::to_string).collect::<Vec<_>>();
                f.write_str(&numbers.join(", "))
            }
        }
    }
}

/// A finite number, or infinity where it is spelt so: an overflow is a slip of the pen.
fn number(text: &str) -> Option<f32> {
    let text = text.trim();
    let x: f32 = text.parse().ok()?;
    let spelt = text.trim_start_matches(['+', '-']).starts_with(['i', 'I']);
    (x.is_finite() || x.is_infinite() && spelt).then_some(x)
}

/// Exactly `N` numbers, separated by commas, spaces or both, as in MaterialX.
fn numbers<const N: usize>(text: &str) -> Option<[f32; N]> {
    parts(text).map(number).collect::<Option<Vec<_>>>()?.try_into().ok()
}

fn parts(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| c == ',' || c.is_whitespace()).filter(|part| !part.is_empty())
}

/// What a text that is no value of this type should be, for messages.
pub(crate) fn expected(ty: Type, text: &str) -> &'static str {
    let overflows = |part: &str| part.parse().is_ok_and(f32::is_infinite) && number(part).is_none();
    if ty.width() > 0 && parts(text).any(overflows) {
        return "within single precision; write a number of at most 3.4e38";
    }
    ty.example()
}
