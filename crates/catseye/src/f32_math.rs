//! Single-precision elementary functions without branches, calls or fused operations.
//!
//! They are inlined into the lobes, turn into vector code in `batch`, and give the same bits on every machine. All
//! polynomials are the functions' Taylor series, cut where the next term is below half a unit in the last place, and
//! summed as a tree, since their latency is what a single evaluation waits for. Selections are marked so that they do
//! not become branches, which random directions would mispredict.

use core::f32::consts::{FRAC_PI_2, LOG2_E};
use core::hint::select_unpredictable as select;

/// Added and subtracted, it rounds a value of magnitude below 2^22 to the nearest integer.
const ROUND: f32 = 12_582_912.0;

/// ln 2 in two parts; the first has so few bits that its multiples by any exponent are exact.
const LN_2_HIGH: f32 = 0.693_359_4;
const LN_2_LOW: f32 = -2.121_944_4e-4;

/// The bits of 1 less those of sqrt(1/2).
const HALF_OCTAVE: i32 = 0x3f80_0000 - 0x3f35_04f3;

/// Powers below this are flushed to 0.
const LOWEST_POWER: f32 = -115.0;

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
    let r2 = r * r;
    let low = 0.5 + r * (1.0 / 6.0);
    let middle = 1.0 / 24.0 + r * (1.0 / 120.0);
    let high = 1.0 / 720.0 + r * (1.0 / 5040.0);
    r + r2 * (low + r2 * (middle + r2 * high))
}

/// 2 to the power of x in `[-inf, 0]`, within 2 ulp; 0 below -115 and for NaN.
#[inline(always)]
pub(crate) fn exp2_nonpositive(x: f32) -> f32 {
    const C: [f32; 8] = exp2_series();
    let clamped = if x > LOWEST_POWER { x } else { LOWEST_POWER };
    let n_plus_round = clamped + ROUND;
    let r = clamped - (n_plus_round - ROUND);
    let r2 = r * r;
    let y = (C[0] + r * C[1]) + r2 * ((C[2] + r * C[3]) + r2 * ((C[4] + r * C[5]) + r2 * (C[6] + r * C[7])));
    y * select(x > LOWEST_POWER, exp2_of_rounded(n_plus_round), 0.0)
}

/// `ln(2)^k / k!`
const fn exp2_series() -> [f32; 8] {
    let mut series = [1.0; 8];
    let (mut term, mut k) = (1.0, 1);
    while k < 8 {
        term *= core::f64::consts::LN_2 / k as f64;
        series[k] = term as f32;
        k += 1;
    }
    series
}

/// `exp(x) - 1` for x in `[-80, 0]`, within 2 ulp.
#[inline(always)]
pub(crate) fn exp_m1_nonpositive(x: f32) -> f32 {
    let n_plus_round = x * LOG2_E + ROUND;
    let n = n_plus_round - ROUND;
    let r = (x - n * LN_2_HIGH) - n * LN_2_LOW;
    let scale = exp2_of_rounded(n_plus_round);
    scale * exp_m1_reduced(r) + (scale - 1.0)
}

/// The integer k and `atanh(s)` with `part / whole = 2^k (1+s)/(1-s)`, given also `lacking = whole - part` with all its
/// digits. The quotient is in `(0, 1]`; `whole` and `part` are normal numbers.
#[inline(always)]
fn reduce_log(lacking: f32, part: f32, whole: f32) -> (f32, f32) {
    // The difference of the bits is nearly 2^23 log2(part / whole); k is an integer near it, and 0 where little lacks.
    let log = (part.to_bits() as i32).wrapping_sub(whole.to_bits() as i32);
    let k = log.wrapping_add(HALF_OCTAVE) >> 23;
    let scaled = f32::from_bits((part.to_bits() as i32).wrapping_sub(k << 23) as u32);
    let s = select(k == 0, -lacking, scaled - whole) / (scaled + whole);
    let z = s * s;
    let low = 1.0 / 3.0 + z * (1.0 / 5.0);
    let high = 1.0 / 7.0 + z * (1.0 / 9.0);
    (k as f32, s + (s * z) * (low + z * z * high))
}

/// `exponent * log2(part / whole)` within 5 ulp, for a quotient in `(0, 1]` of normal numbers, given also `whole - part`.
#[inline(always)]
pub(crate) fn log2_power(exponent: f32, lacking: f32, part: f32, whole: f32) -> f32 {
    let (k, atanh) = reduce_log(lacking, part, whole);
    exponent * k + (exponent * (2.0 * LOG2_E)) * atanh
}

/// `ln(1 - x)` within 4 ulp, for x in `[0, 1)`, given also `1 - x`.
#[inline(always)]
pub(crate) fn ln_one_minus(x: f32, complement: f32) -> f32 {
    let (k, atanh) = reduce_log(x, complement, 1.0);
    k * LN_2_HIGH + (2.0 * atanh + k * LN_2_LOW)
}

/// Sine and cosine of `2 pi u` for u in `[0, 1]`, within 1.2e-7.
#[inline(always)]
pub(crate) fn sin_cos_turns(u: f32) -> (f32, f32) {
    let quarter_plus_round = u * 4.0 + ROUND;
    let r = (u * 4.0 - (quarter_plus_round - ROUND)) * FRAC_PI_2;
    let quarter = quarter_plus_round.to_bits();
    let z = r * r;
    let z2 = z * z;
    let sin = r + r * (z * ((-1.0 / 6.0 + z * (1.0 / 120.0)) + z2 * (-1.0 / 5040.0 + z * (1.0 / 362_880.0))));
    let cos = 1.0 + z * ((-0.5 + z * (1.0 / 24.0)) + z2 * (-1.0 / 720.0 + z * (1.0 / 40320.0)));
    let odd = quarter & 1 == 1;
    let (sin, cos) = (select(odd, cos, sin), select(odd, sin, cos));
    // Signs by quadrant: sine is negative in the last two, cosine in the middle two.
    let sin_sign = (quarter & 2) << 30;
    let cos_sign = (quarter.wrapping_add(1) & 2) << 30;
    (f32::from_bits(sin.to_bits() ^ sin_sign), f32::from_bits(cos.to_bits() ^ cos_sign))
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
            assert!(ulps(exp2_nonpositive(x), f64::from(x).exp2()) < 2.0, "exp2 {x}");
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
        assert_eq!(exp2_nonpositive(0.0), 1.0);
        assert_eq!(exp2_nonpositive(f32::NEG_INFINITY), 0.0);
        assert_eq!(exp2_nonpositive(f32::NAN), 0.0);
        assert_eq!(exp_m1_nonpositive(0.0), 0.0);
        assert_eq!(log2_power(7.0, 0.0, 1.0, 1.0), 0.0);
        assert_eq!(sin_cos_turns(0.25), (1.0, 0.0));
        assert_eq!(fract(3.75), 0.75);
    }
}
