//! The face on the sign.

use std::f32::consts::PI;

use glam::Vec2;

/// A cat's head with two ears, about 2 wide, centred; counter-clockwise.
pub(crate) fn head() -> Vec<Vec2> {
    /// Where the ears stand on the head, from the x axis.
    const EAR: [f32; 2] = [0.13 * PI, 0.40 * PI];
    let around = |angle: f32| Vec2::new(0.92 * angle.cos(), 0.74 * angle.sin());
    let arc = |from: f32, to: f32, steps: u32| {
        (0..=steps).map(move |i| around(from + (to - from) * i as f32 / steps as f32))
    };
    let mut outline: Vec<_> = arc(PI - EAR[0], 2.0 * PI + EAR[0], 40).collect();
    outline.push(Vec2::new(0.90, 1.06));
    outline.extend(arc(EAR[1], PI - EAR[1], 10));
    outline.push(Vec2::new(-0.90, 1.06));
    outline
}

/// The outline of an eye, its outer corner raised; `side` is 1 for the right one.
pub(crate) fn eye(side: f32) -> Vec<Vec2> {
    lens(0.27, 0.17).map(|p| Vec2::from_angle(0.22 * side).rotate(p) + Vec2::new(0.40 * side, 0.06)).collect()
}

/// The slit in an eye.
pub(crate) fn pupil(side: f32) -> Vec<Vec2> {
    lens(0.05, 0.15).map(|p| p + Vec2::new(0.40 * side, 0.06)).collect()
}

/// An ellipse with the given half axes.
fn lens(a: f32, b: f32) -> impl Iterator<Item = Vec2> {
    (0..24).map(move |i| {
        let angle = 2.0 * PI * i as f32 / 24.0;
        Vec2::new(a * angle.cos(), b * angle.sin())
    })
}
