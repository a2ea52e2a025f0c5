//! Everything that a picture is taken of.

use catseye::Model;
use catseye_materialx::{Material, ShadingPoint};
use glam::{Vec2, Vec3};

use crate::accel::{Accel, Primitive};
use crate::bsdf::Albedo;
use crate::material::{MaterialAt, MaterialBsdf};
use crate::surface::{Attributes, Hit, shading_point, texcoords};
use crate::{Bsdf, Camera, Error, Light, Mesh, PictureInfo, Ray, Sphere, ToneMap};

/// A scene, ready to be rendered. Made by a [`SceneBuilder`].
#[derive(Debug)]
pub struct Scene {
    camera: Camera,
    tone_map: ToneMap,
    info: PictureInfo,
    indirect_limit: f32,
    accel: Accel,
    attributes: Vec<Attributes>,
    /// Of the corners of each primitive; none where no material asks.
    texcoords: Vec<[Vec2; 3]>,
    materials: Vec<MaterialBsdf>,
    lights: Vec<Box<dyn Light>>,
    opaque: bool,
}

/// A material of a scene under construction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MaterialId(u32);

/// Collects what is in a scene.
#[derive(Debug)]
pub struct SceneBuilder {
    camera: Camera,
    tone_map: ToneMap,
    info: PictureInfo,
    indirect_limit: f32,
    materials: Vec<MaterialBsdf>,
    meshes: Vec<(Mesh, MaterialId)>,
    spheres: Vec<(Sphere, MaterialId)>,
    lights: Vec<Box<dyn Light>>,
}

impl SceneBuilder {
    /// An empty scene, seen by a camera.
    #[must_use]
    pub fn new(camera: Camera) -> Self {
        Self {
            camera,
            tone_map: ToneMap::default(),
            info: PictureInfo::default(),
            indirect_limit: f32::INFINITY,
            materials: Vec::new(),
            meshes: Vec::new(),
            spheres: Vec::new(),
            lights: Vec::new(),
        }
    }

    /// Adds an opaque material.
    pub fn material(&mut self, bsdf: Bsdf) -> MaterialId {
        self.material_with_opacity(bsdf, 1.0)
    }

    /// Adds a material that lets the share `1 - opacity` of light pass straight through.
    pub fn material_with_opacity(&mut self, bsdf: Bsdf, opacity: f32) -> MaterialId {
        self.push(MaterialBsdf::constant(bsdf, opacity))
    }

    fn push(&mut self, material: MaterialBsdf) -> MaterialId {
        self.materials.push(material);
        MaterialId(self.materials.len() as u32 - 1)
    }

    /// Adds a material of a MaterialX document; its retro-reflective lobes are of the given model.
    ///
    /// # Errors
    /// As [`Bsdf::with_model`].
    pub fn materialx(&mut self, material: &Material, model: Model) -> Result<MaterialId, Error> {
        self.tinted_materialx(material, model, Vec3::ONE)
    }

    /// As [`SceneBuilder::materialx`], what is scattered multiplied by a colour.
    pub(crate) fn tinted_materialx(
        &mut self,
        material: &Material,
        model: Model,
        tint: Vec3,
    ) -> Result<MaterialId, Error> {
        Ok(self.push(MaterialBsdf::new(material, model, tint)?))
    }

    /// Adds a mesh.
    pub fn mesh(&mut self, mesh: Mesh, material: MaterialId) -> &mut Self {
        self.meshes.push((mesh, material));
        self
    }

    /// Adds a sphere. Its tangent runs along the circles of latitude around the y axis.
    pub fn sphere(&mut self, sphere: Sphere, material: MaterialId) -> &mut Self {
        self.spheres.push((sphere, material));
        self
    }

    /// Adds a light. It is not part of the geometry: it casts no shadow.
    pub fn light(&mut self, light: impl Light + 'static) -> &mut Self {
        self.boxed_light(Box::new(light))
    }

    /// As [`SceneBuilder::light`], for a light whose kind is known at run time only.
    pub fn boxed_light(&mut self, light: Box<dyn Light>) -> &mut Self {
        self.lights.push(light);
        self
    }

    /// Whether a material sends light back in a single direction.
    pub(crate) fn has_retro_mirror(&self) -> bool {
        self.materials.iter().any(|material| material.anywhere().bsdf.has_retro_mirror())
    }

    /// Sets the tone map that suits the scene.
    pub fn tone_map(&mut self, tone_map: ToneMap) -> &mut Self {
        self.tone_map = tone_map;
        self
    }

    /// Says what a file of the scene's picture is to say of it; the exposure is the tone map's.
    pub fn info(&mut self, info: PictureInfo) -> &mut Self {
        self.info = info;
        self
    }

    /// Limits what a single path may bring of indirect light: specks that small lamps and smooth surfaces
    /// make in each other vanish, and so do the caustics that they would have become. Without it pictures are
    /// unbiased.
    pub fn indirect_limit(&mut self, radiance: f32) -> &mut Self {
        self.indirect_limit = radiance;
        self
    }

    /// Checks the meshes and builds the acceleration structure.
    ///
    /// # Errors
    /// A mesh that is inconsistent.
    pub fn build(self) -> Result<Scene, Error> {
        let mut primitives = Vec::new();
        let mut attributes = Vec::new();
        let mut corners_texcoords = Vec::new();
        let varies = self.materials.iter().any(MaterialBsdf::varies);
        for (number, (mesh, material)) in self.meshes.iter().enumerate() {
            if let Some(problem) = mesh.problem() {
                return Err(Error::Mesh { mesh: number, problem });
            }
            for &triangle in &mesh.triangles {
                let corners = triangle.map(|i| mesh.positions[i as usize]);
                // A triangle without area has no normal, and no ray meets it but by rounding.
                if (corners[1] - corners[0]).cross(corners[2] - corners[0]).try_normalize().is_some() {
                    primitives.push(Primitive::Triangle(corners));
                    attributes.push(Attributes::of_triangle(mesh, triangle, material.0));
                    corners_texcoords.push(texcoords(mesh, triangle));
                }
            }
        }
        for (sphere, material) in &self.spheres {
            primitives.push(Primitive::Sphere(*sphere));
            attributes.push(Attributes::of_sphere(material.0));
            corners_texcoords.push([Vec2::ZERO; 3]);
        }
        let (accel, order) = Accel::new(&primitives);
        Ok(Scene {
            camera: self.camera,
            info: PictureInfo { exposure_ev: Some(self.tone_map.exposure_ev), ..self.info },
            tone_map: self.tone_map,
            indirect_limit: self.indirect_limit,
            accel,
            attributes: order.iter().map(|&i| attributes[i as usize]).collect(),
            texcoords: match varies {
                true => order.iter().map(|&i| corners_texcoords[i as usize]).collect(),
                false => Vec::new(),
            },
            opaque: self.materials.iter().all(MaterialBsdf::is_opaque),
            materials: self.materials,
            lights: self.lights,
        })
    }
}

impl Scene {
    /// The camera.
    #[must_use]
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The tone map that suits the scene's light.
    #[must_use]
    pub fn tone_map(&self) -> &ToneMap {
        &self.tone_map
    }

    /// What a file of the picture is to say of it: units, exposure and lamp.
    #[must_use]
    pub fn info(&self) -> &PictureInfo {
        &self.info
    }

    /// The most that a single path may bring of indirect light.
    pub(crate) fn indirect_limit(&self) -> f32 {
        self.indirect_limit
    }

    /// The lights.
    pub(crate) fn lights(&self) -> &[Box<dyn Light>] {
        &self.lights
    }

    /// The surface point that the ray meets first.
    pub(crate) fn intersect(&self, ray: &Ray) -> Option<Hit> {
        let (index, t) = self.accel.nearest(ray)?;
        let hit = Hit::new(ray, t, self.accel.primitive(index), &self.attributes[index]);
        Some(Hit { primitive: index as u32, ..hit })
    }

    /// The material at a point that a ray of this direction meets.
    pub(crate) fn material(&self, hit: &Hit, direction: Vec3) -> MaterialAt<'_> {
        let material = &self.materials[hit.material as usize];
        // A point that can't be shaded is shaded like the default point, which can.
        material
            .at(|| self.shading_point(hit, direction), Albedo::Cached)
            .unwrap_or_else(|_| material.anywhere())
    }

    /// The opacity of a surface point that a ray of this direction meets.
    pub(crate) fn opacity(&self, hit: &Hit, direction: Vec3) -> f32 {
        self.materials[hit.material as usize].opacity(|| self.shading_point(hit, direction))
    }

    fn shading_point(&self, hit: &Hit, direction: Vec3) -> ShadingPoint {
        let index = hit.primitive as usize;
        shading_point(hit, direction, self.accel.primitive(index), self.texcoords[index])
    }

    /// The share of light that passes along the whole ray.
    pub(crate) fn transmittance(&self, ray: &Ray) -> f32 {
        if self.opaque {
            return if self.accel.is_blocked(ray) { 0.0 } else { 1.0 };
        }
        let (mut ray, mut passed) = (*ray, 1.0);
        while let Some(hit) = self.intersect(&ray) {
            passed *= 1.0 - self.opacity(&hit, ray.direction);
            if passed <= 0.0 {
                return 0.0;
            }
            let t_max = ray.t_max - hit.t;
            ray = Ray { t_max, ..Ray::leaving(hit.position, hit.normal, ray.direction) };
        }
        passed
    }
}
