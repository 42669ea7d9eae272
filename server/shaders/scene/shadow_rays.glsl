// SPDX-License-Identifier: Apache-2.0
// Rays to punctual lights, through the tree of boxes round all facets. Requires rarely.glsl and facets.glsl. Objects are at
// their present places. Punctual lights shine through glass, since solution/specular/caustic_rays.h knows what of it arrives.
#ifndef CLEAR_GLASS
#define CLEAR_GLASS 1
#endif
const uint facet_base = 0u;
#include "facet_boxes.glsl"

/// Whether a facet is in the way from a point to a light. to_light: from the point; its length is the distance, or without
/// limit where `distant`. tie: m, what is no higher above the point belongs to its surface.
bool is_in_the_way(uint index, vec3 position, vec3 to_light, bool distant, float tie) {
    vec4 plane = facet_plane(index);
    float height = dot(plane.xyz, position) - plane.w;
    float rise = dot(plane.xyz, to_light);
    const float at_light = 1.0 - 1e-6;  // lamps may have a surface where their light is
    bool hides = false;
    RARELY(abs(height) > tie && height * rise < 0.0 && (distant || abs(rise) * at_light > abs(height))) {
        vec4 meeting = vec4(position - to_light * (height / rise), 1.0);
        float w1 = dot(texelFetch(facet_texels, int(4u * index + 1u)), meeting);
        float w2 = dot(texelFetch(facet_texels, int(4u * index + 2u)), meeting);
        const float rim = 1e-5;
        hides = min(min(w1, w2), 1.0 - w1 - w2) >= -rim && is_there(index, position, to_light, w1, w2);
    }
    return hides;
}

/// Whether any facet but the point's own is in the way.
bool is_hidden(vec3 position, vec3 to_light, bool distant, uint own_facet, float tie) {
    const float least = 1e-9;  // component of a direction, so that its inverse is finite
    vec3 slowness = 1.0 / mix(to_light, vec3(least), lessThan(abs(to_light), vec3(least)));
    float farthest = distant ? 1e30 : 1.0;
    uint end = box_count();
    bool hidden = false;
    for (uint node = 0u; node < end;) {
        vec4 low = texelFetch(facet_box_texels, int(2u * node));
        vec4 high = texelFetch(facet_box_texels, int(2u * node + 1u));
        vec3 a = (low.xyz - position) * slowness;
        vec3 b = (high.xyz - position) * slowness;
        vec3 entry = min(a, b);
        vec3 leave = max(a, b);
        float from = max(max(entry.x, entry.y), entry.z);
        float to = min(min(leave.x, leave.y), leave.z);
        bool passed = from > min(to, farthest) || to < 0.0;
        uint facet = floatBitsToUint(high.w);
        RARELY(!passed && facet != NO_HIT && facet != own_facet) {
            hidden = is_in_the_way(facet, position, to_light, distant, tie);
        }
        node = hidden ? end : passed ? floatBitsToUint(low.w) : node + 1u;
    }
    return hidden;
}
