// The lobe as an ellipse of directions around wo: the two widths, in units of the half vector's angle, and the angle of
// the first axis from the direction away from the normal.
//
// To first order in wi - wo the disk offset is d = (h_a / cos(theta_o), h_b), h_a being half the step away from the
// normal and h_b half the step around it: the lobe narrows with the cosine in the plane of incidence.
struct RetroReflectiveEllipse
{
    vec2 widths;
    float angle;
};

RetroReflectiveEllipse mx_retro_reflective_ellipse(vec3 wo, vec2 widths)
{
    // The quadratic form (d_x/m_u)^2 + (d_y/m_v)^2 in (h_a, h_b), and its eigenvalues.
    float sin_theta = sqrt(dot(wo.xy, wo.xy));
    vec2 away = (sin_theta > 1e-4) ? wo.xy / sin_theta : vec2(1.0, 0.0);
    vec2 inv_m2 = 1.0 / (widths * widths);
    float inv_cos = 1.0 / max(wo.z, 0.05);
    float aa = (away.x * away.x * inv_m2.x + away.y * away.y * inv_m2.y) * inv_cos * inv_cos;
    float bb = away.y * away.y * inv_m2.x + away.x * away.x * inv_m2.y;
    float ab = away.x * away.y * (inv_m2.y - inv_m2.x) * inv_cos;
    float middle = 0.5 * (aa + bb);
    float half_range = sqrt(0.25 * (aa - bb) * (aa - bb) + ab * ab);

    RetroReflectiveEllipse ellipse;
    // The product of the eigenvalues is that of the axes; the smaller one would cancel.
    float greater = middle + half_range;
    float lesser = inv_m2.x * inv_m2.y * inv_cos * inv_cos / greater;
    ellipse.widths = vec2(1.0 / sqrt(greater), 1.0 / sqrt(lesser));
    // A circle has no axes.
    ellipse.angle = (half_range > 1e-6 * middle) ? 0.5 * mx_atan(2.0 * ab, aa - bb) : 0.0;
    return ellipse;
}

// The lobe's response to the environment, for unit tint, is the integral of radiance, BSDF and cosine. How it is found depends
// on the environment mode, which no macro of MaterialX's tells. But a file is emitted once, and by now that of the mode has
// been: here the FIS mode's is empty in the FIS mode, and elsewhere the text of two functions. Where it is text, its second
// function's name ends the argument list of KEEP_FIRST and starts one of KEEP_SECOND, so the text itself never remains.
#define RETRO_REFLECTIVE_IF_EMPTY(text, first, second) RETRO_REFLECTIVE_KEEP_FIRST(text, first, second)
#define RETRO_REFLECTIVE_KEEP_FIRST(text, first, second) first
#define RETRO_REFLECTIVE_KEEP_SECOND(text, first, second) second
#define RETRO_REFLECTIVE_OPEN (
#define mx_environment_irradiance , , ) RETRO_REFLECTIVE_KEEP_SECOND RETRO_REFLECTIVE_OPEN
RETRO_REFLECTIVE_IF_EMPTY(
#include "libraries/pbrlib/genglsl/lib/mx_environment_fis.glsl"
,
#include "mx_retro_reflective_environment_fis.glsl"
,
#include "mx_retro_reflective_environment_lookup.glsl"
)
#undef mx_environment_irradiance
