//! Following light backwards: unidirectional path tracing with light sampling.

use glam::Vec3;

use crate::bsdf::Shading;
use crate::light::strength;
use crate::sampler::Sampler;
use crate::surface::Hit;
use crate::{Ray, RenderSettings, Scene};

/// Surfaces that a ray may pass straight through between two scatterings.
const MAX_PASSED: u32 = 64;
/// The part of the probability of choosing a light that all lights share alike: no light is forgotten where
/// the estimate of its importance is wrong.
const UNIFORM_SHARE: f32 = 0.25;

/// Paths that [`Plan::of`] tries.
const PILOTS: u32 = 1024;

/// What all paths of a picture go by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    /// The most scatterings.
    pub(crate) max_depth: u32,
    /// About the radiance that scattered rays meet: what roulette expects of a path that goes on. 0 where
    /// nobody knows.
    expected: f32,
}

impl Plan {
    /// For paths of which nothing is known.
    pub(crate) fn unknown(max_depth: u32) -> Self {
        Self { max_depth, expected: 0.0 }
    }

    /// Tries some paths, all over the picture and the same for each part of it.
    pub(crate) fn of(scene: &Scene, settings: &RenderSettings) -> Self {
        let size = [settings.width as f32, settings.height as f32];
        let max_depth = settings.max_depth;
        let endless = Self { max_depth, expected: f32::INFINITY };
        let (mut sum, mut count) = (0.0, 0.0_f32);
        for index in 0..PILOTS {
            let mut sampler = Sampler::new([u32::MAX; 2], index, 0);
            let [u, v, ..] = sampler.next_4d();
            let ray = scene.camera().ray([u * size[0], v * size[1]], size);
            let mut path = Path::new(scene, ray);
            if path.step(&mut sampler, endless) {
                let (direct, throughput) = (path.radiance, strength(path.throughput));
                while path.step(&mut sampler, endless) {}
                let met = strength(path.radiance - direct) / throughput;
                sum += if met.is_finite() { met } else { 0.0 };
                count += 1.0;
            }
        }
        Self { max_depth, expected: sum / count.max(1.0) }
    }
}

/// A path from the camera to where it has come.
struct Path<'a> {
    scene: &'a Scene,
    ray: Ray,
    /// What light from the ray's far end counts for at the camera.
    throughput: Vec3,
    radiance: Vec3,
    /// Scatterings so far.
    depth: u32,
    /// The last scattering: where it was, and the density of the ray's direction. `None` for the density
    /// after a Dirac lobe and at the camera, where light sampling had no part.
    origin: Vec3,
    pdf: Option<f32>,
}

/// The radiance that arrives along a camera ray.
pub(crate) fn radiance(scene: &Scene, ray: Ray, sampler: &mut Sampler, plan: Plan) -> Vec3 {
    let mut path = Path::new(scene, ray);
    while path.step(sampler, plan) {}
    if path.radiance.is_finite() { path.radiance } else { Vec3::ZERO }
}

impl<'a> Path<'a> {
    /// A path that begins with a camera ray.
    fn new(scene: &'a Scene, ray: Ray) -> Self {
        let [throughput, radiance] = [Vec3::ONE, Vec3::ZERO];
        Self { scene, origin: ray.origin, ray, throughput, radiance, depth: 0, pdf: None }
    }

    /// Goes on to the next scattering; false at the end of the path.
    fn step(&mut self, sampler: &mut Sampler, plan: Plan) -> bool {
        let hit = self.next_hit(sampler);
        if self.meet_lights(hit.as_ref()) {
            return false;
        }
        let Some(hit) = hit else { return false };
        let material = self.scene.material(&hit, self.ray.direction);
        if material.emission != Vec3::ZERO {
            // No light sampling looks for surfaces that glow: paths find them.
            self.add(self.throughput * material.emission, self.depth.saturating_sub(1));
        }
        if self.depth >= plan.max_depth {
            return false;
        }
        self.throughput *= hit.color;
        let shading = material.bsdf.at(hit.frame, -self.ray.direction, hit.inside);
        self.sample_lights(&hit, &shading, sampler);
        self.depth += 1;
        self.scatter(&hit, &shading, sampler, plan.expected)
    }

    /// The next surface that doesn't let the ray pass.
    fn next_hit(&mut self, sampler: &mut Sampler) -> Option<Hit> {
        for _ in 0..MAX_PASSED {
            let hit = self.scene.intersect(&self.ray)?;
            let opacity = self.scene.opacity(&hit, self.ray.direction);
            if opacity >= 1.0 || sampler.next_4d()[0] < opacity {
                return Some(hit);
            }
            // Lights between the surfaces are met on the way.
            if self.meet_lights(Some(&hit)) {
                self.throughput = Vec3::ZERO;
                return None;
            }
            self.ray = Ray::leaving(hit.position, hit.normal, self.ray.direction);
        }
        None
    }

    /// Adds the lights that the ray meets before the surface; true if one of them ends it.
    fn meet_lights(&mut self, hit: Option<&Hit>) -> bool {
        let ray = Ray { t_max: hit.map_or(f32::INFINITY, |h| h.t), ..self.ray };
        let mut nearest: Option<(usize, f32)> = None;
        for (i, light) in self.scene.lights().iter().enumerate() {
            let Some(distance) = light.distance(&ray) else { continue };
            if distance < nearest.map_or(f32::INFINITY, |(_, d)| d) {
                nearest = Some((i, distance));
            }
        }
        if let Some((i, _)) = nearest {
            self.add_light(i);
            return true;
        }
        if hit.is_none() {
            // What lies at infinity hides nothing.
            for i in 0..self.scene.lights().len() {
                if self.scene.lights()[i].distance(&ray).is_some() {
                    self.add_light(i);
                }
            }
        }
        false
    }

    /// Adds a light that the ray meets, weighted against the sampling of lights.
    fn add_light(&mut self, light: usize) {
        let (radiance, light_pdf) = self.scene.lights()[light].radiance_pdf(self.origin, self.ray.direction);
        let weight = match self.pdf {
            None => 1.0,
            Some(pdf) => power_heuristic(pdf, light_pdf * self.light_probability(light)),
        };
        self.add(self.throughput * radiance * weight, self.depth.saturating_sub(1));
    }

    /// The probability with which the last scattering sampled a light. The first one samples them all.
    fn light_probability(&self, light: usize) -> f32 {
        let importance = self.scene.lights()[light].importance(self.origin);
        if importance <= 0.0 || self.depth == 1 {
            return if importance > 0.0 { 1.0 } else { 0.0 };
        }
        let (total, count) = total_importance(self.scene, self.origin);
        (1.0 - UNIFORM_SHARE) * importance / total + UNIFORM_SHARE / count
    }

    /// Adds light that comes directly from the lights.
    fn sample_lights(&mut self, hit: &Hit, shading: &Shading<'_>, sampler: &mut Sampler) {
        if shading.is_dirac() {
            return;
        }
        if self.depth == 0 {
            for light in 0..self.scene.lights().len() {
                if self.scene.lights()[light].importance(hit.position) > 0.0 {
                    let [_, u, v, _] = sampler.next_4d();
                    self.sample_light(light, 1.0, [u, v], hit, shading);
                }
            }
            return;
        }
        let [choice, u, v, _] = sampler.next_4d();
        if let Some((light, probability)) = choose_light(self.scene, hit.position, choice) {
            self.sample_light(light, probability, [u, v], hit, shading);
        }
    }

    fn sample_light(
        &mut self,
        light: usize,
        probability: f32,
        u: [f32; 2],
        hit: &Hit,
        shading: &Shading<'_>,
    ) {
        let Some(sample) = self.scene.lights()[light].sample(hit.position, u) else { return };
        let (f_cos, pdf) = shading.eval_pdf(sample.wi);
        if f_cos == Vec3::ZERO || !sides_agree(hit, sample.wi) {
            return;
        }
        let ray = Ray::leaving(hit.position, hit.normal, sample.wi);
        // Up to the light, not including the surface of a lamp's housing around it.
        let passed = self.scene.transmittance(&Ray { t_max: sample.distance * (1.0 - 1e-4), ..ray });
        if passed <= 0.0 {
            return;
        }
        let weight = if sample.is_dirac { 1.0 } else { power_heuristic(sample.pdf * probability, pdf) };
        let share = passed * weight / probability;
        self.add(self.throughput * f_cos * sample.radiance_over_pdf * share, self.depth);
    }

    /// Adds light that took `bounces` scatterings more than direct light does; only then it is limited.
    fn add(&mut self, radiance: Vec3, bounces: u32) {
        let peak = radiance.max_element();
        let limit = if bounces == 0 { f32::INFINITY } else { self.scene.indirect_limit() };
        self.radiance += if peak > limit { radiance * (limit / peak) } else { radiance };
    }

    /// Chooses the next direction; false if the path ends here.
    fn scatter(&mut self, hit: &Hit, shading: &Shading<'_>, sampler: &mut Sampler, expected: f32) -> bool {
        let Some(sample) = shading.sample(sampler.next_4d()) else { return false };
        if !sides_agree(hit, sample.wi) {
            return false;
        }
        self.throughput *= sample.weight;
        // Russian roulette: a path that is not expected to bring as much as it has brought goes on more
        // rarely. The root keeps rare survivors from counting too much.
        let share = (expected / self.radiance.max_element().max(f32::MIN_POSITIVE)).max(1.0);
        let survival = (self.throughput.max_element() * share).min(1.0).sqrt();
        if survival < 1.0 {
            if sampler.next_4d()[0] >= survival {
                return false;
            }
            self.throughput /= survival;
        }
        self.ray = Ray::leaving(hit.position, hit.normal, sample.wi);
        self.origin = hit.position;
        self.pdf = (!sample.is_dirac).then_some(sample.pdf);
        self.throughput != Vec3::ZERO
    }
}

/// Whether a direction is on the same side of the surface and of its shading normal.
fn sides_agree(hit: &Hit, wi: Vec3) -> bool {
    hit.normal.dot(wi) * hit.frame.z.dot(wi) > 0.0
}

/// Veach's power heuristic with exponent 2, for one sample of each strategy.
fn power_heuristic(pdf: f32, other: f32) -> f32 {
    // Written with a ratio: squares of the densities of narrow lobes overflow.
    let ratio = other / pdf;
    1.0 / (1.0 + ratio * ratio)
}

fn total_importance(scene: &Scene, position: Vec3) -> (f32, f32) {
    let important = scene.lights().iter().map(|l| l.importance(position)).filter(|i| *i > 0.0);
    important.fold((0.0, 0.0), |(total, count), importance| (total + importance, count + 1.0))
}

/// A light to sample from `position`, and the probability of choosing it.
fn choose_light(scene: &Scene, position: Vec3, u: f32) -> Option<(usize, f32)> {
    let (total, count) = total_importance(scene, position);
    let (mut rest, mut last) = (u, None);
    for (i, light) in scene.lights().iter().enumerate() {
        let importance = light.importance(position);
        if importance > 0.0 {
            let probability = (1.0 - UNIFORM_SHARE) * importance / total + UNIFORM_SHARE / count;
            last = Some((i, probability));
            if rest < probability {
                break;
            }
            rest -= probability;
        }
    }
    last
}
