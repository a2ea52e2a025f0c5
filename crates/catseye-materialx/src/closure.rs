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
#[non_exhaustive]
pub enum Closure {
    /// Nothing: an unconnected BSDF input.
    None,
    /// `retro_reflective_bsdf`.
    RetroReflective {
        /// Share of the lobe, in `[0, 1]`.
        weight: f32,
        /// The node's parameters, validated.
        params: Params<f32>,
    },
    /// `oren_nayar_diffuse_bsdf`.
    OrenNayarDiffuse {
        /// Share of the lobe, in `[0, 1]`.
        weight: f32,
        /// Diffuse albedo, in `[0, 1]` per channel.
        color: [f32; 3],
        /// Standard deviation of the facets' slope; 0 is Lambert.
        roughness: f32,
        /// Whether multiple scattering among the facets is compensated (EON instead of qualitative
        /// Oren-Nayar).
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
        /// Whether light is sent back instead of mirrored: `wo` is reflected about the normal first.
        retroreflective: bool,
        /// Directions it scatters into.
        scatter_mode: ScatterMode,
    },
    /// `conductor_bsdf` with the GGX distribution.
    Conductor {
        /// Share of the lobe, in `[0, 1]`.
        weight: f32,
        /// Real part of the refractive index per channel.
        ior: [f32; 3],
        /// Imaginary part of the refractive index per channel.
        extinction: [f32; 3],
        /// GGX alpha along and across the tangent.
        roughness: [f32; 2],
        /// As for `Dielectric`.
        retroreflective: bool,
    },
    /// `generalized_schlick_bsdf` with the GGX distribution.
    GeneralizedSchlick {
        /// Share of the lobe, in `[0, 1]`.
        weight: f32,
        /// Reflectance at normal incidence.
        color0: [f32; 3],
        /// What multiplies Schlick's curve at 82 degrees.
        color82: [f32; 3],
        /// Reflectance at grazing incidence.
        color90: [f32; 3],
        /// Schlick's exponent.
        exponent: f32,
        /// GGX alpha along and across the tangent.
        roughness: [f32; 2],
        /// As for `Dielectric`.
        retroreflective: bool,
        /// Directions it scatters into.
        scatter_mode: ScatterMode,
    },
    /// `burley_diffuse_bsdf`.
    BurleyDiffuse {
        /// Share of the lobe, in `[0, 1]`.
        weight: f32,
        /// Diffuse albedo, in `[0, 1]` per channel.
        color: [f32; 3],
        /// Roughness, in `[0, 1]`.
        roughness: f32,
    },
    /// `translucent_bsdf`: diffuse transmission.
    Translucent {
        /// Share of the lobe, in `[0, 1]`.
        weight: f32,
        /// Transmitted share, in `[0, 1]` per channel.
        color: [f32; 3],
    },
    /// `sheen_bsdf`: backscattering of fibres.
    Sheen {
        /// Share of the lobe, in `[0, 1]`.
        weight: f32,
        /// Colour of the reflection, in `[0, 1]` per channel.
        color: [f32; 3],
        /// Roughness, in `(0, 1]`.
        roughness: f32,
    },
    /// A lobe about a normal or tangent of its own: the inputs `normal`, `tangent` and `tangent_u` of its
    /// node.
    Oriented {
        /// The lobe.
        closure: Box<Closure>,
        /// Unit normal in world space; `None` for the surface's.
        normal: Option<[f32; 3]>,
        /// Tangent in world space; `None` for the surface's.
        tangent: Option<[f32; 3]>,
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

/// What a surface is made of, at a point or everywhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// How it scatters.
    pub bsdf: Closure,
    /// Opacity, in `[0, 1]`.
    pub opacity: f32,
    /// Radiance that it emits towards the viewer.
    pub emission: [f32; 3],
}

impl Default for Surface {
    /// Opaque, it scatters and emits nothing.
    fn default() -> Self {
        Self { bsdf: Closure::None, opacity: 1.0, emission: [0.0; 3] }
    }
}
