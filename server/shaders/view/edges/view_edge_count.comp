// SPDX-License-Identifier: Apache-2.0
// Antialiasing of a viewer's picture at rest: whose surface one sub-sample of each pixel lies on. The pixel's
// own, another flat piece of it, or else the one that the nearest neighbour shows; where none does (something
// thinner than a pixel) it is a stranger.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
#include "scene_geometry.glsl"
#include "facets.glsl"
#include "side_seen.glsl"
#include "edge_counts.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
#include "view_place.glsl"
layout(binding = UNIT_SURFACE_IDS) uniform usampler2D surface_ids;  // at the sub-samples
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
layout(std430, binding = BINDING_EDGE_COUNTS) buffer EdgeCountBuffer { uint edge_counts[]; };
uniform vec3 offset;  // xy: of the sub-sample from the pixel's centre, pixels

// Penalties, squared pixels.
const float curved_on = 10.0;  // another piece of a curved surface: only where the very one is not around
const float different = 1e6;

/// Surface that a pixel shows: 2 * facet + side, or NO_HIT.
uint shown_surface(uint index) {
    uint facet = texelFetch(pixel_texels, int(2u * index + 1u)).w;
    return (facet & PIXEL_SKY) != 0u ? NO_HIT
                                     : 2u * (facet & PIXEL_FACET_MASK) + ((facet & PIXEL_BACK) != 0u ? 1u : 0u);
}

/// Plane of a surface, its normal on the side that is seen.
vec4 seen_plane(uint surface) { return facet_plane(surface >> 1) * ((surface & 1u) != 0u ? -1.0 : 1.0); }

/// Penalty of taking the light of a pixel for that of a surface.
float penalty(uint surface, uint index) {
    uint shown = shown_surface(index);
    if (shown == surface) {
        return 0.0;
    }
    if (shown == NO_HIT || surface == NO_HIT) {
        return different;
    }
    uint a = surface >> 1;
    uint b = shown >> 1;
    vec4 plane = seen_plane(surface);
    float turn = dot(plane.xyz, seen_plane(shown).xyz);
    vec3 position = uintBitsToFloat(texelFetch(pixel_texels, int(2u * index)).xyz);
    float pixel_width = 2.0 * length(view.up.xyz) / float(view.size.y) * dot(view.forward.xyz, position - view.eye.xyz);
    float apart = abs(dot(plane.xyz, position) - plane.w);
    bool one_surface = facet_object(a) == facet_object(b) && facet_material(a) == facet_material(b) && turn > 0.9 &&
                       apart < 2.0 * pixel_width;
    bool flat_on = turn > 0.9999 && apart < 0.1 * pixel_width;
    return !one_surface ? different : flat_on ? 0.0 : curved_on;
}

/// Neighbour that shows a surface and is nearest to the sub-sample, or 8 where that is the pixel itself.
uint neighbour_showing(uint surface, ivec2 at, float own_penalty) {
    vec2 away_from_own = place_in_pixel(uvec2(at)) - offset.xy;
    float least = min(own_penalty + dot(away_from_own, away_from_own), different);
    uint nearest = 8u;
    for (uint k = 0u; k < 8u; ++k) {
        ivec2 step_to = edge_neighbour(k);
        ivec2 beside = at + step_to;
        bool inside = all(greaterThanEqual(beside, ivec2(0))) && all(lessThan(beside, ivec2(view.size.xy)));
        uint index = inside ? uint(beside.y) * view.size.x + uint(beside.x) : 0u;
        vec2 away = vec2(step_to) + place_in_pixel(uvec2(max(beside, ivec2(0)))) - offset.xy;
        float cost = inside ? penalty(surface, index) + dot(away, away) : different;
        if (cost < least) {
            least = cost;
            nearest = k;
        }
    }
    return nearest;
}

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (at.x >= view.size.x || at.y >= view.size.y) {
        return;
    }
    uint index = at.y * view.size.x + at.x;
    uint surface = texelFetch(surface_ids, ivec2(at), 0).r;
    // A loop, not a branch: lanes without an edge skip it.
    RARELY(surface != shown_surface(index)) {
        float own_penalty = penalty(surface, index);
        uint k = own_penalty == 0.0 ? 8u : neighbour_showing(surface, ivec2(at), own_penalty);
        uint counts = edge_counts[2u * index];
        if (k < 8u && edge_count(counts, k) < 15u) {
            edge_counts[2u * index] = counts + (1u << (4u * k));
        } else if (k == 8u && own_penalty >= different && surface != NO_HIT) {
            uint met = side_seen(surface, view.eye.xyz, view_direction(at, offset.xy));
            if (met != NO_PATCH) {
                edge_counts[2u * index + 1u] = with_stranger(edge_counts[2u * index + 1u], met);
            }
        }
    }
}
