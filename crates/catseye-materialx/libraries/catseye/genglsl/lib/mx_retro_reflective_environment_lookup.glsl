// Outside the FIS mode: a look-up in a prefiltered map, nothing in the none mode, and what hosts with a mode of their own make
// of `mx_environment_radiance`, which they all define. A microfacet lobe whose normal is the view direction is a lobe around
// the view direction; its widths are chosen so that half the energy lies in the same ellipse: 1 - 2^(-m^2) for both.
vec3 mx_retro_reflective_environment(vec3 V, vec3 X, vec3 Y, vec3 N, vec3 wo, vec2 widths, float albedo)
{
    RetroReflectiveEllipse ellipse = mx_retro_reflective_ellipse(wo, widths);
    vec2 alpha = clamp(sqrt(vec2(1.0) - exp2(-ellipse.widths * ellipse.widths)), 1e-3, 1.0);

    // The direction away from the normal, in the plane perpendicular to V.
    float sin_theta = sqrt(dot(wo.xy, wo.xy));
    vec3 away = (sin_theta > 1e-4) ? normalize(wo.z * V - N) : X;
    vec3 around = cross(V, away);
    vec3 axis = mx_cos(ellipse.angle) * away + mx_sin(ellipse.angle) * around;

    // The horizon moves the lobe's mean direction towards the normal, by about 4 m^2 sin(theta) cos(theta).
    vec3 mean = normalize(V + 4.0 * widths.x * widths.y * wo.z * N);

    FresnelData fd = mx_init_fresnel_schlick(vec3(1.0), vec3(1.0), vec3(1.0), 5.0, 0.0, 1.0);
    vec3 Li = mx_environment_radiance(mean, mean, axis, alpha, 0, fd);
    return albedo * Li / mx_ggx_dir_albedo(1.0, mx_average_alpha(alpha), 1.0, 1.0);
}
