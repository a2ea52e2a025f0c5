//! The shape of a model that is fitted, and what its numbers mean.

use catseye::Model;

use crate::entrance::{EntranceFactor, Knee};
use crate::sheeting::{EntranceCosine, RetroLobe, Sheeting};

/// Narrowest and widest roughness that is looked for: half-power angles of 0.03 degrees, and all there is.
const ROUGHNESS: [f64; 2] = [5e-4, 3.0];
/// The weakest lobe, or base, that is looked for.
const LEAST_STRENGTH: f64 = 1e-7;
/// What sheeting has, and by which factor it varies: white sheeting and tapes of the standards have strengths of 0.02 to
/// 0.14 and roughnesses of 0.003 to 0.02.
const STRENGTH_PRIOR: [f64; 2] = [0.05, 5.0];
const ROUGHNESS_PRIOR: [f64; 2] = [0.008, 2.5];
/// Exponents of the cosine. What a surface catches falls with the cosine, so R_A falls at least as fast; a slower fall
/// would glow towards the horizon. Beside a knee, which ends that, the exponent may be negative.
const POWER: [f64; 2] = [1.0, 40.0];
const POWER_BESIDE_KNEE: f64 = -3.0;
/// Squared tangent at the knee: 6 to 63 degrees. A steeper knee than the steepest is an edge on the material.
const KNEE_POSITION: [f64; 2] = [0.01, 4.0];
const KNEE_STEEPNESS: [f64; 2] = [1.0, 8.0];

/// How a lobe's strength may depend on the entrance angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum EntranceKind {
    /// Not at all.
    #[default]
    Constant,
    /// As a power of the cosine.
    Power,
    /// As a power of the cosine that breaks off.
    Knee,
}

/// The shape of a sheeting: what a fit is free to choose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Form {
    /// Which lobe model.
    pub model: Model,
    /// Lobes, at least 1.
    pub lobes: usize,
    /// The kind of the entrance factors.
    pub entrance: EntranceKind,
    /// Whether all lobes have the same entrance factor.
    pub shared: bool,
    /// Whether a lobe has two roughnesses.
    pub anisotropic: bool,
    /// Whether there is a diffuse base.
    pub diffuse: bool,
    /// The roughness of a single lobe where it is given.
    pub roughness: Option<f64>,
    /// Refractive index of the clear coat, where there is one.
    pub coat_ior: Option<f64>,
    /// Which cosine the entrance factors see.
    pub entrance_cosine: EntranceCosine,
}

/// What a number of the fit is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// Logarithm of a lobe's strength.
    Strength(usize),
    /// Logarithm of a lobe's roughness along (0) or across (1) the datum axis, or both (`None`).
    Roughness(usize, Option<usize>),
    /// Exponent of the cosine: of a lobe, or of all (`None`).
    Power(Option<usize>),
    /// Logarithm of the knee's position.
    Position(Option<usize>),
    /// Logarithm of the knee's steepness.
    Steepness(Option<usize>),
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
    /// Whether the number is the logarithm of the quantity.
    #[must_use]
    pub fn is_log(self) -> bool {
        !matches!(self, Self::Power(_))
    }

    /// Whether the number belongs to the lobe.
    #[must_use]
    pub(crate) fn concerns(self, lobe: usize) -> bool {
        match self {
            Self::Strength(i) | Self::Roughness(i, _) => i == lobe,
            Self::Power(i) | Self::Position(i) | Self::Steepness(i) => i.is_none_or(|i| i == lobe),
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
            Self::Position(i) => of(i, "entrance knee position"),
            Self::Steepness(i) => of(i, "entrance knee steepness"),
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
        let owners: Vec<_> = if self.shared { vec![None] } else { (0..self.lobes).map(Some).collect() };
        for owner in owners {
            self.entrance_unknowns(owner, &mut unknowns);
        }
        if self.diffuse {
            unknowns.push(log(Meaning::Diffuse, [LEAST_STRENGTH, 1.0], [0.3, 3.0]));
        }
        unknowns
    }

    fn entrance_unknowns(&self, owner: Option<usize>, unknowns: &mut Vec<Unknown>) {
        let knee = self.entrance == EntranceKind::Knee;
        if self.entrance != EntranceKind::Constant {
            let least = if knee { POWER_BESIDE_KNEE } else { POWER[0] };
            let meaning = Meaning::Power(owner);
            unknowns.push(Unknown { meaning, bounds: [least, POWER[1]], prior: [1.0, 3.0] });
        }
        if knee {
            unknowns.push(log(Meaning::Position(owner), KNEE_POSITION, [0.7, 2.0]));
            unknowns.push(log(Meaning::Steepness(owner), KNEE_STEEPNESS, [4.0, 3.0]));
        }
    }

    /// The sheeting that a vector describes.
    pub(crate) fn sheeting(&self, unknowns: &[Unknown], x: &[f64]) -> Sheeting {
        let find =
            |wanted: Meaning| unknowns.iter().position(|unknown| unknown.meaning == wanted).map(|i| x[i]);
        let entrance = |lobe: usize| {
            let owner = (!self.shared).then_some(lobe);
            let position = find(Meaning::Position(owner)).zip(find(Meaning::Steepness(owner)));
            EntranceFactor {
                power: find(Meaning::Power(owner)).unwrap_or(0.0),
                knee: position.map(|(p, s)| Knee { position: p.exp(), steepness: s.exp() }),
            }
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
            form: self.entrance_cosine,
        }
    }
}

/// A positive quantity, fitted by its logarithm; the prior's width is a factor.
fn log(meaning: Meaning, bounds: [f64; 2], [centre, factor]: [f64; 2]) -> Unknown {
    Unknown { meaning, bounds: bounds.map(f64::ln), prior: [centre.ln(), factor.ln()] }
}
