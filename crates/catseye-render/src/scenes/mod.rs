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
    /// The built-in scene: a road at night in the light of two headlamps beside the camera. Everything on the left
    /// wears retro-reflective sheeting, everything on the right the same colours as matte paint.
    ///
    /// `sheeting` replaces the white sheeting (and, multiplied, the coloured ones); `model` is the lobe that its
    /// retro-reflection is computed with. Lengths are metres, light is in photometric units.
    ///
    /// # Errors
    /// A parameter of `sheeting` out of its range, or too many lobes in it.
    pub fn builtin(sheeting: Option<&Material>, model: Model) -> Result<Self, Error> {
        let camera = Camera::perspective(EYE, Vec3::new(0.0, 1.22, -10.0), Vec3::Y, 24.0_f32.to_radians());
        let mut builder = SceneBuilder::new(camera);
        let retro = Finish::sheeting(sheeting, model);
        let matte = Finish::paint();
        road::add(&mut builder, &retro, &matte)?;
        verge::add(&mut builder);
        for (side, finish) in [(-1.0, &retro), (1.0, &matte)] {
            sign::add(&mut builder, Vec3::new(2.55 * side, 0.0, -10.0), finish)?;
            cone::add(&mut builder, Vec3::new(1.25 * side, 0.0, -7.6), finish)?;
        }
        add_lights(&mut builder);
        builder.tone_map(ToneMap { exposure_ev: -6.0, white: 12.0 });
        builder.build()
    }

    /// A stage for one material: what `catseye render MATERIAL.mtlx` shows.
    ///
    /// A sphere and a folded sheet of the material stand on a grey ground. A headlamp 0.2 degrees beside the camera
    /// shows what comes back (the observation angle that data sheets of sheeting begin with), a soft light from the
    /// side and a dim sky show the shape and everything else.
    ///
    /// # Errors
    /// A parameter of the material out of its range, or too many lobes in it.
    pub fn preview(material: &Material, model: Model) -> Result<Self, Error> {
        preview::scene(material, model)
    }
}

fn add_lights(builder: &mut SceneBuilder) {
    for side in [-1.0, 1.0] {
        let sphere = Sphere { centre: EYE + Vec3::new(0.22 * side, -0.12, -0.05), radius: 0.05 };
        let target = Vec3::new(0.9 * side, 0.9, -12.0);
        let beam = Beam::new((target - sphere.centre).normalize(), [0.26, 0.11]);
        builder.light(SphereLight::headlamp(sphere, Vec3::new(1.0, 0.93, 0.80) * 9000.0, beam));
    }
    let moon = Vec3::new(0.45, 0.75, 0.25).normalize();
    builder.light(DistantLight::new(moon, 0.0045, Vec3::new(0.62, 0.78, 1.0) * 6.0));
    builder.light(Environment::Sky(Sky {
        zenith: Vec3::new(0.25, 0.45, 1.1),
        horizon: Vec3::new(1.2, 1.8, 3.2),
        ground: Vec3::new(0.1, 0.12, 0.15),
        glow_direction: Vec3::new(-0.05, 0.0, -1.0),
        glow: Vec3::new(7.0, 3.6, 1.5),
        glow_size: [0.5, 0.07],
    }));
}
