// SPDX-License-Identifier: Apache-2.0
// Alpha MASK, by the point of a facet: where the base colour texture's alpha is below the cutoff nothing is there. Only
// compiled where a scene has such surfaces (ALPHA_MASK).
#ifndef FACETS
layout(binding = UNIT_FACETS) uniform samplerBuffer facet_texels;
#endif
layout(binding = UNIT_MATERIALS) uniform samplerBuffer material_texels;
layout(std430, binding = BINDING_TEXELS) readonly buffer TexelBuffer { uint texels[]; };

/// The texel at a coordinate; the same choice as texture_mean() makes for patches.
int texel_at(float coordinate, int size, bool repeat) {
    float wrapped = repeat ? fract(coordinate) : clamp(coordinate, 0.0, 1.0);
    return clamp(int(wrapped * float(size)), 0, size - 1);
}

/// Whether there is any surface of a facet at a point of it.
bool covered(uint facet, vec2 mesh_uv) {
    int material = 5 * int(floatBitsToUint(texelFetch(facet_texels, int(4u * facet + 3u)).w));
    float cutoff = texelFetch(material_texels, material).w;
    uvec4 info = floatBitsToUint(texelFetch(material_texels, material + 4));
    if (cutoff <= 0.0 || info.y == 0u) {
        return true;
    }
    vec3 mesh = vec3(mesh_uv, 1.0);
    int column = texel_at(dot(texelFetch(material_texels, material + 2).xyz, mesh), int(info.y), (info.w & 1u) != 0u);
    int row = texel_at(dot(texelFetch(material_texels, material + 3).xyz, mesh), int(info.z), (info.w & 2u) != 0u);
    return unpackUnorm4x8(texels[info.x + uint(row) * info.y + uint(column)]).a >= cutoff;
}
