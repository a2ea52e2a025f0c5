//! Which classes of standards a material meets, and where it fails the others by how much.

use std::fmt;

use crate::standards::Class;
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
    class: &'a Class,
    checks: Vec<Check<'a>>,
}

impl Check<'_> {
    /// How far on the right side of the limit the material is: 1 just meets it, 2 is twice a minimum or half of a maximum.
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
    /// `measure` gives the quantity in its SI unit at a geometry, and `None` where it can't, a `R_I` without an area for
    /// instance. `None` comes back where the class has such rows, or no limit to meet: values that are typical of a product
    /// are no demand.
    pub fn new(class: &'a Class, measure: impl Fn(Quantity, &Geometry) -> Option<f64>) -> Option<Self> {
        let limits = class.rows().iter().filter(|row| row.limit != Limit::Typical);
        let check = |row: &'a Row| {
            Some(Check { row, asked: row.value?, found: measure(row.quantity, &row.geometry())? })
        };
        let checks: Vec<Check<'a>> = limits.map(check).collect::<Option<_>>()?;
        (!checks.is_empty()).then_some(Self { class, checks })
    }

    /// The class.
    #[must_use]
    pub fn class(&self) -> &'a Class {
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

/// The verdicts of all classes that have one, nearest first: those that are met before those that are not, and each
/// group by its tightest margin, so that the most demanding class that is met comes first.
pub fn verdicts<'a>(
    classes: impl IntoIterator<Item = &'a Class>,
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
    /// One line, such as `fails ISO 20471 ... white at 1.5 degree, entrance 5 degree: R_A 7.2, at least 10 cd/lx/m2`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Check { row, asked, found } = *self.tightest();
        let verb = if self.is_met() { "meets" } else { "fails" };
        let nearest = if self.is_met() { ", nearest" } else { "" };
        let bound = if row.limit == Limit::Maximum { "at most" } else { "at least" };
        let shown = |digits| [asked, found].map(|value| significant(row.unit.from_si(value), digits));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::standards::Catalogue;

    /// A sheeting that returns `r_a` at all angles.
    fn even(r_a: f64) -> impl Fn(Quantity, &Geometry) -> Option<f64> {
        move |quantity, geometry| {
            let f = Quantity::RetroReflectionCoefficient.to_brdf(r_a, geometry)?;
            quantity.from_brdf(f, geometry)
        }
    }

    #[test]
    fn a_class_is_met_where_all_its_limits_are() {
        let catalogue = Catalogue::embedded().unwrap();
        let class = catalogue.find("fmvss108:dot-c2:white").unwrap();
        let met = Verdict::new(class, even(250.0)).unwrap();
        assert!(met.is_met());
        assert_eq!(
            met.to_string(),
            "meets FMVSS 108 Grade DOT-C2 white, nearest at 0.2 degree, entrance -4 degree: R_A 250, at least 250 cd/lx/m2"
        );
        let failed = Verdict::new(class, even(100.0)).unwrap();
        assert_eq!(
            failed.to_string(),
            "fails FMVSS 108 Grade DOT-C2 white at 0.2 degree, entrance -4 degree: R_A 100, at least 250 cd/lx/m2 (2 of 6 points)"
        );
    }

    #[test]
    fn a_near_miss_does_not_look_like_a_hit() {
        let catalogue = Catalogue::embedded().unwrap();
        let class = catalogue.find("fmvss108:dot-c2:white").unwrap();
        let text = Verdict::new(class, even(249.999)).unwrap().to_string();
        assert!(text.contains("R_A 249.999, at least 250 cd/lx/m2"), "{text}");
    }

    #[test]
    fn maxima_are_met_from_below() {
        let catalogue = Catalogue::embedded().unwrap();
        let class = catalogue.find("fr-plate:white").unwrap();
        assert!(Verdict::new(class, even(100.0)).unwrap().is_met());
        let dazzling = Verdict::new(class, even(300.0)).unwrap();
        assert!(dazzling.to_string().contains("R_A 300, at most 250"), "{dazzling}");
    }

    #[test]
    fn products_and_whole_reflectors_give_no_verdict() {
        let catalogue = Catalogue::embedded().unwrap();
        for name in ["3m-8830", "fmvss108:reflex:white"] {
            assert!(Verdict::new(catalogue.find(name).unwrap(), even(100.0)).is_none(), "{name}");
        }
    }

    #[test]
    fn the_most_demanding_class_that_is_met_comes_first() {
        let catalogue = Catalogue::embedded().unwrap();
        let white = catalogue.classes().iter().filter(|class| class.id().ends_with(":white"));
        let all = verdicts(white, even(251.0));
        assert!(all[0].is_met() && all[0].class().id() == "fmvss108:dot-c2:white", "{}", all[0]);
        let first_failed = all.iter().position(|verdict| !verdict.is_met()).unwrap();
        assert!(all[first_failed..].iter().all(|verdict| !verdict.is_met()));
    }
}
