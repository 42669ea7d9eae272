// SPDX-License-Identifier: Apache-2.0
// Radiance of glossy patches by the random representation of ch. 7.2, repaired (reflectance_table.h):
//   L(y, w_out) = L_e + L_d + C I_m df_r(w_m, w_out) / s_m,
// with the main part L_e + L_d in BINDING_RADIANCE, the rest here. The sign travels with I_m.
// Instead of the direction w_m of the accepted light its source is kept: a point, or one infinitely far
// away. So w_m is exact at every point y of the patch, and the mesh does not blur reflections.
#include "octahedral.glsl"
#include "brdf.glsl"
#include "mesh.glsl"
#include "reflectors.glsl"

/// PackedGloss.
layout(binding = UNIT_GLOSS) uniform usamplerBuffer gloss_texels;

/// BRDF of a glossy patch.
Brdf patch_brdf(uint patch_id) {
    uvec4 reflector = texelFetch(reflector_texels, int(patch_id));
    return make_brdf(reflector.w, uintBitsToFloat(reflector.rgb));
}

/// Where accepted light comes from, seen from the patch's centroid.
struct LightSource {
    vec3 direction;          // unit, world space
    float inverse_distance;  // 1/m; 0: infinitely far away
};

LightSource source_at(vec3 point, vec3 middle) {
    vec3 offset = point - middle;
    float inverse = inversesqrt(max(dot(offset, offset), 1e-30));
    return LightSource(offset * inverse, inverse);
}

/// Direction from a point of the patch to the source.
vec3 direction_to(LightSource source, vec3 middle, vec3 point) {
    return normalize(source.direction + (middle - point) * source.inverse_distance);
}

/// In the GPU's arrays: x: C I_m / s_m by its largest component, snorm 10 bits each; y: that component
/// (radiance units, float bits); z: direction of the source, octahedral snorm 2x16; w: its inverse distance.
uvec4 pack_gloss(vec3 scale, LightSource source) {
    vec3 magnitude = abs(scale);
    float largest = max(magnitude.r, max(magnitude.g, magnitude.b));
    ivec3 share = largest > 0.0 ? ivec3(round(scale / largest * 511.0)) : ivec3(0);
    uvec3 bits = uvec3(share) & 1023u;
    return uvec4(bits.r | bits.g << 10 | bits.b << 20, floatBitsToUint(largest),
                 packSnorm2x16(octahedral_from_vector(source.direction)), floatBitsToUint(source.inverse_distance));
}

/// C I_m / s_m, radiance units.
vec3 gloss_scale(uvec4 packed_gloss) {
    int bits = int(packed_gloss.x);
    ivec3 share = ivec3(bits << 22, bits << 12, bits << 2) >> 22;  // sign-extended
    return vec3(share) * (uintBitsToFloat(packed_gloss.y) / 511.0);
}

LightSource gloss_source(uvec4 packed_gloss) {
    return LightSource(vector_from_octahedral(unpackSnorm2x16(packed_gloss.z)), uintBitsToFloat(packed_gloss.w));
}

vec3 centroid_of(uvec3 triangle, uint vertex_base) {
    uvec3 t = triangle + vertex_base;
    return (world_position(t.x) + world_position(t.y) + world_position(t.z)) / 3.0;
}

/// The glossy part of a patch at a point, made ready for several outgoing directions.
struct Gloss {
    vec3 scale;  // C I_m / s_m
    vec3 w_in;
    vec4 at_in;
    Brdf brdf;
};

/// C I_m df_r(w_m, w_out) / s_m, radiance units.
vec3 difference_radiance(Gloss g, vec3 normal, vec3 w_out) {
    vec4 at_out = brdf_at(g.brdf, dot(normal, w_out));
    return g.scale * brdf_difference(g.brdf, normal, g.w_in, w_out, g.at_in, at_out);
}
