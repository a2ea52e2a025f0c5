//! Scenes that are made in code.

mod cat;
mod cone;
mod materials;
mod preview;
mod road;
mod sign;
mod verge;

use catseye::Model;
use catseye_materialx::Material;
use glam::Vec3;

use crate::light::{Beam, DistantLight, Environment, Sky, SphereLight};
use crate::{Camera, Error, PictureInfo, Scene, SceneBuilder, Sphere, ToneMap};
use materials::Finish;

/// Where the built-in scene is seen from, in metres.
const EYE: Vec3 = Vec3::new(0.0, 1.35, 0.0);
/// How far the signs are.
const SIGN_DISTANCE: f32 = 10.0;
/// Where the headlamps are from the eye, to the right or left, down and back, in units of the distance aside.
const LAMP_DIRECTION: Vec3 = Vec3::new(0.88, -0.48, 0.0);
/// Angle in degrees between the eye and a headlamp, seen from a sign, where none is asked for.
const LAMP_DEG: f32 = 1.4;

/// Luminance that a path may bring of indirect light.
const INDIRECT_LIMIT: f32 = 4.0;

/// What the scenes of this crate can be lit and seen with.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lighting {
    /// The lobe that retro-reflection is computed with.
    pub model: Model,
    /// Observation angle in degrees between the camera and the headlamps, seen from what they light; `None`
    /// for the scene's own.
    pub lamp_deg: Option<f32>,
}

impl From<Model> for Lighting {
    fn from(model: Model) -> Self {
        Self { model, lamp_deg: None }
    }
}

impl Scene {
    /// What wears sheeting in the built-in scene, by the paths that a look assigns materials to.
    pub const BUILTIN_GEOMETRY: [&str; 4] = ["/night/signs", "/night/cones", "/night/studs", "/night/posts"];
    /// Where the white of the left and of the right sign is in a picture of the built-in scene: right and
    /// down from its centre, in units of its height.
    pub const BUILTIN_SIGN_WHITES: [[f32; 2]; 2] = [[-0.602, -0.268], [0.602, -0.268]];
    /// What shows materials on the stage, likewise.
    pub const PREVIEW_GEOMETRY: [&str; 2] = ["/preview/sphere", "/preview/sheet"];

    /// The built-in scene: a road at night in the light of two headlamps beside the camera. Signs, cones,
    /// studs and posts wear retro-reflective sheeting on the left, and matte paint of the same colours on the
    /// right.
    ///
    /// `sheeting` replaces the white sheeting (and, multiplied, the coloured ones). Lengths are metres, light
    /// is in photometric units.
    ///
    /// # Errors
    /// A parameter of `sheeting` out of its range, or too many lobes in it.
    pub fn builtin(sheeting: Option<&Material>, lighting: impl Into<Lighting>) -> Result<Self, Error> {
        Self::builtin_of([sheeting; 4], lighting)
    }

    /// The built-in scene with sheeting of its own for each of [`Scene::BUILTIN_GEOMETRY`].
    ///
    /// # Errors
    /// As [`Scene::builtin`].
    pub fn builtin_of(
        sheeting: [Option<&Material>; 4],
        lighting: impl Into<Lighting>,
    ) -> Result<Self, Error> {
        let lighting = lighting.into();
        let camera = Camera::perspective(EYE, Vec3::new(0.0, 1.22, -10.0), Vec3::Y, 24.0_f32.to_radians());
        let mut builder = SceneBuilder::new(camera);
        let retro = sheeting.map(|material| Finish::sheeting(material, lighting.model));
        let mut matte = Vec::new();
        for finish in &retro {
            matte.push(finish.paint()?);
        }
        road::add(&mut builder);
        verge::add(&mut builder);
        for (side, finishes) in [(-1.0, &retro[..]), (1.0, &matte[..])] {
            let [signs, cones, studs, posts] = finishes else { continue };
            road::add_side(&mut builder, side, studs, posts)?;
            sign::add(&mut builder, Vec3::new(2.55 * side, 0.0, -SIGN_DISTANCE), signs)?;
            cone::add(&mut builder, Vec3::new(1.05 * side, 0.0, -8.0), cones)?;
        }
        let lamp_deg = lighting.lamp_deg.unwrap_or(LAMP_DEG);
        add_lights(&mut builder, SIGN_DISTANCE * lamp_deg.to_radians().tan());
        builder.tone_map(ToneMap { exposure_ev: -4.9, white: 12.0, glare: 0.05 });
        // About the brightest asphalt: what studs and cones throw back on the road comes in specks.
        builder.indirect_limit(INDIRECT_LIMIT);
        let units = "luminance in cd/m2".to_owned();
        builder.info(PictureInfo { units, lamp_deg: Some(lamp_deg), ..PictureInfo::default() });
        builder.build()
    }

    /// A stage for one material: what `catseye render MATERIAL.mtlx` shows.
    ///
    /// A sphere and a folded sheet of the material stand in a studio, a small matte white ball before them. A
    /// headlamp 0.2 degrees beside the camera shows what comes back (the observation angle that tables of
    /// sheeting begin with). It is the same for all materials, so that their radiances compare; for a perfect
    /// retro-reflector, which shows nothing beside the camera itself, it is wider and shines from behind the
    /// pinhole. Two soft lights from the sides and a dim surrounding show the shape and everything else.
    ///
    /// # Errors
    /// A parameter of the material out of its range, or too many lobes in it.
    pub fn preview(material: &Material, lighting: impl Into<Lighting>) -> Result<Self, Error> {
        Self::preview_of([material; 2], lighting)
    }

    /// The stage with a material for each of [`Scene::PREVIEW_GEOMETRY`].
    ///
    /// # Errors
    /// As [`Scene::preview`].
    pub fn preview_of(materials: [&Material; 2], lighting: impl Into<Lighting>) -> Result<Self, Error> {
        preview::scene(materials, &lighting.into())
    }
}

/// Headlamps at a distance from the eye, the moon and the sky.
fn add_lights(builder: &mut SceneBuilder, distance: f32) {
    for side in [-1.0, 1.0] {
        let aside = LAMP_DIRECTION * Vec3::new(side, 1.0, 1.0) * distance;
        let sphere = Sphere { centre: EYE + aside + Vec3::Z * 0.05, radius: 0.05 };
        let towards = |target: Vec3| (target - sphere.centre).normalize();
        // A wide beam for what stands beside the road, and a hot spot that makes a pool of light on it.
        let beam = Beam::new(towards(Vec3::new(1.1 * side, 0.7, -12.0)), [0.28, 0.19]);
        let beam = beam.with_hot_spot(towards(Vec3::new(0.8 * side, 0.0, -11.0)), [0.05, 0.025], 55.0);
        builder.light(SphereLight::headlamp(sphere, Vec3::new(1.0, 0.93, 0.80) * 3500.0, beam));
    }
    let moon = Vec3::new(0.5, 0.6, -0.55).normalize();
    builder.light(DistantLight::new(moon, 0.0045, Vec3::new(0.50, 0.72, 1.0) * 9.0));
    builder.light(Environment::Sky(Sky {
        zenith: Vec3::new(0.07, 0.17, 0.45),
        horizon: Vec3::new(0.4, 0.7, 1.2),
        ground: Vec3::new(0.03, 0.04, 0.05),
        glow_direction: Vec3::new(-0.05, 0.0, -1.0).normalize(),
        glow: Vec3::new(7.0, 3.3, 1.1),
        glow_size: [0.35, 0.035],
        stars: Vec3::new(0.9, 0.95, 1.0) * 10.0,
    }));
}
