// SPDX-License-Identifier: Apache-2.0
// Textures of a material besides its base colour, at a pixel: metalness and roughness as a place in the
// material's grid (scene/material/reflectance_grid.h), and normal maps (scene/material/normal_map.h).
layout(binding = UNIT_MATERIAL_DETAILS) uniform samplerBuffer details_texels;

#ifdef TEXTURED
vec4 details_of(uint material, int row) { return texelFetch(details_texels, MATERIAL_DETAILS_TEXELS * int(material) + row); }

/// Bilinear, of a texture that holds numbers and no colours. row: of its use in MaterialDetails.
vec3 texture_data(uint material, int row, uvec4 info, vec2 mesh_uv) {
    vec3 mesh = vec3(mesh_uv, 1.0);
    vec2 uv = vec2(dot(details_of(material, row).xyz, mesh), dot(details_of(material, row + 1).xyz, mesh));
    vec2 at = uv * vec2(info.yz) - 0.5;
    ivec2 corner = ivec2(floor(at));
    vec2 f = at - vec2(corner);
    vec3 top = mix(texel_data(info, corner), texel_data(info, corner + ivec2(1, 0)), f.x);
    vec3 bottom = mix(texel_data(info, corner + ivec2(0, 1)), texel_data(info, corner + ivec2(1, 1)), f.x);
    return mix(top, bottom, f.y);
}
#endif

#ifdef REFLECTANCE_TEXTURED
/// Place in the material's grid, 0 where it has none.
uint reflectance_place(uint material, vec2 mesh_uv) {
    uvec4 levels = floatBitsToUint(details_of(material, 2));
    if (levels.x == 0u) {
        return 0u;
    }
    vec2 factors = details_of(material, 0).xy;
    vec4 grid = details_of(material, 1);
    vec3 texel = texture_data(material, 3, floatBitsToUint(details_of(material, 5)), mesh_uv);
    float roughness = clamp(factors.y * texel.g, MIN_ROUGHNESS, 1.0);
    vec2 place = floor(vec2(log(roughness) - grid.x, factors.x * texel.b - grid.z) * grid.yw + 0.5);
    uvec2 at = uvec2(clamp(place, vec2(0.0), vec2(levels.xy - 1u)));
    return at.x * levels.y + at.y;
}
#endif

#ifdef NORMAL_MAPS
/// Normal after the material's map. shaded: before it, on the side that is seen; e1, e2 and uv1, uv2: edges of the
/// triangle from corner 0 to 1 and 2, and what mesh uv change along them; to_eye: unit.
vec3 mapped_normal(uint material, vec2 mesh_uv, vec2 uv1, vec2 uv2, vec3 e1, vec3 e2, vec3 shaded, bool back, vec3 to_eye) {
    uvec4 info = floatBitsToUint(details_of(material, 8));
    if (info.y == 0u) {
        return shaded;
    }
    mat2 turned = transpose(mat2(details_of(material, 6).xy, details_of(material, 7).xy));
    uv1 = turned * uv1;
    uv2 = turned * uv2;
    float mirrored = uv1.x * uv2.y - uv1.y * uv2.x;
    float side = mirrored < 0.0 ? -1.0 : 1.0;
    vec3 normal = back ? -shaded : shaded;
    vec3 along_u = side * (e1 * uv2.y - e2 * uv1.y);
    vec3 along_v = side * (e2 * uv1.x - e1 * uv2.x);
    vec3 x = along_u - dot(along_u, normal) * normal;
    float size = length(x);
    if (mirrored != 0.0 && size > 0.0) {
        vec3 tangent = x / size;
        vec3 bitangent = cross(normal, tangent);
        bitangent = dot(bitangent, along_v) > 0.0 ? -bitangent : bitangent;
        vec3 local = texture_data(material, 6, info, mesh_uv) * 2.0 - 1.0;
        local.xy *= details_of(material, 0).z;
        shaded = normalize(local.x * tangent + local.y * bitangent + max(local.z, LEAST_MAP_HEIGHT) * normal);
        shaded = back ? -shaded : shaded;
    }
    // Turned back towards the viewer where it faces away.
    float cosine = dot(shaded, to_eye);
    if (cosine >= LEAST_VIEW_COSINE) {
        return shaded;
    }
    vec3 across = shaded - cosine * to_eye;
    return LEAST_VIEW_COSINE * to_eye + sqrt(1.0 - LEAST_VIEW_COSINE * LEAST_VIEW_COSINE) * across / max(length(across), 1e-20);
}
#endif
