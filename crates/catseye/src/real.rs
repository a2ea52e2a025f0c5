//! The scalar type that the BSDF is written in: one text for `f32` and `f64`.

use core::fmt::{Debug, Display};
use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// `f32` or `f64`. Sealed: the lobes' error bounds hold for these two only.
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
    + Sum
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// The largest finite value.
    const MAX: Self;
    /// The value nearest to `x`.
    fn from_f64(x: f64) -> Self;
    /// The value as `f64`, exactly.
    fn to_f64(self) -> f64;
    /// Whether the value is neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// Whether the value is NaN.
    fn is_nan(self) -> bool;
    /// The greater of two values; the other one where one is NaN.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// The smaller of two values; the other one where one is NaN.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// The absolute value.
    #[must_use]
    fn abs(self) -> Self;
    /// The value with the sign of `sign`.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;
    /// The greatest integer not above the value.
    #[must_use]
    fn floor(self) -> Self;
    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// e to the power of the value.
    #[must_use]
    fn exp(self) -> Self;
    /// `exp(self) - 1`, accurate for small values.
    #[must_use]
    fn exp_m1(self) -> Self;
    /// `ln(1 + self)`, accurate for small values.
    #[must_use]
    fn ln_1p(self) -> Self;
    /// The natural logarithm.
    #[must_use]
    fn ln(self) -> Self;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// The angle of the point `(other, self)` from the x axis, in radians.
    #[must_use]
    fn atan2(self, other: Self) -> Self;
}

macro_rules! real {
    ($t:ident, $($libm:ident)*) => {
        impl Real for $t {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const MAX: Self = $t::MAX;
            #[inline(always)]
            fn from_f64(x: f64) -> Self { x as $t }
            #[inline(always)]
            fn to_f64(self) -> f64 { f64::from(self) }
            #[inline(always)]
            fn is_finite(self) -> bool { self.is_finite() }
            #[inline(always)]
            fn is_nan(self) -> bool { self.is_nan() }
            #[inline(always)]
            fn max(self, other: Self) -> Self { self.max(other) }
            #[inline(always)]
            fn min(self, other: Self) -> Self { self.min(other) }
            #[inline(always)]
            fn abs(self) -> Self { self.abs() }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self { self.copysign(sign) }
            #[inline(always)]
            fn floor(self) -> Self { self.floor() }
            #[inline(always)]
            fn sqrt(self) -> Self { self.sqrt() }
            #[inline(always)]
            fn exp(self) -> Self { self.exp() }
            #[inline(always)]
            fn exp_m1(self) -> Self { self.exp_m1() }
            #[inline(always)]
            fn ln_1p(self) -> Self { self.ln_1p() }
            #[inline(always)]
            fn ln(self) -> Self { self.ln() }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) { self.sin_cos() }
            #[inline(always)]
            fn atan2(self, other: Self) -> Self { self.atan2(other) }
        }
    };
}
real!(f32,);
real!(f64,);
