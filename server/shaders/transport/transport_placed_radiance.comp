// SPDX-License-Identifier: Apache-2.0
// Radiance of all patches with the selection densities p_j / A_j that they have at one place, where an object has
// another size there.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "power.glsl"
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;
layout(std430, binding = BINDING_SENT) writeonly buffer SentBuffer { vec4 sent[]; };
uniform uint patch_count;
uniform uint patch_base;  // of the place that is drawn

void main() {
    uint i = linear_index();
    if (i < patch_count) {
        vec4 texel = texelFetch(radiance_texels, int(i));
        sent[i] = vec4(texel.rgb, density_at(patch_base + i, larger_place(i), texel.w));
    }
}
