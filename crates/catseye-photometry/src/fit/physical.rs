//! Whether a material is one between and beyond the rows that it was fitted to.

use crate::sheeting::{PreparedSheeting, Sheeting};
use crate::{Geometry, Goniometer, Quantity};

/// Degrees between two entrance angles that are looked at, and the last of them.
const STEP_DEG: f64 = 1.0;
const LAST_DEG: f64 = 75.0;
/// The greatest fall of `R_A` within so many degrees, up to an entrance angle of 60 degrees and beyond.
const WITHIN_DEG: f64 = 10.0;
const STEEP_DEG: f64 = 60.0;
const FALL: [f64; 2] = [10.0, 30.0];
/// How far `R_A` may rise over the entrance angle.
const RISE: f64 = 1.1;
/// Observation angles that are looked at, of more as many.
const ANGLES: usize = 16;

/// A change of `R_A` over the entrance angle that no sheeting has: a rise by more than 10 %, or a fall by
/// more than a factor of 10 within 10 degrees, 30 beyond an entrance angle of 60 degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fault {
    /// Observation angle, degrees.
    pub observation_deg: f64,
    /// The entrance angles, degrees.
    pub entrance_deg: [f64; 2],
    /// `R_A` at both.
    pub r_a: [f64; 2],
}

impl Sheeting {
    /// The first fault at the observation angles, in radians, in their order; of more than 16 as many are
    /// looked at.
    ///
    /// The material is measured as sheeting is, in the plane of incidence, from where the viewer is not
    /// nearer to the normal than the light, up to an entrance angle of 75 degrees.
    #[must_use]
    pub fn fault(&self, observations: &[f64]) -> Option<Fault> {
        let prepared = self.prepare().ok()?;
        let count = observations.len().min(ANGLES);
        let place = |i: usize| i * (observations.len() - 1) / count.saturating_sub(1).max(1);
        let chosen = (0..count).map(|i| observations[place(i)].to_degrees());
        chosen.into_iter().find_map(|observation_deg| fault_at(&prepared, observation_deg))
    }
}

fn fault_at(prepared: &PreparedSheeting<'_>, observation_deg: f64) -> Option<Fault> {
    let first = observation_deg.ceil();
    let count = ((LAST_DEG - first) / STEP_DEG).max(0.0) as usize + 1;
    let curve: Vec<[f64; 2]> = (0..count)
        .map(|i| {
            let entrance_deg = first + STEP_DEG * i as f64;
            let geometry = Geometry::from(Goniometer::from_degrees(observation_deg, entrance_deg, 0.0, 0.0));
            let f = prepared.eval(geometry.wo, geometry.wi);
            [entrance_deg, Quantity::RetroReflectionCoefficient.of_brdf(f, &geometry).unwrap_or_default()]
        })
        .collect();
    let is_fault = |[from, before]: [f64; 2], [to, after]: [f64; 2]| {
        let fall = if to <= STEEP_DEG { FALL[0] } else { FALL[1] };
        after > RISE * before || to - from <= WITHIN_DEG && after * fall < before
    };
    curve.iter().enumerate().find_map(|(i, &to)| {
        let from = curve[..i].iter().find(|from| is_fault(**from, to))?;
        Some(Fault { observation_deg, entrance_deg: [from[0], to[0]], r_a: [from[1], to[1]] })
    })
}
