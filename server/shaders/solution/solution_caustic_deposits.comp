// SPDX-License-Identifier: Apache-2.0
// Flux of the patches that a batch of rays has met (solution/specular/caustics.h).
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_CAUSTIC_FLUX) writeonly buffer FluxBuffer { vec4 flux[]; };
layout(std430, binding = BINDING_CAUSTIC_DEPOSITS) readonly buffer DepositBuffer { vec4 deposits[]; };
uniform uint deposit_count;

void main() {
    uint i = linear_index();
    if (i < deposit_count) {
        flux[floatBitsToUint(deposits[i].w)] = vec4(deposits[i].rgb, 0.0);
    }
}
