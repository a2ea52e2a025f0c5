//! Single-precision elementary functions without branches or calls.
//!
//! They are inlined into the lobes, turn into vector code in `batch`, and give the same bits on every machine
//! (but for the feature `fused`). All polynomials meet the functions' Taylor series at Chebyshev nodes of the
//! range that they are used in, which needs one or two terms fewer than the series itself; their errors are
//! below half a unit in the last place. They are summed as a tree, since their latency is what a single
//! evaluation waits for. Selections are marked so that they do not become branches, which random directions
//! would mispredict.

use core::f32::consts::LOG2_E;
use core::f64::consts::{FRAC_1_SQRT_2, LN_2, PI};
use core::hint::select_unpredictable as select;

/// Added and subtracted, it rounds a value of magnitude below 2^22 to the nearest integer.
const ROUND: f32 = 12_582_912.0;

/// ln 2 in two parts; the first has so few bits that its multiples by any exponent are exact.
const LN_2_HIGH: f32 = 0.693_359_4;
const LN_2_LOW: f32 = -2.121_944_4e-4;

/// The bits of 1 less those of sqrt(1/2).
const HALF_OCTAVE: i32 = 0x3f80_0000 - 0x3f35_04f3;

/// The bits of a number that are not its fraction.
const WHOLE_OCTAVES: i32 = -0x80_0000;

/// Powers below this are flushed to 0.
const LOWEST_POWER: f32 = -115.0;

/// Chebyshev nodes in `[-1, 1]`.
const TWO_NODES: [f64; 2] = [-FRAC_1_SQRT_2, FRAC_1_SQRT_2];
const FIVE_NODES: [f64; 5] = [
    -0.951_056_516_295_153_5,
    -0.587_785_252_292_473_1,
    0.0,
    0.587_785_252_292_473_1,
    0.951_056_516_295_153_5,
];
const THREE_NODES: [f64; 3] = [-0.866_025_403_784_438_6, 0.0, 0.866_025_403_784_438_6];

/// Coefficients of the polynomial that meets a power series at Chebyshev nodes in `[0, range]`.
const fn economized<const N: usize>(series: [f64; 8], nodes: [f64; N], range: f64) -> [f32; N] {
    // Divided differences, Newton's form.
    let (mut x, mut divided) = ([0.0; N], [0.0; N]);
    let mut i = 0;
    while i < N {
        x[i] = 0.5 * range * (1.0 + nodes[i]);
        let mut k = series.len();
        while k > 0 {
            k -= 1;
            divided[i] = divided[i] * x[i] + series[k];
        }
        i += 1;
    }
    let mut order = 1;
    while order < N {
        let mut i = N - 1;
        while i >= order {
            divided[i] = (divided[i] - divided[i - 1]) / (x[i] - x[i - order]);
            i -= 1;
        }
        order += 1;
    }
    // Horner's scheme in x - x[i], multiplied out.
    let mut powers = [0.0; N];
    let mut i = N;
    while i > 0 {
        i -= 1;
        let mut k = N - 1;
        while k > 0 {
            powers[k] = powers[k - 1] - x[i] * powers[k];
            k -= 1;
        }
        powers[0] = divided[i] - x[i] * powers[0];
    }
    let mut rounded = [0.0; N];
    let mut i = 0;
    while i < N {
        rounded[i] = powers[i] as f32;
        i += 1;
    }
    rounded
}

/// The terms of `exp(base x)` from the order `first` on, every second one, over the power of x of the first
/// of them: a series in x^2.
const fn exp_series(base: f64, first: usize) -> [f64; 8] {
    let mut series = [0.0; 8];
    let (mut term, mut order) = (1.0, 0);
    while order < first + 16 {
        if order >= first && (order - first).is_multiple_of(2) {
            series[(order - first) / 2] = term;
        }
        order += 1;
        term *= base / order as f64;
    }
    series
}

/// `factor / (first + 2 k)`: the series of `factor` atanh(x) from the power `first` of x on, over that power.
const fn atanh_series(factor: f64, first: usize) -> [f64; 8] {
    let mut series = [0.0; 8];
    let mut k = 0;
    while k < series.len() {
        series[k] = factor / (first + 2 * k) as f64;
        k += 1;
    }
    series
}

/// `sin(pi x) / x - 2`: a series in x^2.
const fn sin_series() -> [f64; 8] {
    let mut series = exp_series(PI, 1);
    series[0] -= 2.0;
    let mut k = 1;
    while k < series.len() {
        series[k] = -series[k];
        k += 2;
    }
    series
}

/// `a * b + c`.
#[inline(always)]
fn fma(a: f32, b: f32, c: f32) -> f32 {
    crate::Real::mul_add(a, b, c)
}

/// Fractional part of a value in `[0, 2^22)`.
#[inline(always)]
pub(crate) fn fract(x: f32) -> f32 {
    let r = x - ((x + ROUND) - ROUND);
    select(r < 0.0, r + 1.0, r)
}

/// `2^n` for the integer-valued `n` in `[-126, 127]` that was rounded by adding `ROUND`.
#[inline(always)]
fn exp2_of_rounded(n_plus_round: f32) -> f32 {
    f32::from_bits((n_plus_round.to_bits() << 23).wrapping_add(1.0_f32.to_bits()))
}

/// `exp(r) - 1` for `|r|` up to ln(2) / 2.
#[inline(always)]
fn exp_m1_reduced(r: f32) -> f32 {
    const RANGE: f64 = 0.25 * LN_2 * LN_2;
    const EVEN: [f32; 3] = economized(exp_series(1.0, 2), THREE_NODES, RANGE);
    const ODD: [f32; 2] = economized(exp_series(1.0, 3), TWO_NODES, RANGE);
    let r2 = r * r;
    let low = fma(r, ODD[0], EVEN[0]);
    let high = fma(r2, EVEN[2], fma(r, ODD[1], EVEN[1]));
    fma(r2, fma(r2, high, low), r)
}

/// `factor` times 2 to the power of x in `[-inf, 0]`, within 2 ulp; 0 below -115 and for NaN.
#[inline(always)]
pub(crate) fn exp2_nonpositive(x: f32, factor: f32) -> f32 {
    const EVEN: [f32; 3] = economized(exp_series(LN_2, 2), THREE_NODES, 0.25);
    const ODD: [f32; 3] = economized(exp_series(LN_2, 1), THREE_NODES, 0.25);
    let clamped = if x > LOWEST_POWER { x } else { LOWEST_POWER };
    let n_plus_round = clamped + ROUND;
    let r = clamped - (n_plus_round - ROUND);
    let r2 = r * r;
    let low = fma(r2, fma(r, ODD[1], EVEN[0]), fma(r, ODD[0], 1.0));
    let high = fma(r2, EVEN[2], fma(r, ODD[2], EVEN[1]));
    let scale = select(x > LOWEST_POWER, exp2_of_rounded(n_plus_round), 0.0);
    fma(r2 * r2, high, low) * (scale * factor)
}

/// `exp(x) - 1` for x in `[-80, 0]`, within 2 ulp.
#[inline(always)]
pub(crate) fn exp_m1_nonpositive(x: f32) -> f32 {
    let n_plus_round = fma(x, LOG2_E, ROUND);
    let n = n_plus_round - ROUND;
    let r = fma(n, -LN_2_LOW, fma(n, -LN_2_HIGH, x));
    let scale = exp2_of_rounded(n_plus_round);
    fma(scale, exp_m1_reduced(r), scale - 1.0)
}

/// The integer k and s with `part / whole = 2^k (1+s)/(1-s)` and |s| below 0.2266, given also `lacking =
/// whole - part` with all its digits. The quotient is in `(0, 1]`; `whole` and `part` are normal numbers.
#[inline(always)]
fn reduce_log(lacking: f32, part: f32, whole: f32) -> (f32, f32) {
    // The difference of the bits is nearly 2^23 log2(part / whole); k is an integer near it, and 0 where
    // little lacks.
    let log = (part.to_bits() as i32).wrapping_sub(whole.to_bits() as i32);
    let octaves = log.wrapping_add(HALF_OCTAVE) & WHOLE_OCTAVES;
    let scaled = f32::from_bits((part.to_bits() as i32).wrapping_sub(octaves) as u32);
    // scaled - whole; where k is 0, that is -lacking with all its digits.
    let s = ((scaled - part) - lacking) / (scaled + whole);
    (octaves as f32 * (1.0 / 8_388_608.0), s)
}

/// The greatest square of what [`reduce_log`] returns.
const LOG_RANGE: f64 = 0.2266 * 0.2266;

/// `exponent * log2(part / whole)` within 5 ulp, for a quotient in `(0, 1]` of normal numbers, given also
/// `whole - part`.
#[inline(always)]
pub(crate) fn log2_power(exponent: f32, lacking: f32, part: f32, whole: f32) -> f32 {
    // log2(e) 2 atanh(s) = s (TWO_LOG2_E + z P(z)), z = s^2
    const TWO_LOG2_E: f32 = 2.0 * LOG2_E;
    const P: [f32; 3] = economized(atanh_series(2.0 / LN_2, 3), THREE_NODES, LOG_RANGE);
    let (k, s) = reduce_log(lacking, part, whole);
    let z = s * s;
    let log_over_s = fma(z * z, fma(z, P[2], P[1]), fma(z, P[0], TWO_LOG2_E));
    exponent * fma(s, log_over_s, k)
}

/// `ln(1 - x)` within 4 ulp, for x in `[0, 1)`, given also `1 - x`.
#[inline(always)]
pub(crate) fn ln_one_minus(x: f32, complement: f32) -> f32 {
    const P: [f32; 3] = economized(atanh_series(2.0, 3), THREE_NODES, LOG_RANGE);
    let (k, s) = reduce_log(x, complement, 1.0);
    let z = s * s;
    let rest = fma(z * z, P[2], fma(z, P[1], P[0]));
    fma(k, LN_2_HIGH, (s + s) + fma(s * z, rest, k * LN_2_LOW))
}

/// Sine and cosine of `2 pi u` for u in `[0, 1]`, within 1.2e-7.
#[inline(always)]
pub(crate) fn sin_cos_turns(u: f32) -> (f32, f32) {
    // Whole half turns only decide the sign. What is left, in half turns, and its complement are exact.
    let half_turns_plus_round = (u + u) + ROUND;
    let r = (u + u) - (half_turns_plus_round - ROUND);
    let sign = half_turns_plus_round.to_bits() << 31;
    let signed = |x: f32| f32::from_bits(x.to_bits() ^ sign);
    (signed(sin_half_turns(r)), signed(sin_half_turns(0.5 - r.abs())))
}

/// Sine of `pi x` for x in `[-1/2, 1/2]`.
#[inline(always)]
fn sin_half_turns(x: f32) -> f32 {
    // x (2 + P(x^2)): the sum of two small numbers has the smaller rounding errors.
    const P: [f32; 5] = economized(sin_series(), FIVE_NODES, 0.25);
    let z = x * x;
    let z2 = z * z;
    (x + x) + x * fma(z2, fma(z2, P[4], fma(z, P[3], P[2])), fma(z, P[1], P[0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Units in the last place of `exact` between it and `found`.
    fn ulps(found: f32, exact: f64) -> f64 {
        let magnitude = exact.abs() as f32;
        let unit = f64::from(f32::from_bits(magnitude.to_bits() + 1)) - f64::from(magnitude);
        (f64::from(found) - exact).abs() / unit
    }

    #[test]
    fn accuracy() {
        for i in 1..1_000_000_u32 {
            let u = i as f32 / 1e6;
            let exact = f64::from(u);
            let x = -79.9 * u * u;
            assert!(ulps(exp2_nonpositive(x, 1.0), f64::from(x).exp2()) < 2.0, "exp2 {x}");
            assert!(ulps(exp_m1_nonpositive(x), f64::from(x).exp_m1()) < 2.0, "exp_m1 {x}");
            let y = (1.0 - exact) as f32;
            assert!(ulps(ln_one_minus(u, y), (-exact).ln_1p()) < 4.0, "ln {u}");
            assert!(
                ulps(log2_power(1.0, u, y, 1.0), (-exact).ln_1p() / core::f64::consts::LN_2) < 5.0,
                "log2 {u}"
            );
            let (sin, cos) = sin_cos_turns(u);
            let angle = exact * core::f64::consts::TAU;
            assert!((f64::from(sin) - angle.sin()).abs() < 1.2e-7, "sin {u}");
            assert!((f64::from(cos) - angle.cos()).abs() < 1.2e-7, "cos {u}");
        }
        for exponent in 1..24 {
            let x = 0.7 * 0.5_f32.powi(exponent);
            assert!(ulps(ln_one_minus(x, 1.0 - x), (-f64::from(x)).ln_1p()) < 3.0, "ln {x}");
            assert!(ulps(exp_m1_nonpositive(-x), (-f64::from(x)).exp_m1()) < 2.0, "exp_m1 {x}");
        }
    }

    #[test]
    fn edges() {
        assert_eq!(exp2_nonpositive(0.0, 1.0), 1.0);
        assert_eq!(exp2_nonpositive(f32::NEG_INFINITY, 1.0), 0.0);
        assert_eq!(exp2_nonpositive(f32::NAN, 1.0), 0.0);
        assert_eq!(exp_m1_nonpositive(0.0), 0.0);
        assert_eq!(log2_power(7.0, 0.0, 1.0, 1.0), 0.0);
        assert_eq!(sin_cos_turns(0.25), (1.0, 0.0));
        assert_eq!(fract(3.75), 0.75);
    }
}
