//! One leaf of a closure tree.

use catseye::{AnyLobe, Lobe as _};
use glam::Vec3;

use super::dielectric::Dielectric;
use super::diffuse::OrenNayar;

/// A lobe and its share.
#[derive(Clone, Debug)]
pub(crate) struct Lobe {
    /// MaterialX's `weight` input, in `[0, 1]`.
    pub(crate) weight: f32,
    pub(crate) kind: LobeKind,
}

#[derive(Clone, Debug)]
pub(crate) enum LobeKind {
    /// The retro-reflective lobe, and its own tangent in world space if it has one.
    Retro {
        lobe: Box<AnyLobe<f32>>,
        tangent_world: Option<Vec3>,
    },
    Diffuse(OrenNayar),
    Dielectric(Dielectric),
}

/// The directions a lobe is asked about. `wo.z` is positive; `inside` says whether the outside of the surface is on
/// the other side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outgoing {
    pub(crate) wo: Vec3,
    pub(crate) inside: bool,
}

/// A direction from a lobe's sampler.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LobeSample {
    pub(crate) wi: Vec3,
    /// f |cos| / pdf.
    pub(crate) weight: Vec3,
    /// `None` for a Dirac lobe.
    pub(crate) pdf: Option<f32>,
}

impl Lobe {
    /// Whether only `sample` can meet the lobe.
    pub(crate) fn is_dirac(&self) -> bool {
        match &self.kind {
            LobeKind::Retro { lobe, .. } => lobe.is_dirac(),
            LobeKind::Diffuse(_) => false,
            LobeKind::Dielectric(lobe) => lobe.is_dirac(),
        }
    }

    /// f without cosine and the density of `wi`, both without the lobe's share.
    #[inline]
    pub(crate) fn eval_pdf(&self, out: Outgoing, wi: Vec3) -> (Vec3, f32) {
        match &self.kind {
            LobeKind::Retro { lobe, .. } => {
                let (f, pdf) = lobe.eval_pdf(to_catseye(out.wo), to_catseye(wi));
                (Vec3::from(f), pdf)
            }
            LobeKind::Diffuse(lobe) => (lobe.eval(out.wo, wi), lobe.pdf(out.wo, wi)),
            LobeKind::Dielectric(lobe) => lobe.eval_pdf(out.wo, wi, out.inside),
        }
    }

    /// A direction for three uniform numbers, without the lobe's share.
    #[inline]
    pub(crate) fn sample(&self, out: Outgoing, u: [f32; 3]) -> Option<LobeSample> {
        match &self.kind {
            LobeKind::Retro { lobe, .. } => {
                let sample = lobe.sample(to_catseye(out.wo), u)?;
                let wi = Vec3::from(<[f32; 3]>::from(sample.wi));
                let pdf = (!lobe.is_dirac()).then_some(sample.pdf);
                Some(LobeSample { wi, weight: Vec3::from(sample.weight), pdf })
            }
            LobeKind::Diffuse(lobe) => self.evaluated(out, lobe.sample([u[0], u[1]])),
            LobeKind::Dielectric(lobe) => {
                let wi = lobe.sample(out.wo, u, out.inside)?;
                if lobe.is_dirac() {
                    let weight = lobe.dirac_weight(out.wo, wi, out.inside);
                    return Some(LobeSample { wi, weight, pdf: None });
                }
                self.evaluated(out, wi)
            }
        }
    }

    fn evaluated(&self, out: Outgoing, wi: Vec3) -> Option<LobeSample> {
        let (f, pdf) = self.eval_pdf(out, wi);
        (pdf > 0.0).then(|| LobeSample { wi, weight: f * (wi.z.abs() / pdf), pdf: Some(pdf) })
    }

    /// The share of the energy from `wo` that is scattered, without the lobe's share.
    #[inline]
    pub(crate) fn albedo(&self, out: Outgoing) -> Vec3 {
        match &self.kind {
            LobeKind::Retro { lobe, .. } => Vec3::from(lobe.albedo(to_catseye(out.wo))),
            LobeKind::Diffuse(lobe) => lobe.albedo(out.wo),
            LobeKind::Dielectric(lobe) => lobe.albedo(out.wo, out.inside),
        }
    }

    /// The share of energy that goes on to what `layer` puts below, the lobe's share included.
    ///
    /// Diffuse reflection lets nothing through, a dielectric what it doesn't reflect (as in MaterialX's own lobes), a
    /// retro-reflective lobe what it doesn't send back: its tint is its strength, what is missing was never caught.
    #[inline]
    pub(crate) fn throughput(&self, out: Outgoing) -> Vec3 {
        let lobe = match &self.kind {
            LobeKind::Retro { .. } => Vec3::ONE - self.albedo(out),
            LobeKind::Diffuse(_) => Vec3::ZERO,
            LobeKind::Dielectric(lobe) => Vec3::splat(lobe.throughput(out.wo, out.inside)),
        };
        (Vec3::ONE + self.weight * (lobe - Vec3::ONE)).clamp(Vec3::ZERO, Vec3::ONE)
    }
}

fn to_catseye(v: Vec3) -> catseye::Vec3<f32> {
    catseye::Vec3::new(v.x, v.y, v.z)
}
