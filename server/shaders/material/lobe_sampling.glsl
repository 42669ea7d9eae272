// SPDX-License-Identifier: Apache-2.0
// Directions drawn from the narrow GGX lobes of a BRDF, by visible normals (Heitz 2018), as scene/material/brdf_sampling.cpp.
// Requires brdf.glsl.

/// Alphas of the lobes that are drawn from: of the base and of a clear coat; 0: too wide, or there is none.
vec2 drawn_lobes(Brdf b) {
    vec2 alphas = vec2(b.kind == LOBE_GGX && b.f90 > 0.0 ? b.width : 0.0, 0.0);
#ifdef CLEAR_COAT
    if (b.coat != 0) {
        vec4 coat = texelFetch(reflectance_texels, b.coat);
        alphas.y = coat.z > 0.0 ? coat.y : 0.0;
    }
#endif
    return vec2(alphas.x <= DRAWN_ALPHA ? alphas.x : 0.0, alphas.y <= DRAWN_ALPHA ? alphas.y : 0.0);
}

/// Density of the mirrored visible normals, 1/sr.
float ggx_density(float alpha, vec3 normal, vec3 w_in, vec3 w_out) {
    float a2 = alpha * alpha;
    vec3 half_vector = w_in + w_out;
    float length2 = dot(half_vector, half_vector);
    float height = dot(normal, half_vector);
    vec3 across = half_vector - height * normal;
    float spread = (dot(across, across) + a2 * height * height) / max(length2, 1e-30);
    float cos_out = dot(normal, w_out);
    float smith = cos_out + sqrt(a2 + (1.0 - a2) * cos_out * cos_out);
    return height > 0.0 && alpha > 0.0 ? a2 * brdf_inverse_pi / (spread * spread * 2.0 * smith) : 0.0;
}

/// Density of drawn_direction(), 1/sr.
float drawn_density(vec2 lobes, vec3 normal, vec3 w_in, vec3 w_out) {
    float sum = ggx_density(lobes.x, normal, w_in, w_out) + ggx_density(lobes.y, normal, w_in, w_out);
    return lobes.x > 0.0 && lobes.y > 0.0 ? 0.5 * sum : sum;
}

/// A direction out of one of the lobes, each as likely. u: in [0, 1).
vec3 drawn_direction(vec2 lobes, vec3 normal, vec3 w_out, vec2 u) {
    float alpha = max(lobes.x, lobes.y);
    if (lobes.x > 0.0 && lobes.y > 0.0) {
        alpha = u.x < 0.5 ? lobes.x : lobes.y;
        u.x = fract(2.0 * u.x);
    }
    vec3 t = normalize(abs(normal.x) > 0.7 ? vec3(-normal.y, normal.x, 0.0) : vec3(0.0, -normal.z, normal.y));
    vec3 s = cross(normal, t);
    vec3 local = vec3(dot(t, w_out), dot(s, w_out), dot(normal, w_out));
    vec3 view_stretched = normalize(vec3(alpha * local.xy, local.z));
    float across2 = dot(view_stretched.xy, view_stretched.xy);
    vec3 t1 = across2 > 0.0 ? vec3(-view_stretched.y, view_stretched.x, 0.0) * inversesqrt(across2) : vec3(1.0, 0.0, 0.0);
    vec3 t2 = cross(view_stretched, t1);
    float radius = sqrt(u.x);
    float phi = 6.28318530718 * u.y;
    float p1 = radius * cos(phi);
    float p2 = radius * sin(phi);
    float share = 0.5 * (1.0 + view_stretched.z);
    p2 = mix(sqrt(max(1.0 - p1 * p1, 0.0)), p2, share);
    vec3 n = p1 * t1 + p2 * t2 + sqrt(max(1.0 - p1 * p1 - p2 * p2, 0.0)) * view_stretched;
    vec3 h = normalize(vec3(alpha * n.xy, max(n.z, 0.0)));
    vec3 mirrored = 2.0 * dot(local, h) * h - local;
    return normalize(mirrored.x * t + mirrored.y * s + mirrored.z * normal);
}

/// The lobes alone that are drawn from.
Brdf drawn_part(Brdf b, vec2 lobes) {
    b.lambert = vec3(0.0);
    b.f0 = lobes.x > 0.0 ? b.f0 : vec3(0.0);
    b.f90 = lobes.x > 0.0 ? b.f90 : 0.0;
    return b;
}

/// Share of the light from everywhere alike that they reflect at an angle; part: drawn_part().
vec3 drawn_albedo(Brdf part, vec2 lobes, float cosine) {
    vec3 albedo = brdf_albedo(part, brdf_at(part, cosine));
#ifdef CLEAR_COAT
    if (lobes.x <= 0.0 && part.coat != 0) {
        vec4 coat = coat_at(part.coat, cosine);
        albedo = vec3(coat.z / max(coat.w, 1e-6) * (1.0 - coat.x));
    }
#endif
    return albedo;
}
