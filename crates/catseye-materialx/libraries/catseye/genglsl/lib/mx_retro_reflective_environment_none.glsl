// SPDX-License-Identifier: MIT OR Apache-2.0
//
// For MaterialX's mx_environment_none.glsl to include.
#define RETRO_REFLECTIVE_ENVIRONMENT

vec3 mx_retro_reflective_environment(vec3 X, vec3 Y, vec3 N, vec3 wo, vec2 widths, float albedo)
{
    return vec3(0.0);
}
