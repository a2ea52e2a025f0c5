//! A sign in the headlamps of a vehicle whose light is traced.

use std::sync::Arc;

use catseye::Model;
use catseye_materialx::Material;
use catseye_photometry::drive::View;
use catseye_photometry::lamp::Lamp;
use catseye_render::glam::{DVec3, Vec3};
use catseye_render::light::ProfileLight;
use catseye_render::{Camera, Mesh, RenderSettings, SceneBuilder, render};

use super::Channel;

/// A place or direction in the vehicle's frame.
type Vector = catseye::Vec3<f64>;

/// Side of the sign, and of the part in its middle that the camera sees, in metres.
const SIDE: f32 = 0.3;
const SEEN: f64 = 0.02;
/// Pixels along each side of the picture, and samples of each.
const PIXELS: usize = 4;
const SAMPLES: u32 = 64;

/// The luminance in cd/m2 of the middle of a sign, rendered from the driver's eye. A crest is not part of the
/// scene: what it hides is left out.
pub(crate) fn luminance(
    view: &View,
    lamp: &Lamp,
    material: &Material,
    model: Model,
    channel: Channel,
) -> anyhow::Result<f64> {
    if view.is_hidden {
        return Ok(0.0);
    }
    // The scene stands in the sign's frame, as a goniometer's: world-space inputs of the material are where
    // the closed form has them, and single precision has the most digits at the sign.
    let axes = [view.datum, view.normal.cross(view.datum), view.normal];
    let place = |v: Vector| {
        let from_sign = v - view.sign;
        DVec3::from_array(axes.map(|axis| axis.dot(from_sign))).as_vec3()
    };
    let eye = place(view.eye);
    let angle = 2.0 * (0.5 * SEEN / f64::from(eye.length())).atan();
    let mut scene = SceneBuilder::new(Camera::perspective(eye, Vec3::ZERO, Vec3::X, angle as f32));
    let sheeting = scene.materialx(material, model)?;
    scene.mesh(Mesh::quad(Vec3::new(-0.5, -0.5, 0.0) * SIDE, Vec3::X * SIDE, Vec3::Y * SIDE), sheeting);
    let lamp = Arc::new(lamp.clone());
    for from in view.lamps.iter().filter(|lamp| !lamp.is_hidden) {
        let lamp = Arc::clone(&lamp);
        let shine = move |direction: Vec3| Vec3::splat(intensity(&lamp, axes, direction));
        scene.light(ProfileLight::new(place(from.position), shine));
    }
    let settings = RenderSettings {
        width: PIXELS,
        height: PIXELS,
        spp: SAMPLES,
        max_depth: 1,
        ..RenderSettings::default()
    };
    let image = render(&scene.build()?, &settings, &|_| ())?;
    Ok(channel.of(image.mean().map(f64::from)))
}

/// A lamp's intensity in a direction of the sign's frame.
fn intensity(lamp: &Lamp, axes: [Vector; 3], direction: Vec3) -> f32 {
    let [x, y, z] = direction.to_array().map(f64::from);
    let ahead = axes[0] * x + axes[1] * y + axes[2] * z;
    let right_deg = (-ahead.y).atan2(ahead.x).to_degrees();
    let up_deg = ahead.z.atan2(ahead.x.hypot(ahead.y)).to_degrees();
    lamp.intensity_cd(right_deg, up_deg).unwrap_or_default() as f32
}
