//! The quantities of retro-reflection (ASTM E808, CIE 54.2), and how they follow from a BSDF.

use std::f64::consts::PI;
use std::fmt;
use std::str::FromStr;

use crate::{Error, Geometry, Unit};

/// A photometric quantity that a BSDF f and a [`Geometry`] determine.
///
/// With f in 1/sr, entrance angle beta (source to normal) and viewing angle nu (receiver to normal); E is
/// illuminance on a plane normal to the illumination unless something else is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// `R_A`, coefficient of retro-reflection: intensity per E and per area of the surface. f cos beta cos
    /// nu, cd/lx/m2.
    RetroReflectionCoefficient,
    /// `R_I`, coefficient of luminous intensity (CIL) of a whole reflector: intensity per E. `R_A` times
    /// area, cd/lx.
    LuminousIntensity,
    /// `R_L`, coefficient of retro-reflected luminance: luminance per E. f cos beta, cd/lx/m2.
    RetroReflectedLuminance,
    /// `R_Phi`, coefficient of retro-reflected luminous flux: intensity per incident flux. f cos nu, cd/lm,
    /// here 1/sr.
    RetroReflectedFlux,
    /// `R_T`, fractional retro-reflectance: share of the incident flux that comes back within the observation
    /// angle, whatever the direction. An integral: [`crate::fractional_retro_reflectance`].
    FractionalRetroReflectance,
    /// `Q_d`, luminance coefficient under diffuse illumination (EN 1436): luminance per illuminance on the
    /// surface under an even sky. An integral, in cd/lx/m2: [`crate::diffuse_luminance_coefficient`].
    DaytimeLuminance,
    /// Y, the luminance factor beta: luminance relative to that of a perfect white diffuser in the same
    /// light. pi f.
    LuminanceFactor,
    /// f, the BSDF itself, 1/sr.
    Brdf,
}

/// Names in use; the first of each quantity is the one that is printed. Compared without case, spaces and
/// underscores.
const NAMES: &[(Quantity, &[&str])] = &[
    (Quantity::RetroReflectionCoefficient, &["R_A", "RA", "R'", "SIA"]),
    (Quantity::LuminousIntensity, &["R_I", "CIL", "R"]),
    (Quantity::RetroReflectedLuminance, &["R_L", "CRL", "SL"]),
    (Quantity::RetroReflectedFlux, &["R_Phi"]),
    (Quantity::FractionalRetroReflectance, &["R_T"]),
    (Quantity::DaytimeLuminance, &["Q_d"]),
    (Quantity::LuminanceFactor, &["Y", "beta", "beta_v", "luminance factor"]),
    (Quantity::Brdf, &["f", "BRDF", "BSDF"]),
];

impl Quantity {
    /// Every quantity.
    pub const ALL: [Self; 8] = [
        Self::RetroReflectionCoefficient,
        Self::LuminousIntensity,
        Self::RetroReflectedLuminance,
        Self::RetroReflectedFlux,
        Self::FractionalRetroReflectance,
        Self::DaytimeLuminance,
        Self::LuminanceFactor,
        Self::Brdf,
    ];

    /// The symbol, such as `R_A`.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        NAMES.iter().find(|(quantity, _)| *quantity == self).map_or("", |(_, names)| names[0])
    }

    /// The SI unit that values are in: cd/lx/m2, cd/lx, 1/sr or 1.
    #[must_use]
    pub fn unit(self) -> Unit {
        match self {
            Self::RetroReflectionCoefficient | Self::RetroReflectedLuminance | Self::DaytimeLuminance => {
                Unit::CandelaPerLuxSquareMetre
            }
            Self::LuminousIntensity => Unit::CandelaPerLux,
            Self::RetroReflectedFlux | Self::Brdf => Unit::PerSteradian,
            Self::FractionalRetroReflectance | Self::LuminanceFactor => Unit::One,
        }
    }

    /// The quantity in its SI unit, from the BSDF `f` in 1/sr at the geometry.
    ///
    /// `None` where more is needed: an area for `R_I`, which is `R_A` times it, or an integral for `R_T` and
    /// `Q_d`.
    #[must_use]
    pub fn of_brdf(self, f: f64, geometry: &Geometry) -> Option<f64> {
        self.per_brdf(geometry).map(|factor| f * factor)
    }

    /// The BSDF in 1/sr, from the quantity in its SI unit at the geometry: the inverse of
    /// [`Quantity::of_brdf`].
    #[must_use]
    pub fn to_brdf(self, value: f64, geometry: &Geometry) -> Option<f64> {
        self.per_brdf(geometry).map(|factor| value / factor)
    }

    /// The smallest and the largest value, in the SI unit, that a real surface may be thought to have: a
    /// factor of 100 and more above what is sold, and below what instruments see, so that what lies outside
    /// is a unit or a decimal point gone wrong.
    #[must_use]
    pub fn plausible(self, geometry: &Geometry) -> [f64; 2] {
        // Road markings are seen at a glance: entrance angles of 88 degrees and more.
        let is_road = geometry.wi.z < ROAD_COSINE;
        match self {
            Self::RetroReflectedLuminance if is_road => [1e-4, 20.0],
            Self::RetroReflectionCoefficient if is_road => [1e-6, 20.0],
            // Goniophotometers follow the tail of a lobe through six powers of ten.
            Self::RetroReflectionCoefficient | Self::RetroReflectedLuminance => [1e-6, 5e4],
            Self::RetroReflectedFlux => [1e-6, 5e4],
            Self::LuminousIntensity => [1e-9, 1e3],
            Self::FractionalRetroReflectance => [1e-6, 1.0],
            // 1/pi for a perfect white diffuser; fluorescent colours exceed it.
            Self::DaytimeLuminance => [1e-3, 1.0],
            Self::LuminanceFactor => [1e-3, 2.0],
            Self::Brdf => [1e-9, 1e8],
        }
    }

    fn per_brdf(self, geometry: &Geometry) -> Option<f64> {
        let (cos_nu, cos_beta) = (geometry.wo.z, geometry.wi.z);
        match self {
            Self::RetroReflectionCoefficient => Some(cos_beta * cos_nu),
            Self::RetroReflectedLuminance => Some(cos_beta),
            Self::RetroReflectedFlux => Some(cos_nu),
            Self::LuminanceFactor => Some(PI),
            Self::Brdf => Some(1.0),
            Self::LuminousIntensity | Self::FractionalRetroReflectance | Self::DaytimeLuminance => None,
        }
    }
}

/// Cosine of the entrance angle, 80 degrees, beyond which a surface is a road.
pub(crate) const ROAD_COSINE: f64 = 0.173_648_177_666_930_3;

impl FromStr for Quantity {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let plain = |name: &str| name.replace(['_', ' '], "").to_lowercase();
        let wanted = plain(text.trim());
        let found = NAMES.iter().find(|(_, names)| names.iter().any(|name| plain(name) == wanted));
        found.map(|(quantity, _)| *quantity).ok_or_else(|| Error::UnknownQuantity {
            name: text.trim().to_owned(),
            known: Self::ALL.map(Self::symbol).join(", "),
        })
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}
