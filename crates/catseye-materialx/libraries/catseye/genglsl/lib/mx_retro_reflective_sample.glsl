// SPDX-License-Identifier: MIT OR Apache-2.0
//
// A sample of single scattering: docs/theory.md, section 3.
#ifndef RETRO_REFLECTIVE_SAMPLE
#define RETRO_REFLECTIVE_SAMPLE

struct RetroReflectiveSample
{
    vec3 wi;
    // BSDF and cosine over pdf: at most 1.
    float weight;
    float pdf;
};

RetroReflectiveSample mx_retro_reflective_sample(vec2 Xi, vec3 wo, vec2 widths)
{
    // The disk offset d, with |d|^2 = 1 - (1 - u)^(1/(n+1)) and 1/(n+1) = |e|^2 along the azimuth.
    vec2 e = widths * vec2(mx_cos(2.0 * M_PI * Xi.y), mx_sin(2.0 * M_PI * Xi.y));
    float m2 = dot(e, e);
    float power = m2 * log(1.0 - Xi.x);
    float d2 = (power > -0.01) ? -power * (1.0 + power * (0.5 + power / 6.0)) : 1.0 - exp(power);
    vec2 d = e * sqrt(d2 / m2);

    // wi = 2 (o.h) / (h.h) h - o with h = (o_xy + d, z_o).
    vec3 h = vec3(wo.xy + d, wo.z);
    float h2 = dot(h, h);
    float z_i = wo.z * (1.0 - d2) / h2;
    float ratio = min(z_i / wo.z, 1.0);

    RetroReflectiveSample s;
    s.wi = vec3((2.0 * (1.0 + dot(wo.xy, d)) / h2 * h - wo).xy, z_i);
    s.weight = ratio * ratio * ratio;
    s.pdf = 0.5 * M_PI_INV / (widths.x * widths.y) * (1.0 - Xi.x) * wo.z / (max(z_i, 1e-6) * (wo.z + z_i));
    return s;
}

#endif
