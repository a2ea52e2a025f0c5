//! How files write down two directions.

use catseye::Vec3;

/// A parametrisation of two directions, by ALTA's names. Angles are radians.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coordinates {
    /// Polar angle of the light at azimuth 0, then the view's azimuthal equidistant projection.
    LightViewProjected,
    /// Polar angles of view and light, and the light's azimuth; the view's is 0.
    ViewLight,
    /// Polar angle of the half vector, then polar angle and azimuth of the view about it.
    HalfDifference,
    /// As `HalfDifference`, the half vector's azimuth after its polar angle.
    FullHalfDifference,
    /// Polar angle and azimuth of the light, then of the view.
    Spherical,
    /// The view, then the light, as vectors.
    Cartesian,
}

const NAMES: [(Coordinates, &str, usize); 6] = [
    (Coordinates::LightViewProjected, "ISOTROPIC_TL_TV_PROJ_DPHI", 3),
    (Coordinates::ViewLight, "ISOTROPIC_TV_TL_DPHI", 3),
    (Coordinates::HalfDifference, "RUSIN_TH_TD_PD", 3),
    (Coordinates::FullHalfDifference, "RUSIN_TH_PH_TD_PD", 4),
    (Coordinates::Spherical, "SPHERICAL_TL_PL_TV_PV", 4),
    (Coordinates::Cartesian, "CARTESIAN", 6),
];

impl Coordinates {
    /// The parametrisation of a name, or the names that are known.
    pub(super) fn named(name: &str) -> Result<Self, String> {
        let found = NAMES.iter().find(|(_, known, _)| *known == name);
        found.map(|(coordinates, ..)| *coordinates).ok_or_else(|| NAMES.map(|(_, known, _)| known).join(", "))
    }

    /// How many numbers it takes.
    pub(super) fn dimension(self) -> usize {
        NAMES.iter().find(|(coordinates, ..)| *coordinates == self).map_or(0, |(.., dimension)| *dimension)
    }

    /// View (`wo`) and light (`wi`) for as many numbers as [`Coordinates::dimension`] says.
    pub(super) fn directions(self, x: &[f64]) -> [Vec3<f64>; 2] {
        match self {
            Self::LightViewProjected => {
                let view = Vec3::from_angles(x[1].hypot(x[2]), x[2].atan2(x[1]));
                [view, Vec3::from_angles(x[0], 0.0)]
            }
            Self::ViewLight => [Vec3::from_angles(x[0], 0.0), Vec3::from_angles(x[1], x[2])],
            Self::HalfDifference => half_difference([x[0], 0.0], [x[1], x[2]]),
            Self::FullHalfDifference => half_difference([x[0], x[1]], [x[2], x[3]]),
            Self::Spherical => [Vec3::from_angles(x[2], x[3]), Vec3::from_angles(x[0], x[1])],
            Self::Cartesian => {
                [Vec3::new(x[0], x[1], x[2]), Vec3::new(x[3], x[4], x[5])].map(Vec3::normalized)
            }
        }
    }
}

/// Directions from the half vector's polar angle and azimuth and the difference's (Rusinkiewicz 1998): the
/// first direction stands at the difference's angles in a frame whose z axis is the half vector, the second
/// opposite.
///
/// The angle between the directions is twice the difference's polar angle: the retro direction is at 0.
pub(super) fn half_difference(half: [f64; 2], [theta, phi]: [f64; 2]) -> [Vec3<f64>; 2] {
    [phi, phi + std::f64::consts::PI].map(|azimuth| {
        let difference = Vec3::from_angles(theta, azimuth);
        let (sin_theta, cos_theta) = half[0].sin_cos();
        let (sin_phi, cos_phi) = half[1].sin_cos();
        // About y by the half vector's polar angle, then about z by its azimuth.
        let x = difference.x * cos_theta + difference.z * sin_theta;
        let z = difference.z * cos_theta - difference.x * sin_theta;
        Vec3::new(x * cos_phi - difference.y * sin_phi, x * sin_phi + difference.y * cos_phi, z)
    })
}
