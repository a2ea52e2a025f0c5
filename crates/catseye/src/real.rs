//! The scalar type that the BSDF is written in: one text for `f32` and `f64`.

use core::fmt::{Debug, Display};
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::f32_math;

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// `f32` or `f64`. Sealed: the lobes' error bounds hold for these two only.
///
/// `f64` uses the platform's mathematical functions and is the oracle. `f32` uses the crate's own branch-free
/// ones, which the compiler can put into vector registers and which give the same bits everywhere.
pub trait Real:
    sealed::Sealed
    + Copy
    + Debug
    + Default
    + Display
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// 2.
    const TWO: Self;
    /// 1 / pi.
    const FRAC_1_PI: Self;
    /// The value nearest to `x`.
    fn from_f64(x: f64) -> Self;
    /// The value of a single-precision constant, exactly.
    fn from_f32(x: f32) -> Self;
    /// The value as `f64`, exactly.
    fn to_f64(self) -> f64;
    /// Whether the value is neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// Whether the value is NaN.
    fn is_nan(self) -> bool;
    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// The fractional part of a value in `[0, 2^22)`.
    #[must_use]
    fn fract(self) -> Self;
    /// `factor` times 2 to the power of a value in `[-inf, 0]`; 0 below -115, where denormals would cost more
    /// than they are worth.
    #[must_use]
    fn exp2_nonpositive(self, factor: Self) -> Self;
    /// `exp(self) - 1` for a value in `[-80, 0]`, accurate for small values.
    #[must_use]
    fn exp_m1_nonpositive(self) -> Self;
    /// `ln(1 - self)` for a value in `[0, 1)`, accurate for small values; `complement` is `1 - self`, from
    /// which the result is computed where `self` is near 1.
    #[must_use]
    fn ln_one_minus(self, complement: Self) -> Self;
    /// `exponent * log2(part / whole)` for `self = whole - part`, accurate where the quotient is near 1 and
    /// where it is small.
    #[must_use]
    fn log2_power(self, exponent: Self, part: Self, whole: Self) -> Self;
    /// `self * factor + summand`, rounded once where the feature `fused` is on and the target has an
    /// instruction for it.
    #[must_use]
    fn mul_add(self, factor: Self, summand: Self) -> Self;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// Sine and cosine of an angle in turns, in `[0, 1]`.
    fn sin_cos_turns(self) -> (Self, Self);

    /// The greater of two values; `other` where `self` is NaN.
    #[inline(always)]
    #[must_use]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    /// The smaller of two values; `other` where `self` is NaN.
    #[inline(always)]
    #[must_use]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
}

/// The functions of the standard library, or of `libm` without it.
macro_rules! math {
    ($std:expr, $libm:expr) => {{
        #[cfg(feature = "std")]
        {
            $std
        }
        #[cfg(all(not(feature = "std"), feature = "libm"))]
        {
            $libm
        }
    }};
}

/// Multiplies and adds, in one instruction where that is wanted and there is one.
macro_rules! mul_add {
    ($x:expr, $factor:expr, $summand:expr) => {{
        #[cfg(all(feature = "fused", any(target_feature = "fma", target_feature = "neon")))]
        {
            $x.mul_add($factor, $summand)
        }
        #[cfg(not(all(feature = "fused", any(target_feature = "fma", target_feature = "neon"))))]
        {
            $summand + $x * $factor
        }
    }};
}

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("catseye needs the feature `std` or, without it, the feature `libm`");

impl Real for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const TWO: Self = 2.0;
    const FRAC_1_PI: Self = core::f64::consts::FRAC_1_PI;
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn from_f32(x: f32) -> Self {
        Self::from(x)
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.is_finite()
    }
    #[inline(always)]
    fn is_nan(self) -> bool {
        self.is_nan()
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        math!(self.sqrt(), libm::sqrt(self))
    }
    #[inline(always)]
    fn fract(self) -> Self {
        math!(self.fract(), self - libm::trunc(self))
    }
    #[inline(always)]
    fn exp2_nonpositive(self, factor: Self) -> Self {
        if self > -115.0 { factor * math!(self.exp2(), libm::exp2(self)) } else { 0.0 }
    }
    #[inline(always)]
    fn exp_m1_nonpositive(self) -> Self {
        math!(self.exp_m1(), libm::expm1(self))
    }
    #[inline(always)]
    fn ln_one_minus(self, complement: Self) -> Self {
        if self < 0.25 {
            math!((-self).ln_1p(), libm::log1p(-self))
        } else {
            math!(complement.ln(), libm::log(complement))
        }
    }
    #[inline(always)]
    fn log2_power(self, exponent: Self, part: Self, whole: Self) -> Self {
        exponent * Real::ln_one_minus(self / whole, part / whole) * core::f64::consts::LOG2_E
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        mul_add!(self, factor, summand)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        math!(self.sin_cos(), libm::sincos(self))
    }
    #[inline(always)]
    fn sin_cos_turns(self) -> (Self, Self) {
        Real::sin_cos(self * core::f64::consts::TAU)
    }
}

impl Real for f32 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const TWO: Self = 2.0;
    const FRAC_1_PI: Self = core::f32::consts::FRAC_1_PI;
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x as Self
    }
    #[inline(always)]
    fn from_f32(x: f32) -> Self {
        x
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.is_finite()
    }
    #[inline(always)]
    fn is_nan(self) -> bool {
        self.is_nan()
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        math!(self.sqrt(), libm::sqrtf(self))
    }
    #[inline(always)]
    fn fract(self) -> Self {
        f32_math::fract(self)
    }
    #[inline(always)]
    fn exp2_nonpositive(self, factor: Self) -> Self {
        f32_math::exp2_nonpositive(self, factor)
    }
    #[inline(always)]
    fn exp_m1_nonpositive(self) -> Self {
        f32_math::exp_m1_nonpositive(self)
    }
    #[inline(always)]
    fn ln_one_minus(self, complement: Self) -> Self {
        f32_math::ln_one_minus(self, complement)
    }
    #[inline(always)]
    fn log2_power(self, exponent: Self, part: Self, whole: Self) -> Self {
        f32_math::log2_power(exponent, self, part, whole)
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        mul_add!(self, factor, summand)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        math!(self.sin_cos(), libm::sincosf(self))
    }
    #[inline(always)]
    fn sin_cos_turns(self) -> (Self, Self) {
        f32_math::sin_cos_turns(self)
    }
}
