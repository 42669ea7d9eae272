// SPDX-License-Identifier: Apache-2.0
// All surfaces of a parallel bundle: one list per window pixel (ch. 4.3.1, "software z-buffer").
#include "layouts.glsl"

layout(std430, binding = BINDING_LAYER_HEADS) buffer HeadBuffer { uint heads[]; };
layout(std430, binding = BINDING_LAYER_NODES) writeonly buffer NodeBuffer { LayerNode nodes[]; };
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_COUNTERS) buffer CounterBuffer { Counters counters; };
uniform uint first_triangle;
uniform uint window_width;
uniform float window_depth;  // m along the axis
uniform vec3 window_origin;
uniform vec3 window_x;  // one pixel
uniform vec3 window_y;
uniform vec3 window_z;  // unit
uniform uint patch_base;

/// Depth of the triangle's plane at the pixel's centre. The rasteriser's own depth is no substitute:
/// it snaps vertices to fractions of a pixel, which at a grazing angle shifts the depth by more than a
/// thin wall's thickness.
float plane_depth() {
    PatchGeometry g = patches[patch_base + (first_triangle + uint(gl_PrimitiveID))];
    float along = dot(g.normal, window_z);
    if (abs(along) < 1e-6) {
        return gl_FragCoord.z * window_depth;
    }
    vec3 point = window_origin + gl_FragCoord.x * window_x + gl_FragCoord.y * window_y;
    return (g.offset - dot(g.normal, point)) / along;
}

void main() {
    uint node = atomicAdd(counters.nodes, 1u);
    if (node >= uint(nodes.length())) {
        return;  // counted: the window is not transferred but drawn again with more nodes
    }
    uint pixel = uint(gl_FragCoord.y) * window_width + uint(gl_FragCoord.x);
    nodes[node].surface = (first_triangle + uint(gl_PrimitiveID)) * 2u + (gl_FrontFacing ? 0u : 1u);
    nodes[node].depth = plane_depth();
    nodes[node].next = atomicExchange(heads[pixel], node);
}
