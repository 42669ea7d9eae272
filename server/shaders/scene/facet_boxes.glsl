// SPDX-License-Identifier: Apache-2.0
// The nearest facet that a ray meets, by the tree of boxes of solution/geometry/facet_boxes.h. Requires rarely.glsl and
// facets.glsl, and of the including shader uint facet_base of the present place. ALPHA_MASK: rays go through where nothing
// is (alpha_mask.glsl); GLASS: and through glass, as bundles do (glass.glsl, which requires density.glsl).
layout(binding = UNIT_FACET_BOXES) uniform samplerBuffer facet_box_texels;
#ifdef ALPHA_MASK
#include "alpha_mask.glsl"
layout(binding = UNIT_VERTEX_DATA) uniform usamplerBuffer vertex_data_texels;
layout(std430, binding = BINDING_FACET_INDICES) readonly buffer FacetIndexBuffer { uint facet_indices[]; };

vec2 corner_uv(uint facet, uint k) {
    return uintBitsToFloat(texelFetch(vertex_data_texels, int(2u * facet_indices[3u * facet + k])).zw);
}
#endif
#ifdef GLASS
#include "glass.glsl"
#endif

/// What a ray meets.
struct Met {
    uint facet;   // NO_HIT: nothing
    float ahead;  // m; of facets that coincide, the one that shows its front is nearer by the tie distance
    bool back;    // the facet's back is met
};

uint box_count() { return floatBitsToUint(texelFetch(facet_box_texels, 0).w); }

/// Whether there is something for a ray where it meets a facet. w1, w2: barycentric weights of corners 1 and 2.
bool is_there(uint facet, vec3 origin, vec3 direction, float w1, float w2) {
    bool there = true;
#ifdef ALPHA_MASK
    vec2 uv = corner_uv(facet, 0u) * (1.0 - w1 - w2) + corner_uv(facet, 1u) * w1 + corner_uv(facet, 2u) * w2;
    there = covered(facet, uv);
#endif
#ifdef GLASS
    uint line = floatBitsToUint(origin.x) ^ floatBitsToUint(origin.y) << 5 ^ floatBitsToUint(origin.z) << 9;
    there = there && !passes(facet, direction, line);
#endif
    return there;
}

/// Takes a facet where the ray meets it before what it has met so far.
void meet(uint facet, vec3 origin, vec3 direction, float tie, inout Met met) {
    vec4 plane = facet_plane(facet_base + facet);
    float approach = dot(plane.xyz, direction);
    float height = plane.w - dot(plane.xyz, origin);
    float distance = height / approach;
    bool back = approach > 0.0;
    float ahead = distance - (back ? 0.0 : tie);
    bool nearer = ahead < met.ahead || (ahead == met.ahead && facet < met.facet);
    RARELY(nearer && distance > 0.0 && abs(height) > tie) {
        const float rounding = 1e-5;  // of the weights: rays do not slip between neighbours
        int at = int(4u * (facet_base + facet));
        vec4 point = vec4(origin + distance * direction, 1.0);
        float w1 = dot(texelFetch(facet_texels, at + 1), point);
        float w2 = dot(texelFetch(facet_texels, at + 2), point);
        if (min(min(w1, w2), 1.0 - w1 - w2) >= -rounding && is_there(facet, origin, direction, w1, w2)) {
            met = Met(facet, ahead, back);
        }
    }
}

/// Nearest facet along a ray in world space that is nearer than `farthest`, m. tie: m, what is no higher above the
/// origin is at its own place and is not met.
Met nearest_facet(vec3 origin, vec3 direction, float farthest, float tie) {
    const float least = 1e-9;  // component of a direction, so that its inverse is finite
    Met met = Met(NO_HIT, farthest, false);
    vec3 slowness = 1.0 / mix(direction, vec3(least), lessThan(abs(direction), vec3(least)));
    uint end = box_count();
    for (uint node = 0u; node < end;) {
        vec4 low = texelFetch(facet_box_texels, int(2u * node));
        vec4 high = texelFetch(facet_box_texels, int(2u * node + 1u));
        vec3 a = (low.xyz - origin) * slowness;
        vec3 b = (high.xyz - origin) * slowness;
        vec3 entry = min(a, b);
        vec3 leave = max(a, b);
        float from = max(max(entry.x, entry.y), entry.z);
        float to = min(min(leave.x, leave.y), leave.z);
        bool passed = from > min(to, met.ahead + tie) || to < 0.0;
        uint facet = floatBitsToUint(high.w);
        RARELY(!passed && facet != NO_HIT) {
            meet(facet, origin, direction, tie, met);
        }
        node = passed ? floatBitsToUint(low.w) : node + 1u;
    }
    return met;
}
