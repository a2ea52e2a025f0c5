//! Finding what a ray meets: a bounding volume hierarchy over triangles and spheres.

use glam::Vec3;
use obvhs::aabb::Aabb;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::bvh2_to_cwbvh::bvh2_to_cwbvh;
use obvhs::ploc::PlocBuilder;
use obvhs::ray::RayHit;
use obvhs::{Boundable, BvhBuildParams};

use crate::triangle::{ShearedRay, intersect_triangle};
use crate::{Ray, Sphere};

/// Primitives in a leaf: the most that the format holds.
const MAX_LEAF: u32 = 3;

/// Something that a ray can meet.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Primitive {
    Triangle([Vec3; 3]),
    Sphere(Sphere),
}

impl Boundable for Primitive {
    fn aabb(&self) -> Aabb {
        let (min, max) = match self {
            Self::Triangle([a, b, c]) => (a.min(*b).min(*c), a.max(*b).max(*c)),
            Self::Sphere(sphere) => (sphere.centre - sphere.radius, sphere.centre + sphere.radius),
        };
        // Through arrays: whichever version of glam obvhs was built with.
        Aabb::new(min.to_array().into(), max.to_array().into())
    }
}

/// The primitives of a scene, in the order of the hierarchy.
#[derive(Debug, Default)]
pub(crate) struct Accel {
    /// None for a scene without primitives.
    bvh: Option<CwBvh>,
    primitives: Vec<Primitive>,
}

impl Accel {
    /// Builds the hierarchy. Also returns which of the given primitives stands at each place of the new
    /// order.
    pub(crate) fn new(primitives: &[Primitive]) -> (Self, Vec<u32>) {
        if primitives.is_empty() {
            return (Self::default(), Vec::new());
        }
        let bvh = build(primitives);
        let order = bvh.primitive_indices.clone();
        let primitives = order.iter().map(|&i| primitives[i as usize]).collect();
        (Self { bvh: Some(bvh), primitives }, order)
    }

    /// The primitive that the ray meets first, and the distance.
    pub(crate) fn nearest(&self, ray: &Ray) -> Option<(usize, f32)> {
        let bvh = self.bvh.as_ref()?;
        let sheared = ShearedRay::new(ray);
        let mut hit = RayHit::none();
        bvh.ray_traverse(traversal(ray), &mut hit, |r, i| self.distance(ray, &sheared, r.tmax, i))
            .then_some((hit.primitive_id as usize, hit.t))
    }

    /// Whether the ray meets anything.
    pub(crate) fn is_blocked(&self, ray: &Ray) -> bool {
        let Some(bvh) = &self.bvh else { return false };
        let sheared = ShearedRay::new(ray);
        !bvh.ray_traverse_miss(traversal(ray), |r, i| self.distance(ray, &sheared, r.tmax, i))
    }

    /// The primitive at a place of the hierarchy's order.
    pub(crate) fn primitive(&self, index: usize) -> &Primitive {
        &self.primitives[index]
    }

    #[inline]
    fn distance(&self, ray: &Ray, sheared: &ShearedRay, t_max: f32, index: usize) -> f32 {
        let t = match &self.primitives[index] {
            Primitive::Triangle(corners) => intersect_triangle(sheared, corners, t_max),
            Primitive::Sphere(sphere) => sphere.intersect(&Ray { t_max, ..*ray }),
        };
        t.unwrap_or(f32::INFINITY)
    }
}

/// As `obvhs::cwbvh::builder::build_cwbvh`, without its self-check in debug builds: that has an absolute
/// tolerance of 1e-5, less than the rounding of scenes beyond a hundred metres.
fn build(primitives: &[Primitive]) -> CwBvh {
    let params = BvhBuildParams::medium_build();
    let mut bvh2 = PlocBuilder::with_capacity(primitives.len()).build(
        params.ploc_search_distance,
        primitives,
        (0..primitives.len() as u32).collect(),
        params.sort_precision,
        params.search_depth_threshold,
    );
    ReinsertionOptimizer::default().run(&mut bvh2, params.reinsertion_batch_ratio, None);
    bvh2_to_cwbvh(&bvh2, MAX_LEAF, true, false)
}

fn traversal(ray: &Ray) -> obvhs::ray::Ray {
    obvhs::ray::Ray::new(ray.origin.to_array().into(), ray.direction.to_array().into(), 0.0, ray.t_max)
}
