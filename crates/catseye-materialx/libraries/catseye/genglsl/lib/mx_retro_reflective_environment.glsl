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

// The lobe's response to the environment, for unit tint: the integral of radiance, BSDF and cosine. `albedo` is that of the
// lobe along wo.
#ifdef CATSEYE_RETRO_REFLECTIVE_FIS

// Filtered importance sampling of the lobe itself, in the modes that have an environment map: theory.md, section 3.
// http://cgg.mff.cuni.cz/~jaroslav/papers/2008-egsr-fis/2008-egsr-fis-final-embedded.pdf
vec3 mx_retro_reflective_environment(vec3 V, vec3 X, vec3 Y, vec3 N, vec3 wo, vec2 widths, float albedo)
{
    float norm = 0.5 * M_PI_INV / (widths.x * widths.y);
    vec3 radiance = vec3(0.0);
    for (int i = 0; i < $envRadianceSamples; i++)
    {
        // The disk offset d, with |d|^2 = 1 - (1 - u)^(1/(n+1)) and 1/(n+1) = |e|^2 along the azimuth.
        vec2 Xi = mx_spherical_fibonacci(i, $envRadianceSamples);
        vec2 e = widths * vec2(mx_cos(2.0 * M_PI * Xi.y), mx_sin(2.0 * M_PI * Xi.y));
        float m2 = dot(e, e);
        float power = m2 * log(1.0 - Xi.x);
        float d2 = (power > -0.01) ? -power * (1.0 + power * (0.5 + power / 6.0)) : 1.0 - exp(power);
        vec2 d = e * sqrt(d2 / m2);

        // wi = 2 (o.h) / (h.h) h - o with h = (o_xy + d, z_o).
        vec3 h = vec3(wo.xy + d, wo.z);
        float a = dot(wo.xy, d);
        vec3 wi = 2.0 * (1.0 + a) / dot(h, h) * h - wo;
        float z_i = wo.z * (1.0 - d2) / dot(h, h);
        float ratio = min(z_i / wo.z, 1.0);

        vec3 Lw = normalize(X * wi.x + Y * wi.y + N * z_i);
        float pdf = norm * (1.0 - Xi.x) * wo.z / (max(z_i, 1e-6) * (wo.z + z_i));
        float lod = mx_latlong_compute_lod(Lw, pdf, float($envRadianceMips - 1), $envRadianceSamples);
        radiance += ratio * ratio * ratio * mx_latlong_map_lookup(Lw, $envMatrix, lod, $envRadiance);
    }
    return radiance * ($envLightIntensity / float(max($envRadianceSamples, 1)));
}

#else

// `mx_environment_radiance` is the one thing that every environment mode, and every host with a mode of its own, defines:
// filtered importance sampling, a look-up in a prefiltered map, or nothing. A microfacet lobe whose normal is the view
// direction is a lobe around the view direction; its widths are chosen so that half the energy lies in the same ellipse:
// 1 - 2^(-m^2) for both.
vec3 mx_retro_reflective_environment(vec3 V, vec3 X, vec3 Y, vec3 N, vec3 wo, vec2 widths, float albedo)
{
    RetroReflectiveEllipse ellipse = mx_retro_reflective_ellipse(wo, widths);
    vec2 alpha = clamp(sqrt(vec2(1.0) - exp2(-ellipse.widths * ellipse.widths)), 1e-3, 1.0);

    // The direction away from the normal, in the plane perpendicular to V.
    float sin_theta = sqrt(dot(wo.xy, wo.xy));
    vec3 away = (sin_theta > 1e-4) ? normalize(wo.z * V - N) : X;
    vec3 around = cross(V, away);
    vec3 axis = mx_cos(ellipse.angle) * away + mx_sin(ellipse.angle) * around;

    FresnelData fd = mx_init_fresnel_schlick(vec3(1.0), vec3(1.0), vec3(1.0), 5.0, 0.0, 1.0);
    vec3 Li = mx_environment_radiance(V, V, axis, alpha, 0, fd);
    return albedo * Li / mx_ggx_dir_albedo(1.0, mx_average_alpha(alpha), 1.0, 1.0);
}

#endif
