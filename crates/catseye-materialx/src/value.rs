//! Types and constant values of inputs.

use crate::error::quoted;

/// The types of inputs and outputs that the known nodes have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Type {
    Boolean,
    Float,
    Color3,
    Vector2,
    Vector3,
    String,
    Bsdf,
    Edf,
    SurfaceShader,
    DisplacementShader,
    Material,
}

impl Type {
    /// The name in documents.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Boolean => "boolean",
            Self::Float => "float",
            Self::Color3 => "color3",
            Self::Vector2 => "vector2",
            Self::Vector3 => "vector3",
            Self::String => "string",
            Self::Bsdf => "BSDF",
            Self::Edf => "EDF",
            Self::SurfaceShader => "surfaceshader",
            Self::DisplacementShader => "displacementshader",
            Self::Material => "material",
        }
    }

    /// What a value of this type looks like, for messages.
    pub(crate) const fn example(self) -> &'static str {
        match self {
            Self::Boolean => "a boolean; write true or false",
            Self::Float => "a number; write one like 0.5",
            Self::Vector2 => "a vector2; write two numbers like 0.1, 0.2",
            Self::Color3 => "a color3; write three numbers like 0.8, 0.8, 0.8",
            Self::Vector3 => "a vector3; write three numbers like 1, 0, 0",
            Self::String => "a string",
            Self::Bsdf | Self::Edf | Self::SurfaceShader | Self::DisplacementShader | Self::Material => {
                "possible here; connect a node with nodename=\"...\""
            }
        }
    }
}

/// A constant of one of the types that have constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Value<'a> {
    Boolean(bool),
    Float(f32),
    Color3([f32; 3]),
    Vector2([f32; 2]),
    Vector3([f32; 3]),
    String(&'a str),
}

impl<'a> Value<'a> {
    /// Reads a value; `None` where the text is no constant of this type. Infinity is one, NaN is not.
    pub(crate) fn parse(ty: Type, text: &'a str) -> Option<Self> {
        match ty {
            Type::Boolean => text.trim().parse().ok().map(Value::Boolean),
            Type::Float => number(text).map(Value::Float),
            Type::Color3 => numbers(text).map(Value::Color3),
            Type::Vector2 => numbers(text).map(Value::Vector2),
            Type::Vector3 => numbers(text).map(Value::Vector3),
            Type::String => Some(Value::String(text)),
            Type::Bsdf | Type::Edf | Type::SurfaceShader | Type::DisplacementShader | Type::Material => None,
        }
    }

    pub(crate) const fn ty(self) -> Type {
        match self {
            Value::Boolean(_) => Type::Boolean,
            Value::Float(_) => Type::Float,
            Value::Color3(_) => Type::Color3,
            Value::Vector2(_) => Type::Vector2,
            Value::Vector3(_) => Type::Vector3,
            Value::String(_) => Type::String,
        }
    }

    /// The value's numbers; none where it has none.
    pub(crate) fn components(&self) -> &[f32] {
        match self {
            Value::Float(x) => core::slice::from_ref(x),
            Value::Color3(x) | Value::Vector3(x) => x,
            Value::Vector2(x) => x,
            Value::Boolean(_) | Value::String(_) => &[],
        }
    }
}

impl core::fmt::Display for Value<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Value::Boolean(x) => write!(f, "{x}"),
            Value::String(x) => f.write_str(&quoted(x)),
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

/// Exactly `N` numbers, separated by commas or, where there are none, by spaces.
fn numbers<const N: usize>(text: &str) -> Option<[f32; N]> {
    let parts: Vec<&str> =
        if text.contains(',') { text.split(',').collect() } else { text.split_whitespace().collect() };
    let numbers = parts.into_iter().map(number).collect::<Option<Vec<_>>>()?;
    numbers.try_into().ok()
}

/// Converts a colour to linear Rec. 709.
pub(crate) type ToLinear = fn(f32) -> f32;

/// Colour spaces by their names in documents, with the conversion of one channel.
pub(crate) const COLOR_SPACES: &[(&str, ToLinear)] =
    &[("lin_rec709", |x| x), ("raw", |x| x), ("none", |x| x), ("srgb_texture", linear_from_srgb)];

/// IEC 61966-2-1, the sRGB transfer function.
fn linear_from_srgb(x: f32) -> f32 {
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}
