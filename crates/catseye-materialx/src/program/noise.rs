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

/// Jenkins' mixing of three words before more of them are added.
fn mix_between([mut a, mut b, mut c]: [u32; 3]) -> [u32; 3] {
    for turns in [[4, 6, 8], [16, 19, 4]] {
        for turn in turns {
            a = a.wrapping_sub(c) ^ c.rotate_left(turn);
            c = c.wrapping_add(b);
            [a, b, c] = [b, c, a];
        }
    }
    [a, b, c]
}

/// A hash of up to four integers.
fn hash(keys: &[i32]) -> u32 {
    let start = 0xdead_beef_u32.wrapping_add((keys.len() as u32) << 2).wrapping_add(13);
    let mut state = [start; 3];
    for (i, key) in keys.iter().enumerate() {
        if i == 3 {
            state = mix_between(state);
        }
        state[i % 3] = state[i % 3].wrapping_add(*key as u32);
    }
    mix_finally(state)
}

/// Numbers in `[0, 1)` for the unit cell of a position: one, or several that differ in a last word of the
/// hash.
pub(crate) fn cell<const N: usize>(position: [f32; N], width: u8) -> Lanes {
    let mut keys = [0; 4];
    keys[..N].copy_from_slice(&position.map(|x| x.floor() as i32));
    core::array::from_fn(|i| {
        keys[N] = i as i32;
        let count = if width > 1 { N + 1 } else { N };
        unit(hash(&keys[..count]))
    })
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

/// Perlin noise in the plane, of as many components as asked for: each takes other bits of the lattice's
/// hash.
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

/// Jittered feature points about a position, one to a cell (Worley 1996).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Worley<const N: usize> {
    nearest: [f32; N],
    /// Of the three nearest.
    squared_distances: [f32; 3],
}

impl<const N: usize> Worley<N> {
    /// Of the nine cells about a position in the plane, or the 27 in space.
    pub(crate) fn new(position: [f32; N], jitter: f32) -> Self {
        let split = position.map(split);
        let mut found = Self { nearest: [0.0; N], squared_distances: [f32::INFINITY; 3] };
        for n in 0..3_i32.pow(N as u32) {
            // The last axis is the innermost: of points that are as near as each other the first one counts.
            let offset = |axis: usize| n / 3_i32.pow((N - 1 - axis) as u32) % 3 - 1;
            let mut keys = [0; 4];
            for axis in 0..N {
                keys[axis] = split[axis].0.wrapping_add(offset(axis));
            }
            let towards: [f32; N] = core::array::from_fn(|axis| {
                keys[N] = axis as i32;
                let jittered = (unit(hash(&keys[..=N])) - 0.5) * jitter + 0.5;
                offset(axis) as f32 + jittered - split[axis].1
            });
            let squared_distance = towards.iter().map(|x| x * x).sum();
            if squared_distance < found.squared_distances[0] {
                found.nearest = core::array::from_fn(|axis| towards[axis] + position[axis]);
            }
            found.insert(squared_distance);
        }
        found
    }

    fn insert(&mut self, mut distance: f32) {
        for slot in &mut self.squared_distances {
            if distance < *slot {
                core::mem::swap(slot, &mut distance);
            }
        }
    }

    /// To the nearest, second and third nearest of them.
    pub(crate) fn distances(self) -> Lanes {
        let [a, b, c] = self.squared_distances.map(f32::sqrt);
        [a, b, c, 0.0]
    }

    /// The nearest of them.
    pub(crate) fn nearest(self) -> Lanes {
        let mut lanes = [0.0; 4];
        lanes[..N].copy_from_slice(&self.nearest);
        lanes
    }
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
            assert!(cell([x, y], 3).iter().all(|x| (0.0..1.0).contains(x)));
            let near = Worley::new([x, y], 1.0).distances();
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
                cell([x, x, x], 3),
                Worley::new([x; 3], 1.0).distances(),
            );
        }
    }
}
