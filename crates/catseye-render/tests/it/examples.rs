//! MaterialX's own example materials load and render; what doesn't says why.
//!
//! Runs where `MATERIALX_SEARCH_PATH` names a checkout of MaterialX (with `libraries` and `resources`). No
//! package brings one, so `CATSEYE_REQUIRE=all`, which asks for what can be installed, does not ask for it.
//! `--nocapture` prints the table.

use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

use catseye::Model;
use catseye_materialx::{Document, Library, Material, SearchPath};
use catseye_render::{RenderSettings, Scene, render};

/// Examples that need nodes which are not implemented here.
const KNOWN_MISSING: &[&str] = &["simple_hair", "onyx_hextiled"];

fn documents(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("the folder can be read").path();
        if path.is_dir() {
            documents(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "mtlx") {
            found.push(path);
        }
    }
}

/// Renders a few pixels; the mean shows that it is neither black nor broken.
fn mean(material: &Material) -> Result<f32, String> {
    let scene = Scene::preview(material, Model::default()).map_err(|error| error.to_string())?;
    let settings = RenderSettings { width: 48, height: 27, spp: 1, ..RenderSettings::default() };
    let image = render(&scene, &settings, &|_| ()).map_err(|error| error.to_string())?;
    let mean = image.mean().iter().sum::<f32>() / 3.0;
    if mean.is_finite() && mean > 0.0 { Ok(mean) } else { Err(format!("the mean of the picture is {mean}")) }
}

#[test]
fn materialx_examples_load_and_render() {
    let search_path = SearchPath::from_env();
    let examples = |folder: &PathBuf| folder.join("resources/Materials/Examples");
    let Some(root) = search_path.folders().iter().map(examples).find(|folder| folder.is_dir()) else {
        eprintln!("skipped: MATERIALX_SEARCH_PATH names no checkout of MaterialX");
        return;
    };
    let library = Arc::new(Library::load(search_path).unwrap());
    let mut paths = Vec::new();
    documents(&root, &mut paths);
    paths.sort();
    let (mut rendered, mut total, mut surprises) = (0, 0, Vec::new());
    for path in &paths {
        let name = path.file_stem().unwrap().to_string_lossy();
        let known = KNOWN_MISSING.iter().any(|missing| name.contains(missing));
        let document = Document::load_with(path, &library);
        let names = document.as_ref().map(Document::material_names).unwrap_or_default();
        for material_name in names.iter().map(Some).chain(names.is_empty().then_some(None)) {
            total += 1;
            let material_name = material_name.map(String::as_str);
            let result = match &document {
                Err(error) => Err(error.to_string()),
                Ok(document) => document.material(material_name).map_err(|error| error.to_string()),
            };
            let shown = material_name.unwrap_or("");
            match result.and_then(|material| mean(&material).map(|mean| (mean, material))) {
                Ok((mean, material)) => {
                    rendered += 1;
                    println!("ok      {name} {shown} (mean {mean:.3})");
                    material.warnings.iter().for_each(|warning| println!("        {warning}"));
                }
                Err(error) => {
                    println!("FAILED  {name} {shown}: {error}");
                    // Pictures may be left out of a copy of MaterialX.
                    if !known && !error.contains("there is no file") {
                        surprises.push(error);
                    }
                }
            }
        }
    }
    println!("{rendered} of {total} materials in {} documents load and render", paths.len());
    assert!(surprises.is_empty(), "{surprises:#?}");
}
