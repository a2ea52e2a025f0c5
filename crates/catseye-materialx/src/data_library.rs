//! The data library that brings `retro_reflective_bsdf` and `retro_sheeting_surface` to MaterialX itself.

/// A file: its path under the library's folder, and its text.
macro_rules! file {
    ($path:literal) => {
        ($path, include_str!(concat!("../libraries/catseye/", $path)))
    };
}

/// The library's folder, by which MaterialX loads it.
pub const NAME: &str = "catseye";

/// Every file of the library: its path under the folder, with `/`, and its text.
pub const FILES: &[(&str, &str)] = &[
    file!("catseye_defs.mtlx"),
    file!("catseye_ng.mtlx"),
    file!("catseye_translation.mtlx"),
    file!("genglsl/catseye_genglsl_impl.mtlx"),
    file!("genglsl/lib/mx_retro_reflective.glsl"),
    file!("genglsl/lib/mx_retro_reflective_albedo.glsl"),
    file!("genglsl/lib/mx_retro_reflective_environment.glsl"),
    file!("genglsl/lib/mx_retro_reflective_environment_fis.glsl"),
    file!("genglsl/lib/mx_retro_reflective_environment_none.glsl"),
    file!("genglsl/lib/mx_retro_reflective_environment_prefilter.glsl"),
    file!("genglsl/lib/mx_retro_reflective_sample.glsl"),
    file!("genglsl/mx_retro_reflective_bsdf.glsl"),
    file!("genmdl/catseye/catseye.mdl"),
    file!("genmdl/catseye_genmdl_impl.mtlx"),
    file!("genosl/catseye_genosl_impl.mtlx"),
    file!("genosl/lib/mx_retro_reflective.osl"),
    file!("genosl/lib/mx_retro_reflective_albedo.osl"),
    file!("genosl/mx_retro_reflective_bsdf.osl"),
];
