//! Intensities on a net of two angles.

use super::Axis;

/// How far outside a net's last angle rounding may lead, in degrees.
const ROUNDING_DEG: f64 = 1e-9;

/// Which goniometer the angles are of. The polar axis of Type A and C is vertical, that of Type B horizontal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// Horizontal angle to the right, elevation.
    A,
    /// Horizontal angle to the right in a plane that is tipped upwards by the vertical angle.
    B,
    /// C and gamma.
    C(Axis),
}

/// How the half or quarter that a file has becomes the whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Symmetry {
    /// The file has all.
    None,
    /// Types A and B: left is as right.
    LeftRight,
    /// All planes are alike.
    Rotation,
    /// C0 to C180.
    C0C180,
    /// C270 to C90, counted from -90 to 90.
    C90C270,
    /// C0 to C90.
    Both,
}

/// Intensities in cd over two angles in degrees, between which they are bilinear.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Net {
    pub(super) kind: Kind,
    pub(super) symmetry: Symmetry,
    /// Horizontal angles or C planes, strictly ascending; one only for [`Symmetry::Rotation`].
    pub(super) planes: Vec<f64>,
    /// Vertical angles or gamma, strictly ascending, at least two.
    pub(super) angles: Vec<f64>,
    /// One run of `angles` for each plane.
    pub(super) intensities: Vec<f64>,
}

impl Net {
    /// The net of all C planes with the first once more, a turn on.
    pub(super) fn closed(mut self) -> Self {
        self.planes.extend(self.planes.first().map(|first| first + 360.0));
        self.intensities.extend_from_within(..self.angles.len());
        self
    }

    /// The intensity in a direction of the Type A goniometer; nothing outside the net.
    pub(super) fn intensity_cd(&self, right_deg: f64, up_deg: f64) -> Option<f64> {
        let [plane, angle] = self.kind.angles_deg(right_deg, up_deg);
        let (angle, t) = segment(&self.angles, angle)?;
        let along = |plane: usize| {
            let run = &self.intensities[plane * self.angles.len()..];
            run[angle] + (run[angle + 1] - run[angle]) * t
        };
        if self.symmetry == Symmetry::Rotation {
            return Some(along(0));
        }
        let plane = self.symmetry.folded(plane);
        // A net around the axis may begin anywhere.
        let around = matches!(self.kind, Kind::C(_)) && plane < self.planes[0];
        let (plane, t) = segment(&self.planes, if around { plane + 360.0 } else { plane })?;
        let [a, b] = [along(plane), along(plane + 1)];
        Some(a + (b - a) * t)
    }
}

impl Kind {
    /// Plane and angle of a direction.
    fn angles_deg(self, right_deg: f64, up_deg: f64) -> [f64; 2] {
        let (sin_h, cos_h) = right_deg.to_radians().sin_cos();
        let (up, cos_v) = up_deg.to_radians().sin_cos();
        let (right, ahead) = (cos_v * sin_h, cos_v * cos_h);
        // The angle from an axis, exact near it, too.
        let polar = |a: f64, b: f64, axis: f64| a.hypot(b).atan2(axis).to_degrees();
        match self {
            Self::A => [right_deg, up_deg],
            Self::B => [right.atan2(up.hypot(ahead)).to_degrees(), up.atan2(ahead).to_degrees()],
            Self::C(Axis::Ahead) => [up.atan2(right).to_degrees(), polar(up, right, ahead)],
            Self::C(Axis::Down) => [(-right).atan2(ahead).to_degrees(), polar(right, ahead, -up)],
        }
    }
}

impl Symmetry {
    /// The plane of a file's part that is like a plane in `[-180, 180]`.
    fn folded(self, plane: f64) -> f64 {
        match self {
            Self::None | Self::Rotation => plane,
            Self::LeftRight | Self::C0C180 => plane.abs(),
            Self::Both => plane.abs().min(180.0 - plane.abs()),
            Self::C90C270 if plane.abs() <= 90.0 => plane,
            Self::C90C270 => (180.0 - plane.abs()).copysign(plane),
        }
    }
}

/// The number of the interval that a value lies in, and how far along it.
fn segment(axis: &[f64], x: f64) -> Option<(usize, f64)> {
    let (first, last) = (*axis.first()?, *axis.last()?);
    if !(x >= first - ROUNDING_DEG && x <= last + ROUNDING_DEG) {
        return None;
    }
    let x = x.clamp(first, last);
    let i = axis.partition_point(|&angle| angle <= x).clamp(1, axis.len().checked_sub(1)?) - 1;
    Some((i, (x - axis[i]) / (axis[i + 1] - axis[i])))
}
