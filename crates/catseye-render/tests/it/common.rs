//! What several tests need.

use catseye::Params;
use catseye_materialx::{Closure, ScatterMode};
use catseye_render::{Image, RenderSettings, Scene, render};
use glam::Vec3;

pub(crate) const SMALL: [usize; 2] = [16, 16];

pub(crate) fn retro(params: Params<f32>) -> Closure {
    Closure::RetroReflective { weight: 1.0, params }
}

pub(crate) fn diffuse(color: f32, roughness: f32) -> Closure {
    Closure::OrenNayarDiffuse { weight: 1.0, color: [color; 3], roughness, energy_compensation: true }
}

pub(crate) fn dielectric(roughness: [f32; 2], scatter_mode: ScatterMode) -> Closure {
    Closure::Dielectric {
        weight: 1.0,
        tint: [1.0; 3],
        ior: 1.5,
        roughness,
        retroreflective: false,
        scatter_mode,
    }
}

pub(crate) fn layer(top: Closure, base: Closure) -> Closure {
    Closure::Layer { top: Box::new(top), base: Box::new(base) }
}

pub(crate) fn mix(foreground: Closure, background: Closure, amount: f32) -> Closure {
    Closure::Mix { foreground: Box::new(foreground), background: Box::new(background), amount }
}

/// Closures of every kind, all white.
pub(crate) fn zoo() -> Vec<(&'static str, Closure)> {
    let white = Params::isotropic(0.3).with_multiscatter_tint([1.0; 3]);
    let coat = || dielectric([0.1, 0.1], ScatterMode::Reflect);
    vec![
        ("diffuse", diffuse(1.0, 0.0)),
        ("rough diffuse", diffuse(0.8, 0.7)),
        (
            "qualitative diffuse",
            Closure::OrenNayarDiffuse {
                weight: 1.0,
                color: [1.0, 0.5, 0.0],
                roughness: 0.5,
                energy_compensation: false,
            },
        ),
        ("retro", retro(white)),
        ("coloured retro", retro(white.with_tint([1.0, 0.5, 0.1]).with_multiscatter_tint([0.0, 0.2, 1.0]))),
        ("anisotropic retro", retro(Params::anisotropic(0.5, 0.1))),
        (
            "turned retro",
            Closure::Oriented {
                closure: Box::new(retro(Params::anisotropic(0.6, 0.2))),
                normal: None,
                tangent: Some([0.5, 0.8, 0.1]),
            },
        ),
        ("reflecting dielectric", dielectric([0.3, 0.1], ScatterMode::Reflect)),
        ("transmitting dielectric", dielectric([0.4, 0.4], ScatterMode::Transmit)),
        ("glass", dielectric([0.25, 0.25], ScatterMode::ReflectTransmit)),
        ("mix", mix(retro(white), diffuse(0.5, 0.0), 0.3)),
        ("coat on retro", layer(coat(), retro(white))),
        ("retro on diffuse", layer(retro(Params::isotropic(0.2).with_tint([0.3; 3])), diffuse(0.9, 0.2))),
        ("coat on retro on diffuse", layer(coat(), layer(retro(Params::isotropic(0.4)), diffuse(1.0, 0.0)))),
        ("multiply", Closure::Multiply { closure: Box::new(retro(white)), factor: [1.0, 0.5, 0.0] }),
        ("metal", conductor(false)),
        ("retro-reflective metal", conductor(true)),
        (
            "generalized schlick",
            Closure::GeneralizedSchlick {
                weight: 1.0,
                color0: [0.04, 0.3, 0.9],
                color82: [1.0; 3],
                color90: [1.0; 3],
                exponent: 5.0,
                roughness: [0.2; 2],
                retroreflective: false,
                scatter_mode: ScatterMode::Reflect,
            },
        ),
        ("burley", Closure::BurleyDiffuse { weight: 1.0, color: [0.8; 3], roughness: 0.5 }),
        ("translucent", Closure::Translucent { weight: 1.0, color: [0.8; 3] }),
        ("sheen", Closure::Sheen { weight: 1.0, color: [0.8; 3], roughness: 0.4 }),
        (
            "sheen on diffuse",
            layer(Closure::Sheen { weight: 0.5, color: [1.0; 3], roughness: 0.4 }, diffuse(0.9, 0.0)),
        ),
        (
            "tilted coat on diffuse",
            layer(
                Closure::Oriented {
                    closure: Box::new(coat()),
                    normal: Some([0.2, 0.1, 0.97]),
                    tangent: Some([0.0, 1.0, 0.0]),
                },
                diffuse(0.5, 0.0),
            ),
        ),
        (
            "sum of halves",
            Closure::Add {
                a: Box::new(Closure::Multiply { closure: Box::new(retro(white)), factor: [0.5; 3] }),
                b: Box::new(Closure::Multiply { closure: Box::new(diffuse(1.0, 0.0)), factor: [0.5; 3] }),
            },
        ),
    ]
}

fn conductor(retroreflective: bool) -> Closure {
    Closure::Conductor {
        weight: 1.0,
        ior: [0.183, 0.421, 1.373],
        extinction: [3.424, 2.346, 1.770],
        roughness: [0.2; 2],
        retroreflective,
    }
}

pub(crate) fn picture(scene: &Scene, [width, height]: [usize; 2], spp: u32, max_depth: u32) -> Image {
    let settings = RenderSettings { width, height, spp, max_depth, ..RenderSettings::default() };
    render(scene, &settings, &|_| ()).expect("the settings are legal")
}

/// Well spread points of the unit hypercube (Roberts' additive recurrence).
pub(crate) fn points(count: u32) -> impl Iterator<Item = [f32; 4]> {
    const ROOT: f64 = 1.167_303_978_261_418_7;
    (0..count).map(|i| [1, 2, 3, 4].map(|k| ((0.5 + f64::from(i) * ROOT.powi(-k)) % 1.0) as f32))
}

/// Uniform direction on the sphere.
pub(crate) fn sphere_direction(u: [f32; 4]) -> Vec3 {
    let z = 1.0 - 2.0 * u[0];
    let (sin, cos) = (std::f32::consts::TAU * u[1]).sin_cos();
    let r = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(r * cos, r * sin, z)
}

/// Outgoing directions from head-on to grazing.
pub(crate) fn outgoing() -> Vec<Vec3> {
    [0.05_f32, 0.7, 1.2, 1.5].iter().map(|t| Vec3::new(t.sin() * 0.8, t.sin() * 0.6, t.cos())).collect()
}
