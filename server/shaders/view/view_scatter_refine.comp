// SPDX-License-Identifier: Apache-2.0
// The scatter of a picture's samples as a finer picture of the same view goes on with it: each of its probe pixels takes
// the sums of the coarser probe that it lies beside.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_FRAME) readonly buffer CoarseScatterBuffer { float coarse_scatter[]; };
layout(std430, binding = BINDING_PIXEL_SCATTER) writeonly buffer PixelScatterBuffer { float pixel_scatter[]; };
uniform uint factor;         // pixels along an edge that each was divided into
uniform uint probes;         // of the finer picture
uniform uint probe_columns;  // likewise
uniform uint coarse_columns;
uniform uint coarse_rows;

void main() {
    uint probe = linear_index();
    if (probe >= probes) {
        return;
    }
    uvec2 at = uvec2(probe % probe_columns, probe / probe_columns) / factor;
    at = min(at, uvec2(coarse_columns, coarse_rows) - 1u);
    uint coarse = at.y * coarse_columns + at.x;
    for (uint i = 0u; i < SCATTER_SUMS; ++i) {
        pixel_scatter[SCATTER_SUMS * probe + i] = coarse_scatter[SCATTER_SUMS * coarse + i];
    }
}
