// SPDX-License-Identifier: Apache-2.0
// What every patch sends whatever bundles bring, as flux per area, for the start of a solve: zones/first_reflection.h.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_COMPLETION) writeonly buffer CompletionBuffer { vec4 emitted[]; };
#include "patch_source.glsl"
uniform uint patch_count;

const float pi = 3.14159265359;

void main() {
    uint i = linear_index();
    if (i < patch_count) {
        emitted[i] = vec4(pi * patch_source(i), 0.0);
    }
}
