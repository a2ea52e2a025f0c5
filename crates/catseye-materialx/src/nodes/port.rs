//! Inputs of nodes: their types, defaults, and the values that they accept.

use crate::{
    program::Geometry,
    value::{Type, Value},
};

/// An input of a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Port {
    pub(crate) name: &'static str,
    pub(crate) types: Types,
    pub(crate) default: Default,
    pub(crate) accepts: Accepts,
}

/// The types that an input may have.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Types {
    /// The node's own type.
    Same,
    /// The node's own type, or a float for all components.
    SameOrFloat,
    /// The vector that is as wide as the node's own type, or a float for all components.
    VectorOrFloat,
    /// One of these; the first one where the input is left out.
    Of(&'static [Type]),
}

/// What an input is when the document says nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Default {
    /// This number in every component.
    Number(f32),
    Value(Value<'static>),
    Geometry(Geometry),
    /// Nothing is connected.
    Unconnected,
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
    /// A direction: finite; zero is ignored.
    Direction,
    /// One of these words.
    Words(&'static [&'static str]),
    /// An integer from the first to the second, the same everywhere.
    Integers(i32, i32),
    /// A letter or digit for each component of the node's type.
    Channels,
    /// Nothing but the default: the rest is not implemented.
    DefaultOnly,
}

/// What `swizzle` makes components of.
const CHANNELS: &str = "rgbaxyzw01";

impl Port {
    pub(crate) const fn accepting(self, accepts: Accepts) -> Self {
        Self { accepts, ..self }
    }

    /// Its type where it is left out of a node of this type.
    pub(crate) fn default_type(&self, node: Type) -> Type {
        match self.types {
            Types::Same | Types::SameOrFloat => node,
            Types::VectorOrFloat => Type::Float,
            Types::Of(types) => types[0],
        }
    }

    /// Whether in a node of type `node` it may have a type.
    pub(crate) fn has_type(&self, node: Type, ty: Type) -> bool {
        self.types(node).contains(&ty)
    }

    /// The types that it may have in a node of type `node`.
    pub(crate) fn types(&self, node: Type) -> Vec<Type> {
        match self.types {
            Types::SameOrFloat if node != Type::Float => vec![node, Type::Float],
            Types::Same | Types::SameOrFloat => vec![node],
            Types::VectorOrFloat => match node.width() {
                2 => vec![Type::Vector2, Type::Float],
                3 => vec![Type::Vector3, Type::Float],
                4 => vec![Type::Vector4, Type::Float],
                _ => vec![Type::Float],
            },
            Types::Of(types) => types.to_vec(),
        }
    }

    /// Whether a value is the default.
    pub(crate) fn is_default(&self, value: Value<'_>) -> bool {
        match self.default {
            Default::Number(x) => value.components().iter().all(|&component| component == x),
            Default::Value(default) => default == value,
            Default::Geometry(_) | Default::Unconnected => false,
        }
    }
}

impl Accepts {
    /// The accepted values in words where `value`, in a node of type `node`, is none.
    pub(crate) fn refusal(self, value: Value<'_>, node: Type) -> Option<String> {
        let all = |inside: fn(f32) -> bool| value.components().iter().all(|&x| inside(x));
        let (accepted, range) = match self {
            Self::Any | Self::Roughness | Self::DefaultOnly => return None,
            Self::Unit => (all(|x| (0.0..=1.0).contains(&x)), "outside [0, 1]".to_owned()),
            Self::Positive => (all(|x| x > 0.0 && x.is_finite()), "outside (0, inf)".to_owned()),
            Self::NotNegative => (all(|x| x >= 0.0 && x.is_finite()), "outside [0, inf)".to_owned()),
            Self::Direction => (all(f32::is_finite), "not a direction; write one like 1, 0, 0".to_owned()),
            Self::Words(words) => {
                let known = matches!(value, Value::String(word) if words.contains(&word));
                (known, format!("not one of {}", words.join(", ")))
            }
            Self::Integers(low, high) => {
                let inside = matches!(value, Value::Integer(x) if (low..=high).contains(&x));
                let range = if low == high {
                    format!("and only {low} is")
                } else {
                    format!("and {low} to {high} are")
                };
                (inside, format!("{range} supported"))
            }
            Self::Channels => {
                let count = usize::from(node.width());
                let fits = |text: &str| text.len() == count && text.chars().all(|c| CHANNELS.contains(c));
                let inside = matches!(value, Value::String(text) if fits(text));
                (inside, format!("not {count} of the characters {CHANNELS}"))
            }
        };
        (!accepted).then_some(range)
    }

    /// Whether the numbers of an input may not vary over the surface.
    pub(crate) fn is_uniform(self) -> bool {
        matches!(self, Self::Integers(..))
    }

    /// Whether values outside can be brought inside; what isn't a number can't.
    pub(crate) fn is_range(self) -> bool {
        !matches!(self, Self::Words(_) | Self::Integers(..) | Self::Channels)
    }

    /// The nearest acceptable number: computed values are brought into range, written ones are refused.
    pub(crate) fn nearest(self, x: f32) -> f32 {
        /// A refractive index that is no longer singular.
        const SMALLEST: f32 = 1e-3;
        match self {
            Self::Unit => x.clamp(0.0, 1.0),
            Self::Positive => x.clamp(SMALLEST, f32::MAX),
            Self::NotNegative => x.clamp(0.0, f32::MAX),
            Self::Roughness => x.max(0.0),
            _ => x,
        }
    }
}

const fn port(name: &'static str, types: Types, default: Default) -> Port {
    Port { name, types, default, accepts: Accepts::Any }
}

/// An input of the node's own type.
pub(crate) const fn same(name: &'static str, default: f32) -> Port {
    port(name, Types::Same, Default::Number(default))
}

pub(crate) const fn same_or_float(name: &'static str, default: f32) -> Port {
    port(name, Types::SameOrFloat, Default::Number(default))
}

pub(crate) const fn vector_or_float(name: &'static str, default: f32) -> Port {
    port(name, Types::VectorOrFloat, Default::Number(default))
}

/// An input of one of several types, of the first one where it is left out.
pub(crate) const fn of(name: &'static str, types: &'static [Type], default: f32) -> Port {
    port(name, Types::Of(types), Default::Number(default))
}

pub(crate) const fn float(name: &'static str, default: f32) -> Port {
    of(name, &[Type::Float], default)
}

pub(crate) const fn integer(name: &'static str, default: f32) -> Port {
    of(name, &[Type::Integer], default)
}

pub(crate) const fn color(name: &'static str, default: f32) -> Port {
    of(name, &[Type::Color3], default)
}

pub(crate) const fn vector2(name: &'static str, default: f32) -> Port {
    of(name, &[Type::Vector2], default)
}

pub(crate) const fn vector3(name: &'static str, default: f32) -> Port {
    of(name, &[Type::Vector3], default)
}

/// An input of one type with a default that is no single number.
pub(crate) const fn valued(name: &'static str, types: &'static [Type], default: Value<'static>) -> Port {
    port(name, Types::Of(types), Default::Value(default))
}

pub(crate) const fn color3(name: &'static str, default: [f32; 3]) -> Port {
    valued(name, &[Type::Color3], Value::Color3(default))
}

pub(crate) const fn flag(name: &'static str, default: bool) -> Port {
    valued(name, &[Type::Boolean], Value::Boolean(default))
}

/// Any text; it is not used.
pub(crate) const fn text(name: &'static str) -> Port {
    valued(name, &[Type::String], Value::String(""))
}

/// One of these words, the first one where it is left out.
pub(crate) const fn word(name: &'static str, words: &'static [&'static str]) -> Port {
    valued(name, &[Type::String], Value::String(words[0])).accepting(Accepts::Words(words))
}

pub(crate) const fn file(name: &'static str) -> Port {
    valued(name, &[Type::Filename], Value::Filename(""))
}

/// A position or direction that is the geometry's own where it is left out.
pub(crate) const fn geometry(name: &'static str, default: Geometry) -> Port {
    port(name, Types::Of(&[Type::Vector3]), Default::Geometry(default))
}

pub(crate) const fn texcoord() -> Port {
    port("texcoord", Types::Of(&[Type::Vector2]), Default::Geometry(Geometry::Texcoord))
}

pub(crate) const fn connection(name: &'static str, types: &'static [Type]) -> Port {
    port(name, Types::Of(types), Default::Unconnected)
}
