//! The data library that brings `retro_reflective_bsdf` and `retro_sheeting_surface` to MaterialX itself.

use std::borrow::Cow;

/// A file: its path under the crate's folder, and its text.
macro_rules! file {
    ($path:literal) => {
        ($path, include_str!(concat!("../", $path)))
    };
}

/// The library's folder, under MaterialX's root.
pub const FOLDER: &str = "libraries/catseye/";

/// Where the library is one module for the web.
const WEB_MODULE: &str = "libraries/catseye/web/catseye.mjs";

/// The files of the repository: their paths under MaterialX's root, with `/`, and their texts.
const FILES: &[(&str, &str)] = &[
    file!("libraries/catseye/LICENSE-APACHE"),
    file!("libraries/catseye/LICENSE-MIT"),
    file!("libraries/catseye/README.md"),
    file!("libraries/catseye/catseye_defs.mtlx"),
    file!("libraries/catseye/catseye_ng.mtlx"),
    file!("libraries/catseye/catseye_translation.mtlx"),
    file!("libraries/catseye/genglsl/catseye_genglsl_impl.mtlx"),
    file!("libraries/catseye/genglsl/lib/mx_retro_reflective.glsl"),
    file!("libraries/catseye/genglsl/lib/mx_retro_reflective_albedo.glsl"),
    file!("libraries/catseye/genglsl/lib/mx_retro_reflective_environment.glsl"),
    file!("libraries/catseye/genglsl/lib/mx_retro_reflective_environment_fis.glsl"),
    file!("libraries/catseye/genglsl/lib/mx_retro_reflective_environment_none.glsl"),
    file!("libraries/catseye/genglsl/lib/mx_retro_reflective_environment_prefilter.glsl"),
    file!("libraries/catseye/genglsl/lib/mx_retro_reflective_sample.glsl"),
    file!("libraries/catseye/genglsl/mx_retro_reflective_bsdf.glsl"),
    file!("libraries/catseye/genmdl/catseye/catseye.mdl"),
    file!("libraries/catseye/genmdl/catseye_genmdl_impl.mtlx"),
    file!("libraries/catseye/genosl/catseye_genosl_impl.mtlx"),
    file!("libraries/catseye/genosl/lib/mx_retro_reflective.osl"),
    file!("libraries/catseye/genosl/lib/mx_retro_reflective_albedo.osl"),
    file!("libraries/catseye/genosl/mx_retro_reflective_bsdf.osl"),
    file!("resources/Materials/Examples/RetroSheeting/retro_sheeting_presets.mtlx"),
    file!("resources/Materials/TestSuite/pbrlib/bsdf/retro_reflective.mtlx"),
];

/// Every file of the export: its path under MaterialX's root, with `/`, and its text.
pub fn files() -> impl Iterator<Item = (&'static str, Cow<'static, str>)> {
    let stored = FILES.iter().map(|(path, text)| (*path, Cow::Borrowed(*text)));
    stored.chain([(WEB_MODULE, Cow::Owned(web_module()))])
}

/// The definitions and graphs, which are for every shading language: file names and texts.
pub(crate) fn definitions() -> impl Iterator<Item = (&'static str, &'static str)> {
    FILES.iter().filter_map(|(path, text)| {
        let name = path.strip_prefix(FOLDER)?;
        (name.ends_with(".mtlx") && !name.contains('/')).then_some((name, *text))
    })
}

/// The definitions and the GLSL in one JavaScript module. Rust's notation of a string of ASCII is
/// JavaScript's.
fn web_module() -> String {
    let files: String = FILES
        .iter()
        .filter_map(|(path, text)| Some((path.strip_prefix("libraries/")?, text)))
        .filter(|(path, _)| path.contains("/genglsl/") || path.starts_with("catseye/catseye_"))
        .map(|(path, text)| format!("  {path:?}: {text:?},\n"))
        .collect();
    include_str!("../web/catseye.mjs").replace("FILES = {}", &format!("FILES = {{\n{files}}}"))
}
