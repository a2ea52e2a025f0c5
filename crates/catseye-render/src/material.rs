//! A material of a document, ready to be asked what it is at a point.

use std::borrow::Cow;
use std::cell::RefCell;

use catseye::Model;
use catseye_materialx::{Closure, Material, Patterns, ShadingPoint, Surface};
use glam::Vec3;

use crate::bsdf::Albedo;
use crate::{Bsdf, Error};

/// What a surface scatters, lets through and emits, the same everywhere or by patterns.
#[derive(Debug)]
pub(crate) struct MaterialBsdf {
    bsdf: Bsdf,
    opacity: f32,
    emission: Vec3,
    varying: Option<Varying>,
}

/// What patterns make of a point.
#[derive(Debug)]
struct Varying {
    patterns: Patterns,
    model: Model,
    /// Factor on the BSDF.
    tint: Vec3,
}

/// A material at a point.
#[derive(Debug)]
pub(crate) struct MaterialAt<'a> {
    pub(crate) bsdf: Cow<'a, Bsdf>,
    /// The share of light that doesn't pass straight through, in `[0, 1]`.
    pub(crate) opacity: f32,
    /// Radiance that it emits towards the viewer.
    pub(crate) emission: Vec3,
}

thread_local! {
    /// Room for the registers of patterns.
    static REGISTERS: RefCell<Vec<[f32; 4]>> = const { RefCell::new(Vec::new()) };
}

impl MaterialBsdf {
    /// A material that is the same everywhere.
    pub(crate) fn constant(bsdf: Bsdf, opacity: f32) -> Self {
        Self { bsdf, opacity: opacity.clamp(0.0, 1.0), emission: Vec3::ZERO, varying: None }
    }

    /// A material of a document, what it scatters multiplied by a colour.
    pub(crate) fn new(material: &Material, model: Model, tint: Vec3) -> Result<Self, Error> {
        let varying = material.patterns.clone().map(|patterns| Varying { patterns, model, tint });
        Ok(Self {
            bsdf: Bsdf::with_model(&tinted(material.surface.bsdf.clone(), tint), model)?,
            opacity: material.surface.opacity.clamp(0.0, 1.0),
            emission: Vec3::from(material.surface.emission),
            varying,
        })
    }

    /// Whether patterns ask for the point.
    pub(crate) fn varies(&self) -> bool {
        self.varying.is_some()
    }

    /// Whether nothing passes anywhere.
    pub(crate) fn is_opaque(&self) -> bool {
        self.opacity >= 1.0 && self.varying.as_ref().is_none_or(|varying| !varying.patterns.has_opacity())
    }

    /// What the material is where it is the same everywhere, and at the default point.
    pub(crate) fn anywhere(&self) -> MaterialAt<'_> {
        MaterialAt { bsdf: Cow::Borrowed(&self.bsdf), opacity: self.opacity, emission: self.emission }
    }

    /// The material at a point, which is computed where patterns ask for it.
    ///
    /// # Errors
    /// As [`Bsdf::with_model`], for what patterns make.
    pub(crate) fn at(
        &self,
        point: impl FnOnce() -> ShadingPoint,
        albedo: Albedo,
    ) -> Result<MaterialAt<'_>, Error> {
        let Some(varying) = &self.varying else { return Ok(self.anywhere()) };
        let Surface { bsdf, opacity, emission } = varying.evaluate(&point());
        let bsdf = Bsdf::with_albedo(&tinted(bsdf, varying.tint), varying.model, albedo)?;
        Ok(MaterialAt {
            bsdf: Cow::Owned(bsdf),
            opacity: opacity.clamp(0.0, 1.0),
            emission: Vec3::from(emission),
        })
    }

    /// The opacity at a point, which is computed where patterns ask for it.
    pub(crate) fn opacity(&self, point: impl FnOnce() -> ShadingPoint) -> f32 {
        match &self.varying {
            Some(varying) if varying.patterns.has_opacity() => varying.evaluate(&point()).opacity,
            _ => self.opacity,
        }
    }
}

impl Varying {
    fn evaluate(&self, point: &ShadingPoint) -> Surface {
        REGISTERS.with_borrow_mut(|registers| self.patterns.at_with(point, registers))
    }
}

/// A closure times a colour.
fn tinted(closure: Closure, tint: Vec3) -> Closure {
    if tint == Vec3::ONE {
        return closure;
    }
    Closure::Multiply { closure: Box::new(closure), factor: tint.to_array() }
}
