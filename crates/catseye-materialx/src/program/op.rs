//! The operations of patterns.

use std::sync::Arc;

use super::{
    Lanes, ShadingPoint, noise,
    noise::Worley,
    texture::{Filter, Texture, Wrap},
};

/// What the geometry gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Geometry {
    Texcoord,
    Position,
    PositionObject,
    Normal,
    Tangent,
    Bitangent,
    View,
}

/// An operation; most work on each component by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Op {
    /// Bits of the numbers.
    Constant([u32; 4]),
    Geometry(Geometry),
    Add,
    Subtract,
    Multiply,
    /// 0 where the divisor is 0.
    Divide,
    Modulo,
    Power,
    Min,
    Max,
    Atan2,
    Abs,
    Sign,
    Floor,
    Ceil,
    Round,
    Fract,
    Sqrt,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Ln,
    Exp,
    /// Background, foreground, amount.
    Mix,
    /// Value, lower edge, upper edge.
    Smoothstep,
    /// 1 or 0.
    Greater,
    GreaterOrEqual,
    Equal,
    /// The second source where the first one is not 0, else the third.
    Select,
    /// The first component in all of them.
    Splat,
    /// One component.
    Extract(u8),
    /// The sources' first components, in their order.
    Combine,
    Dot,
    Length,
    /// 0 for the zero vector.
    Normalize,
    Cross,
    RgbToHsv,
    HsvToRgb,
    /// Gradient noise of as many components, about `[-1, 1]`.
    Noise2,
    Noise3,
    /// Numbers in `[0, 1)` for each unit cell.
    Cell2,
    Cell3,
    /// Distances to the nearest feature points; sources are the position and the jitter.
    Worley2,
    Worley3,
    /// The nearest feature point, of the same sources.
    Nearest2,
    Nearest3,
    /// A texture at texture coordinates, with a default where nothing is.
    Image {
        texture: u32,
        wrap: [Wrap; 2],
        filter: Filter,
    },
    /// The refractive index and the extinction of a metal of this reflectance and edge colour (Gulbrandsen
    /// 2014).
    ArtisticIndex,
    ArtisticExtinction,
}

/// What keeps the bits of the components that a result has, by its width.
const MASKS: [[u32; 4]; 8] = {
    let mut masks = [[u32::MAX; 4]; 8];
    let mut i = 0;
    while i < 16 {
        if i % 4 >= i / 4 {
            masks[i / 4][i % 4] = 0;
        }
        i += 1;
    }
    masks
};

impl Op {
    pub(crate) fn constant(lanes: Lanes) -> Self {
        Self::Constant(lanes.map(f32::to_bits))
    }

    /// Whether its result differs from point to point even if its sources don't.
    pub(crate) fn reads_geometry(self) -> bool {
        matches!(self, Self::Geometry(_))
    }

    /// The result, its components beyond `width` 0.
    pub(crate) fn apply(
        self,
        width: u8,
        s: [&Lanes; 4],
        point: &ShadingPoint,
        textures: &[Arc<Texture>],
    ) -> Lanes {
        let result = self.lanes(width, s, point, textures);
        let mask = &MASKS[usize::from(width) & 7];
        core::array::from_fn(|i| f32::from_bits(result[i].to_bits() & mask[i]))
    }

    fn lanes(self, width: u8, s: [&Lanes; 4], point: &ShadingPoint, textures: &[Arc<Texture>]) -> Lanes {
        let [a, b, c, _] = s;
        let one = |f: fn(f32) -> f32| a.map(f);
        let two = |f: fn(f32, f32) -> f32| core::array::from_fn(|i| f(a[i], b[i]));
        // What takes long is computed for the components that there are.
        let each = |f: &dyn Fn(usize) -> f32| {
            let mut lanes = [0.0; 4];
            lanes.iter_mut().take(usize::from(width)).enumerate().for_each(|(i, lane)| *lane = f(i));
            lanes
        };
        let slow = |f: fn(f32) -> f32| each(&|i| f(a[i]));
        let three = |f: fn(f32, f32, f32) -> f32| core::array::from_fn(|i| f(a[i], b[i], c[i]));
        let truth = |x: bool| scalar(f32::from(u8::from(x)));
        match self {
            Self::Constant(bits) => bits.map(f32::from_bits),
            Self::Geometry(property) => geometry(property, point),
            Self::Add => two(|a, b| a + b),
            Self::Subtract => two(|a, b| a - b),
            Self::Multiply => two(|a, b| a * b),
            Self::Divide => two(|a, b| if b == 0.0 { 0.0 } else { a / b }),
            Self::Modulo => two(|a, b| if b == 0.0 { 0.0 } else { a - b * (a / b).floor() }),
            Self::Power => each(&|i| a[i].powf(b[i])),
            Self::Min => two(f32::min),
            Self::Max => two(f32::max),
            Self::Atan2 => each(&|i| a[i].atan2(b[i])),
            Self::Abs => one(f32::abs),
            Self::Sign => one(|x| if x == 0.0 { 0.0 } else { x.signum() }),
            Self::Floor => one(f32::floor),
            Self::Ceil => one(f32::ceil),
            Self::Round => one(f32::round),
            Self::Fract => one(|x| x - x.floor()),
            Self::Sqrt => one(|x| x.max(0.0).sqrt()),
            Self::Sin => slow(f32::sin),
            Self::Cos => slow(f32::cos),
            Self::Tan => slow(f32::tan),
            Self::Asin => slow(|x| x.clamp(-1.0, 1.0).asin()),
            Self::Acos => slow(|x| x.clamp(-1.0, 1.0).acos()),
            Self::Ln => slow(|x| x.max(f32::MIN_POSITIVE).ln()),
            Self::Exp => slow(f32::exp),
            Self::Mix => three(|bg, fg, t| bg * (1.0 - t) + fg * t),
            Self::Smoothstep => three(smoothstep),
            Self::Greater => truth(a[0] > b[0]),
            Self::GreaterOrEqual => truth(a[0] >= b[0]),
            Self::Equal => truth(a[0] == b[0]),
            Self::Select => {
                if a[0] != 0.0 {
                    *b
                } else {
                    *c
                }
            }
            Self::Splat => [a[0]; 4],
            Self::Extract(i) => scalar(a[usize::from(i) & 3]),
            Self::Combine => core::array::from_fn(|i| s[i][0]),
            Self::Dot => scalar(dot(a, b)),
            Self::Length => scalar(dot(a, a).sqrt()),
            Self::Normalize => normalize(a),
            Self::Cross => {
                [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0.0]
            }
            Self::RgbToHsv => hsv_from_rgb(a),
            Self::HsvToRgb => rgb_from_hsv(a),
            Self::Noise2 => noise::gradient_2d([a[0], a[1]], width),
            Self::Noise3 => noise::gradient_3d([a[0], a[1], a[2]], width),
            Self::Cell2 => noise::cell([a[0], a[1]], width),
            Self::Cell3 => noise::cell([a[0], a[1], a[2]], width),
            Self::Worley2 => Worley::new([a[0], a[1]], b[0]).distances(),
            Self::Worley3 => Worley::new([a[0], a[1], a[2]], b[0]).distances(),
            Self::Nearest2 => Worley::new([a[0], a[1]], b[0]).nearest(),
            Self::Nearest3 => Worley::new([a[0], a[1], a[2]], b[0]).nearest(),
            Self::Image { texture, wrap, filter } => {
                textures[texture as usize].look_up([a[0], a[1]], wrap, filter, *b)
            }
            Self::ArtisticIndex => two(|r, g| artistic_index(r, g).0),
            Self::ArtisticExtinction => two(|r, g| artistic_index(r, g).1),
        }
    }
}

fn scalar(x: f32) -> Lanes {
    [x, 0.0, 0.0, 0.0]
}

fn dot(a: &Lanes, b: &Lanes) -> f32 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn normalize(a: &Lanes) -> Lanes {
    let length = dot(a, a).sqrt();
    if length > 0.0 && length.is_finite() { a.map(|x| x / length) } else { [0.0; 4] }
}

fn geometry(property: Geometry, point: &ShadingPoint) -> Lanes {
    let [x, y, z] = match property {
        Geometry::Texcoord => [point.texcoord[0], point.texcoord[1], 0.0],
        Geometry::Position => point.position,
        Geometry::PositionObject => point.position_object,
        Geometry::Normal => point.normal,
        Geometry::Tangent => point.tangent,
        Geometry::Bitangent => point.bitangent,
        Geometry::View => point.view,
    };
    [x, y, z, 0.0]
}

fn smoothstep(x: f32, low: f32, high: f32) -> f32 {
    if x >= high {
        return 1.0;
    }
    if x <= low {
        return 0.0;
    }
    let t = (x - low) / (high - low);
    t * t * (3.0 - 2.0 * t)
}

/// Hue, saturation and value in `[0, 1]`; Smith, "Color Gamut Transform Pairs", SIGGRAPH 1978.
fn hsv_from_rgb(rgb: &Lanes) -> Lanes {
    let [r, g, b, alpha] = *rgb;
    let (max, min) = (r.max(g).max(b), r.min(g).min(b));
    let range = max - min;
    if range <= 0.0 || max <= 0.0 {
        return [0.0, 0.0, max, alpha];
    }
    let sixths = if max == r {
        (g - b) / range
    } else if max == g {
        2.0 + (b - r) / range
    } else {
        4.0 + (r - g) / range
    };
    [(sixths / 6.0).rem_euclid(1.0), range / max, max, alpha]
}

/// The inverse of [`hsv_from_rgb`]; a saturation below 0 is 0.
fn rgb_from_hsv(hsv: &Lanes) -> Lanes {
    let [h, s, v, alpha] = *hsv;
    let sixths = 6.0 * (h - h.floor());
    let s = s.max(0.0);
    // How far a channel is from full at this hue.
    let channel = |offset: f32| {
        let k = (offset + sixths).rem_euclid(6.0);
        v - v * s * k.min(4.0 - k).clamp(0.0, 1.0)
    };
    [channel(5.0), channel(3.0), channel(1.0), alpha]
}

/// Gulbrandsen, "Artist Friendly Metallic Fresnel", JCGT 3(4), 2014: n and k for a reflectance at normal
/// incidence and an edge tint, both in `[0, 1]`.
fn artistic_index(reflectance: f32, edge: f32) -> (f32, f32) {
    let r = reflectance.clamp(0.0, 0.99);
    let root = r.sqrt();
    let (lowest, highest) = ((1.0 - r) / (1.0 + r), (1.0 + root) / (1.0 - root));
    let n = highest + (lowest - highest) * edge.clamp(0.0, 1.0);
    let k2 = (r * (n + 1.0) * (n + 1.0) - (n - 1.0) * (n - 1.0)) / (1.0 - r);
    (n, k2.max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hue_goes_there_and_back() {
        for rgb in [[1.0, 0.0, 0.0, 0.0], [0.2, 0.9, 0.4, 0.0], [0.1, 0.1, 0.3, 0.0], [0.5, 0.5, 0.5, 0.0]] {
            let back = rgb_from_hsv(&hsv_from_rgb(&rgb));
            for (a, b) in rgb.iter().zip(back) {
                assert!((a - b).abs() < 1e-6, "{rgb:?} {back:?}");
            }
        }
        assert_eq!(hsv_from_rgb(&[0.0, 1.0, 0.0, 0.0])[0], 1.0 / 3.0);
    }

    #[test]
    fn artistic_metal_reflects_what_was_asked_for() {
        for (r, g) in [(0.9, 0.5), (0.5, 0.0), (0.04, 1.0)] {
            let (n, k) = artistic_index(r, g);
            let reflectance = ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
            assert!((reflectance - r).abs() < 1e-4, "{r} {g}: {reflectance}");
        }
    }
}
