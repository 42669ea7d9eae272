// SPDX-License-Identifier: Apache-2.0
// Puts the iterate to the levels of its zones (zones/zone_levels.h), before solution_power_sum.comp, where patches look
// at the iterate of others (TRANSMISSION).
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_SOURCE) buffer SourceBuffer { vec4 source[]; };
#include "zone_level.glsl"
uniform uint patch_count;

void main() {
    uint i = linear_index();
    if (i < patch_count) {
        source[i].rgb = levelled(i, source[i].rgb);
    }
}
