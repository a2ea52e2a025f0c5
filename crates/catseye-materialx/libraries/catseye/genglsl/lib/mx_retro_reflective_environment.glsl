// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The lobe's response to the environment, for unit tint: the integral of radiance, BSDF and cosine. This form needs only
// `mx_environment_radiance`, which every environment mode and every host defines, for a mirror lobe of a given width, and
// what declares its arguments. Where the mode's own file has defined a better one, that one stands.
#ifndef RETRO_REFLECTIVE_ENVIRONMENT
#define RETRO_REFLECTIVE_ENVIRONMENT

#define RETRO_REFLECTIVE_LOOKUPS 8

vec3 mx_retro_reflective_environment(vec3 X, vec3 Y, vec3 N, vec3 wo, vec2 widths, float albedo)
{
    FresnelData fd = mx_init_fresnel_schlick(vec3(1.0), vec3(1.0), vec3(1.0), 5.0, 0.0, 1.0);
    vec3 radiance = vec3(0.0);
    float total = 0.0;
    for (int i = 0; i < RETRO_REFLECTIVE_LOOKUPS; i++)
    {
        RetroReflectiveSample s = mx_retro_reflective_sample(mx_spherical_fibonacci(i, RETRO_REFLECTIVE_LOOKUPS), wo, widths);
        vec3 L = normalize(X * s.wi.x + Y * s.wi.y + N * s.wi.z);
        vec3 axis = (abs(L.z) < 0.7) ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);

        // The share of one sample, in a mirror lobe around it whose peak 1 / (4 pi alpha^2) is as high as our lobe there.
        float alpha = clamp(sqrt(0.25 * M_PI_INV / (float(RETRO_REFLECTIVE_LOOKUPS) * s.pdf)), 1e-3, 1.0);
        vec3 Li = mx_environment_radiance(L, L, axis, vec2(alpha), 0, fd);
        radiance += s.weight * Li / mx_ggx_dir_albedo(1.0, alpha, 1.0, 1.0);
        total += s.weight;
    }
    // The albedo is known exactly; eight weights only share it out.
    return radiance * (albedo / max(total, 1e-6));
}

#endif
