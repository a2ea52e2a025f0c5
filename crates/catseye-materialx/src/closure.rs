//! What a surface is made of: a tree of BSDF closures with resolved inputs.

use catseye::Params;

/// Which directions a dielectric closure scatters into: MaterialX's `scatter_mode`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ScatterMode {
    /// `R`: reflection only.
    #[default]
    Reflect,
    /// `T`: transmission only.
    Transmit,
    /// `RT`: both.
    ReflectTransmit,
}

/// A BSDF expression. Inputs have MaterialX's names, units and ranges; colours are linear Rec. 709.
#[derive(Clone, Debug, PartialEq)]
pub enum Closure {
    /// Nothing: an unconnected BSDF input.
    None,
    /// `retro_reflective_bsdf`.
    RetroReflective {
        /// Share of the lobe, in `[0, 1]`.
        weight: f32,
        /// The node's parameters, validated.
        params: Params<f32>,
        /// `tangent_u` in world space where the document gives one.
        tangent_u: Option<[f32; 3]>,
    },
    /// `oren_nayar_diffuse_bsdf`.
    OrenNayarDiffuse {
        /// Share of the lobe, in `[0, 1]`.
        weight: f32,
        /// Diffuse albedo, in `[0, 1]` per channel.
        color: [f32; 3],
        /// Standard deviation of the facets' slope; 0 is Lambert.
        roughness: f32,
        /// Whether multiple scattering among the facets is compensated (EON instead of qualitative Oren-Nayar).
        energy_compensation: bool,
    },
    /// `dielectric_bsdf` with the GGX distribution.
    Dielectric {
        /// Share of the lobe, in `[0, 1]`.
        weight: f32,
        /// Colour of reflection and transmission, in `[0, 1]` per channel.
        tint: [f32; 3],
        /// Index of refraction.
        ior: f32,
        /// GGX alpha along and across the tangent.
        roughness: [f32; 2],
        /// Directions it scatters into.
        scatter_mode: ScatterMode,
    },
    /// `mix`: `amount * foreground + (1 - amount) * background`.
    Mix {
        /// The closure at `amount` 1.
        foreground: Box<Closure>,
        /// The closure at `amount` 0.
        background: Box<Closure>,
        /// Mixing amount, in `[0, 1]`.
        amount: f32,
    },
    /// `layer`: what `top` does not reflect reaches `base`.
    Layer {
        /// The upper closure.
        top: Box<Closure>,
        /// The closure below it.
        base: Box<Closure>,
    },
    /// `add`: the sum of two closures.
    Add {
        /// First summand.
        a: Box<Closure>,
        /// Second summand.
        b: Box<Closure>,
    },
    /// `multiply`: a closure scaled per channel.
    Multiply {
        /// The scaled closure.
        closure: Box<Closure>,
        /// Factor, in `[0, 1]` per channel.
        factor: [f32; 3],
    },
}

/// A surface material of a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The name of the `surfacematerial` node.
    pub name: String,
    /// The BSDF of its surface.
    pub bsdf: Closure,
    /// Surface opacity, in `[0, 1]`.
    pub opacity: f32,
}
