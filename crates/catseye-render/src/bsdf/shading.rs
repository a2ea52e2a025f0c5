//! A BSDF at a point, seen from a direction.

use glam::Vec3;

use super::lobe::Outgoing;
use super::tree::{Bsdf, MAX_LOBES};
use crate::Frame;

/// The BSDF of a surface point for one outgoing direction: lobes' shares and selection probabilities are
/// settled.
///
/// Directions are in world space. The surface is two-sided: the frame's normal must point to the side of
/// `wo`.
#[derive(Clone, Debug)]
pub struct Shading<'a> {
    bsdf: &'a Bsdf,
    frame: Frame,
    wo_world: Vec3,
    out: [Outgoing; MAX_LOBES],
    shares: [Vec3; MAX_LOBES],
    /// Probabilities with which lobes are sampled; they add up to 1 or 0.
    selection: [f32; MAX_LOBES],
}

/// A sampled direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// The direction, unit length, world space.
    pub wi: Vec3,
    /// f |cos| / pdf.
    pub weight: Vec3,
    /// Density per steradian; 1 for a Dirac lobe, of which only the weight has a meaning.
    pub pdf: f32,
    /// Whether a Dirac lobe chose the direction: light sampling can't meet it.
    pub is_dirac: bool,
}

impl BsdfSample {
    pub(crate) fn dirac(wi: Vec3, weight: Vec3) -> Self {
        Self { wi, weight, pdf: 1.0, is_dirac: true }
    }
}

impl Bsdf {
    /// The BSDF at a point with the given shading frame, seen from `wo_world` on the side of the frame's
    /// normal.
    ///
    /// `inside` says whether that side is the inside of the surface, which matters to dielectrics only.
    #[must_use]
    pub fn at(&self, frame: Frame, wo_world: Vec3, inside: bool) -> Shading<'_> {
        let common = Outgoing { wo: frame.to_local(wo_world), inside };
        let mut out = [common; MAX_LOBES];
        for (out, lobe) in out.iter_mut().zip(&self.lobes) {
            if let Some(own) = lobe.frame(&frame, wo_world) {
                out.wo = own.to_local(wo_world);
            }
        }
        let shares = self.shares(&out);
        let selection = self.selection(&out, &shares);
        Shading { bsdf: self, frame, wo_world, out, shares, selection }
    }

    /// Each lobe's part of the albedo.
    fn selection(&self, out: &[Outgoing; MAX_LOBES], shares: &[Vec3; MAX_LOBES]) -> [f32; MAX_LOBES] {
        let mut selection = [0.0; MAX_LOBES];
        if let [_] = &self.lobes[..] {
            selection[0] = 1.0;
            return selection;
        }
        for (i, lobe) in self.lobes.iter().enumerate() {
            if shares[i] != Vec3::ZERO {
                selection[i] = (shares[i] * lobe.albedo(out[i])).element_sum();
            }
        }
        let total: f32 = selection.iter().sum();
        if total > 0.0 { selection.map(|s| s / total) } else { selection }
    }
}

impl Shading<'_> {
    /// The direction in the frame of a lobe.
    fn local(&self, lobe: usize, wi_world: Vec3, wi_common: Vec3) -> Vec3 {
        let own = self.bsdf.lobes[lobe].frame(&self.frame, self.wo_world);
        own.map_or(wi_common, |own| own.to_local(wi_world))
    }

    fn world(&self, lobe: usize, wi_local: Vec3) -> Vec3 {
        let own = self.bsdf.lobes[lobe].frame(&self.frame, self.wo_world);
        own.unwrap_or(self.frame).to_world(wi_local)
    }

    /// f |cos| per channel, and the density per steradian with which [`Shading::sample`] chooses `wi_world`.
    /// Dirac lobes don't take part.
    #[must_use]
    pub fn eval_pdf(&self, wi_world: Vec3) -> (Vec3, f32) {
        let wi_common = self.frame.to_local(wi_world);
        let (mut f, mut pdf) = (Vec3::ZERO, 0.0);
        for (i, lobe) in self.bsdf.lobes.iter().enumerate() {
            if self.shares[i] == Vec3::ZERO {
                continue;
            }
            let wi = self.local(i, wi_world, wi_common);
            let (f_lobe, pdf_lobe) = lobe.eval_pdf(self.out[i], wi);
            f += self.shares[i] * f_lobe * wi.z.abs();
            pdf += self.selection[i] * pdf_lobe;
        }
        (f, pdf)
    }

    /// A direction for four uniform numbers; `None` where the light is absorbed.
    #[must_use]
    pub fn sample(&self, u: [f32; 4]) -> Option<BsdfSample> {
        let lobe = self.select(u[0])?;
        let sample = self.bsdf.lobes[lobe].sample(self.out[lobe], [u[1], u[2], u[3]])?;
        let wi = self.world(lobe, sample.wi).try_normalize()?;
        if sample.is_dirac || self.bsdf.lobes.len() == 1 {
            let weight = sample.weight * self.shares[lobe] / self.selection[lobe];
            return Some(BsdfSample { wi, weight, ..sample });
        }
        let (f_cos, pdf) = self.eval_pdf(wi);
        (pdf > 0.0).then(|| BsdfSample { wi, weight: f_cos / pdf, pdf, is_dirac: false })
    }

    fn select(&self, u: f32) -> Option<usize> {
        let mut rest = u;
        let mut last = None;
        for (i, &probability) in self.selection.iter().enumerate().take(self.bsdf.lobes.len()) {
            if probability > 0.0 {
                last = Some(i);
                if rest < probability {
                    return last;
                }
                rest -= probability;
            }
        }
        last
    }

    /// Whether all lobes are Dirac distributions: then there is nothing for light sampling to do.
    #[must_use]
    pub fn is_dirac(&self) -> bool {
        self.bsdf.lobes.iter().all(super::lobe::Lobe::is_dirac)
    }

    /// Share of the energy from `wo` that is scattered, per channel.
    #[must_use]
    pub fn albedo(&self) -> Vec3 {
        self.bsdf.lobes.iter().enumerate().map(|(i, l)| self.shares[i] * l.albedo(self.out[i])).sum()
    }
}
