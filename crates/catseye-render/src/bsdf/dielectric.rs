//! Reflection and refraction at a rough dielectric interface: `dielectric_bsdf`.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, PoisonError, RwLock};

use catseye_materialx::ScatterMode;
use glam::Vec3;

use super::albedo::{AlbedoTable, mean_over_square};
use super::fresnel::{fresnel_dielectric, refract};
use super::ggx::{Ggx, SMOOTH_ALPHA};

/// Relative difference of the indices below which there is nothing to see and refraction goes straight on.
const EQUAL_INDEX: f32 = 1e-3;

/// A dielectric interface with GGX facets, single scattering (Walter et al., "Microfacet Models for
/// Refraction through Rough Surfaces", EGSR 2007).
///
/// What is carried along a path is radiance over the squared index, which refraction leaves alone: no factor
/// eta^2.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dielectric {
    tint: Vec3,
    ior: f32,
    ggx: Ggx,
    reflects: bool,
    transmits: bool,
    smooth: bool,
    /// What happens to light from outside and from inside.
    shares: Arc<[Shares; 2]>,
}

/// Shares of the energy as functions of the direction, without tint. Rough facets hide some of either.
#[derive(Clone, Debug, PartialEq)]
struct Shares {
    reflected: AlbedoTable,
    transmitted: AlbedoTable,
}

/// How accurate the shares of energy are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Albedo {
    /// Tabulated for the material.
    Exact,
    /// From a store of steps of the parameters: quick and a little off, for surfaces that vary.
    Cached,
}

impl Dielectric {
    pub(crate) fn new(tint: Vec3, ior: f32, alpha: [f32; 2], mode: ScatterMode, albedo: Albedo) -> Self {
        let ior = if ior.is_finite() && ior > 0.01 { ior } else { 1.0 };
        let smooth = alpha[0].max(alpha[1]) < SMOOTH_ALPHA || (ior - 1.0).abs() < EQUAL_INDEX;
        let ggx = Ggx { alpha: alpha.map(|a| a.clamp(SMOOTH_ALPHA, 1.0)) };
        let shares = match albedo {
            Albedo::Exact => Arc::new(shares(ior, ggx, smooth)),
            Albedo::Cached => stored_shares(ior, (ggx.alpha[0] * ggx.alpha[1]).sqrt(), smooth),
        };
        Self {
            tint: tint.clamp(Vec3::ZERO, Vec3::ONE),
            ior,
            ggx,
            reflects: mode != ScatterMode::Transmit,
            transmits: mode != ScatterMode::Reflect,
            smooth,
            shares,
        }
    }

    /// Whether only `sample` can meet the lobe.
    pub(crate) fn is_dirac(&self) -> bool {
        self.smooth
    }

    /// Index behind the interface over index before it.
    fn eta(&self, inside: bool) -> f32 {
        if inside { 1.0 / self.ior } else { self.ior }
    }

    /// f without cosine, and the density of `wi`. Both 0 for a smooth interface.
    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3, inside: bool) -> (Vec3, f32) {
        if self.smooth || wo.z <= 0.0 || wi.z == 0.0 {
            return (Vec3::ZERO, 0.0);
        }
        let (f, pdf) =
            if wi.z > 0.0 { self.reflected(wo, wi, inside) } else { self.transmitted(wo, wi, inside) };
        if f.is_finite() && pdf.is_finite() { (self.tint * f, pdf) } else { (Vec3::ZERO, 0.0) }
    }

    /// Walter et al., Eq. 20.
    fn reflected(&self, wo: Vec3, wi: Vec3, inside: bool) -> (f32, f32) {
        let Some(m) = (wo + wi).try_normalize().filter(|_| self.reflects) else { return (0.0, 0.0) };
        let fresnel = fresnel_dielectric(wo.dot(m).clamp(0.0, 1.0), self.eta(inside));
        let f = fresnel * self.ggx.d(m) * self.ggx.g2(wo, wi) / (4.0 * wo.z * wi.z);
        let density = self.ggx.d_visible(wo, m) / (4.0 * wo.dot(m));
        (f, density * self.reflect_probability(fresnel))
    }

    /// Walter et al., Eq. 21, without the factor that turns radiance over squared index into radiance.
    fn transmitted(&self, wo: Vec3, wi: Vec3, inside: bool) -> (f32, f32) {
        let eta = self.eta(inside);
        let Some(m) = (wo + wi * eta).try_normalize().filter(|_| self.transmits) else { return (0.0, 0.0) };
        let m = if m.z < 0.0 { -m } else { m };
        let (cos_o, cos_i) = (wo.dot(m), wi.dot(m));
        if cos_o <= 0.0 || cos_i >= 0.0 {
            return (0.0, 0.0);
        }
        let fresnel = fresnel_dielectric(cos_o.min(1.0), eta);
        let jacobian = cos_i.abs() / (cos_i + cos_o / eta).powi(2);
        let f =
            (1.0 - fresnel) * self.ggx.d(m) * self.ggx.g2(wo, wi) * jacobian * cos_o / (wo.z * wi.z.abs());
        let density = self.ggx.d_visible(wo, m) * jacobian;
        (f, density * (1.0 - self.reflect_probability(fresnel)))
    }

    /// The probability with which `sample` reflects at a facet.
    fn reflect_probability(&self, fresnel: f32) -> f32 {
        match (self.reflects, self.transmits) {
            (true, true) => fresnel,
            (true, false) => 1.0,
            (false, _) => 0.0,
        }
    }

    /// A direction; `None` where the facets send it to the wrong side.
    pub(crate) fn sample(&self, wo: Vec3, u: [f32; 3], inside: bool) -> Option<Vec3> {
        let m = if self.smooth { Vec3::Z } else { self.ggx.sample_visible(wo, [u[0], u[1]]) };
        let cos_o = wo.dot(m).clamp(0.0, 1.0);
        let fresnel = fresnel_dielectric(cos_o, self.eta(inside));
        if u[2] < self.reflect_probability(fresnel) {
            let wi = m * (2.0 * wo.dot(m)) - wo;
            return (wi.z > 0.0).then_some(wi);
        }
        let wi = if (self.ior - 1.0).abs() < EQUAL_INDEX { -wo } else { refract(wo, m, self.eta(inside))? };
        (wi.z < 0.0).then_some(wi)
    }

    /// What a smooth interface does with the energy that `sample` sends to `wi`.
    pub(crate) fn dirac_weight(&self, wo: Vec3, wi: Vec3, inside: bool) -> Vec3 {
        let fresnel = fresnel_dielectric(wo.z.min(1.0), self.eta(inside));
        let share = if wi.z > 0.0 { fresnel } else { 1.0 - fresnel };
        let probability = self.reflect_probability(fresnel);
        self.tint * (share / if wi.z > 0.0 { probability } else { 1.0 - probability })
    }

    /// The share of energy that is reflected or transmitted.
    pub(crate) fn albedo(&self, wo: Vec3, inside: bool) -> Vec3 {
        let shares = &self.shares[usize::from(inside)];
        let reflected = if self.reflects { shares.reflected.look_up_direction(wo) } else { 0.0 };
        let transmitted = if self.transmits { shares.transmitted.look_up_direction(wo) } else { 0.0 };
        self.tint * (reflected + transmitted)
    }

    /// The share of energy that goes on to what lies below, in MaterialX's sense: the tint doesn't count.
    pub(crate) fn throughput(&self, wo: Vec3, inside: bool) -> f32 {
        let reflected = self.shares[usize::from(inside)].reflected.look_up_direction(wo);
        match (self.reflects, self.transmits) {
            (true, false) => 1.0 - reflected,
            (false, true) => reflected,
            _ => 0.0,
        }
    }
}

/// The shares of energy from outside and from inside.
fn shares(ior: f32, ggx: Ggx, smooth: bool) -> [Shares; 2] {
    let isotropic = smooth || ggx.alpha[0] == ggx.alpha[1];
    [ior, 1.0 / ior].map(|eta| {
        let table = |share: fn(Ggx, Vec3, f32) -> f32, smooth_share: fn(f32) -> f32| {
            AlbedoTable::of_directions(isotropic, |wo| {
                if smooth { smooth_share(fresnel_dielectric(wo.z, eta)) } else { share(ggx, wo, eta) }
            })
        };
        Shares {
            reflected: table(rough_reflectance, |fresnel| fresnel),
            transmitted: table(rough_transmittance, |fresnel| 1.0 - fresnel),
        }
    })
}

/// [`shares`] of an interface nearby: indices in steps of 1/64 up to 8, roots of alpha in steps of 1/32.
///
/// What is found depends on the arguments alone, not on who asked before.
fn stored_shares(ior: f32, alpha: f32, smooth: bool) -> Arc<[Shares; 2]> {
    type Store = RwLock<HashMap<(u16, u16, bool), Arc<[Shares; 2]>>>;
    static STORE: LazyLock<Store> = LazyLock::new(Store::default);
    let (ior_step, alpha_step) =
        ((ior.min(8.0) * 64.0).round().max(1.0), (alpha.sqrt() * 32.0).round().max(1.0));
    let key = (ior_step as u16, alpha_step as u16, smooth);
    if let Some(known) = STORE.read().unwrap_or_else(PoisonError::into_inner).get(&key) {
        return Arc::clone(known);
    }
    let alpha = (alpha_step / 32.0) * (alpha_step / 32.0);
    let made = Arc::new(shares(ior_step / 64.0, Ggx { alpha: [alpha; 2] }, smooth));
    let mut store = STORE.write().unwrap_or_else(PoisonError::into_inner);
    Arc::clone(store.entry(key).or_insert(made))
}

/// The mean of F G2/G1 over visible facets.
fn rough_reflectance(ggx: Ggx, wo: Vec3, eta: f32) -> f32 {
    mean_over_square(|u| {
        let m = ggx.sample_visible(wo, u);
        let cos = wo.dot(m).clamp(0.0, 1.0);
        let wi = m * (2.0 * cos) - wo;
        if wi.z > 0.0 { fresnel_dielectric(cos, eta) * ggx.g2(wo, wi) / ggx.g1(wo) } else { 0.0 }
    })
}

/// The mean of (1 - F) G2/G1 over visible facets.
fn rough_transmittance(ggx: Ggx, wo: Vec3, eta: f32) -> f32 {
    mean_over_square(|u| {
        let m = ggx.sample_visible(wo, u);
        let fresnel = fresnel_dielectric(wo.dot(m).clamp(0.0, 1.0), eta);
        match refract(wo, m, eta) {
            Some(wi) if wi.z < 0.0 => (1.0 - fresnel) * ggx.g2(wo, wi) / ggx.g1(wo),
            _ => 0.0,
        }
    })
}
