//! The files of engines: glTF, three.js and OpenPBR.

use serde_json::{Value, json};

use super::single::{Dielectric, OpenPbr};
use crate::mtlx::{Binding, Document, identifier};

/// A glTF 2.0 asset of one material, a dielectric whose reflection goes back.
///
/// The extension `KHR_materials_retroreflection` is a draft (KhronosGroup/glTF pull request 2610, July 2026).
/// `facts` go into the material's `extras`.
#[must_use]
pub fn gltf(name: &str, material: &Dielectric, facts: &Value) -> String {
    let [red, green, blue] = material.color;
    let document = json!({
        "asset": { "version": "2.0", "generator": "catseye export" },
        "extensionsUsed": ["KHR_materials_retroreflection", "KHR_materials_specular"],
        "materials": [{
            "name": name,
            "pbrMetallicRoughness": {
                "baseColorFactor": [red, green, blue, 1.0],
                "metallicFactor": 0.0,
                "roughnessFactor": material.roughness,
            },
            "extensions": {
                "KHR_materials_retroreflection": { "retroreflectionFactor": 1.0 },
                "KHR_materials_specular": {
                    "specularFactor": material.specular,
                    "specularColorFactor": material.specular_color,
                },
            },
            "extras": { "catseye": facts },
        }],
    });
    format!("{document:#}\n")
}

/// A JavaScript module that exports a `MeshPhysicalMaterial` of three.js r187 or newer.
#[must_use]
pub fn three(name: &str, material: &Dielectric, remarks: &[String]) -> String {
    let comment: String = remarks.iter().map(|line| format!("// {}\n", line.replace('\n', " "))).collect();
    let linear = |[red, green, blue]: [f64; 3]| format!("linear({red}, {green}, {blue})");
    let name = identifier(name);
    format!(
        "{comment}import {{ Color, LinearSRGBColorSpace, MeshPhysicalMaterial }} from 'three';\n\n\
         const linear = (r, g, b) => new Color().setRGB(r, g, b, LinearSRGBColorSpace);\n\n\
         export const {name} = new MeshPhysicalMaterial({{\n  name: '{name}',\n  color: {},\n  \
         metalness: 0,\n  roughness: {},\n  ior: 1.5,\n  specularIntensity: {},\n  specularColor: {},\n  \
         retroreflectivity: 1,\n}});\n",
        linear(material.color),
        material.roughness,
        material.specular,
        linear(material.specular_color),
    )
}

/// A MaterialX document with an `open_pbr_surface` of OpenPBR 1.2.
#[must_use]
pub fn open_pbr(name: &str, material: &OpenPbr, remarks: &[String]) -> String {
    let mut document = Document::new(&remarks.join("\n    "));
    let name = identifier(name);
    let surface = format!("{name}_surface");
    let float = |name: &'static str, value: f64| (name, "float", Binding::Value(value.to_string()));
    let color = material.base_color.map(|channel| channel.to_string()).join(", ");
    let inputs = [
        ("base_color", "color3", Binding::Value(color)),
        float("base_metalness", material.base_metalness),
        float("specular_weight", material.specular_weight),
        float("specular_roughness", material.specular_roughness),
        float("specular_ior", 1.0),
        float("specular_retroreflectivity", 1.0),
    ];
    document.node("open_pbr_surface", &surface, "surfaceshader", &inputs);
    let inputs = [("surfaceshader", "surfaceshader", Binding::Node(surface.clone()))];
    document.node("surfacematerial", &name, "material", &inputs);
    document.finish()
}
