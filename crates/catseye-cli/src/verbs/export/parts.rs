//! What a material is made of, and what of it other programs can't have.

use anyhow::bail;
use catseye_materialx::{Closure, Material, ScatterMode, ShadingPoint};
use catseye_photometry::export::{Coat, LobeSample, ViewedLobe};

use crate::instrument::goniometer::varies_over_the_surface;

/// Cosines between viewer and normal that a material is looked at.
const COSINES: usize = 24;
/// The widest roughness whose compensation is left out: it returns some thousandths of what the lobe does.
const NARROW: f32 = 0.05;
/// Sine of the polar angle from which on the viewer's projection has a direction.
const LEAST_SINE: f32 = 1e-3;

/// A BSDF that scatters by itself, with the product of all weights above it.
#[derive(Clone, Debug)]
enum Leaf {
    /// `retro_reflective_bsdf`.
    Retro { tint: [f32; 3], roughness: [f32; 2], tangent: Option<[f32; 3]>, compensated: bool },
    /// A microfacet lobe with `retroreflective`.
    BackVector,
    /// Diffuse reflection, and whether it is Lambert's.
    Diffuse { color: [f32; 3], lambert: bool },
    /// Anything else, by its node's name.
    Other(&'static str),
}

/// The parts of a material, for Radiance.
#[derive(Clone, Debug)]
pub(super) struct Parts {
    pub(super) lobes: Vec<ViewedLobe>,
    pub(super) base: [f64; 3],
    pub(super) coat: Option<Coat>,
    pub(super) left_out: Vec<LeftOut>,
}

/// What of a material is approximated, and counts in its error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LeftOut {
    /// A diffuse base that is rough, or depends on the viewer's direction, is Lambert's.
    RoughBase,
    /// The compensation of narrow lobes.
    Compensation,
}

impl LeftOut {
    /// The same as a sentence.
    pub(super) fn sentence(self) -> &'static str {
        match self {
            Self::RoughBase => "the base is not Lambert's, and is here, of the same luminance factor at 45/0",
            Self::Compensation => {
                "multiscatter_tint is left out: of lobes so narrow it returns next to nothing"
            }
        }
    }
}

/// Whether light is sent back by some lobe, as a viewer along the normal sees it.
pub(super) fn is_retro(material: &Material) -> bool {
    let leaves = leaves(&material.surface.bsdf);
    leaves.iter().any(|leaf| matches!(leaf, Leaf::Retro { .. } | Leaf::BackVector))
}

/// Refuses what is neither a retro-reflective lobe nor diffuse: glass, fibres, holes, a glow, a texture, and
/// a clear coat over all of it unless there is room for one.
pub(super) fn refuse_others(name: &str, material: &Material, has_coat: bool) -> anyhow::Result<()> {
    let surface = &material.surface;
    let below = if has_coat { below_coat(&surface.bsdf).1 } else { &surface.bsdf };
    let other = leaves(below).into_iter().find_map(|leaf| match leaf {
        Leaf::Other(node) => Some(format!("has a {node}")),
        _ => None,
    });
    let has_holes =
        surface.opacity < 1.0 || material.patterns.as_ref().is_some_and(|patterns| patterns.has_opacity());
    let glows = surface.emission.iter().any(|channel| *channel != 0.0);
    let more = [
        (has_holes, "has an opacity below 1"),
        (glows, "emits light"),
        (varies_over_the_surface(material), "varies over the surface"),
    ];
    let more = more.into_iter().find_map(|(is_so, what)| is_so.then(|| what.to_owned()));
    match other.or(more) {
        Some(part) => bail!(
            "{name}: {part}, which this target can't carry beside the lobes; export the material without it, \
             or to csv or openmaterial, which hold what is measured of the whole"
        ),
        None => Ok(()),
    }
}

impl Parts {
    /// The lobes and the base, of a material that [`refuse_others`] lets pass, as formulas of the viewer's
    /// direction.
    pub(super) fn of(name: &str, material: &Material) -> anyhow::Result<Self> {
        let (coat, below) = below_coat(&material.surface.bsdf);
        let head_on = leaves(below);
        let mut base = [0.0; 3];
        let mut left_out = Vec::new();
        for leaf in &head_on {
            match leaf {
                Leaf::Diffuse { color, lambert } => {
                    base = [0, 1, 2].map(|c| base[c] + f64::from(color[c]));
                    left_out.extend((!lambert).then_some(LeftOut::RoughBase));
                }
                Leaf::BackVector => bail!(
                    "{name}: has a back-vector lobe (retroreflective); Radiance is given \
                     retro_reflective_bsdf, which `catseye fit` makes; export it to csv"
                ),
                Leaf::Retro { compensated: true, roughness, .. } if roughness[0] > NARROW => bail!(
                    "{name}: its multiscatter_tint can't be carried, and is not small at a roughness above \
                     {NARROW}; leave it out, or export it to csv"
                ),
                Leaf::Retro { compensated: true, .. } => left_out.push(LeftOut::Compensation),
                _ => {}
            }
        }
        let views: Vec<View> = (0..COSINES).flat_map(|i| View::both(i, material)).collect();
        let lobes = (0..head_on.len()).filter(|&i| matches!(head_on[i], Leaf::Retro { .. }));
        let lobe = |i: usize| {
            let samples: Option<Vec<LobeSample>> = views.iter().map(|view| view.sample(i)).collect();
            let Some(samples) = samples else {
                bail!(
                    "{name}: which lobes it has depends on the viewer's direction; export it to csv instead"
                );
            };
            ViewedLobe::of(&samples).map_err(|fault| {
                anyhow::anyhow!("{name}: a retro-reflective lobe {fault}; export it to csv instead")
            })
        };
        let lobes: Vec<ViewedLobe> = lobes.map(lobe).collect::<anyhow::Result<_>>()?;
        if views.iter().any(|view| view.base() != base) {
            left_out.insert(0, LeftOut::RoughBase);
        }
        left_out.dedup();
        if views.iter().any(|view| view.coat != coat) {
            bail!("{name}: its coat depends on the viewer's direction; export it to csv instead");
        }
        Ok(Self { lobes, base, coat, left_out })
    }
}

/// A material as seen from a direction.
struct View {
    cosine: f32,
    /// Along the viewer's projection on the surface.
    projection: [f32; 3],
    coat: Option<Coat>,
    leaves: Vec<Leaf>,
}

impl View {
    /// The views of a cosine along and across the tangent.
    fn both(i: usize, material: &Material) -> [Self; 2] {
        // From 1 down to 0.04: 88 degrees.
        let cosine = 1.0 - 0.96 * i as f32 / (COSINES - 1) as f32;
        let sine = (1.0 - cosine * cosine).sqrt();
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|projection: [f32; 3]| {
            let view = [-sine * projection[0], -sine * projection[1], -cosine];
            let surface = material.at(&ShadingPoint { view, ..ShadingPoint::default() });
            let (coat, below) = below_coat(&surface.bsdf);
            Self { cosine, projection, coat, leaves: leaves(below) }
        })
    }

    /// The inputs of the lobe in a place of the tree, if it is there from here.
    fn sample(&self, i: usize) -> Option<LobeSample> {
        let Some(Leaf::Retro { tint, roughness: [u, v], tangent, .. }) = self.leaves.get(i) else {
            return None;
        };
        let tangent = tangent.unwrap_or([1.0, 0.0, 0.0]);
        let along: f32 = (0..3).map(|c| tangent[c] * self.projection[c]).sum();
        let is_head_on = 1.0 - self.cosine * self.cosine < LEAST_SINE * LEAST_SINE;
        // Neither along nor across: the roughness along the projection is none of both.
        let roughness = match along.abs() {
            _ if is_head_on => [*v, *v],
            share if share > 0.999 => [*u, *v],
            share if share < 0.05 => [*v, *u],
            _ => [*u, f32::NAN],
        };
        Some(LobeSample {
            cosine: f64::from(self.cosine),
            tint: tint.map(f64::from),
            roughness: roughness.map(f64::from),
        })
    }

    fn base(&self) -> [f64; 3] {
        self.leaves.iter().fold([0.0; 3], |sum, leaf| match leaf {
            Leaf::Diffuse { color, .. } => [0, 1, 2].map(|c| sum[c] + f64::from(color[c])),
            _ => sum,
        })
    }
}

/// The clear coat over all else, if there is one, and what is below.
fn below_coat(closure: &Closure) -> (Option<Coat>, &Closure) {
    let Closure::Layer { top, base } = closure else { return (None, closure) };
    match **top {
        Closure::Dielectric {
            weight,
            tint,
            ior,
            roughness: [u, v],
            retroreflective: false,
            scatter_mode,
        } if tint == [1.0; 3] && u == v && scatter_mode == ScatterMode::Reflect => {
            let [weight, ior, alpha] = [weight, ior, u].map(f64::from);
            (Some(Coat { weight, ior, alpha }), base)
        }
        _ => (None, closure),
    }
}

/// The BSDFs of a tree that scatter, from left to right, whatever their weight.
fn leaves(closure: &Closure) -> Vec<Leaf> {
    let mut found = Vec::new();
    collect(closure, [1.0; 3], None, &mut found);
    found
}

fn collect(closure: &Closure, factor: [f32; 3], tangent: Option<[f32; 3]>, found: &mut Vec<Leaf>) {
    let times = |color: [f32; 3], share: f32| [0, 1, 2].map(|c| factor[c] * color[c] * share);
    let retro = |retroreflective: bool, node: &'static str| match retroreflective {
        true => Leaf::BackVector,
        false => Leaf::Other(node),
    };
    match closure {
        Closure::None => {}
        Closure::RetroReflective { weight, params } => found.push(Leaf::Retro {
            tint: times(params.tint, *weight),
            roughness: params.roughness(),
            tangent,
            compensated: params.multiscatter_tint.iter().any(|channel| *channel > 0.0),
        }),
        Closure::OrenNayarDiffuse { weight, color, roughness, .. } => {
            found.push(Leaf::Diffuse { color: times(*color, *weight), lambert: *roughness == 0.0 });
        }
        Closure::BurleyDiffuse { weight, color, .. } => {
            found.push(Leaf::Diffuse { color: times(*color, *weight), lambert: false });
        }
        Closure::Dielectric { retroreflective, .. } => found.push(retro(*retroreflective, "dielectric_bsdf")),
        Closure::Conductor { retroreflective, .. } => found.push(retro(*retroreflective, "conductor_bsdf")),
        Closure::GeneralizedSchlick { retroreflective, .. } => {
            found.push(retro(*retroreflective, "generalized_schlick_bsdf"));
        }
        Closure::Translucent { .. } => found.push(Leaf::Other("translucent_bsdf")),
        Closure::Sheen { .. } => found.push(Leaf::Other("sheen_bsdf")),
        Closure::Oriented { closure, normal: None, tangent } => collect(closure, factor, *tangent, found),
        Closure::Oriented { .. } => found.push(Leaf::Other("normal of its own")),
        Closure::Mix { foreground, background, amount } => {
            collect(foreground, factor.map(|x| x * amount), tangent, found);
            collect(background, factor.map(|x| x * (1.0 - amount)), tangent, found);
        }
        Closure::Layer { base, .. } => {
            found.push(Leaf::Other("coat (a layer)"));
            collect(base, factor, tangent, found);
        }
        Closure::Add { a, b } => {
            collect(a, factor, tangent, found);
            collect(b, factor, tangent, found);
        }
        Closure::Multiply { closure, factor: more } => collect(closure, times(*more, 1.0), tangent, found),
        _ => found.push(Leaf::Other("BSDF of an unknown kind")),
    }
}
