// SPDX-License-Identifier: Apache-2.0
// All surfaces of a parallel bundle: one list per window pixel (ch. 4.3.1, "software z-buffer"). Depths
// are not kept: the planes of the facets give them where they are needed, and the rasteriser's own would
// not do: it snaps vertices to fractions of a pixel, which at a grazing angle shifts the depth by more
// than a thin wall's thickness.
#include "layouts.glsl"
#include "density.glsl"
#include "layers.glsl"
#ifdef ALPHA_MASK
layout(location = 0) in vec2 mesh_uv;
#include "alpha_mask.glsl"
#endif
#ifdef GLASS
uniform uint facet_base;
#include "glass.glsl"
#endif

layout(std430, binding = BINDING_COUNTERS) buffer CounterBuffer { Counters counters; };
uniform uint first_facet;

void main() {
    uint facet = first_facet + uint(gl_PrimitiveID);
#ifdef ALPHA_MASK
    if (!covered(facet, mesh_uv)) {
        return;
    }
#endif
#ifdef GLASS
    if (passes(facet, bundle.axis_z.xyz, uint(gl_FragCoord.y) << 16 | uint(gl_FragCoord.x))) {
        return;
    }
#endif
    uint pixel = uint(gl_FragCoord.y) * bundle.resolution.x + uint(gl_FragCoord.x);
    uint slot = atomicAdd(layer_counts[pixel], 1u);
    if (slot < layer_capacity()) {
        layer_surfaces[layer_slot(slot, pixel)] = facet * 2u + (gl_FrontFacing ? 0u : 1u);
    } else {  // the window is not transferred but drawn again with more room
        atomicMax(counters.layers, slot + 1u);
    }
}
