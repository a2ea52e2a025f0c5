// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The reciprocal lobe on the halfway vector disk: docs/theory.md, section 2. Local frame: x along tangent_u, z along the
// normal; wo towards the viewer, wi towards the light.
// Edwards et al., "The halfway vector disk for BRDF modeling", ACM TOG 25(1), 2006: Equations 15, 20, 26, 32, 33

// A perfect retro-reflector has no density. The peak of this roughness, 2 / (4 pi 0.002^2) = 39800, is still within the
// range of half-precision frame buffers; the narrowest of real sheeting is wider.
#define RETRO_REFLECTIVE_MIN_ROUGHNESS 0.002

// The tangent made perpendicular to the normal; any such vector where that is impossible.
vec3 mx_retro_reflective_tangent(vec3 X, vec3 N)
{
    X = X - dot(X, N) * N;
    if (!(dot(X, X) > 1e-12))
    {
        X = cross((abs(N.z) < 0.7) ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0), N);
    }
    return normalize(X);
}

// m = sqrt(1 / (n + 1)) with n = 2 / roughness^2, for both roughnesses. Comparisons send NaN to the minimum.
vec2 mx_retro_reflective_widths(float roughness_u, float roughness_v)
{
    float r_u = (roughness_u > RETRO_REFLECTIVE_MIN_ROUGHNESS) ? roughness_u : RETRO_REFLECTIVE_MIN_ROUGHNESS;
    float r_v = (roughness_v < 0.0) ? r_u : roughness_v;
    r_v = (r_v > RETRO_REFLECTIVE_MIN_ROUGHNESS) ? r_v : RETRO_REFLECTIVE_MIN_ROUGHNESS;
    return vec2(1.0 / sqrt(1.0 + 2.0 / (r_u * r_u)), 1.0 / sqrt(1.0 + 2.0 / (r_v * r_v)));
}

// ln(1 - x), given also rest = 1 - x with all its digits. For small x the series of -2 atanh(x / (2 - x)).
float mx_retro_reflective_ln_one_minus(float x, float rest)
{
    if (x > 0.25)
    {
        return log(max(rest, 1e-30));
    }
    float s = x / (2.0 - x);
    float z = s * s;
    return -2.0 * s * (1.0 + z * (1.0 / 3.0 + z * (1.0 / 5.0 + z * (1.0 / 7.0))));
}

// B = sqrt((n_u+1)(n_v+1)) / (2 pi) * (1-|d|^2)^(n+1), with d = (z_o i_xy - z_i o_xy) / (z_o + z_i) and delta = wi - wo.
float mx_retro_reflective_lump(vec3 wo, vec3 delta, vec2 widths)
{
    // Scaled by z_o + z_i. (1-|d|^2) (z_o + z_i)^2 = z_o z_i |wo + wi|^2 is accurate where |d| is near 1.
    vec2 d = wo.z * delta.xy - delta.z * wo.xy;
    float d2 = dot(d, d);
    vec3 sum = 2.0 * wo + delta;
    float whole = sum.z * sum.z;
    float part = wo.z * (wo.z + delta.z) * dot(sum, sum);

    // n + 1 along d.
    vec2 e = d / widths;
    float exponent = dot(e, e) / max(d2, 1e-30);
    float norm = 0.5 * M_PI_INV / (widths.x * widths.y);
    return norm * exp(exponent * mx_retro_reflective_ln_one_minus(d2 / whole, part / whole));
}

// f = B min(z_o, z_i) / (max(z_o, z_i)^2 (z_o + z_i)), in 1/sr, for two directions above the horizon.
float mx_retro_reflective_single(vec3 wo, vec3 delta, vec2 widths)
{
    float z_i = wo.z + delta.z;
    float low = min(wo.z, z_i);
    float high = max(wo.z, z_i);
    return mx_retro_reflective_lump(wo, delta, widths) * (low / high) / (high * (wo.z + z_i));
}
