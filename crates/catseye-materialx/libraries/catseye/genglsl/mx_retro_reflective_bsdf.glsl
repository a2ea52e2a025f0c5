// SPDX-License-Identifier: MIT OR Apache-2.0

#include "lib/mx_retro_reflective.glsl"
#include "lib/mx_retro_reflective_albedo.glsl"
#include "lib/mx_retro_reflective_sample.glsl"
#include "lib/mx_retro_reflective_environment.glsl"

void mx_retro_reflective_bsdf(ClosureData closureData, BSDF declared, float weight, float roughness_u, float roughness_v, vec3 tint, vec3 multiscatter_tint, vec3 N, vec3 X, inout BSDF bsdf)
{
    if (weight < M_FLOAT_EPS)
    {
        return;
    }

    vec3 V = closureData.V;
    vec3 L = closureData.L;

    N = mx_forward_facing_normal(N, V);
    X = mx_retro_reflective_tangent(X, N);
    vec3 Y = cross(N, X);
    vec3 wo = vec3(dot(V, X), dot(V, Y), dot(V, N));

    vec2 widths = mx_retro_reflective_widths(roughness_u, roughness_v);
    RetroReflectiveAlbedo albedo = mx_retro_reflective_albedo_init(widths);
    float loss_o = mx_retro_reflective_loss(albedo, wo.x * wo.x, wo.y * wo.y);

    vec3 safeTint = clamp(tint, 0.0, 1.0);
    vec3 safeMultiscatterTint = clamp(multiscatter_tint, 0.0, 1.0);
    vec3 dirAlbedo = safeTint * (1.0 - loss_o) + safeMultiscatterTint * loss_o;
    bsdf.throughput = vec3(1.0) - dirAlbedo * weight;

    if (closureData.closureType == CLOSURE_TYPE_REFLECTION)
    {
        // The difference is taken first: near the retro direction it keeps the digits that matter.
        vec3 LV = L - V;
        vec3 delta = vec3(dot(LV, X), dot(LV, Y), dot(LV, N));
        vec3 wi = wo + delta;
        if (min(wo.z, wi.z) <= M_FLOAT_EPS)
        {
            bsdf.response = vec3(0.0);
            return;
        }

        // The cosine of the light's direction is part of the response.
        vec3 f = safeTint * mx_retro_reflective_single(wo, delta, widths);
        if (max(safeMultiscatterTint.x, max(safeMultiscatterTint.y, safeMultiscatterTint.z)) > 0.0)
        {
            float loss_i = mx_retro_reflective_loss(albedo, wi.x * wi.x, wi.y * wi.y);
            f += safeMultiscatterTint * (loss_o * loss_i * M_PI_INV / mx_retro_reflective_average_loss(albedo));
        }
        bsdf.response = f * wi.z * closureData.occlusion * weight;
    }
    else if (closureData.closureType == CLOSURE_TYPE_INDIRECT)
    {
        wo.z = max(wo.z, M_FLOAT_EPS);
        vec3 single = mx_retro_reflective_environment(X, Y, N, wo, widths, 1.0 - loss_o);
        vec3 multiple = loss_o * mx_environment_irradiance(N);
        bsdf.response = (safeTint * single + safeMultiscatterTint * multiple) * weight;
    }
}
