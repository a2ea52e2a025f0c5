//! A virtual retroreflectometer: the coefficient of retro-reflection of a material, measured by tracing rays.
//!
//! The arrangement is that of ASTM E810 and CIE 54.2: a lamp and a photoreceptor, each behind a round
//! aperture, stand at the same distance from a specimen. What arrives at the receiver is compared with what
//! arrives at the specimen.

use catseye::Model;
use catseye_materialx::Material;
use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::integrator::Plan;
use crate::light::AreaLight;
use crate::sampler::Sampler;
use crate::{Camera, Error, Mesh, Ray, Scene, SceneBuilder, integrator};

/// Parts of a measurement with random numbers of their own, whose scatter is the standard error.
const REPLICATES: usize = 32;
/// Scatterings of a path: the specimen is flat and alone, so light meets it once.
const MAX_DEPTH: u32 = 1;
/// Tells the instrument's random numbers from those of a picture's pixels.
const STREAM: u32 = 0x4e81_0e80;

/// A retroreflectometer: lengths in metres.
///
/// The scene stands in the specimen's own frame: instead of turning the specimen by the goniometer's angles,
/// source and receiver are moved around it, which is the same to a material and keeps world-space inputs (a
/// `tangent_u` given by the document) where the specimen's frame has them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Retroreflectometer {
    /// Distance between the specimen's centre and the centres of both apertures. Default 15 m, as ASTM E810.
    pub distance_m: f32,
    /// Side of the square specimen. Default 0.2 m.
    pub specimen_side_m: f32,
    /// Diameter of the source's exit aperture. Default 0.026 m, 0.1 degrees at 15 m: the most that ASTM E810
    /// allows.
    pub source_aperture_m: f32,
    /// Diameter of the receiver's entrance aperture. Default 0.026 m, as the source's.
    pub receiver_aperture_m: f32,
}

impl Default for Retroreflectometer {
    fn default() -> Self {
        Self { distance_m: 15.0, specimen_side_m: 0.2, source_aperture_m: 0.026, receiver_aperture_m: 0.026 }
    }
}

/// A Monte Carlo estimate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// What the instrument reads, for any colour of the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// `R_A` per channel of linear Rec. 709, of each replicate.
    parts: [[f64; 3]; REPLICATES],
    /// Cosine of the angle between the specimen's normal and the receiver.
    cos_view: f64,
}

impl Reading {
    /// The coefficient of retro-reflection `R_A` in cd/lx/m2 (the same number as 1/sr), its channels of
    /// linear Rec. 709 summed with weights: one of them 1 for light of that colour, those of luminance for
    /// white light.
    #[must_use]
    pub fn r_a(&self, weights: [f64; 3]) -> Estimate {
        let count = REPLICATES as f64;
        let values = self.parts.map(|part| part.iter().zip(weights).map(|(x, w)| x * w).sum::<f64>());
        let value = values.iter().sum::<f64>() / count;
        let variance = values.iter().map(|x| (x - value).powi(2)).sum::<f64>() / (count - 1.0);
        Estimate { value, standard_error: (variance / count).sqrt() }
    }

    /// The coefficient of retro-reflected luminance `R_L = R_A / cos(nu)` in cd/m2/lx, where nu is the angle
    /// between the specimen's normal and the receiver (ASTM E808); the weights are those of [`Reading::r_a`].
    #[must_use]
    pub fn r_l(&self, weights: [f64; 3]) -> Estimate {
        let Estimate { value, standard_error } = self.r_a(weights);
        Estimate { value: value / self.cos_view, standard_error: standard_error / self.cos_view }
    }
}

/// A specimen between source and receiver.
struct Setup {
    scene: Scene,
    receiver: Aperture,
}

/// A round hole that faces the specimen.
#[derive(Clone, Copy)]
struct Aperture {
    centre: DVec3,
    across: [DVec3; 2],
    radius: f64,
}

impl Retroreflectometer {
    /// Measures a material with the receiver in the direction `wo` and the source in the direction `wi`, unit
    /// vectors of the specimen's frame: z is its normal, x its tangent (the datum mark).
    ///
    /// `samples` paths are traced, in 32 independent parts from whose scatter the standard error is taken.
    /// The reading depends on the arguments only, not on the number of threads. What the specimen emits
    /// itself doesn't count, as if the lamp were chopped. A direction below the specimen's plane reads 0.
    ///
    /// # Errors
    /// A size that is not positive, a direction that is not a unit vector, a parameter of the material out of
    /// range.
    pub fn measure(
        &self,
        material: &Material,
        model: Model,
        [wo, wi]: [catseye::Vec3<f64>; 2],
        samples: u32,
        seed: u32,
    ) -> Result<Reading, Error> {
        self.validate()?;
        let wo = direction("wo", wo)?;
        let wi = direction("wi", wi)?;
        if samples == 0 {
            return Err(Error::Setting { name: "samples", value: 0, range: "1 and above" });
        }
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return Ok(Reading { parts: [[0.0; 3]; REPLICATES], cos_view: 1.0 });
        }
        let setup = self.setup(material, model, wo, wi)?;
        let paths = samples.div_ceil(REPLICATES as u32);
        let mut parts = [[0.0; 3]; REPLICATES];
        parts.par_iter_mut().enumerate().for_each(|(number, part)| {
            *part = self.replicate(&setup, number as u32, paths, seed);
        });
        Ok(Reading { parts, cos_view: wo.z })
    }

    fn validate(&self) -> Result<(), Error> {
        let sizes = [
            ("distance_m", self.distance_m),
            ("specimen_side_m", self.specimen_side_m),
            ("source_aperture_m", self.source_aperture_m),
            ("receiver_aperture_m", self.receiver_aperture_m),
        ];
        match sizes.into_iter().find(|(_, size)| !(size.is_finite() && *size > 0.0)) {
            Some((name, size)) => Err(Error::Instrument {
                name,
                value: f64::from(size),
                expected: "a length in metres, above 0",
            }),
            None => Ok(()),
        }
    }

    fn setup(&self, material: &Material, model: Model, wo: DVec3, wi: DVec3) -> Result<Setup, Error> {
        let distance = f64::from(self.distance_m);
        let source = Aperture::new(wi * distance, -wi, 0.5 * f64::from(self.source_aperture_m));
        let receiver = Aperture::new(wo * distance, -wo, 0.5 * f64::from(self.receiver_aperture_m));
        // The camera takes no part: rays start at the receiver.
        let camera = Camera::perspective(receiver.centre.as_vec3(), Vec3::ZERO, Vec3::Y, 0.1);
        let mut builder = SceneBuilder::new(camera);
        let sheeting = builder.materialx(material, model)?;
        let side = self.specimen_side_m;
        builder.mesh(Mesh::quad(Vec3::new(-0.5, -0.5, 0.0) * side, Vec3::X * side, Vec3::Y * side), sheeting);
        // A disk of radiance L, seen head-on, brings pi L sin^2 of the half angle. So E_perp is 1, which also
        // puts what the specimen sends back and what it may emit itself into the same order of magnitude.
        let squared = source.radius * source.radius;
        let radiance = (squared + distance * distance) / (std::f64::consts::PI * squared);
        let (centre, normal) = (source.centre.as_vec3(), -wi.as_vec3());
        builder.light(AreaLight::disk(centre, normal, source.radius as f32, Vec3::splat(radiance as f32)));
        Ok(Setup { scene: builder.build()?, receiver })
    }

    /// The mean of `R_A` over the paths of one replicate, per channel.
    fn replicate(&self, setup: &Setup, part: u32, paths: u32, seed: u32) -> [f64; 3] {
        let mut sum = DVec3::ZERO;
        for index in 0..paths {
            let mut sampler = Sampler::new([STREAM, part], index, seed);
            let [a, b, s, t] = sampler.next_4d().map(f64::from);
            let point = (DVec3::new(s, t, 0.0) - DVec3::new(0.5, 0.5, 0.0)) * f64::from(self.specimen_side_m);
            sum += self.path(setup, setup.receiver.point([a, b]), point, &sampler);
        }
        (sum / f64::from(paths)).to_array()
    }

    /// What the light between a point of the specimen and a point of the receiver adds to `R_A = E_r d^2 /
    /// (E_perp A)`.
    fn path(&self, setup: &Setup, receiver: DVec3, point: DVec3, sampler: &Sampler) -> DVec3 {
        let along = point - receiver;
        let squared = along.length_squared();
        let ray = Ray::new(receiver.as_vec3(), (along / squared.sqrt()).as_vec3());
        let light = |depth| {
            let plan = Plan::unknown(depth);
            integrator::radiance(&setup.scene, ray, &mut sampler.clone(), plan).as_dvec3()
        };
        // Without scattering there is only what the specimen emits itself.
        let radiance = light(MAX_DEPTH) - light(0);
        // E_r is the integral of radiance cos cos / r^2 over the specimen's area A, which the quotient
        // cancels. The illuminance E_perp at the specimen's centre, on a plane that faces the source, is 1.
        let cos_specimen = -along.z / squared.sqrt();
        let cos_receiver = -along.dot(setup.receiver.centre) / (squared.sqrt() * f64::from(self.distance_m));
        let falloff = f64::from(self.distance_m).powi(2) / squared;
        radiance * (cos_specimen * cos_receiver * falloff)
    }
}

impl Aperture {
    fn new(centre: DVec3, normal: DVec3, radius: f64) -> Self {
        let (u, v) = normal.any_orthonormal_pair();
        Self { centre, across: [u, v], radius }
    }

    /// The point of the disk for two uniform numbers.
    fn point(&self, [a, b]: [f64; 2]) -> DVec3 {
        let (sin, cos) = (std::f64::consts::TAU * b).sin_cos();
        self.centre + (self.across[0] * cos + self.across[1] * sin) * (self.radius * a.sqrt())
    }
}

fn direction(name: &'static str, w: catseye::Vec3<f64>) -> Result<DVec3, Error> {
    /// How far a unit vector's length may be from 1: what rounding to printed digits does.
    const TOLERANCE: f64 = 1e-3;
    let w = DVec3::new(w.x, w.y, w.z);
    let length = w.length();
    if (length - 1.0).abs() < TOLERANCE {
        return Ok(w / length);
    }
    Err(Error::Instrument { name, value: length, expected: "a vector of length 1" })
}
