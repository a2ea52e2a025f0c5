//! Why there is nothing to be seen.

use crate::significant;

/// What is wrong with a scene, and the way out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DriveError {
    /// A length or an angle out of its range.
    #[error("{name} is {}, outside {range}", significant(*value, 6))]
    Range {
        /// What it is.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The range, and the unit.
        range: &'static str,
    },
    /// A sign that is not in front of everything else.
    #[error(
        "at a distance of {} m the sign is {} m ahead of the headlamps, not in front of lamps and eye: \
         take a greater distance, or a wider curve",
        significant(*distance_m, 6), significant(*ahead_m, 3)
    )]
    Behind {
        /// Distance along the road.
        distance_m: f64,
        /// Distance along the vehicle's axis.
        ahead_m: f64,
    },
    /// A sign that turns its back.
    #[error(
        "at a distance of {} m the sign shows its back or its edge to the {whom}: turn it to the traffic",
        significant(*distance_m, 6)
    )]
    Back {
        /// Distance along the road.
        distance_m: f64,
        /// Who is behind it: the eye or a lamp.
        whom: &'static str,
    },
    /// A direction in which nothing is known of the lamp.
    #[error(
        "at a distance of {} m the sign is {} to the right of the lamp's axis and {} above it, where the \
         lamp's file has no intensity: take a lamp that was measured there, or another distance",
        significant(*distance_m, 6), degrees(*right_deg), degrees(*up_deg)
    )]
    Dark {
        /// Distance along the road.
        distance_m: f64,
        /// Angle to the right.
        right_deg: f64,
        /// Angle upwards.
        up_deg: f64,
    },
}

fn degrees(angle: f64) -> String {
    format!("{} deg", significant(angle, 3))
}
