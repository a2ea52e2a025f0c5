//! The shape of a model that is fitted, and what its numbers mean.

use catseye::Model;

use crate::entrance::EntranceLaw;
use crate::sheeting::{RetroLobe, Sheeting};

/// Narrowest and widest roughness that is looked for: half-power angles of 0.03 degrees, and all there is.
const ROUGHNESS: [f64; 2] = [5e-4, 3.0];
/// The weakest lobe, or base, that is looked for.
const LEAST_STRENGTH: f64 = 1e-7;
/// What sheeting has, and by which factor it varies: white sheeting and tapes of the standards have strengths
/// of 0.02 to 0.14 and roughnesses of 0.003 to 0.02.
const STRENGTH_PRIOR: [f64; 2] = [0.05, 5.0];
const ROUGHNESS_PRIOR: [f64; 2] = [0.008, 2.5];
/// Powers of the cosine, and of the tangent beyond a bend. What a surface catches falls with the cosine, so
/// `R_A` falls at least as fast. At most it falls by (tan 60 / tan 50)^6 = 9.4 in the 10 degrees up to 60,
/// and by 28 in those up to 75.
const POWER: [f64; 2] = [1.0, 6.0];
/// Squared tangent at the bend: 30 to 70 degrees. Below 30 a sharp bend would fall by more than ten times in
/// 10 degrees.
const BEND: [f64; 2] = [1.0 / 3.0, 7.55];
/// Sharpness of the bend: 2 is that of a power of the cosine; at 12 it is over within 10 degrees.
const SHARPNESS: [f64; 2] = [2.0, 12.0];
/// The laws that are steepest of all, before the bend and beyond it.
pub(crate) const EXTREME_LAWS: [EntranceLaw; 2] = [
    EntranceLaw { slope: POWER[1], bend: BEND[0], sharpness: SHARPNESS[0] },
    EntranceLaw { slope: POWER[1], bend: BEND[0], sharpness: SHARPNESS[1] },
];
/// What beads and metallised cubes have: 45 to 50 degrees, 2 to 3, and a power of about 3.
const POWER_PRIOR: [f64; 2] = [3.0, 2.0];
const BEND_PRIOR: [f64; 2] = [1.0, 1.7];
const SHARPNESS_PRIOR: [f64; 2] = [2.0, 2.0];

/// How a lobe's strength may depend on the entrance angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum EntranceKind {
    /// Not at all.
    #[default]
    Constant,
    /// As a power of the cosine.
    Power,
    /// Flat at first, one bend, then a power of the tangent.
    Bend,
}

/// The shape of a sheeting: what a fit is free to choose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Form {
    /// Which lobe model.
    pub model: Model,
    /// Lobes, at least 1.
    pub lobes: usize,
    /// The kind of the entrance laws.
    pub entrance: EntranceKind,
    /// Whether all lobes have the same entrance law; if not, each has its own power, and the bend is common.
    pub shared: bool,
    /// Whether a lobe has two roughnesses.
    pub anisotropic: bool,
    /// Whether there is a diffuse base.
    pub diffuse: bool,
    /// The roughness of a single lobe where it is given.
    pub roughness: Option<f64>,
    /// Refractive index of the clear coat, where there is one.
    pub coat_ior: Option<f64>,
}

/// What a number of the fit is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// Logarithm of a lobe's strength.
    Strength(usize),
    /// Logarithm of a lobe's roughness along (0) or across (1) the datum axis, or both (`None`).
    Roughness(usize, Option<usize>),
    /// Exponent of the cosine, and of the tangent beyond a bend: of a lobe, or of all (`None`).
    Power(Option<usize>),
    /// Logarithm of the squared tangent of the bend's entrance angle.
    Bend,
    /// Logarithm of the bend's sharpness.
    Sharpness,
    /// Logarithm of the albedo of the base.
    Diffuse,
}

/// One number of the fit: its bounds, and where it is drawn, weakly, if the data don't say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unknown {
    pub(crate) meaning: Meaning,
    pub(crate) bounds: [f64; 2],
    /// Where ignorance puts it, and how far from there is one unit of `prior_residual`.
    pub(crate) prior: [f64; 2],
}

impl Unknown {
    /// How far a value is from where ignorance puts it.
    pub(crate) fn prior_residual(&self, x: f64) -> f64 {
        (x - self.prior[0]) / self.prior[1]
    }
}

impl Meaning {
    /// The quantity for a number of the fit; of the bend its angle in degrees.
    #[must_use]
    pub(crate) fn quantity(self, x: f64) -> f64 {
        match self {
            Self::Power(_) => x,
            Self::Bend => (0.5 * x).exp().atan().to_degrees(),
            _ => x.exp(),
        }
    }

    /// Whether the number belongs to the lobe.
    #[must_use]
    pub(crate) fn concerns(self, lobe: usize) -> bool {
        match self {
            Self::Strength(i) | Self::Roughness(i, _) => i == lobe,
            Self::Power(i) => i.is_none_or(|i| i == lobe),
            Self::Bend | Self::Sharpness => true,
            Self::Diffuse => false,
        }
    }

    /// The quantity's name, as in `lobe 2 roughness`.
    #[must_use]
    pub fn name(self) -> String {
        let of = |lobe: Option<usize>, what: &str| match lobe {
            Some(i) => format!("lobe {} {what}", i + 1),
            None => what.to_owned(),
        };
        match self {
            Self::Strength(i) => of(Some(i), "strength"),
            Self::Roughness(i, None) => of(Some(i), "roughness"),
            Self::Roughness(i, Some(0)) => of(Some(i), "roughness_u"),
            Self::Roughness(i, Some(_)) => of(Some(i), "roughness_v"),
            Self::Power(i) => of(i, "entrance power"),
            Self::Bend => "entrance bend (deg)".to_owned(),
            Self::Sharpness => "entrance sharpness".to_owned(),
            Self::Diffuse => "diffuse albedo".to_owned(),
        }
    }
}

impl Form {
    /// The numbers that the form leaves open, in the order of a fit's vector.
    pub(crate) fn unknowns(&self) -> Vec<Unknown> {
        let mut unknowns = Vec::new();
        for lobe in 0..self.lobes {
            unknowns.push(log(Meaning::Strength(lobe), [LEAST_STRENGTH, 1.0], STRENGTH_PRIOR));
            if self.roughness.is_none() {
                let axes: &[_] = if self.anisotropic { &[Some(0), Some(1)] } else { &[None] };
                let roughness = |&axis| log(Meaning::Roughness(lobe, axis), ROUGHNESS, ROUGHNESS_PRIOR);
                unknowns.extend(axes.iter().map(roughness));
            }
        }
        if self.entrance != EntranceKind::Constant {
            let owners = if self.shared { vec![None] } else { (0..self.lobes).map(Some).collect() };
            unknowns.extend(owners.into_iter().map(|owner| Unknown {
                meaning: Meaning::Power(owner),
                bounds: POWER,
                prior: POWER_PRIOR,
            }));
        }
        if self.entrance == EntranceKind::Bend {
            unknowns.push(log(Meaning::Bend, BEND, BEND_PRIOR));
            unknowns.push(log(Meaning::Sharpness, SHARPNESS, SHARPNESS_PRIOR));
        }
        if self.diffuse {
            unknowns.push(log(Meaning::Diffuse, [LEAST_STRENGTH, 1.0], [0.3, 3.0]));
        }
        unknowns
    }

    /// The sheeting that a vector describes.
    pub(crate) fn sheeting(&self, unknowns: &[Unknown], x: &[f64]) -> Sheeting {
        let find =
            |wanted: Meaning| unknowns.iter().position(|unknown| unknown.meaning == wanted).map(|i| x[i]);
        let entrance = |lobe: usize| {
            let owner = (!self.shared).then_some(lobe);
            let law = EntranceLaw::power(find(Meaning::Power(owner))?);
            Some(match find(Meaning::Bend).zip(find(Meaning::Sharpness)) {
                Some((bend, sharpness)) => {
                    EntranceLaw { bend: bend.exp(), sharpness: sharpness.exp(), ..law }
                }
                None => law,
            })
        };
        let roughness = |lobe: usize| {
            let of = |axis| find(Meaning::Roughness(lobe, axis)).map(f64::exp);
            let both = self.roughness.or_else(|| of(None));
            [0, 1].map(|axis| both.or_else(|| of(Some(axis))).unwrap_or(0.0))
        };
        let lobe = |i| RetroLobe {
            strength: find(Meaning::Strength(i)).map_or(0.0, f64::exp),
            roughness: roughness(i),
            entrance: entrance(i),
        };
        Sheeting {
            model: self.model,
            lobes: (0..self.lobes).map(lobe).collect(),
            diffuse: find(Meaning::Diffuse).map_or(0.0, f64::exp),
            coat_ior: self.coat_ior,
            coat_roughness: 0.0,
        }
    }
}

impl Form {
    /// The numbers of this form that describe a sheeting of a simpler form; `None` where that is no case of
    /// this one.
    ///
    /// A lobe more shares the strength of the last one, with the same roughness.
    pub(crate) fn embed(&self, simpler: &Self, x: &[f64]) -> Option<Vec<f64>> {
        let more = self.lobes.checked_sub(simpler.lobes)?;
        let is_case = simpler.entrance <= self.entrance
            && (simpler.entrance == EntranceKind::Constant) == (self.entrance == EntranceKind::Constant)
            && (simpler.shared || !self.shared || simpler.lobes == 1);
        if !is_case {
            return None;
        }
        let known = simpler.unknowns();
        let find = |wanted: Meaning| known.iter().position(|unknown| unknown.meaning == wanted).map(|i| x[i]);
        let last = simpler.lobes - 1;
        let value = |unknown: Unknown| match unknown.meaning {
            Meaning::Strength(i) => {
                let parts = if i >= last { 1.0 + more as f64 } else { 1.0 };
                find(Meaning::Strength(i.min(last))).map(|x| x - parts.ln())
            }
            Meaning::Roughness(i, axis) => find(Meaning::Roughness(i.min(last), axis)),
            Meaning::Power(owner) => {
                find(Meaning::Power(None)).or_else(|| find(Meaning::Power(owner.map(|i| i.min(last)))))
            }
            // A power of the cosine is a law with this bend and this sharpness.
            Meaning::Bend => Some(find(Meaning::Bend).unwrap_or(0.0)),
            Meaning::Sharpness => Some(find(Meaning::Sharpness).unwrap_or(2.0_f64.ln())),
            Meaning::Diffuse => find(Meaning::Diffuse),
        };
        self.unknowns().into_iter().map(value).collect()
    }
}

/// A positive quantity, fitted by its logarithm; the prior's width is a factor.
fn log(meaning: Meaning, bounds: [f64; 2], [centre, factor]: [f64; 2]) -> Unknown {
    Unknown { meaning, bounds: bounds.map(f64::ln), prior: [centre.ln(), factor.ln()] }
}
