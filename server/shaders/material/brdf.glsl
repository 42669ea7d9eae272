// SPDX-License-Identifier: Apache-2.0
// Reflectance of surfaces, as in scene/material/brdf.h and scene/material/reflectance_table.h, which say what is what.
// MAX_PHONG, CLEAR_COAT and COATS (smooth ones, and polished surfaces) are defined where the scene has such a material;
// else their code is not compiled.

// Records of all materials (Reflectance), then rows of REFLECTANCE_NODES texels from grazing to normal
// incidence: scale, bias, transmission, importance.
layout(binding = UNIT_REFLECTANCE) uniform samplerBuffer reflectance_texels;

const float brdf_inverse_pi = 0.31830988618379067;
const float brdf_min_cosine = 1e-6;

struct Brdf {
    vec3 lambert;
    vec3 f0;
    float f90;
    float width;         // alpha; max-Phong: exponent
    float inverse_mean;  // 1 / mean transmission
    float grazing;       // scale q of the nodes
    int first_node;
    int kind;            // LOBE_*
#ifdef CLEAR_COAT
    int coat;            // first of REFLECTANCE_NODES texels of its coat: what passes, alpha, strength, factor; 0: none
#endif
};

/// Record of a material at a pixel: the place in its grid comes with the packed albedo.
uint reflectance_record(uint material, uint packed_albedo) {
#ifdef REFLECTANCE_TEXTURED
    if (int(texelFetch(reflectance_texels, 3 * int(material) + 2).z) == LOBE_TEXTURED) {
        return uint(texelFetch(reflectance_texels, 3 * int(material)).x) + (packed_albedo >> 24);
    }
#endif
    return material;
}

/// The BRDF of a record where its base colour (factor times texture, linear) is known.
Brdf make_brdf(uint record, vec3 base_colour) {
    int at = 3 * int(record);
    vec4 f0 = texelFetch(reflectance_texels, at);
    vec4 lobe = texelFetch(reflectance_texels, at + 1);
    vec4 table = texelFetch(reflectance_texels, at + 2);
    vec3 colour = clamp(base_colour, 0.0, MAX_ALBEDO);
    Brdf b;
    b.lambert = lobe.z * colour;
    b.f0 = lobe.y < 0.0 ? vec3(0.0) : f0.rgb + f0.w * colour;
    b.width = lobe.x;
    b.f90 = max(lobe.y, 0.0);
    b.inverse_mean = lobe.w;
    b.grazing = table.x;
    b.first_node = int(table.y);
    b.kind = int(table.z);
#ifdef CLEAR_COAT
    b.coat = 0;
    if (b.kind == LOBE_COATED) {
        b.kind = LOBE_GGX;
        b.coat = int(table.x);
        b.grazing = b.width / (1.0 + 3.0 * b.width);  // grazing_scale() of scene/material/reflectance_nodes.h
    }
#endif
#ifdef MAX_PHONG
    if (b.kind == LOBE_MAX_PHONG) {
        vec3 scale = min(vec3(1.0), MAX_ALBEDO / max(b.lambert + b.f0, 1e-6));
        b.lambert *= scale;
        b.f0 *= scale;
    }
#endif
    return b;
}

/// Position of an angle among the nodes: node_of_cosine() of scene/material/reflectance_nodes.h.
float brdf_node(float grazing, float cosine) {
    float c = clamp(cosine, 0.0, 1.0);
    float shadowing = c * (1.0 + grazing) / (c + grazing);
    float fresnel = c * (2.0 - c);
    float normal = 1.0 - sqrt(1.0 - c);
    return (0.3 * shadowing + 0.2 * fresnel + 0.5 * normal) * float(REFLECTANCE_NODES - 1);
}

#ifdef CLEAR_COAT
/// Share of the light from an angle that the coat lets pass; its alpha, strength and factor.
vec4 coat_at(int coat, float cosine) {
    float alpha = texelFetch(reflectance_texels, coat).y;
    float node = brdf_node(alpha / (1.0 + 3.0 * alpha), cosine);
    int first = min(int(node), REFLECTANCE_NODES - 2);
    vec4 low = texelFetch(reflectance_texels, coat + first);
    low.x = mix(low.x, texelFetch(reflectance_texels, coat + first + 1).x, node - float(first));
    return low;
}
#endif

/// Scale, bias, transmission and importance S at an angle. A clear coat's own reflection is in the bias.
vec4 brdf_at(Brdf b, float cosine) {
    float node = brdf_node(b.grazing, cosine);
    int first = min(int(node), REFLECTANCE_NODES - 2);
    vec4 low = texelFetch(reflectance_texels, b.first_node + first);
    vec4 high = texelFetch(reflectance_texels, b.first_node + first + 1);
    vec4 at = mix(low, high, node - float(first));
#ifdef CLEAR_COAT
    if (b.coat != 0) {
        vec4 coat = coat_at(b.coat, cosine);
        at.z *= coat.x;
        at.y += coat.z / coat.w * (1.0 - coat.x) / max(b.f90, 1e-30);
    }
#endif
    return at;
}

/// Directional albedo; at = brdf_at() of the angle.
vec3 brdf_albedo(Brdf b, vec4 at) { return b.lambert * at.z + b.f0 * at.x + b.f90 * at.y; }

/// D V of a GGX lobe (height-correlated Smith), and Schlick's p.
vec2 brdf_ggx(float alpha, vec3 normal, vec3 sum, float cos_in, float cos_out) {
    float clamped_in = max(cos_in, brdf_min_cosine);
    float clamped_out = max(cos_out, brdf_min_cosine);
    vec3 across = sum - (cos_in + cos_out) * normal;
    float along = clamped_in + clamped_out;
    float sine2 = dot(across, across);
    float length2 = sine2 + along * along;  // of the half vector: 2 v.h
    float a2 = alpha * alpha;
    float spread = (sine2 + a2 * along * along) / length2;
    float smith = clamped_in * sqrt(a2 + (1.0 - a2) * clamped_out * clamped_out) +
                  clamped_out * sqrt(a2 + (1.0 - a2) * clamped_in * clamped_in);
    float grazing = max(0.0, 1.0 - 0.5 * sqrt(length2));
    float grazing2 = grazing * grazing;
    return vec2(0.5 * brdf_inverse_pi * a2 / (spread * spread * smith), grazing2 * grazing2 * grazing);
}

/// f_r, 1/sr; 0 where a direction is not above the horizon. Unit vectors away from the surface.
/// passed: product of the transmissions, brdf_at().z, at both angles.
vec3 brdf_value(Brdf b, vec3 normal, vec3 w_in, vec3 w_out, float passed) {
    float cos_in = dot(normal, w_in);
    float cos_out = dot(normal, w_out);
    vec3 sum = w_in + w_out;
    vec3 lambert = b.lambert * (passed * b.inverse_mean * brdf_inverse_pi);
    vec3 value = lambert;
    if (b.kind == LOBE_GGX) {
        vec2 lobe = brdf_ggx(b.width, normal, sum, cos_in, cos_out);
        vec3 reflected = mix(b.f0, vec3(b.f90), lobe.y) * lobe.x;
#ifdef CLEAR_COAT
        if (b.coat != 0) {
            vec4 coat = coat_at(b.coat, cos_in);
            reflected *= min(coat.x, coat_at(b.coat, cos_out).x);
            vec2 top = brdf_ggx(coat.y, normal, sum, cos_in, cos_out);
            reflected += coat.z * mix(0.04, 1.0, top.y) * top.x;
        }
#endif
        value += reflected;
    }
#ifdef MAX_PHONG
    if (b.kind == LOBE_MAX_PHONG) {
        vec3 apart = 2.0 * cos_in * normal - sum;  // from w_out to the mirrored w_in
        float cosine = max(1.0 - 0.5 * dot(apart, apart), 0.0);
        value += b.f0 * (pow(cosine, b.width) * (b.width + 2.0) * 0.5 * brdf_inverse_pi /
                         max(max(cos_in, cos_out), brdf_min_cosine));
    }
#endif
    return cos_in > 0.0 && cos_out > 0.0 ? value : vec3(0.0);
}

#ifdef COATS
/// What a smooth coat or a polished surface reflects, 1/sr, and view rays show instead of f_r: for lights without
/// extent, which no view ray meets, but for those that stand for the sun. b: of that record.
vec3 traced_value(Brdf b, uint record, vec3 normal, vec3 w_in, vec3 w_out) {
    float cos_in = dot(normal, w_in);
    float cos_out = dot(normal, w_out);
    vec3 sum = w_in + w_out;
    vec3 value = vec3(0.0);
    vec4 lobe = texelFetch(reflectance_texels, 3 * int(record) + 1);
    if (lobe.y < 0.0) {
        vec4 f0 = texelFetch(reflectance_texels, 3 * int(record));
        vec3 coloured = f0.rgb + f0.w * b.lambert / max(lobe.z, 1e-4);
        vec2 polish = brdf_ggx(b.width, normal, sum, cos_in, cos_out);
        value = mix(coloured, vec3(-lobe.y), polish.y) * polish.x;
    }
#ifdef CLEAR_COAT
    if (b.coat != 0) {
        vec4 coat = coat_at(b.coat, cos_in);
        value *= min(coat.x, coat_at(b.coat, cos_out).x);
        vec2 top = brdf_ggx(coat.y, normal, sum, cos_in, cos_out);
        value += coat.z > 0.0 ? vec3(0.0) : vec3(coat.w * mix(0.04, 1.0, top.y) * top.x);
    }
#endif
    return cos_in > 0.0 && cos_out > 0.0 ? value : vec3(0.0);
}
#endif

/// df_r = f_r - a(w_in)/pi; in, out = brdf_at() of the angles.
vec3 brdf_difference(Brdf b, vec3 normal, vec3 w_in, vec3 w_out, vec4 at_in, vec4 at_out) {
    return brdf_value(b, normal, w_in, w_out, at_in.z * at_out.z) - brdf_albedo(b, at_in) * brdf_inverse_pi;
}
