//! Which classes of standards a material meets, and where it fails the others by how much.

use std::fmt;

use crate::standards::StandardClass;
use crate::{Geometry, Limit, Quantity, Row, significant};

/// Share of a limit that rounding may cost: 250 from cosines is not quite 250.
const ROUNDING: f64 = 1e-9;

/// Significant digits of values in texts, and how many there may be where fewer don't tell two values apart.
const DIGITS: i32 = 3;
const MOST_DIGITS: i32 = 10;

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

/// What a class of a standard has to say of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict<'a> {
    class: &'a StandardClass,
    checks: Vec<Check<'a>>,
}

impl Check<'_> {
    /// How far on the right side of the limit the material is: 1 just meets it, 2 is twice a minimum or half
    /// of a maximum.
    #[must_use]
    pub fn margin(&self) -> f64 {
        if self.row.limit == Limit::Maximum { self.asked / self.found } else { self.found / self.asked }
    }

    /// Whether the limit is met.
    #[must_use]
    pub fn is_met(&self) -> bool {
        self.margin() >= 1.0 - ROUNDING
    }
}

impl<'a> Verdict<'a> {
    /// Judges a material by a class.
    ///
    /// `measure` gives the quantity in its SI unit at a geometry, and `None` where it can't, a `R_I` without
    /// an area for instance. `None` comes back where the class has such rows, or no limit to meet: values
    /// that are typical of a product are no demand.
    pub fn new(
        class: &'a StandardClass,
        measure: impl Fn(Quantity, &Geometry) -> Option<f64>,
    ) -> Option<Self> {
        let limits = class.rows().iter().filter(|row| row.limit != Limit::Typical);
        let check = |row: &'a Row| {
            Some(Check { row, asked: row.value?, found: measure(row.quantity, &row.geometry())? })
        };
        let checks: Vec<Check<'a>> = limits.map(check).collect::<Option<_>>()?;
        (!checks.is_empty()).then_some(Self { class, checks })
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

    /// Whether all limits are met.
    #[must_use]
    pub fn is_met(&self) -> bool {
        self.checks.iter().all(Check::is_met)
    }

    /// The limit that is met with the least margin, or missed by most; the first of several.
    #[must_use]
    pub fn tightest(&self) -> &Check<'a> {
        // The first of equals, whatever the rounding.
        let tighter = |a, b| if Check::margin(b) < Check::margin(a) * (1.0 - ROUNDING) { b } else { a };
        self.checks.iter().fold(&self.checks[0], tighter)
    }
}

/// The verdicts of all classes that have one, nearest first: those that are met before those that are not,
/// and each group by its tightest margin, so that the most demanding class that is met comes first.
pub fn verdicts<'a>(
    classes: impl IntoIterator<Item = &'a StandardClass>,
    measure: impl Fn(Quantity, &Geometry) -> Option<f64>,
) -> Vec<Verdict<'a>> {
    let mut all: Vec<Verdict<'a>> =
        classes.into_iter().filter_map(|class| Verdict::new(class, &measure)).collect();
    // Both groups are sorted by how far the tightest margin is from 1.
    let distance = |verdict: &Verdict<'_>| verdict.tightest().margin().max(f64::MIN_POSITIVE).ln().abs();
    all.sort_by(|a, b| b.is_met().cmp(&a.is_met()).then(distance(a).total_cmp(&distance(b))));
    all
}

impl fmt::Display for Verdict<'_> {
    /// One line, such as
    /// `fails ISO 20471 ... white at 1.5 degree, entrance 5 degree: R_A 7.2, at least 10 cd/lx/m2`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Check { row, asked, found } = *self.tightest();
        let verb = if self.is_met() { "meets" } else { "fails" };
        let nearest = if self.is_met() { ", nearest" } else { "" };
        let bound = if row.limit == Limit::Maximum { "at most" } else { "at least" };
        let shown = |digits| [asked, found].map(|value| significant(row.unit.of_si(value), digits));
        // A near miss must not look like a hit.
        let differs = |&digits: &i32| self.is_met() || shown(digits)[0] != shown(digits)[1];
        let [asked, found] = shown((DIGITS..MOST_DIGITS).find(differs).unwrap_or(MOST_DIGITS));
        write!(
            f,
            "{verb} {}{nearest} at {} degree, entrance {} degree: {} {found}, {bound} {asked} {}",
            self.class.title(),
            row.observation_deg,
            row.entrance_deg,
            row.quantity,
            row.unit
        )?;
        let failed = self.checks.iter().filter(|check| !check.is_met()).count();
        if failed > 1 { write!(f, " ({failed} of {} points)", self.checks.len()) } else { Ok(()) }
    }
}
