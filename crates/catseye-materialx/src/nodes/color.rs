//! Adjustment of colours, and composition of two.

use super::{
    COLOR, FLOAT_AND_COLORS, FLOATS, Inputs, NodeDef, formula,
    math::remap,
    operation,
    port::{Port, color3, flag, float, same, same_or_float, valued},
};
use crate::{
    program::{Expr, Op},
    value::{Type, Value},
};

const BLEND: &[Port] = &[same("fg", 0.0), same("bg", 0.0), float("mix", 1.0)];
/// Luminance of `ACEScg`.
const WEIGHTS: Port = color3("lumacoeffs", [0.272_228_7, 0.674_081_8, 0.053_689_5]);
/// What MaterialX's code takes for 0: `M_FLOAT_EPS`.
const EPSILON: f32 = 1e-8;

/// Foreground over background with a share that `formula` mixes with the background.
fn blend<'p>(n: &Inputs<'p>, formula: impl Fn(Expr<'p>, Expr<'p>) -> Expr<'p>) -> Expr<'p> {
    let [fg, bg, mix] = n.all();
    bg.mix(formula(fg, bg), mix)
}

/// A quotient for each component, mixed with the background; 0 where the divisor, made of the foreground, is
/// 0.
fn blend_quotient<'p>(
    n: &Inputs<'p>,
    divisor: impl Fn(Expr<'p>) -> Expr<'p>,
    formula: impl Fn(Expr<'p>, Expr<'p>) -> Expr<'p>,
) -> Expr<'p> {
    let [fg, bg, mix] = n.all();
    divisor(fg).for_each([bg], |divisor, [bg]| {
        let blended = bg.mix(formula(divisor, bg), mix);
        divisor.abs().greater_or_equal(EPSILON).select(blended, n.program.number(0.0))
    })
}

/// A colour with the alpha of another, if that has one.
fn with_alpha_of<'p>(color: Expr<'p>, x: Expr<'p>) -> Expr<'p> {
    let parts = [color.part(0), color.part(1), color.part(2), x.part(3)];
    x.program().combine(&parts[..usize::from(x.width())])
}

fn luminance<'p>(x: Expr<'p>, weights: Expr<'p>) -> Expr<'p> {
    with_alpha_of(x.dot(weights).to(3), x)
}

pub(super) static NODES: &[NodeDef] = &[
    formula("luminance", COLOR, &[same("in", 0.0), WEIGHTS], |n| {
        let [x, weights] = n.all();
        luminance(x, weights)
    }),
    operation("rgbtohsv", COLOR, &[same("in", 0.0)], Op::RgbToHsv),
    operation("hsvtorgb", COLOR, &[same("in", 0.0)], Op::HsvToRgb),
    formula(
        "hsvadjust",
        COLOR,
        &[same("in", 0.0), valued("amount", &[Type::Vector3], Value::Vector3([0.0, 1.0, 1.0]))],
        |n| {
            let [x, amount] = n.all();
            let hsv = n.op(Op::RgbToHsv, &[x]);
            let hue = hsv.part(0) + amount.part(0);
            let [saturation, value] = [1, 2].map(|i| hsv.part(i) * amount.part(i));
            let adjusted = n.program.combine(&[hue, saturation, value]);
            n.op(Op::HsvToRgb, &[with_alpha_of(adjusted, x)])
        },
    ),
    formula("saturate", COLOR, &[same("in", 0.0), float("amount", 1.0), WEIGHTS], |n| {
        let [x, amount, weights] = n.all();
        luminance(x, weights).mix(x, amount)
    }),
    formula(
        "range",
        FLOATS,
        &[
            same("in", 0.0),
            same_or_float("inlow", 0.0),
            same_or_float("inhigh", 1.0),
            same_or_float("gamma", 1.0),
            same_or_float("outlow", 0.0),
            same_or_float("outhigh", 1.0),
            flag("doclamp", false),
        ],
        |n| {
            let [x, in_low, in_high, gamma, low, high, clamp] = n.all();
            let [zero, one] = [0.0, 1.0].map(|x| n.program.number(x));
            let share = remap(x, [in_low, in_high], [zero, one]);
            let bent = share.sign() * share.abs().power(1.0 / gamma);
            let result = low + bent * (high - low);
            clamp.select(result.clamp(low, high), result)
        },
    ),
    formula("mix", FLOATS, &[same("fg", 0.0), same("bg", 0.0), same_or_float("mix", 0.0)], |n| {
        let [fg, bg, mix] = n.all();
        bg.mix(fg, mix)
    }),
    formula("plus", FLOAT_AND_COLORS, BLEND, |n| blend(n, |fg, bg| bg + fg)),
    formula("minus", FLOAT_AND_COLORS, BLEND, |n| blend(n, |fg, bg| bg - fg)),
    formula("difference", FLOAT_AND_COLORS, BLEND, |n| blend(n, |fg, bg| (bg - fg).abs())),
    formula("screen", FLOAT_AND_COLORS, BLEND, |n| blend(n, |fg, bg| 1.0 - (1.0 - fg) * (1.0 - bg))),
    formula("overlay", FLOAT_AND_COLORS, BLEND, |n| {
        blend(n, |fg, bg| {
            fg.for_each([bg], |fg, [bg]| {
                let (dark, light) = (fg * bg * 2.0, 1.0 - (1.0 - bg) * (1.0 - fg) * 2.0);
                bg.greater_or_equal(0.5).select(light, dark)
            })
        })
    }),
    formula("burn", FLOAT_AND_COLORS, BLEND, |n| blend_quotient(n, |fg| fg, |fg, bg| 1.0 - (1.0 - bg) / fg)),
    formula("dodge", FLOAT_AND_COLORS, BLEND, |n| blend_quotient(n, |fg| 1.0 - fg, |rest, bg| bg / rest)),
    formula("inside", FLOAT_AND_COLORS, &[same("in", 0.0), float("mask", 1.0)], |n| {
        let [x, mask] = n.all();
        x * mask
    }),
    formula("outside", FLOAT_AND_COLORS, &[same("in", 0.0), float("mask", 0.0)], |n| {
        let [x, mask] = n.all();
        x * (1.0 - mask)
    }),
];
