// T_1 to T_4 at 2 x - 1.
vec4 mx_retro_reflective_chebyshev(float x)
{
    float t1 = 2.0 * x - 1.0;
    float t2 = 2.0 * t1 * t1 - 1.0;
    float t3 = 2.0 * t1 * t2 - t1;
    return vec4(t1, t2, t3, 2.0 * t1 * t3 - t2);
}

RetroReflectiveAlbedo mx_retro_reflective_albedo_init(vec2 widths)
{
    RetroReflectiveAlbedo albedo;
    float m = max(widths.x, widths.y);
    float k = min(widths.x, widths.y) / m;
    albedo.p0 = vec4(0.0);
    albedo.p0_p1 = vec4(0.0);
    albedo.p2 = 0.0;
    vec4 t_m = mx_retro_reflective_chebyshev(m);
    if (widths.x == widths.y)
    {
        mx_retro_reflective_contract_isotropic(t_m, m, albedo);
    }
    else
    {
        mx_retro_reflective_contract(t_m, mx_retro_reflective_chebyshev(k), m, albedo);
    }
    albedo.ratio = k;
    albedo.u_wider = widths.x > widths.y;
    albedo.e = albedo.u_wider ? vec2(1.0, k * k) : vec2(k * k, 1.0);
    albedo.e_0 = RETRO_REFLECTIVE_ALBEDO_KAPPA * m * m * (1.0 + k * k);
    albedo.w = albedo.u_wider ? vec2(0.0, 1.0 - k * k) : vec2(1.0 - k * k, 0.0);
    return albedo;
}

// 1 - rho for a direction of which the squares of the tangential components are given.
float mx_retro_reflective_loss(RetroReflectiveAlbedo albedo, float x2, float y2)
{
    float e = sqrt(albedo.e.x * x2 + albedo.e.y * y2 + albedo.e_0) - 0.6;
    float w = albedo.w.x * x2 + albedo.w.y * y2;
    vec4 a = albedo.p0;
    vec4 b = albedo.p0_p1;
    float p0 = a.x + e * (a.y + e * (a.z + e * (a.w + e * b.x)));
    float p1 = b.y + e * (b.z + e * b.w);
    return clamp(p0 + w * (p1 + w * albedo.p2), 0.0, 1.0);
}

// The integral of loss s ds, s being the sine, along a ray of constant azimuth given by its squared cosine from the
// x axis. In t, which runs with e from 0 to 1, it is a polynomial of degree 5: three Gauss points are exact.
float mx_retro_reflective_energy(RetroReflectiveAlbedo albedo, float cos2)
{
    float b = albedo.e.x * cos2 + albedo.e.y * (1.0 - cos2);
    float first = sqrt(albedo.e_0);
    float inv_sum = 1.0 / (first + sqrt(b + albedo.e_0));
    float start = first * inv_sum;
    float range = b * inv_sum * inv_sum;
    float energy = 0.0;
    for (int i = -1; i <= 1; i++)
    {
        float t = 0.5 + 0.38729833462 * float(i);
        float s2 = t * (2.0 * start + range * t);
        float gauss = (i == 0) ? 4.0 / 9.0 : 5.0 / 18.0;
        energy += gauss * (start + range * t) * mx_retro_reflective_loss(albedo, s2 * cos2, s2 * (1.0 - cos2));
    }
    return energy;
}

// 1 - rho_avg, the cosine-weighted average over the hemisphere.
float mx_retro_reflective_average_loss(RetroReflectiveAlbedo albedo)
{
    if (albedo.ratio == 1.0)
    {
        return 2.0 * mx_retro_reflective_energy(albedo, 0.5);
    }
    // The azimuth from the wider axis is pi/2 (1 - (1 - t)^2): the nodes crowd towards the narrower one, where the
    // loss has a bend.
    const int NODES = 6;
    float average = 0.0;
    for (int i = 0; i < NODES; i++)
    {
        float rest = 1.0 - (float(i) + 0.5) / float(NODES);
        float c = mx_cos(0.5 * M_PI * (1.0 - rest * rest));
        float cos2 = albedo.u_wider ? c * c : 1.0 - c * c;
        average += rest * mx_retro_reflective_energy(albedo, cos2);
    }
    return average * 4.0 / float(NODES);
}
