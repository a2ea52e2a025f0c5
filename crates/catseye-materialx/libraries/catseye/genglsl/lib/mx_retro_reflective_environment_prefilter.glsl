// SPDX-License-Identifier: MIT OR Apache-2.0
//
// For MaterialX's mx_environment_prefilter.glsl to include: look-ups are what a prefiltered map has.
#include "mx_retro_reflective_sample.glsl"
#include "mx_retro_reflective_environment.glsl"
