//! Single-precision elementary functions without branches, calls or fused operations.
//!
//! They are inlined into the lobes, turn into vector code in `batch`, and give the same bits on every machine. All
//! polynomials are the functions' Taylor series, cut where the next term is below half a unit in the last place.

/// Added and subtracted, it rounds a value of magnitude below 2^22 to the nearest integer.
const ROUND: f32 = 12_582_912.0;

/// ln 2 in two parts; the first has so few bits that its multiples by any exponent are exact.
const LN_2_HIGH: f32 = 0.693_359_4;
const LN_2_LOW: f32 = -2.121_944_4e-4;

/// The bits of sqrt(1/2), where mantissas are folded so that they lie around 1.
const SQRT_HALF_BITS: u32 = 0x3f35_04f3;

/// Fractional part of a value in `[0, 2^22)`.
#[inline(always)]
pub(crate) fn fract(x: f32) -> f32 {
    let r = x - ((x + ROUND) - ROUND);
    if r < 0.0 { r + 1.0 } else { r }
}

/// `2^n` for the integer-valued `n` in `[-126, 127]` that was rounded by adding `ROUND`.
#[inline(always)]
fn exp2_of_rounded(n_plus_round: f32) -> f32 {
    f32::from_bits((n_plus_round.to_bits() << 23).wrapping_add(1.0_f32.to_bits()))
}

/// `exp(r) - 1` for `|r|` up to ln(2) / 2.
#[inline(always)]
fn exp_m1_reduced(r: f32) -> f32 {
    let p = 1.0 / 120.0 + r * (1.0 / 720.0 + r * (1.0 / 5040.0));
    let p = 0.5 + r * (1.0 / 6.0 + r * (1.0 / 24.0 + r * p));
    r + r * r * p
}

/// Splits x into `n ln 2 + r` and returns `r` and n as rounded by adding `ROUND`.
#[inline(always)]
fn reduce_exp(x: f32) -> (f32, f32) {
    let n_plus_round = x * core::f32::consts::LOG2_E + ROUND;
    let n = n_plus_round - ROUND;
    ((x - n * LN_2_HIGH) - n * LN_2_LOW, n_plus_round)
}

/// e to the power of x in `[-inf, 0]`, within 2 ulp; 0 below -80.
#[inline(always)]
pub(crate) fn exp_falling(x: f32) -> f32 {
    let clamped = if x > -80.0 { x } else { -80.0 };
    let (r, n_plus_round) = reduce_exp(clamped);
    let y = (1.0 + exp_m1_reduced(r)) * exp2_of_rounded(n_plus_round);
    if x > -80.0 { y } else { 0.0 }
}

/// `exp(x) - 1` for x in `[-80, 0]`, within 2 ulp.
#[inline(always)]
pub(crate) fn exp_m1_falling(x: f32) -> f32 {
    let (r, n_plus_round) = reduce_exp(x);
    let scale = exp2_of_rounded(n_plus_round);
    scale * exp_m1_reduced(r) + (scale - 1.0)
}

/// `ln(1 - x)` for x in `[0, 1)`, given `y = 1 - x` to full relative precision, within 3 ulp.
#[inline(always)]
pub(crate) fn ln_one_minus(x: f32, y: f32) -> f32 {
    // y = 2^k (1 + f) with 1 + f in [sqrt(1/2), sqrt(2)); where k = 0, f is -x with all its digits.
    let bits = y.to_bits().wrapping_sub(SQRT_HALF_BITS);
    let k = (bits as i32) >> 23;
    let f = f32::from_bits((bits & 0x007f_ffff) + SQRT_HALF_BITS) - 1.0;
    let f = if k == 0 { -x } else { f };
    // ln(1 + f) = 2 atanh(s)
    let s = f / (2.0 + f);
    let z = s * s;
    let p = z * (1.0 / 3.0 + z * (1.0 / 5.0 + z * (1.0 / 7.0 + z * (1.0 / 9.0))));
    let k = k as f32;
    k * LN_2_HIGH + (2.0 * (s + s * p) + k * LN_2_LOW)
}

/// Sine and cosine of `2 pi u` for u in `[0, 1]`, within 2 ulp.
#[inline(always)]
pub(crate) fn sin_cos_turns(u: f32) -> (f32, f32) {
    let quarter_plus_round = u * 4.0 + ROUND;
    let r = (u * 4.0 - (quarter_plus_round - ROUND)) * core::f32::consts::FRAC_PI_2;
    let quarter = quarter_plus_round.to_bits();
    let z = r * r;
    let sin = r + r * z * (-1.0 / 6.0 + z * (1.0 / 120.0 + z * (-1.0 / 5040.0 + z * (1.0 / 362_880.0))));
    let cos = 1.0 + z * (-0.5 + z * (1.0 / 24.0 + z * (-1.0 / 720.0 + z * (1.0 / 40320.0))));
    let odd = quarter & 1 == 1;
    let (sin, cos) = (if odd { cos } else { sin }, if odd { sin } else { cos });
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
        let unit =
            f64::from(f32::from_bits((exact.abs() as f32).to_bits() + 1)) - f64::from(exact.abs() as f32);
        (f64::from(found) - exact).abs() / unit
    }

    #[test]
    fn accuracy() {
        for i in 1..1_000_000_u32 {
            let u = i as f32 / 1e6;
            let x = -79.9 * u * u;
            let exact = f64::from(x);
            assert!(ulps(exp_falling(x), exact.exp()) < 2.0, "exp {x}");
            assert!(ulps(exp_m1_falling(x), exact.exp_m1()) < 2.0, "exp_m1 {x}");
            let y = (1.0 - f64::from(u)) as f32;
            assert!(ulps(ln_one_minus(u, y), (-f64::from(u)).ln_1p()) < 3.0, "ln {u}");
            let (sin, cos) = sin_cos_turns(u);
            let angle = f64::from(u) * core::f64::consts::TAU;
            assert!((f64::from(sin) - angle.sin()).abs() < 1.2e-7, "sin {u}");
            assert!((f64::from(cos) - angle.cos()).abs() < 1.2e-7, "cos {u}");
        }
        for exponent in 1..24 {
            let x = 0.7 * 0.5_f32.powi(exponent);
            assert!(ulps(ln_one_minus(x, 1.0 - x), (-f64::from(x)).ln_1p()) < 3.0, "ln {x}");
            assert!(ulps(exp_m1_falling(-x), (-f64::from(x)).exp_m1()) < 2.0, "exp_m1 {x}");
        }
    }

    #[test]
    fn edges() {
        assert_eq!(exp_falling(0.0), 1.0);
        assert_eq!(exp_falling(f32::NEG_INFINITY), 0.0);
        assert_eq!(exp_falling(f32::NAN), 0.0);
        assert_eq!(exp_m1_falling(0.0), 0.0);
        assert_eq!(ln_one_minus(0.0, 1.0), 0.0);
        assert_eq!(sin_cos_turns(0.25), (1.0, 0.0));
        assert_eq!(fract(3.75), 0.75);
    }
}
