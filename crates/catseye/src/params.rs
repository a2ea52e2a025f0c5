//! The parameters of the MaterialX node and their validation.

use core::fmt;

use crate::Real;

/// The inputs of the `retro_reflective_bsdf` node, under the names of the proposal.
///
/// `tangent_u` is not among them: it is the x axis of the local frame that directions are given in.
#[derive(Clone, Copy, Debug, PartialEq)]
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

    /// Checks every value against its range.
    ///
    /// # Errors
    /// The first value that is NaN or out of range, by name.
    pub fn validate(&self) -> Result<(), ParamError> {
        self.validate_roughness(None, "[0, inf]")?;
        for (name, colour) in [("tint", self.tint), ("multiscatter_tint", self.multiscatter_tint)] {
            for (channel, value) in colour.into_iter().enumerate() {
                if !(value >= T::ZERO && value <= T::ONE) {
                    return Err(ParamError {
                        name,
                        channel: Some(channel),
                        value: value.to_f64(),
                        range: "[0, 1]",
                    });
                }
            }
        }
        Ok(())
    }

    /// Checks both roughnesses against 0 and an upper limit, if any.
    pub(crate) fn validate_roughness(&self, limit: Option<T>, range: &'static str) -> Result<(), ParamError> {
        let [roughness_u, roughness_v] = self.roughness();
        for (name, value) in [("roughness_u", roughness_u), ("roughness_v", roughness_v)] {
            if value.is_nan() || value < T::ZERO || limit.is_some_and(|limit| value > limit) {
                return Err(ParamError { name, channel: None, value: value.to_f64(), range });
            }
        }
        Ok(())
    }

    /// The nearest legal parameters: what a shading kernel does with values that it can't report.
    ///
    /// Roughness below 0 or NaN becomes 0, colours are clamped to `[0, 1]`, a NaN colour becomes 0.
    #[must_use]
    pub fn clamped(self) -> Self {
        // `greater` returns its argument where the value is NaN.
        let colour = |c: [T; 3]| c.map(|x| x.greater(T::ZERO).lesser(T::ONE));
        Self {
            roughness_u: self.roughness_u.greater(T::ZERO),
            roughness_v: self.roughness_v.map(|r| r.greater(T::ZERO)),
            tint: colour(self.tint),
            multiscatter_tint: colour(self.multiscatter_tint),
        }
    }
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

    /// The value, and the range it is outside of in the notation `[0, 1]`.
    #[must_use]
    pub fn value_and_range(&self) -> (f64, &'static str) {
        (self.value, self.range)
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
