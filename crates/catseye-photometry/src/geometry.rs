//! Where source and receiver stand: the angular systems of CIE 54.2 and ASTM E808, and directions.

use catseye::Vec3;

/// Length of a projected direction below which it has no azimuth: the angle is 0 to rounding.
const DEGENERATE: f64 = 1e-14;

/// Directions to the receiver and to the source in the local frame: z is the retroreflector axis, x the datum
/// axis.
///
/// In catseye's terms z is the shading normal and x is `tangent_u`. Both directions have unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// To the receiver: the observation axis.
    pub wo: Vec3<f64>,
    /// To the source: the illumination axis.
    pub wi: Vec3<f64>,
}

/// The CIE goniometer system (CIE 54.2, ASTM E808), in radians.
///
/// The laboratory's frame, in which the signs are said once: the illumination axis is +Z, the observation
/// half-plane extends from it towards +X, and the receiver is at `(sin alpha, 0, cos alpha)`. The first axis
/// is Y, the normal of that half-plane. The retroreflector axis is `(sin b1 cos b2, sin b2, cos b1 cos b2)`:
/// a positive `entrance_1` tips it towards the receiver, and at the -4 degrees of sheeting the glare of the
/// front surface, which leaves at twice that angle, falls on the side away from the receiver. The positive
/// second axis is `(cos b1, 0, -sin b1)`. Seen from the source, `rotation` turns counter-clockwise, which is
/// right-handed about the retroreflector axis.
///
/// What of this public texts confirm: the observation angle, cos beta = cos `beta_1` cos `beta_2`, and by
/// consequence the sign of `entrance_1`, as the 30 m geometry of road markings has the receiver between
/// source and normal at a positive entrance angle and presentation angle 0 (ASTM E1710, D4061). The senses of
/// `entrance_2` (towards +Y = Z x X) and of the angles about an axis (counter-clockwise seen from the source)
/// were not found in public and not checked against the text of E808. No table of this crate has an
/// `entrance_2`, and the opposite senses mirror the geometry in the observation half-plane, which no
/// isotropic surface and no pair of anisotropic axes in that plane can tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goniometer {
    /// Observation angle alpha, from the illumination axis to the observation axis, in `[0, pi]`.
    pub observation: f64,
    /// Entrance angle component `beta_1`, in the observation half-plane, in `(-pi, pi]`.
    pub entrance_1: f64,
    /// Entrance angle component `beta_2`, from the observation half-plane to the retroreflector axis, in
    /// `[-pi/2, pi/2]`.
    pub entrance_2: f64,
    /// Rotation angle epsilon, about the retroreflector axis from the positive second axis to the datum axis,
    /// in `(-pi, pi]`.
    pub rotation: f64,
}

/// The intrinsic system of ASTM E808, which asks nothing of a goniometer's axes, in radians.
///
/// Half-planes are bounded by the illumination axis: the entrance half-plane contains the retroreflector
/// axis, the observation half-plane the observation axis. Counter-clockwise is as seen from the source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intrinsic {
    /// Observation angle alpha, from the illumination axis to the observation axis, in `[0, pi]`.
    pub observation: f64,
    /// Entrance angle beta, from the illumination axis to the retroreflector axis, in `[0, pi]`.
    pub entrance: f64,
    /// Presentation angle gamma, counter-clockwise from the entrance half-plane to the observation
    /// half-plane, in `(-pi, pi]`.
    pub presentation: f64,
    /// Orientation angle `omega_s`, counter-clockwise about the retroreflector axis from the entrance
    /// half-plane to the datum axis, in `(-pi, pi]`.
    pub orientation: f64,
}

/// The road-marking system: directions by their elevation above the surface, in radians.
///
/// The elevations are the complements of entrance and viewing angle (ASTM E808 calls them co-entrance and
/// co-viewing angle, EN 1436 illumination and observation angle).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoadMarking {
    /// Elevation of the source: the co-entrance angle, in `[-pi/2, pi/2]`.
    pub co_entrance: f64,
    /// Elevation of the receiver: the co-viewing angle, in `[-pi/2, pi/2]`.
    pub co_viewing: f64,
    /// Dihedral angle, counter-clockwise seen from above from the vertical plane of the source to that of the
    /// receiver, in `(-pi, pi]`. For a driver's eye above the headlamp it is 0.
    pub dihedral: f64,
    /// Orientation angle `omega_s`, as in [`Intrinsic`]: pi for a datum axis that points towards the source.
    pub orientation: f64,
}

impl Goniometer {
    /// The angles given in degrees.
    #[must_use]
    pub fn from_degrees(observation: f64, entrance_1: f64, entrance_2: f64, rotation: f64) -> Self {
        Self {
            observation: observation.to_radians(),
            entrance_1: entrance_1.to_radians(),
            entrance_2: entrance_2.to_radians(),
            rotation: rotation.to_radians(),
        }
    }
}

impl Intrinsic {
    /// The angles given in degrees.
    #[must_use]
    pub fn from_degrees(observation: f64, entrance: f64, presentation: f64, orientation: f64) -> Self {
        Self {
            observation: observation.to_radians(),
            entrance: entrance.to_radians(),
            presentation: presentation.to_radians(),
            orientation: orientation.to_radians(),
        }
    }
}

impl RoadMarking {
    /// The 30 m geometry of EN 1436 and ASTM E1710: a driver 30 m from the marking, illumination at 1.24
    /// degrees and view at 2.29 degrees above the road; observation angle 1.05, entrance angle 88.76 degrees.
    pub const STANDARD_30_M_DEG: [f64; 4] = [1.24, 2.29, 0.0, 180.0];

    /// The angles given in degrees.
    #[must_use]
    pub fn from_degrees(co_entrance: f64, co_viewing: f64, dihedral: f64, orientation: f64) -> Self {
        Self {
            co_entrance: co_entrance.to_radians(),
            co_viewing: co_viewing.to_radians(),
            dihedral: dihedral.to_radians(),
            orientation: orientation.to_radians(),
        }
    }

    /// The geometry of [`RoadMarking::STANDARD_30_M_DEG`].
    #[must_use]
    pub fn standard_30_m() -> Self {
        let [co_entrance, co_viewing, dihedral, orientation] = Self::STANDARD_30_M_DEG;
        Self::from_degrees(co_entrance, co_viewing, dihedral, orientation)
    }
}

impl Geometry {
    /// Observation angle alpha, between source and receiver, in `[0, pi]`: from the chord, as the cosine of a
    /// tenth of a degree has no digits left.
    #[must_use]
    pub fn observation(&self) -> f64 {
        angle_between(self.wo, self.wi)
    }

    /// Entrance angle beta, between the source and the retroreflector axis, in `[0, pi]`.
    #[must_use]
    pub fn entrance(&self) -> f64 {
        polar_angle(self.wi)
    }

    /// Viewing angle nu, between the receiver and the retroreflector axis, in `[0, pi]`.
    #[must_use]
    pub fn viewing(&self) -> f64 {
        polar_angle(self.wo)
    }

    /// Whether source and receiver are above the surface.
    #[must_use]
    pub fn is_above_horizon(&self) -> bool {
        self.wo.z > 0.0 && self.wi.z > 0.0
    }

    /// The offset d of the halfway-vector disk (docs/theory.md, section 2), times the sum of the cosines.
    pub(crate) fn scaled_offset(&self) -> [f64; 2] {
        let Self { wo, wi } = *self;
        [wo.z * wi.x - wi.z * wo.x, wo.z * wi.y - wi.z * wo.y]
    }

    /// The direction of the offset up to its sign, in `[0, pi)`: that in which the sample is turned to the
    /// instrument.
    pub(crate) fn offset_plane(&self) -> f64 {
        let [x, y] = self.scaled_offset();
        y.atan2(x).rem_euclid(std::f64::consts::PI)
    }

    /// The geometry with the datum axis turned by `angle` about the retroreflector axis.
    fn with_datum_turned(wo: Vec3<f64>, wi: Vec3<f64>, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        let turn = |w: Vec3<f64>| Vec3::new(w.x * cos + w.y * sin, w.y * cos - w.x * sin, w.z);
        Self { wo: turn(wo), wi: turn(wi) }
    }
}

impl From<Goniometer> for Geometry {
    fn from(angles: Goniometer) -> Self {
        let Goniometer { observation, entrance_1, entrance_2, rotation } = angles;
        let (sin_2, cos_2) = entrance_2.sin_cos();
        // Both axes lie in the observation half-plane, at an angle from the plane of first and retroreflector
        // axis.
        let in_half_plane = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            Vec3::new(-sin, -sin_2 * cos, cos_2 * cos)
        };
        Self::with_datum_turned(in_half_plane(entrance_1 - observation), in_half_plane(entrance_1), rotation)
    }
}

impl From<Intrinsic> for Geometry {
    fn from(angles: Intrinsic) -> Self {
        let Intrinsic { observation, entrance, presentation, orientation } = angles;
        let (sin_a, cos_a) = observation.sin_cos();
        let (sin_b, cos_b) = entrance.sin_cos();
        let (sin_g, cos_g) = presentation.sin_cos();
        let wi = Vec3::new(-sin_b, 0.0, cos_b);
        let wo = Vec3::new(
            sin_a * cos_b * cos_g - cos_a * sin_b,
            sin_a * sin_g,
            sin_a * sin_b * cos_g + cos_a * cos_b,
        );
        Self::with_datum_turned(wo, wi, orientation)
    }
}

impl From<RoadMarking> for Geometry {
    fn from(angles: RoadMarking) -> Self {
        let RoadMarking { co_entrance, co_viewing, dihedral, orientation } = angles;
        let (sin_e, cos_e) = co_entrance.sin_cos();
        let (sin_v, cos_v) = co_viewing.sin_cos();
        let (sin_d, cos_d) = dihedral.sin_cos();
        let wi = Vec3::new(-cos_e, 0.0, sin_e);
        let wo = Vec3::new(-cos_v * cos_d, -cos_v * sin_d, sin_v);
        Self::with_datum_turned(wo, wi, orientation)
    }
}

impl From<Geometry> for Goniometer {
    /// Where source and receiver coincide the observation half-plane is taken to contain the retroreflector
    /// axis, and where that coincides, too, the datum axis.
    fn from(geometry: Geometry) -> Self {
        let z = geometry.wi;
        let y = normal_of_half_plane(&geometry);
        let x = y.cross(z);
        // The retroreflector axis is the local z axis: its components in the laboratory are the z of x, y and
        // z.
        let entrance_1 = if x.z.hypot(z.z) > DEGENERATE { x.z.atan2(z.z) } else { 0.0 };
        let entrance_2 = y.z.atan2(x.z.hypot(z.z));
        let (sin, cos) = entrance_1.sin_cos();
        let second = [cos * x.x - sin * z.x, cos * x.y - sin * z.y];
        let rotation = (-second[1]).atan2(second[0]);
        Self { observation: geometry.observation(), entrance_1, entrance_2, rotation }
    }
}

impl From<Geometry> for Intrinsic {
    /// Where source and receiver coincide `presentation` is 0; at entrance angle 0 `orientation` is 0.
    fn from(geometry: Geometry) -> Self {
        let Geometry { wo, wi } = geometry;
        let sin_b = wi.x.hypot(wi.y);
        let away = if sin_b > DEGENERATE { [-wi.x / sin_b, -wi.y / sin_b] } else { [1.0, 0.0] };
        let across = Vec3::new(-away[1], away[0], 0.0);
        let along = across.cross(wi);
        let step = wo - wi;
        let distant = step.dot(step).sqrt() > DEGENERATE;
        Self {
            observation: geometry.observation(),
            entrance: geometry.entrance(),
            presentation: if distant { step.dot(across).atan2(step.dot(along)) } else { 0.0 },
            orientation: (-away[1]).atan2(away[0]),
        }
    }
}

impl From<Geometry> for RoadMarking {
    /// Directions along the retroreflector axis have no vertical plane: angles from it are 0.
    fn from(geometry: Geometry) -> Self {
        let Geometry { wo, wi } = geometry;
        let azimuth = |w: Vec3<f64>| (w.x.hypot(w.y) > DEGENERATE).then(|| w.y.atan2(w.x));
        // From the sine and the cosine of the difference, which needs no care at the jump of the azimuth.
        let (cos_d, sin_d) = (wo.x * wi.x + wo.y * wi.y, wi.x * wo.y - wi.y * wo.x);
        let both = azimuth(wo).is_some() && azimuth(wi).is_some();
        Self {
            co_entrance: wi.z.atan2(wi.x.hypot(wi.y)),
            co_viewing: wo.z.atan2(wo.x.hypot(wo.y)),
            dihedral: if both { sin_d.atan2(cos_d) } else { 0.0 },
            orientation: azimuth(wi).map_or(0.0, |_| wi.y.atan2(-wi.x)),
        }
    }
}

/// The first axis: the unit normal of the observation half-plane, in the local frame.
fn normal_of_half_plane(geometry: &Geometry) -> Vec3<f64> {
    let Geometry { wo, wi } = *geometry;
    // The difference is exact where it is small; the product of the directions themselves is not.
    let from_receiver = wi.cross(wo - wi);
    let from_axis = wi.cross(Vec3::new(0.0, 0.0, 1.0));
    let from_datum = wi.cross(Vec3::new(1.0, 0.0, 0.0));
    let is_long = |w: &Vec3<f64>| w.dot(*w).sqrt() > DEGENERATE;
    [from_receiver, from_axis].into_iter().find(is_long).unwrap_or(from_datum).normalized()
}

/// The angle between two unit vectors: 2 asin of half the chord, or from the sum where they are nearly
/// opposite.
fn angle_between(a: Vec3<f64>, b: Vec3<f64>) -> f64 {
    let (apart, together) = (a - b, a + b);
    2.0 * apart.dot(apart).sqrt().atan2(together.dot(together).sqrt())
}

/// The angle between a unit vector and the z axis.
fn polar_angle(w: Vec3<f64>) -> f64 {
    w.x.hypot(w.y).atan2(w.z)
}
