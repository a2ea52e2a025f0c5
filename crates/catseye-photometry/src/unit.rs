//! The units that data sheets and standards give their numbers in.

use std::fmt;
use std::str::FromStr;

use crate::{Error, Quantity};

/// Square metres in a square foot: (0.3048 m)^2, exact. A footcandle is a lumen per square foot.
const SQUARE_FOOT: f64 = 0.3048 * 0.3048;

/// A unit of a photometric quantity.
///
/// It is read in the spellings of data sheets and printed in one: `cd/lx/m2` is also `cd/(lx.m2)`,
/// `cd.lx-1.m-2`, `cd/lux/m^2` and `cd/m²/lx`. A remark such as `(R_L)` or `(CIL)` may follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unit {
    /// cd/lx/m2, the unit of `R_A`, `R_L` and `Q_d`.
    CandelaPerLuxSquareMetre,
    /// mcd/lx/m2, in which road markings are specified.
    MillicandelaPerLuxSquareMetre,
    /// cd/fc/ft2: the same number as cd/lx/m2, since lux and footcandle are lumens per the same area that is
    /// divided by.
    CandelaPerFootcandleSquareFoot,
    /// cd/lx, the unit of `R_I`.
    CandelaPerLux,
    /// mcd/lx.
    MillicandelaPerLux,
    /// cd/fc: 1/10.764 cd/lx.
    CandelaPerFootcandle,
    /// 1/sr, and cd/lm, which is the same.
    PerSteradian,
    /// A plain number.
    One,
    /// Hundredths.
    Percent,
}

/// What a unit measures, up to a factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Dimension {
    LuminancePerIlluminance,
    IntensityPerIlluminance,
    PerSolidAngle,
    Number,
}

/// Spellings after [`normalized`]; the first of each unit is the one that is printed.
const SPELLINGS: &[(Unit, &[&str])] = &[
    (
        Unit::CandelaPerLuxSquareMetre,
        &[
            "cd/lx/m2",
            "cd/m2/lx",
            "cd/(lx.m2)",
            "cd/(m2.lx)",
            "cd.lx-1.m-2",
            "cd.m-2.lx-1",
            "cd/lx.m2",
            "cd/m2.lx",
        ],
    ),
    (
        Unit::MillicandelaPerLuxSquareMetre,
        &[
            "mcd/lx/m2",
            "mcd/m2/lx",
            "mcd/(lx.m2)",
            "mcd/(m2.lx)",
            "mcd.lx-1.m-2",
            "mcd.m-2.lx-1",
            "mcd/lx.m2",
            "mcd/m2.lx",
        ],
    ),
    (Unit::CandelaPerFootcandleSquareFoot, &["cd/fc/ft2", "cd/ft2/fc", "cd/(fc.ft2)", "cd/(ft2.fc)", "cpl"]),
    (Unit::CandelaPerLux, &["cd/lx", "cd.lx-1"]),
    (Unit::MillicandelaPerLux, &["mcd/lx", "mcd.lx-1"]),
    (Unit::CandelaPerFootcandle, &["cd/fc", "cd.fc-1"]),
    (Unit::PerSteradian, &["1/sr", "sr-1", "cd/lm", "cd.lm-1"]),
    (Unit::One, &["1", "-"]),
    (Unit::Percent, &["%", "percent"]),
];

impl Unit {
    /// Every unit.
    pub const ALL: [Self; 9] = [
        Self::CandelaPerLuxSquareMetre,
        Self::MillicandelaPerLuxSquareMetre,
        Self::CandelaPerFootcandleSquareFoot,
        Self::CandelaPerLux,
        Self::MillicandelaPerLux,
        Self::CandelaPerFootcandle,
        Self::PerSteradian,
        Self::One,
        Self::Percent,
    ];

    /// The unit's usual spelling, such as `cd/lx/m2`.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        SPELLINGS.iter().find(|(unit, _)| *unit == self).map_or("", |(_, spellings)| spellings[0])
    }

    /// The number of SI units (cd/lx/m2, cd/lx, 1/sr or 1) in one of this unit.
    #[must_use]
    pub fn factor(self) -> f64 {
        match self {
            Self::CandelaPerLuxSquareMetre
            | Self::CandelaPerFootcandleSquareFoot
            | Self::CandelaPerLux
            | Self::PerSteradian
            | Self::One => 1.0,
            Self::MillicandelaPerLuxSquareMetre | Self::MillicandelaPerLux => 1e-3,
            Self::CandelaPerFootcandle => SQUARE_FOOT,
            Self::Percent => 0.01,
        }
    }

    /// A number of this unit, in SI units.
    #[must_use]
    pub fn to_si(self, value: f64) -> f64 {
        // A quotient of round numbers keeps its digits: 150 mcd are 0.15 cd, but 150 * 1e-3 is not.
        match self {
            Self::MillicandelaPerLuxSquareMetre | Self::MillicandelaPerLux => value / 1e3,
            Self::Percent => value / 1e2,
            _ => value * self.factor(),
        }
    }

    /// A number of SI units, in this unit.
    #[must_use]
    pub fn of_si(self, value: f64) -> f64 {
        match self {
            Self::MillicandelaPerLuxSquareMetre | Self::MillicandelaPerLux => value * 1e3,
            Self::Percent => value * 1e2,
            _ => value / self.factor(),
        }
    }

    /// Whether the quantity can be given in this unit.
    #[must_use]
    pub fn measures(self, quantity: Quantity) -> bool {
        self.dimension() == quantity.unit().dimension()
    }

    /// The quantity that is meant where only the unit is given.
    ///
    /// `R_A` for cd/lx/m2, and `R_L` for mcd/lx/m2, which is in use for road markings only.
    #[must_use]
    pub fn usual_quantity(self) -> Quantity {
        match self {
            Self::CandelaPerLuxSquareMetre | Self::CandelaPerFootcandleSquareFoot => {
                Quantity::RetroReflectionCoefficient
            }
            Self::MillicandelaPerLuxSquareMetre => Quantity::RetroReflectedLuminance,
            Self::CandelaPerLux | Self::MillicandelaPerLux | Self::CandelaPerFootcandle => {
                Quantity::LuminousIntensity
            }
            Self::PerSteradian => Quantity::Brdf,
            Self::One | Self::Percent => Quantity::LuminanceFactor,
        }
    }

    /// The unit, and the quantity that it says it is of: `mcd/lx/m2 (R_L)` is of `R_L`.
    ///
    /// # Errors
    /// A unit that is not known. A remark that names no quantity is none.
    pub fn parse_with_quantity(text: &str) -> Result<(Self, Quantity), Error> {
        let unit: Self = text.parse()?;
        let remark = text.split_once(" (").map(|(_, remark)| remark.trim().trim_end_matches(')'));
        let named = remark.and_then(|remark| remark.parse().ok()).filter(|&quantity| unit.measures(quantity));
        Ok((unit, named.unwrap_or_else(|| unit.usual_quantity())))
    }

    fn dimension(self) -> Dimension {
        match self {
            Self::CandelaPerLuxSquareMetre
            | Self::MillicandelaPerLuxSquareMetre
            | Self::CandelaPerFootcandleSquareFoot => Dimension::LuminancePerIlluminance,
            Self::CandelaPerLux | Self::MillicandelaPerLux | Self::CandelaPerFootcandle => {
                Dimension::IntensityPerIlluminance
            }
            Self::PerSteradian => Dimension::PerSolidAngle,
            Self::One | Self::Percent => Dimension::Number,
        }
    }
}

impl FromStr for Unit {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let unit = normalized(text);
        let found = SPELLINGS.iter().find(|(_, spellings)| spellings.contains(&unit.as_str()));
        found.map(|(unit, _)| *unit).ok_or_else(|| Error::UnknownUnit {
            name: text.trim().to_owned(),
            known: Self::ALL.map(Self::symbol).join(", "),
        })
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}

/// One spelling for the many that differ in nothing but signs: lower case, no spaces, no remark.
fn normalized(text: &str) -> String {
    let text = text.split_once(" (").map_or(text, |(unit, _)| unit);
    let mut unit = text.trim().to_lowercase();
    let signs = [
        (" ", ""),
        ("·", "."),
        ("⋅", "."),
        ("*", "."),
        ("⁻¹", "-1"),
        ("⁻²", "-2"),
        ("²", "2"),
        ("^", ""),
        ("−", "-"),
        ("lux", "lx"),
        ("ft-c", "fc"),
        ("sqm", "m2"),
    ];
    for (from, to) in signs {
        unit = unit.replace(from, to);
    }
    unit
}
