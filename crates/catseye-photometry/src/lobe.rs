//! A lobe of strength 1, as fast as a fit needs it: its value and its derivatives by the roughnesses.

use std::f64::consts::PI;

use catseye::{AnyLobe, DIRAC_ROUGHNESS, Lobe as _, Model, ParamError, Params, Vec3};

use crate::Geometry;
use crate::entrance::{LEAST_COSINE, log_squared_tangent};
use crate::sheeting::RetroLobe;

/// Length of a projected direction below which it has no azimuth: there all lobes are round.
const NO_AZIMUTH: f64 = 1e-12;
/// Step of the logarithm of a roughness in difference quotients: their error is below 1e-8.
const ROUGHNESS_STEP: f64 = 1e-4;

/// Two directions, and what all lobes see of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    geometry: Geometry,
    /// Cosine of the viewer's direction, and the logarithm of its squared tangent, both kept finite.
    pub(crate) cosine: f64,
    pub(crate) log_tangent: f64,
    /// What all lobes are multiplied by: with a and b for the exponents plus 1, and e and g for
    /// [`Pair::exponents`], a lobe is `scale` sqrt(a b) exp(-a e - b g) (docs/theory.md, section 2).
    pub(crate) scale: f64,
    /// Along and across the datum axis, and along and across the viewer's projection.
    pub(crate) exponents: [[f64; 2]; 2],
}

impl Pair {
    /// The directions as the lobes of a model see them; the back-vector lobe has a formula of its own.
    pub(crate) fn new(model: Model, wo: Vec3<f64>, wi: Vec3<f64>) -> Self {
        let geometry = Geometry { wo, wi };
        let cosine = wo.z.clamp(LEAST_COSINE, 1.0);
        let dark = Self {
            geometry,
            cosine,
            log_tangent: log_squared_tangent(cosine),
            scale: 0.0,
            exponents: [[0.0; 2]; 2],
        };
        if !(wo.z.min(wi.z) > 0.0) {
            return dark;
        }
        let sum = wo.z + wi.z;
        let [x, y] = geometry.scaled_offset().map(|x| x / sum);
        let squared = x * x + y * y;
        let together = wo + wi;
        // 1 - |d|^2 has no digits where d is small, and d none where it is near 1.
        let log = if squared < 0.5 {
            -(-squared).ln_1p()
        } else {
            -(wo.z * wi.z * together.dot(together) / (sum * sum)).ln()
        };
        let per_square = if squared > 0.0 { log / squared } else { 1.0 };
        let [turned_o, turned_i] = along_projection(wo, wi);
        let along = Geometry { wo: turned_o, wi: turned_i }.scaled_offset().map(|x| x / sum);
        let exponents = [[x, y], along].map(|d| d.map(|x| per_square * x * x));
        let (low, high) = match model {
            Model::Reciprocal => (wo.z.min(wi.z), wo.z.max(wi.z)),
            _ => (wo.z, wi.z),
        };
        Self { scale: low / (2.0 * PI * high * high * sum), exponents, ..dark }
    }
}

/// Both directions in the frame whose x axis is the projection of `wo`.
pub(crate) fn along_projection(wo: Vec3<f64>, wi: Vec3<f64>) -> [Vec3<f64>; 2] {
    let length = wo.x.hypot(wo.y);
    if length < NO_AZIMUTH {
        return [wo, wi];
    }
    let (cos, sin) = (wo.x / length, wo.y / length);
    [wo, wi].map(|w| Vec3::new(w.x * cos + w.y * sin, w.y * cos - w.x * sin, w.z))
}

/// A lobe of strength 1.
#[derive(Clone, Debug)]
pub(crate) enum UnitLobe {
    /// Of the halfway-vector disk: 2 / roughness^2, and whether the lobe keeps its width.
    Disk {
        exponents: [f64; 2],
        keeps_width: bool,
    },
    /// With the roughnesses as they are, and with each a step up and down.
    Other(Box<[AnyLobe<f64>; 5]>),
    Dirac,
}

impl UnitLobe {
    pub(crate) fn new(model: Model, lobe: &RetroLobe) -> Result<Self, ParamError> {
        let [u, v] = lobe.roughness;
        Params::anisotropic(u, v).validate()?;
        if u.max(v) < DIRAC_ROUGHNESS {
            return Ok(Self::Dirac);
        }
        if model == Model::BackVector {
            let (up, down) = (ROUGHNESS_STEP.exp(), (-ROUGHNESS_STEP).exp());
            let stepped = [[u, v], [u * up, v], [u * down, v], [u, v * up], [u, v * down]];
            let [middle, a, b, c, d] = stepped.map(|[u, v]| AnyLobe::new(model, &Params::anisotropic(u, v)));
            return Ok(Self::Other(Box::new([middle?, a?, b?, c?, d?])));
        }
        let exponents = lobe.roughness.map(|r| 2.0 / r.max(DIRAC_ROUGHNESS).powi(2));
        Ok(Self::Disk { exponents, keeps_width: lobe.keeps_width(model) })
    }

    /// The BSDF in 1/sr.
    pub(crate) fn eval(&self, pair: &Pair) -> f64 {
        match self {
            Self::Disk { .. } => self.disk(pair).0,
            Self::Other(lobes) => lobes[0].eval(pair.geometry.wo, pair.geometry.wi)[0],
            Self::Dirac => 0.0,
        }
    }

    /// The BSDF and its derivatives by the logarithms of the two roughnesses.
    pub(crate) fn with_slopes(&self, pair: &Pair) -> (f64, [f64; 2]) {
        match self {
            Self::Disk { exponents, .. } => {
                let (value, [e_u, e_v], squeeze) = self.disk(pair);
                // Both n are proportional to the inverse square of their roughness.
                let slope = |n: f64, e: f64| value * n * (2.0 * e - 1.0 / (n + 1.0));
                (value, [slope(exponents[0] * squeeze, e_u), slope(exponents[1], e_v)])
            }
            Self::Other(lobes) => {
                let at = |i: usize| lobes[i].eval(pair.geometry.wo, pair.geometry.wi)[0];
                let slope = |i: usize| (at(i) - at(i + 1)) / (2.0 * ROUGHNESS_STEP);
                (at(0), [slope(1), slope(3)])
            }
            Self::Dirac => (0.0, [0.0; 2]),
        }
    }

    /// A lobe of the disk, the exponents that it sees, and what its first one is multiplied by: along the
    /// viewer's projection its roughness is that over N.V where it keeps its width.
    fn disk(&self, pair: &Pair) -> (f64, [f64; 2], f64) {
        let &Self::Disk { exponents: [n_u, n_v], keeps_width } = self else { return (0.0, [0.0; 2], 1.0) };
        let squeeze = if keeps_width { pair.cosine * pair.cosine } else { 1.0 };
        let [e_u, e_v] = pair.exponents[usize::from(keeps_width)];
        let [n_u, n_v] = [n_u * squeeze + 1.0, n_v + 1.0];
        let value = pair.scale * (n_u * n_v).sqrt() * (-n_u * e_u - n_v * e_v).exp();
        (value, [e_u, e_v], squeeze)
    }
}
