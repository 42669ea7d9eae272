// SPDX-License-Identifier: Apache-2.0
// Sorts every pixel's list by depth; surfaces that coincide (closer than the tie distance) are ordered
// so that the one facing the window comes first: then a thin wall is a wall, not a gap that two
// surfaces exchange light through (ch. 4.3.1, figure 4.4). Ties beyond that break by surface number,
// so that the order in which fragments arrived never shows.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "density.glsl"
#include "scene_geometry.glsl"
#include "layers.glsl"
layout(std430, binding = BINDING_COUNTERS) buffer CounterBuffer { Counters counters; };
uniform uint first_column;
uniform uint first_row;
uniform uint columns;
uniform uint rows;
uniform uint patch_base;  // of the place that was drawn
uniform uint slot;  // of the iteration in its group

bool before(uint a, uint b) {
    float da = nodes[a].depth;
    float db = nodes[b].depth;
    return da != db ? da < db : nodes[a].surface < nodes[b].surface;
}

/// Insertion sort of a linked list; returns its first node.
uint sort_list(uint head) {
    uint sorted = NO_NODE;
    while (head != NO_NODE) {
        uint node = head;
        head = nodes[node].next;
        if (sorted == NO_NODE || before(node, sorted)) {
            nodes[node].next = sorted;
            sorted = node;
            continue;
        }
        uint at = sorted;
        uint next = nodes[at].next;
        while (next != NO_NODE && before(next, node)) {
            at = next;
            next = nodes[at].next;
        }
        nodes[node].next = next;
        nodes[at].next = node;
    }
    return sorted;
}

/// True where two surfaces are one plane, back to back. Rasterised depths cannot tell: seen at a
/// grazing angle they err by many times the thickness of a thin wall. The planes themselves can.
bool coincide(uint surface_a, uint surface_b) {
    vec4 a = patch_plane(patch_base + (surface_a >> 1));
    vec4 b = patch_plane(patch_base + (surface_b >> 1));
    return dot(a.xyz, b.xyz) < -0.999999 && abs(a.w + b.w) <= bundle.sky.w;
}

/// Within each cluster of coinciding surfaces moves those that face the window to the front.
void order_coincident(uint head) {
    for (uint node = head; node != NO_NODE; node = nodes[node].next) {
        if (!faces_far(nodes[node].surface)) {
            continue;
        }
        float limit = nodes[node].depth + 16.0 * bundle.weights.z;
        for (uint other = nodes[node].next; other != NO_NODE && nodes[other].depth <= limit;
             other = nodes[other].next) {
            if (!faces_far(nodes[other].surface) && coincide(nodes[node].surface, nodes[other].surface)) {
                uint surface = nodes[node].surface;
                nodes[node].surface = nodes[other].surface;
                nodes[other].surface = surface;
                break;
            }
        }
    }
}

void main() {
    uint row = gl_GlobalInvocationID.x / columns;
    if (gl_GlobalInvocationID.x == 0u) {
        bool overflowed = counters.nodes > uint(nodes.length());
        counters.overflowed = overflowed ? 1u : 0u;
        if (overflowed) {
            counters.wanted = max(counters.wanted, counters.nodes);
            counters.overflow_mask |= 1u << slot;
        }
    }
    if (row >= rows || counters.nodes > uint(nodes.length())) {
        return;
    }
    uint pixel = (first_row + row) * bundle.resolution.x + first_column +
                 (gl_GlobalInvocationID.x - row * columns);
    uint head = heads[pixel];
    if (head == NO_NODE) {
        return;
    }
    head = sort_list(head);
#ifdef THIN_WALLS
    order_coincident(head);
#endif
    heads[pixel] = head;
}
