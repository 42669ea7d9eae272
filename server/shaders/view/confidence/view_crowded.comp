// SPDX-License-Identifier: Apache-2.0
// Marks and lists the pixels that have other surfaces near them, in front of their own: those follow their own rays
// through a layered bundle (transport_layers_pixels.comp). For a range of the pixels at a time.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#define CROWDED_ACCESS
#include "crowded_pixels.glsl"
#include "facets.glsl"
#include "mesh.glsl"
layout(binding = UNIT_FACET_BOXES) uniform samplerBuffer facet_box_texels;
layout(std430, binding = BINDING_PIXELS) buffer PixelBuffer { uvec4 pixels[]; };
layout(std430, binding = BINDING_FACET_INDICES) readonly buffer FacetIndexBuffer { uint facet_indices[]; };
uniform uint first_pixel;
uniform uint end_pixel;
uniform float radius;  // m; 0: no pixel is crowded
uniform float tie;     // m: what is no higher above a surface belongs to it

vec3 facet_corner(uint facet, uint k) { return world_position(facet_indices[3u * facet + k]); }

float square_distance_to_edge(vec3 p, vec3 a, vec3 b) {
    vec3 along = b - a;
    float share = clamp(dot(p - a, along) / max(dot(along, along), 1e-30), 0.0, 1.0);
    vec3 offset = p - a - share * along;
    return dot(offset, offset);
}

/// Square of the distance of a point from a facet, m^2.
float square_distance(vec3 p, vec3 a, vec3 b, vec3 c, vec4 plane) {
    vec3 n = plane.xyz;
    bool inside = dot(cross(b - a, p - a), n) >= 0.0 && dot(cross(c - b, p - b), n) >= 0.0 &&
                  dot(cross(a - c, p - c), n) >= 0.0;
    float height = dot(n, p) - plane.w;
    float to_edges = min(min(square_distance_to_edge(p, a, b), square_distance_to_edge(p, b, c)),
                         square_distance_to_edge(p, c, a));
    return inside ? height * height : to_edges;
}

/// Whether a facet is near, and somewhere above the tangent plane.
bool crowds(uint facet, vec3 point, vec3 normal) {
    vec3 a = facet_corner(facet, 0u);
    vec3 b = facet_corner(facet, 1u);
    vec3 c = facet_corner(facet, 2u);
    float highest = max(max(dot(normal, a - point), dot(normal, b - point)), dot(normal, c - point));
    return highest > tie && square_distance(point, a, b, c, facet_plane(facet)) < radius * radius;
}

bool is_crowded(vec3 point, vec3 normal) {
    uint end = floatBitsToUint(texelFetch(facet_box_texels, 0).w);
    bool crowded = false;
    for (uint node = 0u; node < end;) {
        vec4 low = texelFetch(facet_box_texels, int(2u * node));
        vec4 high = texelFetch(facet_box_texels, int(2u * node + 1u));
        vec3 centre = 0.5 * (low.xyz + high.xyz) - point;
        vec3 half_sides = 0.5 * (high.xyz - low.xyz);
        vec3 gap = max(abs(centre) - half_sides, vec3(0.0));
        bool near = dot(gap, gap) < radius * radius && dot(normal, centre) + dot(abs(normal), half_sides) > tie;
        uint facet = floatBitsToUint(high.w);
        RARELY(near && facet != NO_HIT) {
            crowded = crowds(facet, point, normal);
        }
        node = near ? node + 1u : floatBitsToUint(low.w);
        node = crowded ? end : node;
    }
    return crowded;
}

void append(uint index) {
    uint k = atomicAdd(crowded_count, 1u);
    crowded_pixels[k] = index;
    if (k % CROWDED_GROUP == 0u) {
        uint groups = k / CROWDED_GROUP + 1u;
        atomicMax(crowded_command[0], min(groups, crowded_groups_a_row));
        atomicMax(crowded_command[1], (groups - 1u) / crowded_groups_a_row + 1u);
        crowded_command[2] = 1u;
    }
}

void main() {
    uint index = first_pixel + linear_index();
    uvec4 p = pixels[2u * min(index, end_pixel - 1u)];
    if (index >= end_pixel || p.w == NO_PATCH) {
        return;
    }
    uint facet = pixels[2u * index + 1u].w;
    vec3 normal = facet_plane(facet & PIXEL_FACET_MASK).xyz;
    normal = (facet & PIXEL_BACK) != 0u ? -normal : normal;
    bool crowded = is_crowded(uintBitsToFloat(p.xyz), normal);
    if (crowded) {
        append(index);
    }
    pixels[2u * index + 1u].w = crowded ? facet | PIXEL_CROWDED : facet & ~PIXEL_CROWDED;
}
