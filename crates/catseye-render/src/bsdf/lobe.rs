//! One leaf of a closure tree.

use catseye::{AnyLobe, Lobe as _};
use glam::Vec3;

use super::dielectric::Dielectric;
use super::diffuse::Diffuse;
use super::microfacet::Microfacet;
use super::shading::BsdfSample;
use crate::Frame;

/// A lobe and its share.
#[derive(Clone, Debug)]
pub(crate) struct Lobe {
    /// MaterialX's `weight` input, in `[0, 1]`.
    pub(crate) weight: f32,
    pub(crate) kind: LobeKind,
    /// Whether `wo` is mirrored about the normal first: what would be mirrored is sent back.
    pub(crate) retroreflective: bool,
    /// The lobe's own normal and tangent in world space.
    pub(crate) normal_world: Option<Vec3>,
    pub(crate) tangent_world: Option<Vec3>,
}

#[derive(Clone, Debug)]
pub(crate) enum LobeKind {
    Retro(Box<AnyLobe<f32>>),
    Diffuse(Diffuse),
    Dielectric(Dielectric),
    Microfacet(Microfacet),
}

/// The directions a lobe is asked about. `wo.z` is positive; `inside` says whether the outside of the surface
/// is on the other side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outgoing {
    pub(crate) wo: Vec3,
    pub(crate) inside: bool,
}

impl Lobe {
    /// A lobe about the surface's normal and tangent.
    pub(crate) fn new(weight: f32, kind: LobeKind) -> Self {
        let weight = weight.clamp(0.0, 1.0);
        Self { weight, kind, retroreflective: false, normal_world: None, tangent_world: None }
    }

    /// The lobe's own frame; `None` where it is the surface's.
    #[inline]
    pub(crate) fn frame(&self, surface: &Frame, wo_world: Vec3) -> Option<Frame> {
        if self.normal_world.is_none() && self.tangent_world.is_none() {
            return None;
        }
        let normal = self.normal_world.map_or(surface.z, |normal| visible(normal, surface.z, wo_world));
        Some(Frame::from_normal_tangent(normal, self.tangent_world.unwrap_or(surface.x)))
    }

    /// Whether only `sample` can meet the lobe.
    pub(crate) fn is_dirac(&self) -> bool {
        match &self.kind {
            LobeKind::Retro(lobe) => lobe.is_dirac(),
            LobeKind::Diffuse(_) => false,
            LobeKind::Dielectric(lobe) => lobe.is_dirac(),
            LobeKind::Microfacet(lobe) => lobe.is_dirac(),
        }
    }

    /// Whether the lobe is about the direction that the light comes from.
    pub(crate) fn is_retroreflective(&self) -> bool {
        self.retroreflective || matches!(self.kind, LobeKind::Retro(_))
    }

    /// The direction that facets see.
    fn mirrored(&self, out: Outgoing) -> Outgoing {
        match self.retroreflective {
            true => Outgoing { wo: Vec3::new(-out.wo.x, -out.wo.y, out.wo.z), ..out },
            false => out,
        }
    }

    /// f without cosine and the density of `wi`, both without the lobe's share.
    #[inline]
    pub(crate) fn eval_pdf(&self, out: Outgoing, wi: Vec3) -> (Vec3, f32) {
        match &self.kind {
            LobeKind::Retro(lobe) => {
                let (f, pdf) = lobe.eval_pdf(to_catseye(out.wo), to_catseye(wi));
                (Vec3::from(f), pdf)
            }
            LobeKind::Diffuse(lobe) => (lobe.eval(out.wo, wi), lobe.pdf(out.wo, wi)),
            LobeKind::Dielectric(lobe) => lobe.eval_pdf(self.mirrored(out).wo, wi, out.inside),
            LobeKind::Microfacet(lobe) => lobe.eval_pdf(self.mirrored(out).wo, wi),
        }
    }

    /// A direction in the lobe's frame for three uniform numbers, without the lobe's share.
    #[inline]
    pub(crate) fn sample(&self, out: Outgoing, u: [f32; 3]) -> Option<BsdfSample> {
        let mirrored = self.mirrored(out).wo;
        match &self.kind {
            LobeKind::Retro(lobe) => {
                let sample = lobe.sample(to_catseye(out.wo), u)?;
                let wi = Vec3::from(<[f32; 3]>::from(sample.wi));
                let (weight, is_dirac) = (Vec3::from(sample.weight), lobe.is_dirac());
                Some(BsdfSample { wi, weight, pdf: sample.pdf, is_dirac })
            }
            LobeKind::Diffuse(lobe) => self.evaluated(out, lobe.sample([u[0], u[1]])),
            LobeKind::Dielectric(lobe) => {
                let wi = lobe.sample(mirrored, u, out.inside)?;
                if lobe.is_dirac() {
                    return Some(BsdfSample::dirac(wi, lobe.dirac_weight(mirrored, wi, out.inside)));
                }
                self.evaluated(out, wi)
            }
            LobeKind::Microfacet(lobe) => {
                let wi = lobe.sample(mirrored, [u[0], u[1]])?;
                if lobe.is_dirac() {
                    return Some(BsdfSample::dirac(wi, lobe.dirac_weight(mirrored)));
                }
                self.evaluated(out, wi)
            }
        }
    }

    fn evaluated(&self, out: Outgoing, wi: Vec3) -> Option<BsdfSample> {
        let (f, pdf) = self.eval_pdf(out, wi);
        (pdf > 0.0).then(|| BsdfSample { wi, weight: f * (wi.z.abs() / pdf), pdf, is_dirac: false })
    }

    /// The share of the energy from `wo` that is scattered, without the lobe's share.
    #[inline]
    pub(crate) fn albedo(&self, out: Outgoing) -> Vec3 {
        match &self.kind {
            LobeKind::Retro(lobe) => Vec3::from(lobe.albedo(to_catseye(out.wo))),
            LobeKind::Diffuse(lobe) => lobe.albedo(out.wo),
            LobeKind::Dielectric(lobe) => lobe.albedo(out.wo, out.inside),
            LobeKind::Microfacet(lobe) => lobe.albedo(out.wo),
        }
    }

    /// The share of energy that goes on to what `layer` puts below, the lobe's share included.
    ///
    /// Diffuse reflection and metals let nothing through, a dielectric what it doesn't reflect (as in
    /// MaterialX's own lobes), a retro-reflective lobe what it doesn't send back: its tint is its strength,
    /// what is missing was never caught.
    #[inline]
    pub(crate) fn throughput(&self, out: Outgoing) -> Vec3 {
        let lobe = match &self.kind {
            LobeKind::Retro(_) => Vec3::ONE - self.albedo(out),
            LobeKind::Diffuse(lobe) => lobe.throughput(out.wo),
            LobeKind::Dielectric(lobe) => Vec3::splat(lobe.throughput(out.wo, out.inside)),
            LobeKind::Microfacet(lobe) => lobe.throughput(out.wo),
        };
        (Vec3::ONE + self.weight * (lobe - Vec3::ONE)).clamp(Vec3::ZERO, Vec3::ONE)
    }
}

/// A normal turned to the side of the surface's, and bent to where the viewer can see it.
fn visible(normal: Vec3, surface: Vec3, wo: Vec3) -> Vec3 {
    /// The least cosine between the normal and the viewer.
    const LEAST: f32 = 0.01;
    let normal = if normal.dot(surface) < 0.0 { -normal } else { normal };
    let cos = normal.dot(wo);
    if cos >= LEAST { normal } else { (normal + wo * (LEAST - cos)).normalize_or(surface) }
}

fn to_catseye(v: Vec3) -> catseye::Vec3<f32> {
    catseye::Vec3::new(v.x, v.y, v.z)
}
