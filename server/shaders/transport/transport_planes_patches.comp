// SPDX-License-Identifier: Apache-2.0
// Plane parallel bundle to patches (ch. 4.3.1, "hardware z-buffer"): the nearest surfaces behind and ahead
// of a random plane see each other and exchange radiance both ways.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(binding = UNIT_SURFACE_IDS) uniform usampler2D surface_ids;
uniform uint run_columns;  // runs of run_length pixels a row
#define AS_RASTERISED
#include "parallel_runs.glsl"

uvec2 load_pair(ivec2 texel) {
    return uvec2(texelFetch(surface_ids, texel, 0).r,
                 texelFetch(surface_ids, texel + ivec2(0, bundle.resolution.y), 0).r);
}

void main() {
    if (linear_index() == 0u) {
        counters.overflowed = 0u;
    }
    // Neighbouring invocations take neighbouring rows: their runs end at nearly the same places.
    uint block = linear_index() >> 3;
    uint row_block = block / run_columns;
    uint row = row_stride * (row_block * 8u + (linear_index() & 7u)) + row_phase;
    if (row >= bundle.resolution.y) {
        return;
    }
    ivec2 texel = ivec2((block - row_block * run_columns) * run_length, row);
    int end = min(texel.x + int(run_length), int(bundle.resolution.x));
    exchange_row(texel, end);
}
