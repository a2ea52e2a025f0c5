//! Which classes of standards a material meets, and where it fails the others by how much.
//!
//! A class is judged in the quantities that its table has and in no other: [`Verdict::judged`] and
//! [`Verdict::not_judged`] say which.

use std::fmt;

use crate::standards::StandardClass;
use crate::{Geometry, Limit, Quantity, Row, significant};

/// Share of a limit that counts as rounding: materials are evaluated in single precision, which at the angles
/// of standards (from 0.2 degree on, where more than 1e-4 of the peak is left) is within 9e-5 of the exact
/// value (a test of `catseye-render`, `specimen.rs`, measures it). So a tint that was made for a limit meets
/// it.
pub const EVALUATION: f64 = 1e-4;

/// Significant digits of values in texts, and how many there may be where fewer don't tell two values apart.
const DIGITS: i32 = 3;
const MOST_DIGITS: i32 = 10;

/// What a class is of, by the quantity that it limits: one kind is not judged by the classes of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// `R_A`: sheeting, tape, textiles, plates.
    Sheeting,
    /// `R_L`, `Q_d`: road markings.
    Marking,
    /// `R_I`: a whole reflector, whose area has to be known.
    Reflector,
}

impl Kind {
    /// What the class is of.
    #[must_use]
    pub fn of(class: &StandardClass) -> Self {
        let kind = |row: &Row| match row.quantity {
            Quantity::LuminousIntensity => Some(Self::Reflector),
            Quantity::RetroReflectedLuminance | Quantity::DaytimeLuminance => Some(Self::Marking),
            _ => None,
        };
        class.rows().iter().find_map(kind).unwrap_or(Self::Sheeting)
    }

    /// `sheeting`, `marking` or `reflector`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sheeting => "sheeting",
            Self::Marking => "marking",
            Self::Reflector => "reflector",
        }
    }
}

/// On which side of a limit a material is. The best comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Standing {
    /// On the right side, by the guard band and more.
    Meets,
    /// On the right side, by less than the guard band.
    WithinGuard,
    /// On the wrong side.
    Fails,
}

impl Standing {
    /// `meets`, `within guard` or `fails`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Meets => "meets",
            Self::WithinGuard => "within guard",
            Self::Fails => "fails",
        }
    }
}

/// A value that a standard asks for, and what the material has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Check<'a> {
    /// What is asked.
    pub row: &'a Row,
    /// The value that the row asks for, in the SI unit of its quantity.
    pub asked: f64,
    /// What the material has, in the same unit.
    pub found: f64,
}

/// Why a class has nothing to say of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Unjudged {
    /// Values that are typical of a product are no demand.
    #[error("its values are typical ones, no limits; a column `limit` says minimum or maximum")]
    NoLimit,
    /// A quantity that can't be measured of the material.
    #[error("{0} can't be measured; R_I needs the reflector's area")]
    NotMeasured(Quantity),
}

/// What a class of a standard has to say of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict<'a> {
    class: &'a StandardClass,
    checks: Vec<Check<'a>>,
    guard: f64,
}

impl Check<'_> {
    /// How far on the right side of the limit the material is: 1 just meets it, 2 is twice a minimum or half
    /// of a maximum.
    #[must_use]
    pub fn margin(&self) -> f64 {
        if self.row.limit == Limit::Maximum { self.asked / self.found } else { self.found / self.asked }
    }

    /// Whether the margin is at least 1, and at least 1 plus the guard band, a share of the limit; both less
    /// [`EVALUATION`].
    #[must_use]
    pub fn standing(&self, guard: f64) -> Standing {
        let is_at_least = |least: f64| self.margin() >= least * (1.0 - EVALUATION);
        match (is_at_least(1.0 + guard), is_at_least(1.0)) {
            (true, _) => Standing::Meets,
            (false, true) => Standing::WithinGuard,
            (false, false) => Standing::Fails,
        }
    }
}

impl<'a> Verdict<'a> {
    /// Judges a material by a class, which it meets where every margin is 1 + `guard` or more.
    ///
    /// `measure` gives the quantity in its SI unit at a geometry, and `None` where it can't, a `R_I` without
    /// an area for instance.
    ///
    /// # Errors
    /// A class that has such rows, or no limit to meet.
    pub fn new(
        class: &'a StandardClass,
        guard: f64,
        measure: impl Fn(Quantity, &Geometry) -> Option<f64>,
    ) -> Result<Self, Unjudged> {
        let limits = class.rows().iter().filter(|row| row.limit != Limit::Typical);
        let check = |row: &'a Row| {
            let found = measure(row.quantity, &row.geometry());
            let pair = row.value.zip(found).ok_or(Unjudged::NotMeasured(row.quantity));
            pair.map(|(asked, found)| Check { row, asked, found })
        };
        let checks: Vec<Check<'a>> = limits.map(check).collect::<Result<_, _>>()?;
        if checks.is_empty() { Err(Unjudged::NoLimit) } else { Ok(Self { class, checks, guard }) }
    }

    /// The class.
    #[must_use]
    pub fn class(&self) -> &'a StandardClass {
        self.class
    }

    /// All limits of the class, in its order; never none.
    #[must_use]
    pub fn checks(&self) -> &[Check<'a>] {
        &self.checks
    }

    /// The guard band, a share of each limit.
    #[must_use]
    pub fn guard(&self) -> f64 {
        self.guard
    }

    /// The worst standing of all limits.
    #[must_use]
    pub fn standing(&self) -> Standing {
        self.checks.iter().map(|check| check.standing(self.guard)).fold(Standing::Meets, Standing::max)
    }

    /// Whether all limits are met, with the guard band.
    #[must_use]
    pub fn is_met(&self) -> bool {
        self.standing() == Standing::Meets
    }

    /// The limit that is met with the least margin, or missed by most; the first of several.
    #[must_use]
    pub fn tightest(&self) -> &Check<'a> {
        // The first of equals, whatever the rounding.
        let tighter = |a, b| if Check::margin(b) < Check::margin(a) * (1.0 - 1e-9) { b } else { a };
        self.checks.iter().fold(&self.checks[0], tighter)
    }

    /// The quantities that the class limits, each once.
    #[must_use]
    pub fn judged(&self) -> Vec<Quantity> {
        let mut judged = Vec::new();
        for Check { row, .. } in &self.checks {
            if !judged.contains(&row.quantity) {
                judged.push(row.quantity);
            }
        }
        judged
    }

    /// What standards demand of things of this kind and the class's table doesn't have. The chromaticity is
    /// in none.
    #[must_use]
    pub fn not_judged(&self) -> Vec<&'static str> {
        let judged = self.judged();
        let by_day = match Kind::of(self.class) {
            Kind::Sheeting => Some((Quantity::LuminanceFactor, "luminance factor")),
            Kind::Marking => Some((Quantity::DaytimeLuminance, "luminance by day")),
            Kind::Reflector => None,
        };
        let by_day = by_day.filter(|(quantity, _)| !judged.contains(quantity)).map(|(_, name)| name);
        let first = self.checks[0].row.rotation_deg;
        let is_turned = self.checks.iter().any(|check| check.row.rotation_deg != first);
        let rotation = (!is_turned).then_some("rotation");
        by_day.into_iter().chain(["colour"]).chain(rotation).collect()
    }
}

/// The verdicts of all classes that have one, nearest first: those that are met, those within the guard band,
/// and those that fail, each group by its tightest margin, so that the most demanding class that is met comes
/// first. Then the classes that have none, in their order, and why.
pub fn verdicts<'a>(
    classes: impl IntoIterator<Item = &'a StandardClass>,
    guard: f64,
    measure: impl Fn(Quantity, &Geometry) -> Option<f64>,
) -> (Vec<Verdict<'a>>, Vec<(&'a StandardClass, Unjudged)>) {
    let (mut all, mut none) = (Vec::new(), Vec::new());
    for class in classes {
        match Verdict::new(class, guard, &measure) {
            Ok(verdict) => all.push(verdict),
            Err(reason) => none.push((class, reason)),
        }
    }
    // All groups are sorted by how far the tightest margin is from 1.
    let distance = |verdict: &Verdict<'_>| verdict.tightest().margin().max(f64::MIN_POSITIVE).ln().abs();
    all.sort_by(|a, b| a.standing().cmp(&b.standing()).then(distance(a).total_cmp(&distance(b))));
    (all, none)
}

impl fmt::Display for Verdict<'_> {
    /// One line, such as
    /// `fails ISO 20471 ... white at 1.5 degree, entrance 5 degree: R_A 7.2, at least 10 cd/lx/m2`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Check { row, asked, found } = *self.tightest();
        let standing = self.standing();
        let bound = if row.limit == Limit::Maximum { "at most" } else { "at least" };
        let shown = |digits| [asked, found].map(|value| significant(row.unit.of_si(value), digits));
        // A near miss must not look like a hit.
        let differs = |&digits: &i32| standing == Standing::Meets || shown(digits)[0] != shown(digits)[1];
        let [asked, found] = shown((DIGITS..MOST_DIGITS).find(differs).unwrap_or(MOST_DIGITS));
        let judged: Vec<&str> = self.judged().into_iter().map(Quantity::symbol).collect();
        let (title, judged) = (self.class.title(), judged.join(", "));
        match standing {
            Standing::Meets => write!(f, "meets {title} in {judged}, nearest")?,
            Standing::WithinGuard => write!(f, "within the guard band of {title} in {judged},")?,
            Standing::Fails => write!(f, "fails {title}")?,
        }
        let Row { observation_deg, entrance_deg, quantity, unit, .. } = row;
        write!(
            f,
            " at {observation_deg} degree, entrance {entrance_deg} degree: {quantity} {found}, {bound} \
             {asked} {unit}"
        )?;
        if self.guard > 0.0 && standing != Standing::Fails {
            write!(f, " and {} % to spare", significant(100.0 * self.guard, DIGITS))?;
        }
        let failed = self.checks.iter().filter(|check| check.standing(self.guard) == standing).count();
        match standing {
            Standing::Meets => write!(f, "; not judged: {}", self.not_judged().join(", ")),
            _ if failed > 1 => write!(f, " ({failed} of {} points)", self.checks.len()),
            _ => Ok(()),
        }
    }
}
