// SPDX-License-Identifier: Apache-2.0
// Geometry buffer of a viewer: surface point, normal and texture colour of every pixel, from the
// rasterised surface ids; specular surfaces get their base colour here and the rest in
// view_resolve_specular.comp. Accumulated irradiance follows its surface point from the picture before
// (reprojection by world position and patch); what was not visible there starts without weight. Variants: TEXTURED,
// DETAILS (material_details.glsl), VERTEX_COLOURS, SMOOTH (some vertex normals bend away from their planes), REPROJECT,
// MOVED (objects have just moved), CONTINUED (pixels behind mirrors and glass, see continued.glsl).
#include "layouts.glsl"
#include "rarely.glsl"
#ifdef SOFTWARE_RENDERER  // as pixels lie in memory: squares take a third longer
layout(local_size_x = 64, local_size_y = 1) in;
#else
layout(local_size_x = 8, local_size_y = 8) in;
#endif
#include "scene_geometry.glsl"
#include "facets.glsl"
#include "side_seen.glsl"
#include "mesh.glsl"
#include "sides.glsl"
#include "octahedral.glsl"
#include "pixel_albedo.glsl"
#include "pixel_sum.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
#include "view_place.glsl"
layout(binding = UNIT_SURFACE_IDS) uniform usampler2D surface_ids;
layout(binding = UNIT_MATERIALS) uniform samplerBuffer material_texels;
layout(std430, binding = BINDING_PIXELS) writeonly buffer PixelBuffer { uvec4 pixels[]; };
layout(std430, binding = BINDING_PIXEL_IRRADIANCE) writeonly buffer IrradianceBuffer {
    vec4 pixel_irradiance[];
};
#if defined(TEXTURED) || defined(SMOOTH) || defined(VERTEX_COLOURS)
layout(binding = UNIT_VERTEX_DATA) uniform usamplerBuffer vertex_data_texels;
#endif
#ifdef TEXTURED
layout(std430, binding = BINDING_TEXELS) readonly buffer TexelBuffer { uint texels[]; };
#endif
#ifdef SPECULAR
layout(binding = UNIT_REFLECTANCE) uniform samplerBuffer reflectance_texels;
layout(std430, binding = BINDING_SPECULAR_FLAGS) buffer SpecularFlagBuffer { uint listed[]; };
#define SPECULAR_GROUPS_ACCESS
#include "specular_groups.glsl"
#endif
#ifdef MIRRORS
#include "continued.glsl"
#endif
#ifdef SMOOTH
layout(std430, binding = BINDING_OBJECTS) readonly buffer ObjectBuffer { mat4 world_from_object[]; };
#endif
uniform uvec4 refreshed;        // pixels [x, z) x [y, w) that are made
uniform float common_weight;    // of all pixels, see pixel_sum.glsl
uniform float crease_distance;  // m, see receiving_point()
#ifdef REPROJECT
#include "reproject.glsl"
#endif

#ifdef TEXTURED
vec3 texel_data(uvec4 info, ivec2 at) {
    ivec2 size = ivec2(info.yz);
    at.x = (info.w & 1u) != 0u ? at.x - size.x * int(floor(float(at.x) / float(size.x))) : clamp(at.x, 0, size.x - 1);
    at.y = (info.w & 2u) != 0u ? at.y - size.y * int(floor(float(at.y) / float(size.y))) : clamp(at.y, 0, size.y - 1);
    return unpackUnorm4x8(texels[info.x + uint(at.y * size.x + at.x)]).rgb;
}

vec3 texel(uvec4 info, ivec2 at) {
    vec3 encoded = texel_data(info, at);
    return mix(encoded / 12.92, pow((encoded + 0.055) / 1.055, vec3(2.4)), step(0.04045, encoded));
}

/// The level of a texture whose texels are 2^level as wide: offset, width, height, flags.
uvec4 texture_level(uvec4 info, int level) {
    for (int l = 0; l < level && max(info.y, info.z) > 1u; ++l) {
        info.x += info.y * info.z;
        info.yz = max(info.yz >> 1u, uvec2(1u));
    }
    return info;
}

vec3 bilinear(uvec4 info, vec2 uv) {
    vec2 at = uv * vec2(info.yz) - 0.5;
    ivec2 corner = ivec2(floor(at));
    vec2 f = at - vec2(corner);
    vec3 top = mix(texel(info, corner), texel(info, corner + ivec2(1, 0)), f.x);
    vec3 bottom = mix(texel(info, corner + ivec2(0, 1)), texel(info, corner + ivec2(1, 1)), f.x);
    return mix(top, bottom, f.y);
}

/// Mean colour over what a pixel covers: along the longer side of its parallelogram in the texture some places of a
/// level whose texels are as wide as the shorter one (after J. McCormack et al. 1999, "Feline"). across, upwards:
/// sides of the pixel, mesh uv.
vec3 texture_colour(int material, uvec4 info, vec2 mesh_uv, vec2 across, vec2 upwards) {
    const float most_places = 8.0;
    const float most_texels = 65536.0;  // under one pixel; more is beside the horizon
    vec3 row0 = texelFetch(material_texels, material + 2).xyz;
    vec3 row1 = texelFetch(material_texels, material + 3).xyz;
    vec2 uv = vec2(dot(row0, vec3(mesh_uv, 1.0)), dot(row1, vec3(mesh_uv, 1.0)));
    vec2 u = vec2(dot(row0.xy, across), dot(row1.xy, across));
    vec2 v = vec2(dot(row0.xy, upwards), dot(row1.xy, upwards));
    vec2 size = vec2(info.yz);
    bool wide = dot(u * size, u * size) > dot(v * size, v * size);
    vec2 longer = wide ? u : v;
    float length_in_texels = length(longer * size);
    if (!(length_in_texels < most_texels)) {
        longer = vec2(0.0);
        length_in_texels = most_texels;
    }
    float width_in_texels = abs(u.x * v.y - u.y * v.x) * size.x * size.y / max(length_in_texels, 1e-9);
    float texel_width = clamp(max(width_in_texels, length_in_texels / most_places), 1.0, most_texels);
    uvec4 level = texture_level(info, int(log2(texel_width) + 0.5));
    float places = clamp(floor(length_in_texels / texel_width + 0.5), 1.0, most_places);
    vec3 sum = vec3(0.0);
    for (float k = 0.5; k < places; k += 1.0) {
        sum += bilinear(level, uv + (k / places - 0.5) * longer);
    }
    return sum / places;
}

vec2 vertex_uv(uint vertex) { return uintBitsToFloat(texelFetch(vertex_data_texels, int(2u * vertex)).zw); }
#endif

#ifdef DETAILS
#include "material_details.glsl"
#endif

#ifdef VERTEX_COLOURS
vec3 vertex_colour(uint vertex) {
    vec3 root = unpackUnorm4x8(texelFetch(vertex_data_texels, int(2u * vertex + 1u)).w).rgb;
    return root * root;
}
#endif

#ifdef SMOOTH
vec3 vertex_normal(uint vertex) {
    return vector_from_octahedral(uintBitsToFloat(texelFetch(vertex_data_texels, int(2u * vertex)).xy));
}

/// Interpolated vertex normal, world space, on the patch's side.
vec3 shading_normal(uvec3 triangle, vec3 weights, vec3 plane_normal, uint object) {
    vec3 n = weights.x * vertex_normal(triangle.x) + weights.y * vertex_normal(triangle.y) +
             weights.z * vertex_normal(triangle.z);
    mat3 m = mat3(world_from_object[object]);
    // Normals transform by the cofactor matrix (the inverse transpose times the determinant).
    n = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])) * n;
    n = dot(n, plane_normal) < 0.0 ? -n : n;
    return dot(n, n) > 0.0 ? normalize(n) : plane_normal;
}
#endif

#ifdef SPECULAR
/// Puts the pixel's group on the list of those with specular surfaces. Looking first saves most exchanges.
void note_specular(uint index, bool specular) {
    uint group = index / SPECULAR_GROUP;
    if (specular && listed[group] == 0u && atomicExchange(listed[group], 1u) == 0u) {
        groups[atomicAdd(group_count, 1u)] = group;
    }
}
#endif

/// Where the pixel receives bundles: its surface point, kept about a bundle pixel away from creases, since
/// a bundle's pixel next to a corner may show the other wall or miss the room altogether.
vec3 receiving_point(uint creases, vec3 weights, vec3 a, vec3 e1, vec3 e2) {
    float twice_area = length(cross(e1, e2));
    vec3 edges = vec3(length(e2 - e1), length(e2), length(e1));  // opposite to each vertex
    vec3 least = min(crease_distance * edges / max(twice_area, 1e-20), 0.3);
    vec3 flagged = vec3(creases & 1u, creases >> 1 & 1u, creases >> 2);
    weights = max(weights, least * flagged);
    weights /= weights.x + weights.y + weights.z;
    return a + weights.y * e1 + weights.z * e2;
}

/// Barycentric weights of a triangle's corners 1 and 2 where a ray meets its plane (Moeller, Trumbore 1997).
/// from_corner: from corner 0 to the eye.
vec2 plane_weights(vec3 direction, vec3 from_corner, vec3 e1, vec3 e2) {
    vec3 q = cross(direction, e2);
    float determinant = dot(e1, q);
    float inverse = abs(determinant) > 0.0 ? 1.0 / determinant : 0.0;
    return vec2(dot(from_corner, q), dot(direction, cross(from_corner, e1))) * inverse;
}

#if defined(MIRRORS) && !defined(CONTINUED)
/// Whether the strongest end of a specular pixel's view ray is a lamp or the sky: such a pixel counts for no error.
bool ends_at_light(uvec2 at) {
    uint surface = continued[continued_index(at, continued_entry(at), 0u)].surface;
    return surface == NO_HIT ||
           texelFetch(material_texels, 5 * int(facet_material(surface >> 1)) + 1).rgb != vec3(0.0);
}
#endif

void main() {
    uvec2 at = refreshed.xy + gl_GlobalInvocationID.xy;
    if (at.x >= refreshed.z || at.y >= refreshed.w) {
        return;
    }
    uint index = at.y * view.size.x + at.x;
    vec4 no_samples = vec4(0.0, 0.0, 0.0, -common_weight);
#ifdef CONTINUED
    uint surface = continued[index].surface;
    vec3 direction = -continued_towards(index);
    vec3 eye = continued[index].position - direction;
    if (surface == CONTINUED_NONE) {
        pixels[2u * index] = uvec4(0u, 0u, 0u, NO_PATCH);
        pixels[2u * index + 1u] = uvec4(0u, 0u, 0u, PIXEL_BACK);
        pixel_irradiance[index] = no_samples;
        return;
    }
#else
    uint surface = texelFetch(surface_ids, ivec2(at), 0).r;
    vec3 direction = view_direction(at, place_in_pixel(at));
    vec3 eye = view.eye.xyz;
#endif
    uint id = surface == NO_HIT ? NO_PATCH : side_seen(surface, eye, direction);
    if (id == NO_PATCH) {  // sky, or the back of a one-sided surface: black
        pixels[2u * index] = uvec4(0u, 0u, 0u, NO_PATCH);
        pixels[2u * index + 1u] = uvec4(0u, 0u, 0u, surface == NO_HIT ? PIXEL_SKY : surface >> 1 | PIXEL_BACK);
        pixel_irradiance[index] = no_samples;
        return;
    }
    uvec4 triangle = triangle_of(id);
    uint object = object_of_triangle(triangle.xyz);
    vec3 normal = side_normal(id);
    vec3 a = world_position(triangle.x);
    vec3 e1 = world_position(triangle.y) - a;
    vec3 e2 = world_position(triangle.z) - a;
    vec3 s = eye - a;
    vec2 met = plane_weights(direction, s, e1, e2);
    float v1 = clamp(met.x, 0.0, 1.0);
    float v2 = clamp(met.y, 0.0, 1.0 - v1);
    vec3 weights = vec3(1.0 - v1 - v2, v1, v2);
    vec3 position = a + v1 * e1 + v2 * e2;

    int material = 5 * int(triangle.w & MATERIAL_MASK);
    vec3 albedo = texelFetch(material_texels, material).rgb;
#ifdef TEXTURED
    uvec4 info = floatBitsToUint(texelFetch(material_texels, material + 4));
    vec2 mesh_uv = weights.x * vertex_uv(triangle.x) + weights.y * vertex_uv(triangle.y) + weights.z * vertex_uv(triangle.z);
    if (info.y != 0u) {
        vec2 across = vec2(0.0);
        vec2 upwards = vec2(0.0);
#ifndef CONTINUED  // whose pixels' ends have no size
        mat2 uv_from_weights = mat2(vertex_uv(triangle.y) - vertex_uv(triangle.x), vertex_uv(triangle.z) - vertex_uv(triangle.x));
        vec3 right = view.right.xyz * (2.0 / float(view.size.x));
        vec3 up = view.up.xyz * (2.0 / float(view.size.y));
        across = uv_from_weights * (plane_weights(direction + right, s, e1, e2) - met);
        upwards = uv_from_weights * (plane_weights(direction + up, s, e1, e2) - met);
#endif
        albedo *= texture_colour(material, info, mesh_uv, across, upwards);
    }
#endif
#ifdef VERTEX_COLOURS
    albedo *= weights.x * vertex_colour(triangle.x) + weights.y * vertex_colour(triangle.y) +
              weights.z * vertex_colour(triangle.z);
#endif
    vec3 shaded = normal;
#ifdef SMOOTH
    RARELY((triangle.w & TRIANGLE_SMOOTH) != 0u) {
        shaded = shading_normal(triangle.xyz, weights, normal, object);
    }
#endif
    uint flags = (surface & 1u) != 0u ? PIXEL_BACK : 0u;
    float place = 0.0;  // in the material's grid of reflectance
#ifdef NORMAL_MAPS
    vec2 uv0 = vertex_uv(triangle.x);
    shaded = mapped_normal(triangle.w & MATERIAL_MASK, mesh_uv, vertex_uv(triangle.y) - uv0, vertex_uv(triangle.z) - uv0,
                           e1, e2, shaded, (surface & 1u) != 0u, normalize(-direction));
#endif
#ifdef REFLECTANCE_TEXTURED
    place = float(reflectance_place(triangle.w & MATERIAL_MASK, mesh_uv)) / 255.0;
#endif
#ifdef UNLIT
    flags |= texelFetch(details_texels, MATERIAL_DETAILS_TEXELS * int(triangle.w & MATERIAL_MASK)).w > 0.0 ? PIXEL_UNLIT : 0u;
#endif
#ifdef SPECULAR
    vec4 lobe = texelFetch(reflectance_texels, 3 * int(triangle.w & MATERIAL_MASK) + 2);
    flags |= lobe.w > 0.0 ? PIXEL_GLOSSY : 0u;
    note_specular(index, int(lobe.z) != LOBE_NONE);
#endif
#if defined(MIRRORS) && !defined(CONTINUED)
    if (is_continued(at)) {
        flags |= PIXEL_CONTINUED | (ends_at_light(at) ? PIXEL_EMITTER : 0u);
    }
#endif
    bool emitter = texelFetch(material_texels, material + 1).rgb != vec3(0.0);
    pixels[2u * index] = uvec4(floatBitsToUint(receiving_point(triangle.w >> CREASE_SHIFT, weights, a, e1, e2)), id);
    pixels[2u * index + 1u] = uvec4(packSnorm2x16(octahedral_from_vector(shaded)),
                                    pack_albedo(albedo, place, index, 0u),
                                    packUnorm2x16(vec2(v1, v2)),
                                    surface >> 1 | (emitter ? PIXEL_EMITTER : 0u) | flags);
#ifdef CONSTANT_RADIANCE
    no_samples.rgb -= constant_share(packSnorm2x16(octahedral_from_vector(shaded)), surface >> 1) * view.constant.rgb;
#endif
#ifdef REPROJECT
#ifdef CONTINUED
    uint old_index = continued[index].old_index;
#else
    uint old_index = old_pixel(position_before(position, object, triangle.xyz, weights), normal, id, object);
#endif
    vec4 old_sum = vec4(0.0);
    RARELY(old_index != hidden) {
        old_sum = texelFetch(old_irradiance_texels, int(old_index));
#ifdef CONSTANT_RADIANCE
        uvec2 old_surface = texelFetch(old_pixel_texels, int(2u * old_index + 1u)).xw;
        old_sum.rgb += constant_share(old_surface.x, old_surface.y) * old_constant;
#endif
        old_sum = carried(old_sum, kept_weight);
    }
    pixel_irradiance[index] = old_sum + no_samples;
#else
    pixel_irradiance[index] = no_samples;
#endif
}
