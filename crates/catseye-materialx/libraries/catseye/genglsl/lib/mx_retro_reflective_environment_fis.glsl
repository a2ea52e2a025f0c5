// Filtered importance sampling of the lobe itself: docs/theory.md, section 3.
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
