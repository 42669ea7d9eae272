// SPDX-License-Identifier: Apache-2.0
// The solution before any transfer: every patch sends what it emits.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_RADIANCE) writeonly buffer RadianceBuffer { vec4 radiance[]; };
uniform uint patch_count;

void main() {
    uint i = linear_index();
    if (i < patch_count) {
        radiance[i] = vec4(surfaces[i].emission.rgb, 0.0);
    }
}
