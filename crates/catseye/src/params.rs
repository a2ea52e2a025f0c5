//! The parameters of the MaterialX node and their validation.

use core::fmt;

use crate::Real;

/// The inputs of the `retro_reflective_bsdf` node, under the names of the proposal.
///
/// `tangent_u` is not among them: it is the x axis of the local frame that directions are given in.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Params<T> {
    /// Roughness along `tangent_u`, in `[0, inf]`; 0 is a perfect retro-reflector. Default 0.
    pub roughness_u: T,
    /// Roughness across `tangent_u`, in `[0, inf]`; `None`, the default, means "as `roughness_u`".
    pub roughness_v: Option<T>,
    /// Colour of the single-scattering lobe, in `[0, 1]` per channel. Default 1.
    pub tint: [T; 3],
    /// Share of the energy lost by single scattering that is returned by a diffuse-like lobe, in `[0, 1]` per
    /// channel: 0 (the default) none, 1 all of it.
    pub multiscatter_tint: [T; 3],
}

impl<T: Real> Default for Params<T> {
    fn default() -> Self {
        Self { roughness_u: T::ZERO, roughness_v: None, tint: [T::ONE; 3], multiscatter_tint: [T::ZERO; 3] }
    }
}

impl<T: Real> Params<T> {
    /// Equal roughness in both directions, everything else as in [`Params::default`].
    #[must_use]
    pub fn isotropic(roughness: T) -> Self {
        Self { roughness_u: roughness, ..Self::default() }
    }

    /// Roughness along and across `tangent_u`, everything else as in [`Params::default`].
    #[must_use]
    pub fn anisotropic(roughness_u: T, roughness_v: T) -> Self {
        Self { roughness_u, roughness_v: Some(roughness_v), ..Self::default() }
    }

    /// The same parameters with another `roughness_v`; `None` means "as `roughness_u`".
    #[must_use]
    pub fn with_roughness_v(self, roughness_v: Option<T>) -> Self {
        Self { roughness_v, ..self }
    }

    /// The same parameters with another `tint`.
    #[must_use]
    pub fn with_tint(self, tint: [T; 3]) -> Self {
        Self { tint, ..self }
    }

    /// The same parameters with another `multiscatter_tint`.
    #[must_use]
    pub fn with_multiscatter_tint(self, multiscatter_tint: [T; 3]) -> Self {
        Self { multiscatter_tint, ..self }
    }

    /// Both roughnesses, the default of `roughness_v` resolved.
    #[must_use]
    pub fn roughness(&self) -> [T; 2] {
        [self.roughness_u, self.roughness_v.unwrap_or(self.roughness_u)]
    }

    /// The albedo per channel where single scattering without a tint keeps the share `rho`.
    #[inline(always)]
    #[must_use]
    pub fn albedo(&self, rho: T) -> [T; 3] {
        [0, 1, 2].map(|c| self.tint[c] * rho + self.multiscatter_tint[c] * (T::ONE - rho))
    }

    /// Every number as another type, by `convert`.
    #[must_use]
    pub fn map<U>(self, mut convert: impl FnMut(T) -> U) -> Params<U> {
        Params {
            roughness_u: convert(self.roughness_u),
            roughness_v: self.roughness_v.map(&mut convert),
            tint: self.tint.map(&mut convert),
            multiscatter_tint: self.multiscatter_tint.map(&mut convert),
        }
    }

    /// Checks every value against its range.
    ///
    /// # Errors
    /// The first value that is NaN or out of range, by name.
    pub fn validate(&self) -> Result<(), ParamError> {
        let [roughness_u, roughness_v] = self.roughness();
        for (name, value) in [("roughness_u", roughness_u), ("roughness_v", roughness_v)] {
            if value.is_nan() || value < T::ZERO {
                return Err(ParamError { name, channel: None, value: value.to_f64(), range: "[0, inf]" });
            }
        }
        validate_colour("tint", self.tint)?;
        validate_colour("multiscatter_tint", self.multiscatter_tint)
    }

    /// The nearest legal parameters: what a shading kernel does with values that it can't report.
    ///
    /// Roughness below 0 or NaN becomes 0, colours are clamped to `[0, 1]`, a NaN colour becomes 0.
    #[must_use]
    pub fn clamped(self) -> Self {
        // `max` returns its argument where the value is NaN.
        let colour = |c: [T; 3]| c.map(|x| x.max(T::ZERO).min(T::ONE));
        Self {
            roughness_u: self.roughness_u.max(T::ZERO),
            roughness_v: self.roughness_v.map(|r| r.max(T::ZERO)),
            tint: colour(self.tint),
            multiscatter_tint: colour(self.multiscatter_tint),
        }
    }
}

/// Checks every channel of a colour against `[0, 1]`.
pub(crate) fn validate_colour<T: Real>(name: &'static str, colour: [T; 3]) -> Result<(), ParamError> {
    for (channel, value) in colour.into_iter().enumerate() {
        validate_share(name, Some(channel), value)?;
    }
    Ok(())
}

/// Checks a number against `[0, 1]`.
pub(crate) fn validate_share<T: Real>(
    name: &'static str,
    channel: Option<usize>,
    value: T,
) -> Result<(), ParamError> {
    if value >= T::ZERO && value <= T::ONE {
        return Ok(());
    }
    Err(ParamError { name, channel, value: value.to_f64(), range: "[0, 1]" })
}

/// A parameter outside its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParamError {
    name: &'static str,
    channel: Option<usize>,
    value: f64,
    range: &'static str,
}

impl ParamError {
    /// The parameter's name, as in the MaterialX node.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The colour channel (0, 1, 2) the value stands in, where the parameter is a colour.
    #[must_use]
    pub fn channel(&self) -> Option<usize> {
        self.channel
    }

    /// The value.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.value
    }

    /// The range that the value is outside of, in the notation `[0, 1]`.
    #[must_use]
    pub fn range(&self) -> &'static str {
        self.range
    }
}

impl fmt::Display for ParamError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, value, range, .. } = self;
        match self.channel {
            None => write!(f, "{name} is {value}, outside {range}"),
            Some(channel) => write!(f, "{name}[{channel}] is {value}, outside {range}"),
        }
    }
}

impl core::error::Error for ParamError {}
