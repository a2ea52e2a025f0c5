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
use crate::{Camera, Error, Scene, SceneBuilder, Sphere, ToneMap};
use materials::Finish;

/// Where the built-in scene is seen from, in metres.
const EYE: Vec3 = Vec3::new(0.0, 1.35, 0.0);

impl Scene {
    /// What wears sheeting in the built-in scene, by the paths that a look assigns materials to.
    pub const BUILTIN_GEOMETRY: [&str; 4] = ["/night/signs", "/night/cones", "/night/studs", "/night/posts"];
    /// What shows materials on the stage, likewise.
    pub const PREVIEW_GEOMETRY: [&str; 2] = ["/preview/sphere", "/preview/sheet"];

    /// The built-in scene: a road at night in the light of two headlamps beside the camera. Everything on the left
    /// wears retro-reflective sheeting, everything on the right the same colours as matte paint.
    ///
    /// `sheeting` replaces the white sheeting (and, multiplied, the coloured ones); `model` is the lobe that its
    /// retro-reflection is computed with. Lengths are metres, light is in photometric units.
    ///
    /// # Errors
    /// A parameter of `sheeting` out of its range, or too many lobes in it.
    pub fn builtin(sheeting: Option<&Material>, model: Model) -> Result<Self, Error> {
        Self::builtin_of([sheeting; 4], model)
    }

    /// The built-in scene with sheeting of its own for each of [`Scene::BUILTIN_GEOMETRY`].
    ///
    /// # Errors
    /// As [`Scene::builtin`].
    pub fn builtin_of(sheeting: [Option<&Material>; 4], model: Model) -> Result<Self, Error> {
        let camera = Camera::perspective(EYE, Vec3::new(0.0, 1.22, -10.0), Vec3::Y, 24.0_f32.to_radians());
        let mut builder = SceneBuilder::new(camera);
        let retro = sheeting.map(|material| Finish::sheeting(material, model));
        let matte = [(); 4].map(|()| Finish::paint());
        road::add(&mut builder);
        verge::add(&mut builder);
        for (side, [signs, cones, studs, posts]) in [(-1.0, &retro), (1.0, &matte)] {
            road::add_side(&mut builder, side, studs, posts)?;
            sign::add(&mut builder, Vec3::new(2.55 * side, 0.0, -10.0), signs)?;
            cone::add(&mut builder, Vec3::new(1.05 * side, 0.0, -8.0), cones)?;
        }
        add_lights(&mut builder);
        builder.tone_map(ToneMap { exposure_ev: -7.85, white: 4.0, glare: 0.06 });
        builder.build()
    }

    /// A stage for one material: what `catseye render MATERIAL.mtlx` shows.
    ///
    /// A sphere and a folded sheet of the material stand in a studio, a small matte white ball before them. A headlamp
    /// 0.2 degrees beside the camera shows what comes back (the observation angle that tables of sheeting begin with);
    /// it is dimmed for materials that would send back more than a picture can hold, and shines from behind the camera
    /// for a perfect retro-reflector. Two soft lights from the sides and a dim surrounding show the shape and
    /// everything else.
    ///
    /// # Errors
    /// A parameter of the material out of its range, or too many lobes in it.
    pub fn preview(material: &Material, model: Model) -> Result<Self, Error> {
        preview::scene([material; 2], model)
    }

    /// The stage with a material for each of [`Scene::PREVIEW_GEOMETRY`].
    ///
    /// # Errors
    /// As [`Scene::preview`].
    pub fn preview_of(materials: [&Material; 2], model: Model) -> Result<Self, Error> {
        preview::scene(materials, model)
    }
}

fn add_lights(builder: &mut SceneBuilder) {
    for side in [-1.0, 1.0] {
        let sphere = Sphere { centre: EYE + Vec3::new(0.22 * side, -0.12, -0.05), radius: 0.05 };
        let target = Vec3::new(1.1 * side, 0.7, -12.0);
        let beam = Beam::new((target - sphere.centre).normalize(), [0.28, 0.19]);
        builder.light(SphereLight::headlamp(sphere, Vec3::new(1.0, 0.93, 0.80) * 9000.0, beam));
    }
    let moon = Vec3::new(0.5, 0.6, -0.55).normalize();
    builder.light(DistantLight::new(moon, 0.0045, Vec3::new(0.50, 0.72, 1.0) * 40.0));
    builder.light(Environment::Sky(Sky {
        zenith: Vec3::new(0.6, 1.5, 4.3),
        horizon: Vec3::new(3.8, 6.7, 11.4),
        ground: Vec3::new(0.1, 0.12, 0.15),
        glow_direction: Vec3::new(-0.05, 0.0, -1.0).normalize(),
        glow: Vec3::new(58.0, 27.0, 8.0),
        glow_size: [0.35, 0.035],
        stars: Vec3::new(0.9, 0.95, 1.0) * 30.0,
    }));
}
