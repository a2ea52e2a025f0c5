// SPDX-License-Identifier: MIT OR Apache-2.0
//
// For MaterialX's mx_environment_fis.glsl to include: filtered importance sampling of the lobe itself.
// http://cgg.mff.cuni.cz/~jaroslav/papers/2008-egsr-fis/2008-egsr-fis-final-embedded.pdf
#define RETRO_REFLECTIVE_ENVIRONMENT
#include "mx_retro_reflective_sample.glsl"

vec3 mx_retro_reflective_environment(vec3 X, vec3 Y, vec3 N, vec3 wo, vec2 widths, float albedo)
{
    vec3 radiance = vec3(0.0);
    for (int i = 0; i < $envRadianceSamples; i++)
    {
        RetroReflectiveSample s = mx_retro_reflective_sample(mx_spherical_fibonacci(i, $envRadianceSamples), wo, widths);
        vec3 L = normalize(X * s.wi.x + Y * s.wi.y + N * s.wi.z);
        float lod = mx_latlong_compute_lod(L, s.pdf, float($envRadianceMips - 1), $envRadianceSamples);
        radiance += s.weight * mx_latlong_map_lookup(L, $envMatrix, lod, $envRadiance);
    }
    return radiance * ($envLightIntensity / float(max($envRadianceSamples, 1)));
}
