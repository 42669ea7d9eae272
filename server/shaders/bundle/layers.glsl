// SPDX-License-Identifier: Apache-2.0
// The surface lists of a parallel bundle, in no order.
#include "parallel.glsl"

layout(std430, binding = BINDING_LAYER_COUNTS) buffer CountBuffer { uint layer_counts[]; };
layout(std430, binding = BINDING_LAYER_SURFACES) buffer SurfaceListBuffer { uint layer_surfaces[]; };

/// Place of the k-th surface of a pixel's line: the first four lie together, the others apart.
uint layer_slot(uint k, uint pixel) {
    return k < 4u ? 4u * pixel + k : k * bundle.resolution.x * bundle.resolution.y + pixel;
}

/// Surfaces that a pixel has room for.
uint layer_capacity() { return bundle.resolution.z; }

const float beyond_all = 1e30;
