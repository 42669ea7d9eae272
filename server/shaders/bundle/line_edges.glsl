// SPDX-License-Identifier: Apache-2.0
// Where a line of a layered bundle runs by the edges of surfaces, the rasteriser and the planes disagree by its rounding: a
// closed room would see the sky. Requires Hit, nth() and coincidence_range() of transport_layers_patches.comp.
#include "facet_boxes.glsl"

/// Shift of the line, in the window's plane, to where it meets a facet as far inside of an edge as it is outside; 0 where it
/// is inside. The rasteriser rounds corners to 1/256 pixel, so that lines just outside have fragments.
vec3 shift_inside(uint surface, vec4 plane, vec3 point, float depth) {
    int at = int(4u * (facet_base + facet_of(surface)));
    vec4 w1 = texelFetch(facet_texels, at + 1);
    vec4 w2 = texelFetch(facet_texels, at + 2);
    vec4 w0 = vec4(0.0, 0.0, 0.0, 1.0) - w1 - w2;
    vec4 meeting = vec4(point + depth * bundle.axis_z.xyz, 1.0);
    vec3 weights = vec3(dot(w0, meeting), dot(w1, meeting), dot(w2, meeting));
    float least = min(min(weights.x, weights.y), weights.z);
    vec3 gradient = least == weights.x ? w0.xyz : least == weights.y ? w1.xyz : w2.xyz;
    gradient -= plane.xyz * (dot(gradient, bundle.axis_z.xyz) / dot(plane.xyz, bundle.axis_z.xyz));
    vec3 shift = gradient * (-2.0 * least / max(dot(gradient, gradient), 1e-30));
    bool rounded = least < 0.0 && dot(shift, shift) < bundle.weights.z * bundle.weights.z / 4096.0;
    return rounded ? shift : vec3(0.0);
}

/// How much nearer a plane is where the line is shifted.
float rise(vec4 plane, vec3 shift) { return dot(plane.xyz, shift) / dot(plane.xyz, bundle.axis_z.xyz); }

/// Where two sides of a body or a room meet, planes cross. Just outside of their common edge they come in the wrong
/// order, and the inside of a closed room would see the sky: their order inside of the edge counts.
void order_at_edge(inout Hit a, inout Hit b, vec3 point) {
    bool close = faces_far(a.surface) != faces_far(b.surface) && b.depth - a.depth <= coincidence_range() &&
                 max(a.surface, b.surface) < turned_over;
    RARELY(close) {
        vec4 plane_a = facet_plane(facet_base + facet_of(a.surface));
        vec4 plane_b = facet_plane(facet_base + facet_of(b.surface));
        vec3 shift = shift_inside(b.surface, plane_b, point, b.depth);
        if (shift == vec3(0.0)) {
            shift = shift_inside(a.surface, plane_a, point, a.depth);
        }
        if (b.depth - rise(plane_b, shift) < a.depth - rise(plane_a, shift)) {
            Hit c = a;
            a = b;
            b = c;
        }
    }
}

/// Projection to the window's plane of how a weight of a facet changes along the facet.
vec3 along_window(vec3 gradient, vec4 plane) {
    return gradient - plane.xyz * (dot(gradient, bundle.axis_z.xyz) / dot(plane.xyz, bundle.axis_z.xyz));
}

/// Surface that is in the way from where a line meets a facet, looking far or near, if that is so close to an edge that the
/// rasteriser may have missed what begins there: sides that meet need not have the same corners. NO_HIT: none.
uint missed_surface(uint surface, vec3 point, bool far) {
    vec4 plane = facet_plane(facet_base + facet_of(surface));
    int at = int(4u * (facet_base + facet_of(surface)));
    vec4 w1 = texelFetch(facet_texels, at + 1);
    vec4 w2 = texelFetch(facet_texels, at + 2);
    vec4 meeting = vec4(point + plane_depth(plane, point) * bundle.axis_z.xyz, 1.0);
    vec3 h1 = along_window(w1.xyz, plane);
    vec3 h2 = along_window(w2.xyz, plane);
    vec3 h0 = -h1 - h2;
    vec3 weights = vec3(0.0, dot(w1, meeting), dot(w2, meeting));
    weights.x = 1.0 - weights.y - weights.z;
    vec3 lengths = max(vec3(length(h0), length(h1), length(h2)), 1e-30);
    vec3 inside = weights / lengths;  // m
    float least = min(min(inside.x, inside.y), inside.z);
    float rounding = bundle.weights.z / 64.0;  // twice what two corners may be off by
    uint found = NO_HIT;
    RARELY(abs(least) < rounding) {
        vec3 inward = least == inside.x ? h0 / lengths.x : least == inside.y ? h1 / lengths.y : h2 / lengths.z;
        vec3 shift = inward * (rounding - least);
        shift -= bundle.axis_z.xyz * (dot(plane.xyz, shift) / dot(plane.xyz, bundle.axis_z.xyz));
        vec3 direction = far ? bundle.axis_z.xyz : -bundle.axis_z.xyz;
        Met met = nearest_facet(meeting.xyz + shift, direction, beyond_all, bundle.sky.w);
        found = met.facet == NO_HIT ? NO_HIT : 2u * met.facet + (met.back == far ? 0u : 1u);
    }
    return found;
}

/// Puts what the rasteriser has missed at the ends of a line that see the sky. Objects are at their present places.
void add_missed(inout uvec4 sorted, inout uint count, vec3 point) {
    uint first = sorted.x;
    uint last = nth(sorted, int(count) - 1);
    bool sees_near = count > 0u && count < 4u && !faces_far(first) && first < turned_over;
    bool sees_far = count > 0u && count < 4u && faces_far(last) && last < turned_over;
    uint ahead = NO_HIT;
    RARELY(sees_far) {
        ahead = missed_surface(last, point, true);
    }
    if (ahead != NO_HIT) {
        sorted = count == 1u ? uvec4(first, ahead, NO_HIT, NO_HIT)
                             : count == 2u ? uvec4(sorted.xy, ahead, NO_HIT) : uvec4(sorted.xyz, ahead);
        ++count;
    }
    uint behind = NO_HIT;
    RARELY(sees_near && count < 4u) {
        behind = missed_surface(first, point, false);
    }
    if (behind != NO_HIT) {
        sorted = uvec4(behind, sorted.xyz);
        ++count;
    }
}
