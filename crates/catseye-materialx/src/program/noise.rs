//! Noise: hashes of lattice points, and functions between them.

use super::Lanes;

/// Jenkins' final mixing of three words ("lookup3", 2006, public domain).
fn mix_finally([mut a, mut b, mut c]: [u32; 3]) -> u32 {
    let steps = [14, 11, 25, 16, 4, 14, 24];
    for (i, turn) in steps.into_iter().enumerate() {
        let (from, to) = match i % 3 {
            0 => (b, &mut c),
            1 => (c, &mut a),
            _ => (a, &mut b),
        };
        *to = (*to ^ from).wrapping_sub(from.rotate_left(turn));
    }
    c
}

/// A hash of up to three integers.
fn hash(keys: &[i32]) -> u32 {
    let start = 0xdead_beef_u32.wrapping_add((keys.len() as u32) << 2).wrapping_add(13);
    let mut state = [start; 3];
    for (word, key) in state.iter_mut().zip(keys) {
        *word = word.wrapping_add(*key as u32);
    }
    mix_finally(state)
}

/// A number in `[0, 1)` for the unit cell of a position.
pub(crate) fn cell(position: &[f32]) -> f32 {
    let mut keys = [0; 3];
    let count = position.len().min(3);
    for (key, x) in keys.iter_mut().zip(position) {
        *key = x.floor() as i32;
    }
    unit(hash(&keys[..count]))
}

fn unit(hash: u32) -> f32 {
    // The 24 bits that a float can hold.
    (hash >> 8) as f32 / (1 << 24) as f32
}

/// Perlin's quintic; "Improving Noise", SIGGRAPH 2002.
fn fade(t: f32) -> f32 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// Lattice cell and position in it.
fn split(x: f32) -> (i32, f32) {
    let floor = x.floor();
    (floor as i32, x - floor)
}

/// What makes the gradient noise of the plane fill `[-1, 1]` about.
const SCALE_2D: f32 = 0.6616;
/// As [`SCALE_2D`], in space.
const SCALE_3D: f32 = 0.982;

/// Perlin noise in the plane, of as many components as asked for: each takes other bits of the lattice's hash.
pub(crate) fn gradient_2d([x, y]: [f32; 2], width: u8) -> Lanes {
    let ((xi, xf), (yi, yf)) = (split(x), split(y));
    let (u, v) = (fade(xf), fade(yf));
    let corners = [(0, 0), (1, 0), (0, 1), (1, 1)]
        .map(|(i, j)| (hash(&[xi.wrapping_add(i), yi.wrapping_add(j)]), xf - i as f32, yf - j as f32));
    components(width, |shift, mask| {
        let [a, b, c, d] = corners.map(|(hash, x, y)| slope_2d((hash >> shift) & mask, x, y));
        SCALE_2D * lerp(lerp(a, b, u), lerp(c, d, u), v)
    })
}

/// Perlin noise in space.
pub(crate) fn gradient_3d([x, y, z]: [f32; 3], width: u8) -> Lanes {
    let ((xi, xf), (yi, yf), (zi, zf)) = (split(x), split(y), split(z));
    let (u, v, w) = (fade(xf), fade(yf), fade(zf));
    let corner = |n: i32| {
        let (i, j, k) = (n & 1, n >> 1 & 1, n >> 2);
        let key = [xi.wrapping_add(i), yi.wrapping_add(j), zi.wrapping_add(k)];
        (hash(&key), [xf - i as f32, yf - j as f32, zf - k as f32])
    };
    let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(corner);
    components(width, |shift, mask| {
        let s = corners.map(|(hash, p)| slope_3d((hash >> shift) & mask, p));
        let plane = |i: usize| lerp(lerp(s[i], s[i + 1], u), lerp(s[i + 2], s[i + 3], u), v);
        SCALE_3D * lerp(plane(0), plane(4), w)
    })
}

/// One component takes the whole hash, several take a byte each.
fn components(width: u8, component: impl Fn(u32, u32) -> f32) -> Lanes {
    if width <= 1 {
        return [component(0, u32::MAX), 0.0, 0.0, 0.0];
    }
    core::array::from_fn(|i| if i < usize::from(width) { component(8 * i as u32, 0xff) } else { 0.0 })
}

/// One of eight directions along (1, 2) and its mirror images, times the offset.
fn slope_2d(hash: u32, x: f32, y: f32) -> f32 {
    let (long, short) = if hash & 4 == 0 { (y, x) } else { (x, y) };
    signed(short, hash & 1) + signed(2.0 * long, hash & 2)
}

/// One of the twelve edges of a cube, times the offset.
fn slope_3d(hash: u32, [x, y, z]: [f32; 3]) -> f32 {
    let h = hash & 15;
    let u = if h < 8 { x } else { y };
    let v = match h {
        0..=3 => y,
        12 | 14 => x,
        _ => z,
    };
    signed(u, h & 1) + signed(v, h & 2)
}

fn signed(x: f32, negative: u32) -> f32 {
    if negative == 0 { x } else { -x }
}

fn lerp(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// Distances to the nearest, second and third nearest of jittered feature points, one to a cell (Worley 1996).
pub(crate) fn worley_2d(position: [f32; 2], jitter: f32) -> Lanes {
    let ((xi, xf), (yi, yf)) = (split(position[0]), split(position[1]));
    let mut nearest = [f32::INFINITY; 3];
    for i in -1..=1 {
        for j in -1..=1 {
            let key = [xi.wrapping_add(i), yi.wrapping_add(j)];
            let at = |axis: i32| 0.5 + (unit(hash(&[key[0], key[1], axis])) - 0.5) * jitter;
            let (dx, dy) = (i as f32 + at(0) - xf, j as f32 + at(1) - yf);
            insert(&mut nearest, dx * dx + dy * dy);
        }
    }
    distances(nearest)
}

/// As [`worley_2d`], in space.
pub(crate) fn worley_3d(position: [f32; 3], jitter: f32) -> Lanes {
    let [(xi, xf), (yi, yf), (zi, zf)] = position.map(split);
    let mut nearest = [f32::INFINITY; 3];
    for n in 0..27 {
        let [i, j, k] = [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1];
        let cell = hash(&[xi.wrapping_add(i), yi.wrapping_add(j), zi.wrapping_add(k)]) as i32;
        let at = |axis: i32| 0.5 + (unit(hash(&[cell, axis])) - 0.5) * jitter;
        let d = [i as f32 + at(0) - xf, j as f32 + at(1) - yf, k as f32 + at(2) - zf];
        insert(&mut nearest, d.iter().map(|x| x * x).sum());
    }
    distances(nearest)
}

fn insert(nearest: &mut [f32; 3], mut distance: f32) {
    for slot in nearest {
        if distance < *slot {
            core::mem::swap(slot, &mut distance);
        }
    }
}

fn distances(squares: [f32; 3]) -> Lanes {
    let [a, b, c] = squares.map(f32::sqrt);
    [a, b, c, 0.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_vanishes_on_the_lattice_and_stays_in_range() {
        for n in 0..2000 {
            let x = n as f32 * 0.137;
            let y = n as f32 * -0.071;
            assert_eq!(gradient_2d([x.floor(), y.floor()], 1)[0], 0.0);
            assert_eq!(gradient_3d([x.floor(), y.floor(), 3.0], 1)[0], 0.0);
            for value in gradient_2d([x, y], 3).into_iter().chain(gradient_3d([x, y, 0.3 * x], 4)) {
                assert!(value.abs() <= 1.1, "{value}");
            }
            assert!((0.0..1.0).contains(&cell(&[x, y])));
            let near = worley_2d([x, y], 1.0);
            assert!(near[0] <= near[1] && near[1] <= near[2] && near[0] < 1.5);
        }
    }

    #[test]
    fn noise_is_continuous_and_varies() {
        let mut sum = 0.0;
        for n in 0..1000 {
            let x = n as f32 * 0.1;
            let step = gradient_3d([x + 1e-4, 0.4, 0.7], 1)[0] - gradient_3d([x, 0.4, 0.7], 1)[0];
            assert!(step.abs() < 1e-3, "{step}");
            sum += gradient_3d([x, 0.4, 0.7], 1)[0].abs();
        }
        assert!(sum > 50.0, "{sum}");
    }

    #[test]
    fn extreme_positions_are_harmless() {
        for x in [f32::MAX, f32::MIN, f32::INFINITY, f32::NAN, 1e30] {
            let _ = (
                gradient_2d([x, x], 4),
                gradient_3d([x, 0.0, x], 3),
                cell(&[x, x, x]),
                worley_3d([x; 3], 1.0),
            );
        }
    }
}
